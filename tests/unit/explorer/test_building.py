"""Which frames of which runs the page holds, and how it is put together; what it does is seen by `make test-pages`."""

import json
import logging
import re

import numpy as np
import pytest
from bands import FACTORS, made_up_run, source_of

from granugas.explorer import Source, building, write_explorer
from granugas.explorer.building import FRAMES, LEAST, SCRIPTS, WEIGHT, WORKER, Part, bundle, chosen_samples, page, share_out
from granugas.storage.dataset import read

TIMES = [0, *np.geomspace(0.01, 100, 60)]


def source(label):
    return Source(label, label, label, None)


def test_samples_lie_on_a_logarithmic_grid():
    times = np.array([0, *np.geomspace(5e-3, 446.6, 250)])
    chosen = chosen_samples(times, 40)
    assert len(chosen) == 40 and chosen[[0, 1, -1]].tolist() == [0, 1, 250]
    ratios = times[chosen[2:]] / times[chosen[1:-1]]
    assert ratios.max() / ratios.min() < 1.2
    linear = chosen_samples(np.linspace(0, 5, 5001), 40)
    assert linear[0] == 0 and linear[-1] == 5000 and 25 < len(linear) <= 40 and (np.diff(linear) > 0).all()


def test_samples_end_where_the_run_ends():
    times = np.where(np.arange(100) < 70, np.linspace(0, 9.9, 100), np.nan)
    assert chosen_samples(times, 20)[-1] == 69
    assert chosen_samples(times[:5], 20).tolist() == [0, 1, 2, 3, 4]


def test_runs_share_the_room():
    filmed, other = Part(source("filmed"), 251, 500_000, True), Part(source("other"), 101, 125_000, False)
    few = Part(source("few"), 10, 1000, False)
    shares = dict(share_out([filmed, other, few]))
    assert [shares[part.source] for part in (filmed, other, few)] == [40, 40, 10]  # 25 MB
    shares = dict(share_out([filmed, *[other._replace(source=source(f"{k}")) for k in range(6)]]))
    assert shares[filmed.source] == 36 and set(shares.values()) == {36, 12}
    crowded = [filmed, *[other._replace(source=source(f"{k}")) for k in range(20)]]
    shares = dict(share_out(crowded))
    assert shares[filmed.source] == WEIGHT * shares[source("0")] == 21
    total = sum(part.bytes * shares[part.source] for part in crowded)
    assert total <= building.LIMIT < total + 20 * 125_000 + 3 * 500_000


def test_what_is_too_large_is_left_out_and_said(caplog):
    huge, small = Part(source("huge"), 100, 8_000_000, True), Part(source("small"), 100, 1000, False)
    with caplog.at_level(logging.WARNING, "granugas"):
        assert share_out([huge, small]) == [(small.source, FRAMES)]
    assert [record.getMessage() for record in caplog.records] == ["huge: left out of the explorer, whose limit is 29 MB"]
    assert share_out([huge]) == [] and LEAST * huge.bytes > building.LIMIT


@pytest.fixture(scope="module")
def runs(tmp_path_factory):
    folder = tmp_path_factory.mktemp("runs")
    ended = made_up_run(10, TIMES, seed=2)
    ended["trajectory"] = ended["trajectory"].where(ended["time"] < 10)
    return [
        source_of(made_up_run(12, TIMES), folder, "filmed"),
        source_of(ended, folder, "ended, r = 0.8", factors=None, filmed=False),
    ]


def known_of(path):
    text = path.read_text()
    return json.loads(re.search(r'id="known">(.*?)</script>', text, re.S)[1]), text


def test_the_page_knows_its_runs(runs, tmp_path):
    write_explorer(runs, tmp_path / "explorer.html")
    known, text = known_of(tmp_path / "explorer.html")
    filmed, ended = known["runs"]
    assert filmed["label"] == "filmed" and filmed["n_particles"] == 144 and filmed["factors"] == [1.0, *FACTORS]
    assert filmed["colours"] == ["energy", "collision_frequency", "initial_height"] and ended["colours"] == ["initial_height"]
    assert len(filmed["frames"]) == FRAMES and filmed["frames"][-1]["time"] == pytest.approx(100)
    assert ended["frames"][-1]["time"] < 10 and ended["factors"] == [1.0] and ended["curves"] is None
    clusters, observed = read(runs[0].clusters), read(runs[0].run)
    np.testing.assert_array_equal(filmed["curves"]["cluster_count"], clusters["cluster_count"].values[:, 1:])
    times = [frame["time"] for frame in filmed["frames"]]
    np.testing.assert_array_equal(
        [frame["kinetic_energy"] for frame in filmed["frames"]], observed["kinetic_energy"].sel(time=times, method="nearest")
    )
    assert [*re.findall(r'id="(frame-\d+-\d+)"', text)] == [
        f"frame-{number}-{k}" for number, run in enumerate(known["runs"]) for k in range(len(run["frames"]))
    ]


def test_equal_runs_give_equal_pages(runs, tmp_path):
    for name in ("a.html", "b.html"):
        write_explorer(runs, tmp_path / name)
    assert (tmp_path / "a.html").read_bytes() == (tmp_path / "b.html").read_bytes()


def test_what_does_not_fit_is_refused(runs, tmp_path, monkeypatch):
    monkeypatch.setattr(building, "LIMIT", 1000)
    with pytest.raises(ValueError, match=r"explorer: none of 2 runs fits into 0\.001 MB"):
        write_explorer(runs, tmp_path / "explorer.html")
    assert not any(tmp_path.iterdir())


def test_a_label_cannot_end_the_script(runs, tmp_path):
    text = page([{"label": "</script><b>"}], [("frame-0-0", "abc=")])
    assert "</script><b>" not in text and '<script type="text/plain" id="frame-0-0">abc=</script>' in text
    assert "{{" not in text


@pytest.mark.parametrize("names", [SCRIPTS, WORKER])
def test_modules_become_one(names):
    """Nothing is imported or exported any more, all that they import stands above, and no name twice."""
    text = bundle(names)
    assert not re.search(r"^(import|export)\b", text, re.M)
    defined = re.findall(r"^(?:async )?(?:function|class|const|let) (\w+)", text, re.M)
    assert len(defined) == len(set(defined))
    for place, name in enumerate(names):
        imported = re.findall(r'^import .* from "\./(\w+)\.js";$', building._source(f"{name}.js"), re.M)
        assert set(imported) <= set(names[:place]), name
