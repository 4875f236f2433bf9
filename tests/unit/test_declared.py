"""What files of figures and experiments say they need is read from them, and they are not run."""

from pathlib import Path

import pytest

from granugas.configuration import ConfigError
from granugas.declared import check_captions, experiments_in, runs_alone, studies_in, tables_in


def test_a_figure_says_what_it_draws(tmp_path: Path) -> None:
    (tmp_path / "cooling.py").write_text('import nothing\n\nSTUDIES = ("scan",)\n')
    (tmp_path / "both.py").write_text('STUDIES = ("scan", "elsewhere")\nEXPERIMENTS = ("tried",)\nTABLES = ("cost",)\n')
    (tmp_path / "overview.py").write_text("")
    (tmp_path / "_shared.py").write_text("")
    assert studies_in(tmp_path) == {"cooling": ("scan",), "both": ("scan", "elsewhere")}
    assert experiments_in(tmp_path, folder_of(tmp_path / "experiments", "tried.py")) == {"cooling": (), "both": ("tried",)}
    assert tables_in(tmp_path) == {"cooling": (), "both": ("cost",)}


def folder_of(folder: Path, *names: str) -> Path:
    folder.mkdir()
    for name in names:
        (folder / name).write_text("")
    return folder


def test_names_that_nothing_has_are_refused(tmp_path: Path) -> None:
    known = folder_of(tmp_path / "experiments", "bouncing.py")
    (tmp_path / "one.py").write_text('EXPERIMENTS = ("bounce",)\n')
    with pytest.raises(ConfigError, match=r"one\.py: EXPERIMENTS = 'bounce'.*did you mean bouncing\?"):
        experiments_in(tmp_path, known)
    (tmp_path / "one.py").write_text('STUDIES = ("scan")\n')
    with pytest.raises(ConfigError, match=r"one\.py: STUDIES = 'scan'.*with a comma: \(\"scan\",\)"):
        studies_in(tmp_path)


def test_a_figure_without_a_caption_is_refused(tmp_path: Path) -> None:
    figures, captions = folder_of(tmp_path / "figures", "one.py", "two.py"), folder_of(tmp_path / "report", "one.rst")
    with pytest.raises(ConfigError, match=r"report/two\.rst = .missing.: allowed is a file with the caption of the figure two"):
        check_captions(figures, captions)
    (captions / "two.rst").write_text("")
    check_captions(figures, captions)


def test_a_figure_that_does_not_say_its_studies_is_refused(tmp_path: Path) -> None:
    (tmp_path / "lost.py").write_text("x = 1\n")
    with pytest.raises(ConfigError, match=r"lost\.py: STUDIES"):
        studies_in(tmp_path)


def test_an_experiment_says_whether_it_times_something(tmp_path: Path) -> None:
    (tmp_path / "timed.py").write_text('ALONE = ("the time of a collision",)\n')
    (tmp_path / "counted.py").write_text("import nothing\n")
    assert runs_alone(tmp_path / "timed.py") and not runs_alone(tmp_path / "counted.py")
