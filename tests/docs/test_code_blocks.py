"""Every code block of the README and of the documentation runs, in a copy of the project."""

import shutil
from pathlib import Path

import matplotlib.pyplot as plt
import pytest
from docs.blocks import PAGES, blocks_of, copy_of_project, dry, outside_of_fences, run_page
from workflow.project import ROOT

START, NOTEBOOK = Path("docs/start.md"), Path("docs/first_result.md")
ELSEWHERE = {Path("docs/analyses.md"): "tests/unit/test_analyses.py"}
"""Pages that a test of their own runs, on a dataset of its own."""

HERE = [page for page in PAGES if page not in ELSEWHERE]
WITH_BLOCKS = [page for page in HERE if blocks_of((ROOT / page).read_text(encoding="utf-8"))]


@pytest.fixture(scope="module")
def begun(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The project after its page for beginners, which the others go on from."""
    plt.switch_backend("agg")
    folder = copy_of_project(tmp_path_factory.mktemp("clone"))
    run_page(START, folder)
    # the README looks at a study that a full run builds: here it is the small one, by that name
    shutil.copy(folder / "results/studies/my_first_sweep.nc", folder / "results/studies/cluster1999_large.nc")
    return folder


def test_the_first_sweep_is_there(begun):
    assert {path.name for path in begun.glob("results/figures/*.png")} >= {"study_my_first_sweep.png"}
    assert (begun / "run.nc").is_file()


@pytest.mark.parametrize("page", [page for page in WITH_BLOCKS if page not in (START, NOTEBOOK)], ids=str)
def test_the_blocks_of_a_page_run(page, begun):
    run_page(page, begun)
    plt.close("all")


def test_the_notebook_finds_what_it_says(begun):
    found = run_page(NOTEBOOK, begun)
    ratio, grown = found["ratio"], found["grown"]
    assert all(abs(ratio[r][:, 1] - 1).max() < 0.05 for r in ratio)  # at first all follow Haff's law
    ends = [ratio[r][:, -1].mean() for r in (0.95, 0.8, 0.5)]
    assert ends[0] > 1.2 and ends[1] > 5 * ends[0] and ends[2] > 2 * ends[1]
    assert grown[0.5] > 5 > 3 > grown[0.95]
    assert all(figure.axes for figure in map(plt.figure, plt.get_fignums())) and len(plt.get_fignums()) == 3
    plt.close("all")


def test_no_block_escapes():
    """An indented block, or a fence without a language, would not be run."""
    assert all(str(page) in (ROOT / test).read_text() for page, test in ELSEWHERE.items())
    for page in HERE:
        text = "\n" + (ROOT / page).read_text(encoding="utf-8")
        directives = text.count("\n```{") - text.count("\n```{code-cell}")
        assert "\n    " not in outside_of_fences(text), page
        assert text.count("\n```") == 2 * (len(blocks_of(text)) + directives), page


def test_a_page_in_which_everything_goes_wrong(tmp_path, monkeypatch):
    page = tmp_path / "page.md"
    monkeypatch.setattr("docs.blocks.ROOT", tmp_path)
    for text, error in (
        ("```python\nprint(1 / 0)\n```\n", ZeroDivisionError),
        ("```bash\nfalse\ntrue\n```\n", AssertionError),
        ("```yaml\na: 1\n```\n", AssertionError),
        ("<!-- dry run: it takes long -->\n```bash\nsleep 100\n```\n", AssertionError),
    ):
        page.write_text(text)
        with pytest.raises(error):
            run_page(Path("page.md"), tmp_path)
    page.write_text("```python\na = 1\n```\n\n<!-- only shown: no such module -->\n```python\nimport nothing\n```\n")
    assert run_page(Path("page.md"), tmp_path)["a"] == 1
    page.write_text("```yaml\n# new.yaml\na: 1\n```\n")
    run_page(Path("page.md"), tmp_path)
    assert (tmp_path / "new.yaml").read_text() == "# new.yaml\na: 1\n"


def test_dry_runs():
    assert dry("make figures") == "make --dry-run figures"
    assert dry("true\n.venv/bin/snakemake x \\\n    y") == "true\n.venv/bin/snakemake --dry-run x \\\n    y"
