"""What a figure is: a function that draws it, the name of its file, where it belongs, and a caption.

A module of this package draws some figures and registers each with `drawing`.  All are saved as PNG, for reading,
and as PDF, for papers; beside them captions.json says what is seen, and drawn.json sums up what was drawn, in numbers
that do not depend on how matplotlib renders text.
"""

from collections.abc import Callable
from typing import Any, NamedTuple

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import Collection
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from numpy.typing import NDArray

from experiments.store import FIGURES, save_figure, write_json
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
    """Sum up the artists of each axes: how many points they have, and mean and spread of their coordinates."""
    headings = [{"title": heading} for part in (figure, *figure.subfigs) if (heading := part.get_suptitle())]
    return headings + [
        {"title": " | ".join(filter(None, (ax.get_title(loc=where) for where in ("left", "center", "right"))))}
        | {kind: _summary(points) for kind, points in _points(ax).items() if len(points)}
        for ax in figure.axes
    ]


def _points(ax: Any) -> dict[str, NDArray[np.float64]]:
    """Data coordinates of lines, collections and patches."""
    found: dict[str, list[NDArray[np.float64]]] = {"lines": [], "collections": [], "patches": []}
    for artist in ax.get_children():
        if isinstance(artist, Line2D):
            found["lines"].append(np.asarray(artist.get_xydata(), dtype=np.float64))
        elif isinstance(artist, Collection):
            found["collections"].append(np.asarray(artist.get_offsets(), dtype=np.float64))
            found["collections"] += [np.asarray(path.vertices) for path in artist.get_paths()]
        elif isinstance(artist, Patch) and artist is not ax.patch:
            found["patches"].append(np.asarray(artist.get_path().vertices))
    return {kind: np.concatenate([np.empty((0, 2)), *points]) for kind, points in found.items()}


def _summary(points: NDArray[np.float64]) -> list[float]:
    finite = points[np.isfinite(points).all(axis=1)]
    weights = 1 + np.arange(len(finite)) % 7  # so that an exchange of points is noticed
    moments = [*finite.mean(axis=0), *finite.std(axis=0), *(weights @ finite / max(len(finite), 1))]
    return [len(points), *(float(f"{moment:.9g}") for moment in moments)]


def save_all() -> None:
    """Draw and save every figure, with captions.json and drawn.json."""
    draw.use_style()
    summaries = {}
    for name, (_, _, _, make) in sorted(DRAWINGS.items()):
        figure = make()
        summaries[name] = drawn(figure)
        print(f"figures: {save_figure(figure, name).name}")
        plt.close(figure)
    write_json(FIGURES / "drawn.json", summaries)
    captions = {name: {"of": d.of, "caption": d.caption} for name, d in sorted(DRAWINGS.items())}
    write_json(FIGURES / "captions.json", captions)
