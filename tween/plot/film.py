"""Films: a morph laid out on a canvas, frame by frame, for whoever draws it.

A film holds each shape on the way once, in pixels, and says which of them is shown when, and for how long:

    number    0   1   2  ...  k-2  k-1  k-2  ...  1   0
    seconds  rest  one / fps each  rest  one / fps each

What is drawn picture by picture has shapes evenly spaced on the clock.  What a player moves straight from one shape
to the next takes, where it can, those of a `tween.measuring.playback`, of the shapes as they are on the canvas: so
all that is played is verified.

Legend: ``k`` shapes, ``n`` vertices, ``j`` pictures shown; ``s`` the clock, from 0 to 1 on the way there; ``t`` time
of the morph.
"""

from collections.abc import Callable
from dataclasses import dataclass
from math import isfinite
from typing import Any, NamedTuple

import numpy as np
from matplotlib.colors import is_color_like, to_rgb, to_rgba
from numpy.typing import NDArray

from tween.choices import SIZES, STYLES, Style
from tween.colors import EDGE, INK, SOURCE, TARGET
from tween.easing import AnyEase, as_ease
from tween.errors import TweenError
from tween.measuring.playback import playback
from tween.morphing.morph import Morph
from tween.morphing.sequence import Sequence
from tween.plot.shapes import identity_colors

Color = tuple[int, int, int]

OPACITY = 0.45
"""Of one layer of a disk, unless a colour was chosen for it."""

_TOLERANCE = 2e-3  # of a shape's width, between the shapes of a playback: a pixel of 480
_MARGIN = 0.04  # of the longer side, on every side
"""Pixels of a side, least and most."""

_SLOWEST, _FASTEST = 0.1, 100  # frames a second
_LONGEST = 30  # seconds of rest; some formats cannot hold a minute
_WIDEST = 100  # pixels of an outline
_LIGHT_INK = "0.9"  # on dark backgrounds
_BARE = ("none", "transparent")
_BRIGHTNESS = (0.2126, 0.7152, 0.0722)  # of red, green and blue


@dataclass(frozen=True, eq=False)
class Film:
    """A morph on a canvas; made by `record`.

    Attributes
    ----------
    clock : ndarray of float64, shape (k,)
        When each shape is reached on the way there, as a fraction of its time.
    times : ndarray of float64, shape (k,)
        When in the morph each shape is.
    shapes : ndarray of float64, shape (k, n, 2)
        Pixels from the upper left corner, x to the right and y down.
    triangles : ndarray of int, shape (k, n-2, 3)
        In force at each shape; the rows keep their identity, and a flip changes one corner of each of its two rows.
    flips : ndarray of int, shape (k,)
        How many flips were done until each shape.
    fps, hold, way : float
        Frames a second; seconds of rest at the source and the target; seconds from one to the other.
    trouble : str
        Why straight motion between the shapes is not verified, where that was asked for and cannot be; otherwise empty.
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
    opacity : float
        Of one layer of the disk.
    line : float
        Width of the outline in pixels; 0 for none.
    transparent : bool
        Whether the canvas shows what lies behind it; its colour then counts for nothing.
    pictures : int or None
        How many of the shapes in order of appearance are shown; None for all.
    """

    clock: NDArray[np.float64]
    times: NDArray[np.float64]
    shapes: NDArray[np.float64]
    triangles: NDArray[np.int64]
    flips: NDArray[np.int64]
    fps: float
    hold: float
    way: float
    trouble: str
    there_and_back: bool
    width: int
    height: int
    style: Style
    colors: NDArray[np.int64]
    tints: NDArray[np.int64]
    background: Color
    ink: Color
    edge: Color
    opacity: float
    line: float
    transparent: bool
    pictures: int | None

    @property
    def numbers(self) -> NDArray[np.int64]:
        """The shapes in order of appearance, shape (j,)."""
        there = np.arange(len(self.times))
        return np.concatenate([there, there[-2::-1]])[: self.pictures] if self.there_and_back else there

    @property
    def seconds(self) -> NDArray[np.float64]:
        """How long each of those is shown, evenly spaced, shape (j,); as the film goes round, the source rests once."""
        seconds = np.full(len(self.numbers), 1 / self.fps)
        seconds[[0, len(self.times) - 1]] += self.hold
        return seconds


def record(
    m: Morph,
    frames: int = 60,
    fps: float = 25,
    size: int | tuple[int, int] = 480,
    style: Style = "triangles",
    ease: AnyEase = True,
    hold: float = 0.4,
    there_and_back: bool = True,
    background: str = "white",
    verified: bool = False,
    fill: str | None = None,
    stroke: str | None = None,
    width: float | None = None,
    pictures: int | None = None,
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
    ease : str, four float or bool
        How the motion spends its time, see `tween.easing.as_ease`; true for a slow start and a slow end.
    hold : float
        Seconds for which the source and the target rest, up to 30, besides their turn among the frames.
    there_and_back : bool
        Whether the frames run back to the source.
    background : colour
        Or "transparent".
    verified : bool
        Whether the shapes are those of a playback, straight motion between which is verified, rather than evenly
        spaced; they take the same time.  Where there is none they are evenly spaced, and `Film.trouble` says why.
    fill, stroke : colour, optional
        Of the disk and of its outline; "none" for no outline.  A colour of the disk may have an alpha; where layers
        overlap, it counts again.
    width : float, optional
        Of the outline, in pixels.
    pictures : int, optional
        How many of the shapes in order of appearance are shown.

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
    look = _look(m, style, background, fill, stroke, width)
    clock = np.linspace(0.0, 1.0, frames)
    stage = _Stage(m, ease, size, clock)
    trouble, lists = "", None
    if verified:
        try:
            played = playback(stage, _TOLERANCE)
            clock, lists = played.times, list(played.triangles)
        except TweenError as error:
            trouble = str(error)
    times = stage.eased(clock)
    flips = np.searchsorted([event.time for event in m.events], times, side="right")
    share = 1 - np.abs(2 * times - 1) if isinstance(m, Sequence) and m.loop else times
    return Film(
        clock=clock,
        times=times,
        shapes=stage.at(clock) * [1, -1],
        triangles=_steady(lists or [m.triangles_at(float(t)) for t in times]),
        flips=np.where(times > 0, flips, 0),
        fps=float(fps),
        hold=float(hold),
        way=(frames - 1) / float(fps),
        trouble=trouble,
        there_and_back=bool(there_and_back),
        width=stage.width,
        height=stage.height,
        style=style,
        colors=look.colors,
        tints=np.rint((1 - share[:, None]) * _bytes(look.tints[0]) + share[:, None] * _bytes(look.tints[1])).astype(
            int
        ),
        background=_color("white" if look.transparent else background),
        ink=_color(look.ink),
        edge=_color(EDGE),
        opacity=look.opacity,
        line=max(1.0, max(stage.width, stage.height) / 250) if look.line is None else look.line,
        transparent=look.transparent,
        pictures=pictures,
    )


class _Look(NamedTuple):
    """Colours, from those that were chosen."""

    colors: NDArray[np.int64]
    tints: tuple[str, str]
    ink: str
    opacity: float
    line: float | None
    transparent: bool


def _look(m: Morph, style: str, background: str, fill: Any, stroke: Any, width: Any) -> _Look:
    for name, value, right, expected in (
        ("fill", fill, fill is None or _is_color(fill), "a colour such as 'black' or '#00000080'"),
        (
            "stroke",
            stroke,
            stroke is None or stroke in _BARE or _is_color(stroke),
            "a colour such as 'black', or 'none'",
        ),
        ("width", width, width is None or (_number(width) and 0 < width <= _WIDEST), f"pixels, up to {_WIDEST}"),
    ):
        if not right:
            raise ValueError(f"{name} is {value!r}, expected {expected}")
    transparent = background in _BARE
    dark = not transparent and float(np.dot(to_rgb(background), _BRIGHTNESS)) < 0.4
    ink = stroke if stroke is not None and stroke not in _BARE else _LIGHT_INK if dark else INK
    chosen = fill if style != "outline" else stroke if stroke not in _BARE else None
    tints = (chosen, chosen) if chosen is not None else (SOURCE, TARGET)
    colors = np.rint(255 * identity_colors(m.source)[:, :3]).astype(np.int64)
    if fill is not None:
        colors = np.repeat(np.rint(_bytes(fill)).astype(np.int64)[None], len(colors), axis=0)
    opacity = OPACITY if fill is None else float(to_rgba(fill)[3])
    return _Look(colors, tints, ink, opacity, 0.0 if stroke in _BARE else width, transparent)


class _Stage:
    """A morph by the clock, in pixels with y upwards: below the upper left corner of the canvas y is negative."""

    def __init__(self, m: Morph, ease: AnyEase, size: int | tuple[int, int], clock: NDArray[np.float64]) -> None:
        self._m, self._ease = m, as_ease(ease)
        self._placed, self.width, self.height = _on_canvas(m.at(self.eased(clock)), size)
        self.events = [event._replace(time=self._uneased(event.time)) for event in m.events]

    def eased(self, s: NDArray[np.float64]) -> NDArray[np.float64]:
        return self._ease.at(s)

    def _uneased(self, t: float) -> float:
        return float(self._ease.when(np.array([t]))[0])

    def at(self, s: NDArray[np.float64]) -> NDArray[np.float64]:
        return self._placed(self._m.at(self.eased(s)))

    def triangles_at(self, s: float) -> NDArray[np.int64]:
        return self._m.triangles_at(float(self.eased(np.array([s]))[0]))


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
        ("background", background, _opaque(background), "a colour such as 'white' or '#fff7e0', or 'transparent'"),
    ):
        if not right:
            raise ValueError(f"{name} is {value!r}, expected {expected}")


def _whole(value: Any) -> bool:
    return isinstance(value, int | np.integer) and not isinstance(value, bool)


def _number(value: Any) -> bool:
    return (_whole(value) or isinstance(value, float | np.floating)) and isfinite(value)


def _is_color(value: Any) -> bool:
    return value not in _BARE and is_color_like(value)


def _opaque(value: Any) -> bool:
    return value in _BARE or (is_color_like(value) and to_rgba(value)[3] == 1)


def _bytes(color: str) -> NDArray[np.float64]:
    return 255 * np.array(to_rgb(color))


def _color(color: str) -> Color:
    red, green, blue = np.rint(_bytes(color)).astype(int).tolist()
    return red, green, blue


def _on_canvas(
    shapes: NDArray[np.float64], size: int | tuple[int, int]
) -> tuple[Callable[[NDArray[np.float64]], NDArray[np.float64]], int, int]:
    """What puts shapes on the canvas, all at one scale, and the width and height of it."""
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
    middle, center = 0.5 * (low + high), np.array([0.5 * width, -0.5 * height])
    return lambda shapes: (shapes - middle) * scale + center, width, height


def _steady(lists: list[NDArray[np.int64]]) -> NDArray[np.int64]:
    """The lists, the corners of each row turned so that as many as possible stay where they were."""
    steady = [lists[0]]
    for triangles in lists[1:]:
        turns = np.stack([np.roll(triangles, k, axis=1) for k in range(3)])
        kept = (turns == steady[-1]).sum(axis=2).argmax(axis=0)
        steady.append(turns[kept, np.arange(len(triangles))])
    return np.stack(steady)
