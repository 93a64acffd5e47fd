"""What a figure is: a function that draws it, the name of its file, where it belongs, and a caption.

A module of this package draws some figures and registers each with `drawing`.  All are saved as PNG, for reading,
and as PDF, for papers; beside them captions.json says what is seen, and drawn.json sums up what was drawn, in numbers
that do not depend on how matplotlib renders text.
"""

from collections.abc import Callable, Iterator
from typing import Any, NamedTuple

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.cm import ScalarMappable
from matplotlib.collections import Collection, PathCollection
from matplotlib.colors import to_rgba_array
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from matplotlib.quiver import Quiver
from matplotlib.spines import Spine
from matplotlib.text import Annotation, Text
from numpy.typing import NDArray

from experiments.store import save_figure
from tween import plot as draw

SEED = 20100
WIDTH = 7.2  # inches, the width of every figure


class Drawing(NamedTuple):
    """A figure: of what (such as "Figure 7" of the paper, or "ours"), what is seen, and how it is drawn."""

    name: str
    of: str
    caption: str
    make: Callable[[], Figure]


DRAWINGS: dict[str, Drawing] = {}


def drawing(name: str, of: str, caption: str) -> Callable[[Callable[[], Figure]], Callable[[], Figure]]:
    """Register a function that draws a figure."""

    def register(make: Callable[[], Figure]) -> Callable[[], Figure]:
        assert name not in DRAWINGS, f"two figures are called {name}"
        DRAWINGS[name] = Drawing(name, of, " ".join(caption.split()), make)
        return make

    return register


def drawn(figure: Figure) -> list[dict[str, Any]]:
    """Sum up what each axes shows: words, and count, mean and spread of coordinates, values and colours."""
    axes = [inner for ax in figure.axes for inner in (ax, *ax.child_axes)]
    parts = (figure, *figure.subfigs)
    texts = [text for part in parts for text in part.texts]  # the headings are among them
    texts += [text for part in parts for legend in part.legends for text in legend.get_texts()]
    return [*(_shown(ax) for ax in axes), {"texts": [text.get_text() for text in texts]}]


def _shown(ax: Any) -> dict[str, Any]:
    title = " | ".join(filter(None, (ax.get_title(loc=where) for where in ("left", "center", "right"))))
    legend = ax.get_legend().get_texts() if ax.get_legend() else []
    words = [text.get_text() for text in (*ax.texts, ax.xaxis.label, ax.yaxis.label, *legend)]
    shown: dict[str, Any] = {"title": title, "texts": [word for word in words if word]}
    for artist in ax.get_children():
        for kind, points in _data(artist, ax):
            shown[kind] = [*shown.get(kind, []), points]
    summaries = {k: _summary(np.concatenate(v)) for k, v in shown.items() if k not in ("title", "texts")}
    return {k: v for k, v in (shown | summaries).items() if v}


def _data(artist: Any, ax: Any) -> Iterator[tuple[str, NDArray[np.float64]]]:
    """The kind of an artist with its coordinates as the axes scales them, then its values and its colours."""
    if artist is ax.patch or isinstance(artist, Spine):
        return
    if isinstance(artist, Line2D):
        yield "lines", _scaled(artist.get_xydata(), artist.get_transform(), ax)
        yield "colors", _rgba(artist.get_color())
    elif isinstance(artist, Collection):
        yield "collections", _of_collection(artist, ax)
        yield "colors", np.concatenate([_rgba(artist.get_facecolor()), _rgba(artist.get_edgecolor())])
    elif isinstance(artist, Patch):
        yield "patches", _scaled(artist.get_path().vertices, artist.get_transform(), ax)
        yield "colors", np.concatenate([_rgba(artist.get_facecolor()), _rgba(artist.get_edgecolor())])
    elif isinstance(artist, Text) and artist in ax.texts:
        ends = [artist.xy, artist.xyann] if isinstance(artist, Annotation) else [artist.get_position()]
        yield "places", np.array(ends, dtype=np.float64)
    if isinstance(artist, ScalarMappable) and artist.get_array() is not None:
        values = np.ma.filled(np.ma.asarray(artist.get_array(), dtype=np.float64), np.nan).ravel()
        yield "values", np.column_stack([np.arange(len(values)), values])


def _of_collection(artist: Any, ax: Any) -> NDArray[np.float64]:
    """Where the markers of a scatter plot are; where arrows start and point; otherwise all corners."""
    if isinstance(artist, Quiver):
        return np.concatenate([artist.XY, np.column_stack([artist.U, artist.V])])
    if isinstance(artist, PathCollection):
        return _scaled(artist.get_offsets(), artist.get_offset_transform(), ax)
    corners = [np.empty((0, 2)), *(np.asarray(path.vertices) for path in artist.get_paths())]
    return _scaled(np.concatenate(corners), artist.get_transform(), ax)


def _scaled(points: Any, transform: Any, ax: Any) -> NDArray[np.float64]:
    """Data coordinates as the axes scales them, so that on a logarithmic axis small numbers count as much as large."""
    plain = np.asarray(np.ma.filled(np.ma.asarray(points, dtype=np.float64), np.nan)).reshape(-1, 2)
    scaled = np.where(transform.contains_branch_seperately(ax.transData), ax.transScale.transform(plain), plain)
    scaled[scaled <= -1000] = np.nan  # where matplotlib puts zero on a logarithmic axis
    return scaled


def _rgba(colors: Any) -> NDArray[np.float64]:
    return np.asarray(to_rgba_array(colors), dtype=np.float64).reshape(-1, 2)


def _summary(points: NDArray[np.float64]) -> list[float]:
    finite = points[np.isfinite(points).all(axis=1)]
    if not len(finite):
        return [len(points)]
    weights = 1 + np.arange(len(finite)) % 7  # so that an exchange of points is noticed
    moments = np.array([finite.mean(axis=0), finite.std(axis=0), weights @ finite / len(finite)])
    return [len(points), *_rounded(moments).ravel().tolist()]


def _rounded(moments: NDArray[np.float64]) -> NDArray[np.float64]:
    """Nine digits of the largest in each column: what cancels to next to nothing is nothing."""
    largest = np.maximum(np.abs(moments).max(axis=0), 1e-99)
    digits = (8 - np.floor(np.log10(largest))).astype(int)
    columns = [np.round(column, d) for column, d in zip(moments.T, digits.tolist(), strict=True)]
    return np.array(columns).T + 0.0  # no minus zero


def save(name: str) -> list[dict[str, Any]]:
    """Draw a figure and save it; returns its summary."""
    draw.use_style()
    figure = DRAWINGS[name].make()
    summary = drawn(figure)
    save_figure(figure, name)
    plt.close(figure)
    return summary
