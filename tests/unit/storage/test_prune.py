"""Files that no study names any more go, after a look at them; nothing else does."""

import fcntl
from pathlib import Path

import pytest
import yaml
from workflow.project import ROOT

from granugas import studies
from granugas.__main__ import main
from granugas.storage.prune import leftovers, listing, remove

SCHEMA = yaml.safe_load((ROOT / "workflow/schemas/config.schema.yaml").read_text())
STUDY = {
    "grid": {"n_particles": 42, "restitution": [0.9, 0.8]},
    "realizations": 2,
    "until": {"time": 0.1},
    "distance_factors": [1.1],
}
FOLDERS = {"runs": "nc", "states": "nc", "positions": "nc", "clusters": "nc", "checkpoints": "npz"}
OTHERS = ["studies/scan.nc", "figures/old.png", "logs/simulate/old.log", "runs/notes.txt", "claims.csv", "gallery/old.nc"]


@pytest.fixture
def here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder with a configuration, the files of its runs, and those of runs that it does not name."""
    config = {"output": "out", "studies": {"scan": STUDY}}
    (tmp_path / "config").mkdir()
    (tmp_path / "config/config.yaml").write_text(yaml.safe_dump(config))
    for folder, names in studies.load(config, SCHEMA).names().items():
        for name in [*names, "n42_old"]:
            _file(tmp_path / "out" / folder / f"{name}.{FOLDERS[folder]}")
    for name in OTHERS:
        _file(tmp_path / "out" / name)
    monkeypatch.chdir(tmp_path)
    return tmp_path / "out"


def _file(path: Path) -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(b"x" * 1000)


def files(folder: Path) -> set[str]:
    return {str(path.relative_to(folder)) for path in folder.rglob("*") if path.is_file() and path.name != ".lock"}


def prune(*words: str) -> int:
    return main(["prune", "--workflow", str(ROOT / "workflow"), *words])


OLD = {f"{folder}/n42_old.{suffix}" for folder, suffix in FOLDERS.items()}


def test_what_nobody_names_is_listed_and_removed(here, capsys):
    before = files(here)
    assert prune("--yes") == 0
    assert before - files(here) == OLD
    said = capsys.readouterr().out
    assert all(f"0.001 MB  out/{name}\n" in said for name in OLD)
    assert "0.005 MB in 5 files\n5 files removed." in said
    assert prune("--yes") == 0
    assert before - files(here) == OLD


def test_nothing_goes_unasked(here, capsys, monkeypatch):
    before = files(here)
    monkeypatch.setattr("sys.stdin.isatty", lambda: False, raising=False)
    assert prune() == 0
    assert "Nothing is removed: --yes removes them." in capsys.readouterr().out
    monkeypatch.setattr("sys.stdin.isatty", lambda: True, raising=False)
    for answer, removed in (("", set()), ("n", set()), ("yess", set()), ("y", OLD)):
        monkeypatch.setattr("builtins.input", lambda question, answer=answer: answer)
        assert prune() == 0
        assert before - files(here) == removed


def test_never_during_a_build(here, capsys):
    before = files(here)
    with open(here / ".lock", "w") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        assert prune("--yes") == 2
    assert "output = 'out': a build is writing there" in capsys.readouterr().err
    assert files(here) == before


def test_studies_of_overlays_keep_their_files(here, capsys):
    Path("mine.yaml").write_text(yaml.safe_dump({"studies": {"mine": STUDY | {"grid": {"n_particles": 7}}}}))
    own = studies.load({"studies": {"mine": STUDY | {"grid": {"n_particles": 7}}}}, SCHEMA).names()
    kept = {f"{folder}/{name}.{FOLDERS[folder]}" for folder, names in own.items() for name in names}
    for name in kept:
        _file(here / name)
    assert prune("--yes", "mine.yaml") == 0
    assert kept <= files(here) and not OLD & files(here)
    assert prune("--yes") == 0
    assert not kept & files(here)


def test_a_folder_without_results(here, capsys):
    Path("mine.yaml").write_text("output: elsewhere")
    assert prune("--yes", "mine.yaml") == 2
    assert "output = 'elsewhere': no such folder" in capsys.readouterr().err
    assert not Path("elsewhere").exists()


@pytest.mark.parametrize(("text", "said"), [("studies: {scan: {untl: {}}}", "did you mean until?"), ("a: [", "(no YAML)")])
def test_a_wrong_configuration_removes_nothing(here, capsys, text, said):
    before = files(here)
    Path("mine.yaml").write_text(text)
    assert prune("--yes", "mine.yaml") == 2
    assert said in capsys.readouterr().err
    assert files(here) == before


def test_hidden_files_stay(tmp_path):
    _file(tmp_path / "runs/.n42.nc.suspect")
    _file(tmp_path / "runs/.n42.nc")
    assert leftovers(tmp_path, dict.fromkeys(FOLDERS, ())) == []
    assert listing([]) == "     0.000 MB in 0 files"
    remove([tmp_path / "gone.nc"])
