"""The figures: what is drawn is what is committed, in numbers; captions, PNG and PDF belong to it.

How matplotlib renders a figure depends on its version and fonts; what it was told to draw does not.  So every
figure is drawn anew, and counts, words, and means and spreads of coordinates and colours are held against
results/figures/drawn.json.
"""

import json
from collections.abc import Callable, Iterator
from typing import Any, cast

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
import pytest
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.image import imread
from matplotlib.quiver import Quiver

from experiments.figures.everything import DRAWINGS, drawn, save_some
from experiments.store import FIGURES, RESULTS
from tween import plot

NAMES = sorted(DRAWINGS)
DRAWN = json.loads((FIGURES / "drawn.json").read_text(encoding="utf-8"))
CAPTIONS = json.loads((FIGURES / "captions.json").read_text(encoding="utf-8"))
# As a share of mean or spread, the larger.  Sines one unit in the last place off move no point by 1e-13 of the spread;
# the file holds nine digits.
RTOL = 1e-7


@pytest.fixture(autouse=True)
def style() -> Iterator[None]:
    """Draw in the project's style, on no screen, and leave the settings as they were."""
    plt.switch_backend("agg")
    with plt.rc_context():
        plot.use_style()
        yield
    plt.close("all")


def differences(expected: Any, got: Any, place: str = "figure") -> list[str]:
    """Name each place where two summaries of `drawn` differ."""
    if isinstance(expected, dict) and isinstance(got, dict):
        if list(expected) != list(got):
            return [f"{place} holds {list(got)}, expected {list(expected)}"]
        return [d for key in expected for d in differences(expected[key], got[key], f"{place}, {key}")]
    if not (isinstance(expected, list) and isinstance(got, list)):
        return [] if expected == got else [f"{place}: {got!r}, expected {expected!r}"]
    if len(expected) != len(got):
        return [f"{place}: {len(got)} entries, expected {len(expected)}"]
    if expected and all(isinstance(entry, int | float) for entry in expected):
        return _different_numbers(expected, got, place)
    pairs = enumerate(zip(expected, got, strict=True))
    return [d for i, (one, other) in pairs for d in differences(one, other, f"{place} {i}")]


def _different_numbers(expected: list[float], got: list[float], place: str) -> list[str]:
    """Compare a count and moments, those of x and of y in turn; each coordinate has a scale of its own."""
    if expected[0] != got[0]:
        return [f"{place}: {got[0]} points, expected {expected[0]}"]
    moments = np.array([expected[1:], got[1:]]).reshape(2, -1, 2)
    scale = np.abs(moments[0]).max(axis=0)
    off = np.abs(moments[1] - moments[0]) > RTOL * scale
    return [f"{place}: moments {got[1:]}, expected {expected[1:]}"] if off.any() else []


# Every figure


@pytest.mark.parametrize("name", NAMES)
def test_a_figure_is_drawn_as_committed(name: str) -> None:
    summary = json.loads(json.dumps(drawn(DRAWINGS[name].make())))
    assert differences(DRAWN[name], summary, name) == [], "`python -m experiments.figures` draws all figures anew"


@pytest.mark.parametrize("name", NAMES)
def test_a_figure_has_a_caption_a_png_and_a_pdf(name: str) -> None:
    assert CAPTIONS[name] == {"of": DRAWINGS[name].of, "caption": DRAWINGS[name].caption}
    assert CAPTIONS[name]["caption"].endswith((".", "?"))
    assert (FIGURES / f"{name}.pdf").read_bytes().startswith(b"%PDF")
    assert (FIGURES / f"{name}.png").exists()


@pytest.mark.parametrize("name", NAMES)
def test_a_picture_is_not_blank(name: str) -> None:
    picture = imread(FIGURES / f"{name}.png")[..., :3]
    assert min(picture.shape[:2]) > 100
    ink = np.flatnonzero((picture < 0.9).any(axis=2).any(axis=0))
    assert len(ink) > 0.1 * picture.shape[1], "ink in less than a tenth of the columns"


def test_the_folder_holds_the_registered_figures_and_no_others() -> None:
    assert sorted(DRAWN) == sorted(CAPTIONS) == NAMES
    for suffix in ("png", "pdf"):
        assert sorted(path.stem for path in FIGURES.glob(f"*.{suffix}")) == NAMES


@pytest.mark.parametrize("name", ["figure_04_interiors", "figure_08_linear_slide", "guarantee_paths"])
def test_a_film_leaves_no_side_empty(name: str) -> None:
    picture = imread(FIGURES / f"{name}.png")[..., :3]
    inked = np.flatnonzero((picture < 0.9).any(axis=2).any(axis=0))
    assert inked[0] < 0.05 * picture.shape[1]
    assert inked[-1] > 0.95 * picture.shape[1]


def test_a_choice_of_curves_is_a_part_of_the_supplement() -> None:
    for name in ("root_choice", "table_1_slide"):
        some, every = ([label.get_text() for label in _first(n).get_yticklabels()] for n in (name, f"{name}_all"))
        assert set(some) < set(every)
        assert (len(some), len(every)) == (14, 34)


def _first(name: str) -> Axes:
    return DRAWINGS[name].make().axes[0]


def test_every_claim_of_the_ledger_has_its_mark() -> None:
    words = [text.get_text() for ax in DRAWINGS["verdicts"].make().axes for text in ax.texts]
    ledger = pd.read_csv(RESULTS / "claims.csv")
    asked = ledger.kind == "open question"
    assert sum(word.endswith(" (open question)") for word in words) == asked.sum() == 3
    assert sorted(word.removesuffix(" (open question)") for word in words) == sorted(ledger.id.str.replace("-", " "))


def test_a_figure_that_is_none_is_refused_before_anything_is_drawn() -> None:
    with pytest.raises(ValueError, match=r"there is no figure figure_12; there are .*figure_01"):
        save_some(["verdicts", "figure_12"])


# The guard itself

X = np.linspace(0.0, 1.0, 500)


def small() -> Figure:
    """Return a figure with an artist of each kind that figures here are made of."""
    figure, (left, right, third) = plt.subplots(1, 3)
    left.set_title("3 flips")
    left.plot(X, X**2)
    left.hlines(X[:9], 0.0, 1.0)
    right.scatter(X, 1.0 - X)
    right.fill(X, np.sin(X))
    right.bar([1.0, 2.0], [3.0, 4.0])
    left.text(0.5, 0.5, "12 leaves")
    figure.suptitle("2 curves")
    third.set_xscale("log")
    third.scatter(10.0 ** (-12 * X), X)
    third.imshow(np.outer(X[:5], X[:5]), extent=(1e-9, 1e-3, 0.0, 1.0))
    third.quiver([1e-6], [0.5], [1.0], [0.0])
    return figure


def move_line(figure: Figure) -> None:
    line = figure.axes[0].lines[0]
    y = np.array(line.get_ydata())
    y[250] += 0.001
    line.set_ydata(y)


def move_segment(figure: Figure) -> None:
    vertices = figure.axes[0].collections[0].get_paths()[4].vertices
    np.asarray(vertices)[0, 0] += 0.001


def move_marker(figure: Figure) -> None:
    markers = figure.axes[1].collections[0]
    offsets = np.array(markers.get_offsets())
    offsets[250, 1] += 0.001
    markers.set_offsets(offsets)


def exchange_markers(figure: Figure) -> None:
    markers = figure.axes[1].collections[0]
    markers.set_offsets(np.array(markers.get_offsets())[::-1])


def move_corner(figure: Figure) -> None:
    np.asarray(figure.axes[1].patches[0].get_path().vertices)[250, 1] += 0.001


def drop_line(figure: Figure) -> None:
    figure.axes[0].lines[0].remove()


def drop_point(figure: Figure) -> None:
    line = figure.axes[0].lines[0]
    line.set_data(X[:-1], X[:-1] ** 2)


def add_line(figure: Figure) -> None:
    figure.axes[1].plot(X, X)


def retitle(figure: Figure) -> None:
    figure.axes[0].set_title("4 flips")


def recolor(figure: Figure) -> None:
    figure.axes[0].lines[0].set_color("red")


def retell(figure: Figure) -> None:
    figure.axes[0].texts[0].set_text("13 leaves")


def rename(figure: Figure) -> None:
    figure.suptitle("3 curves")


def double_a_small_value_on_a_logarithmic_axis(figure: Figure) -> None:
    markers = figure.axes[2].collections[0]
    offsets = np.array(markers.get_offsets())
    offsets[400, 0] *= 2
    markers.set_offsets(offsets)


def repaint(figure: Figure) -> None:
    figure.axes[2].images[0].set_data(np.outer(X[:5], X[1:6]))


def turn_arrow(figure: Figure) -> None:
    cast(Quiver, figure.axes[2].collections[1]).set_UVC([0.0], [1.0])


def drop_axes(figure: Figure) -> None:
    figure.axes[1].remove()


CHANGES = (
    move_line,
    move_segment,
    move_marker,
    exchange_markers,
    move_corner,
    drop_line,
    drop_point,
    add_line,
    retitle,
    recolor,
    retell,
    rename,
    double_a_small_value_on_a_logarithmic_axis,
    repaint,
    turn_arrow,
    drop_axes,
)


@pytest.mark.parametrize("change", CHANGES, ids=lambda change: change.__name__)
def test_a_change_of_a_single_datum_is_seen(change: Callable[[Figure], None]) -> None:
    before, figure = drawn(small()), small()
    assert differences(before, drawn(figure)) == []
    change(figure)
    assert differences(before, drawn(figure)) != []


def test_what_rounding_may_do_is_no_change() -> None:
    before, figure = drawn(small()), small()
    line = figure.axes[0].lines[0]
    line.set_ydata(np.asarray(line.get_ydata()) * (1 + 1e-12))
    assert differences(before, drawn(figure)) == []


@pytest.mark.parametrize("name", ["figure_03_dual_graphs", "table_1_slide"])
def test_a_moved_vertex_of_a_committed_figure_is_seen(name: str) -> None:
    figure = DRAWINGS[name].make()
    vertices = np.asarray(figure.axes[0].collections[0].get_paths()[0].vertices)
    vertices[0] += 0.1 * (1 + np.abs(vertices[0]))
    assert differences(DRAWN[name], drawn(figure)) != []
