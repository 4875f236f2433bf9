"""The style of the figures, numbers and tables in them, and how they are saved."""

import subprocess
import sys

import matplotlib as mpl
import numpy as np
import pytest
from matplotlib import style as matplotlib_style
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.colors import to_rgb
from matplotlib.figure import Figure

from granugas.plotting import style


@pytest.mark.parametrize("ending", ["png", "pdf", "svg"])
def test_equal_figures_give_equal_files(ending, tmp_path):
    for name in ("one", "two"):
        figure = Figure()
        figure.add_subplot(xscale="log", yscale="log").plot([1, 2, 4], [1, 8, 16])
        style.save(figure, tmp_path / "new" / f"{name}.{ending}")
    one, two = ((tmp_path / "new" / f"{name}.{ending}").read_bytes() for name in ("one", "two"))
    assert one == two
    assert b"Date" not in one and b"matplotlib.org" not in one[-500:]


def test_style_is_in_force_while_drawing_only():
    before = mpl.rcParams["xtick.direction"]
    drawn = style.styled(lambda data: mpl.rcParams["xtick.direction"])({})
    assert (before, drawn, mpl.rcParams["xtick.direction"]) == ("out", "in", "out")


def test_style_is_for_everybody():
    """No two colours of the cycle are as close in brightness and hue as grey prints or colour blindness confuse."""
    with matplotlib_style.context(style.STYLE):
        cycle = mpl.rcParams["axes.prop_cycle"].by_key()["color"]
    assert len(set(cycle)) == 7
    brightness = [np.dot([0.2126, 0.7152, 0.0722], to_rgb(colour)) for colour in style.shades(9)]
    assert (np.diff(brightness) > 0.03).all()


def test_pyplot_is_not_needed():
    code = "import sys, granugas.plotting.style; sys.exit('matplotlib.pyplot' in sys.modules)"
    assert subprocess.run([sys.executable, "-c", code]).returncode == 0


def test_numbers():
    assert [style.power_of_ten(t) for t in (0, 1e-12, 5e-4, 1.5e-3)] == [
        "$0$",
        "$10^{-12}$",
        r"$5\times10^{-4}$",
        r"$1.5\times10^{-3}$",
    ]


def test_text_tables_keep_inside_their_columns():
    cells = [["", "one", "two"], ["energy", "$E = 0.1250$", "$-$"], ["force", "$f = 1$", ""]]
    figure = style.styled(lambda _: style.text_table(cells, [1.2, 1.0, 0.8], ["a note"]))({})
    (axes,) = figure.axes
    FigureCanvasAgg(figure).draw()
    boxes = [text.get_window_extent().transformed(axes.transData.inverted()) for text in axes.texts]
    assert [text.get_text() for text in axes.texts] == [*(cell for row in cells for cell in row), "a note"]
    edges = np.array([0, 1.2, 2.2, 3.0])
    for k, box in enumerate(boxes[:-1]):
        assert edges[k % 3] <= box.x0 <= box.x1 <= edges[k % 3 + 1]
    middles = [(box.y0 + box.y1) / 2 for box in boxes]
    rules = [line.get_ydata()[0] for line in axes.lines]
    assert rules[0] < middles[1] < rules[1] < middles[4] < middles[7] < rules[2] < middles[-1] < axes.get_ylim()[0]
