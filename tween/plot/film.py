"""Films: a morph laid out on a canvas, frame by frame, for whoever draws it.

A film holds each shape on the way once, in pixels, and says which of them is shown when, and for how long:

    number    0   1   2  ...  k-2  k-1  k-2  ...  1   0
    seconds  rest  one / fps each  rest  one / fps each

Legend: ``k`` shapes, ``n`` vertices, ``j`` pictures shown; ``t`` time of the morph.
"""

from dataclasses import dataclass
from math import isfinite
from typing import Any

import numpy as np
from matplotlib.colors import is_color_like, to_rgb, to_rgba
from numpy.typing import NDArray

from tween.choices import SIZES, STYLES, Style
from tween.colors import EDGE, INK, SOURCE, TARGET
from tween.morphing.morph import Morph
from tween.plot.shapes import identity_colors

Color = tuple[int, int, int]

OPACITY = 0.45
"""Of one layer of a disk."""

_MARGIN = 0.04  # of the longer side, on every side
"""Pixels of a side, least and most."""

_SLOWEST, _FASTEST = 0.1, 100  # frames a second
_LONGEST = 30  # seconds of rest; some formats cannot hold a minute
_LIGHT_INK = "0.9"  # on dark backgrounds
_BRIGHTNESS = (0.2126, 0.7152, 0.0722)  # of red, green and blue


@dataclass(frozen=True, eq=False)
class Film:
    """A morph on a canvas; made by `record`.

    Attributes
    ----------
    times : ndarray of float64, shape (k,)
        When in the morph each shape is.
    shapes : ndarray of float64, shape (k, n, 2)
        Pixels from the upper left corner, x to the right and y down.
    triangles : ndarray of int, shape (k, n-2, 3)
        In force at each shape; the rows keep their identity, and a flip changes one corner of each of its two rows.
    flips : ndarray of int, shape (k,)
        How many flips were done until each shape.
    fps, hold : float
        Frames a second; seconds of rest at the source and the target.
    there_and_back : bool
    width, height : int
        Pixels.
    style : {"triangles", "outline", "fill"}
    colors : ndarray of int, shape (n-2, 3)
        Red, green and blue of each triangle, 0 to 255.
    tints : ndarray of int, shape (k, 3)
        Colour of each shape as a whole: the source's, the target's, and between.
    background, ink, edge : (int, int, int)
        Colours of the canvas, of outlines and of diagonals.
    """

    times: NDArray[np.float64]
    shapes: NDArray[np.float64]
    triangles: NDArray[np.int64]
    flips: NDArray[np.int64]
    fps: float
    hold: float
    there_and_back: bool
    width: int
    height: int
    style: Style
    colors: NDArray[np.int64]
    tints: NDArray[np.int64]
    background: Color
    ink: Color
    edge: Color

    @property
    def line(self) -> float:
        """Width of an outline in pixels."""
        return max(1.0, max(self.width, self.height) / 250)

    @property
    def numbers(self) -> NDArray[np.int64]:
        """The shapes in order of appearance, shape (j,)."""
        there = np.arange(len(self.times))
        return np.concatenate([there, there[-2::-1]]) if self.there_and_back else there

    @property
    def seconds(self) -> NDArray[np.float64]:
        """How long each of those is shown, shape (j,); the source rests at the start only, as the film goes round."""
        seconds = np.full(len(self.numbers), 1 / self.fps)
        seconds[[0, len(self.times) - 1]] += self.hold
        return seconds


def record(
    m: Morph,
    frames: int = 60,
    fps: float = 25,
    size: int | tuple[int, int] = 480,
    style: Style = "triangles",
    ease: bool = True,
    hold: float = 0.4,
    there_and_back: bool = True,
    background: str = "white",
) -> Film:
    """Lay out a morph on a canvas, all shapes at one scale.

    Parameters
    ----------
    m : Morph
    frames : int
        Shapes from the source to the target, both included, at least 2.
    fps : float
        Frames a second, from 0.1 to 100.
    size : int or (int, int)
        Pixels: of the longer side, the other being as long as the shapes need; or width and height.
    style : {"triangles", "outline", "fill"}
        Triangles coloured by identity, the curve alone, or the disk, the darker the more layers it has.
    ease : bool
        Whether the motion starts and ends slowly; otherwise the shapes are evenly spaced in time.
    hold : float
        Seconds for which the source and the target rest, up to 30, besides their turn among the frames.
    there_and_back : bool
        Whether the frames run back to the source.
    background : colour

    Returns
    -------
    Film

    Raises
    ------
    ValueError
        Where an option is none; the message names it and what was expected.

    Examples
    --------
    >>> from tween import gallery, morph, triangulate
    >>> T = triangulate(gallery.curve("ess"))
    >>> shown = record(morph(T, T.on_disk()), frames=10, size=200)
    >>> len(shown.times), len(shown.numbers), max(shown.width, shown.height)
    (10, 19, 200)
    """
    _check_options(m, frames, fps, size, style, hold, background)
    s = np.linspace(0.0, 1.0, frames)
    times = s * s * (3 - 2 * s) if ease else s
    shapes, width, height = _on_canvas(m.at(times), size)
    flips = np.searchsorted([event.time for event in m.events], times, side="right")
    dark = float(np.dot(to_rgb(background), _BRIGHTNESS)) < 0.4
    tints = (1 - times[:, None]) * _bytes(SOURCE) + times[:, None] * _bytes(TARGET)
    return Film(
        times=times,
        shapes=shapes,
        triangles=_steady([m.triangles_at(float(t)) for t in times]),
        flips=np.where(times > 0, flips, 0),
        fps=float(fps),
        hold=float(hold),
        there_and_back=bool(there_and_back),
        width=width,
        height=height,
        style=style,
        colors=np.rint(255 * identity_colors(m.source)[:, :3]).astype(np.int64),
        tints=np.rint(tints).astype(np.int64),
        background=_color(background),
        ink=_color(_LIGHT_INK if dark else INK),
        edge=_color(EDGE),
    )


def _check_options(m: Any, frames: Any, fps: Any, size: Any, style: Any, hold: Any, background: Any) -> None:
    """Name the option that is none, and what was expected."""
    low, high = SIZES
    sides = size if isinstance(size, tuple | list) and len(size) == 2 else (size,)
    for name, value, right, expected in (
        ("m", type(m), isinstance(m, Morph), "a Morph, as tween.morph makes"),
        ("frames", frames, _whole(frames) and frames >= 2, "a whole number, at least 2: the source and the target"),
        ("fps", fps, _number(fps) and _SLOWEST <= fps <= _FASTEST, f"a number from {_SLOWEST} to {_FASTEST}"),
        (
            "size",
            size,
            all(_whole(side) and low <= side <= high for side in sides),
            f"a whole number of pixels from {low} to {high}, or two of them",
        ),
        ("style", style, style in STYLES, f"one of {', '.join(STYLES)}"),
        ("hold", hold, _number(hold) and 0 <= hold <= _LONGEST, f"a number of seconds from 0 to {_LONGEST}"),
        ("background", background, _opaque(background), "a colour such as 'white' or '#fff7e0'"),
    ):
        if not right:
            raise ValueError(f"{name} is {value!r}, expected {expected}")


def _whole(value: Any) -> bool:
    return isinstance(value, int | np.integer) and not isinstance(value, bool)


def _number(value: Any) -> bool:
    return (_whole(value) or isinstance(value, float | np.floating)) and isfinite(value)


def _opaque(value: Any) -> bool:
    return is_color_like(value) and to_rgba(value)[3] == 1


def _bytes(color: str) -> NDArray[np.float64]:
    return 255 * np.array(to_rgb(color))


def _color(color: str) -> Color:
    red, green, blue = np.rint(_bytes(color)).astype(int).tolist()
    return red, green, blue


def _on_canvas(shapes: NDArray[np.float64], size: int | tuple[int, int]) -> tuple[NDArray[np.float64], int, int]:
    """Shapes in pixels, all at one scale, and the width and height of the canvas."""
    low, high = shapes.min(axis=(0, 1)), shapes.max(axis=(0, 1))
    extent = high - low
    if isinstance(size, tuple | list):
        width, height = int(size[0]), int(size[1])
        margin = _MARGIN * max(width, height)
    else:
        margin = _MARGIN * size
        sides = extent / extent.max() * (size - 2 * margin) + 2 * margin
        width, height = (2 * int(np.ceil(side / 2 - 1e-9)) if side < size else size for side in sides.tolist())
    scale = ((np.array([width, height]) - 2 * margin) / extent).min()
    middle = 0.5 * (low + high)
    return (shapes - middle) * [scale, -scale] + [0.5 * width, 0.5 * height], width, height


def _steady(lists: list[NDArray[np.int64]]) -> NDArray[np.int64]:
    """The lists, the corners of each row turned so that as many as possible stay where they were."""
    steady = [lists[0]]
    for triangles in lists[1:]:
        turns = np.stack([np.roll(triangles, k, axis=1) for k in range(3)])
        kept = (turns == steady[-1]).sum(axis=2).argmax(axis=0)
        steady.append(turns[kept, np.arange(len(triangles))])
    return np.stack(steady)
