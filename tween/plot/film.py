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

import numpy as np
from numpy.typing import NDArray

from tween.choices import Style
from tween.colors import EDGE
from tween.easing import AnyEase, as_ease
from tween.errors import TweenError
from tween.measuring.playback import playback
from tween.morphing.morph import Morph
from tween.morphing.sequence import Sequence
from tween.plot.look import Color, check_options, color, look

_TOLERANCE = 2e-3  # of a shape's width, between the shapes of a playback: a pixel of 480
_MARGIN = 0.04  # of the longer side, on every side


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
    check_options(m, frames, fps, size, style, hold, background)
    chosen = look(m.source, style, background, fill, stroke, width)
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
        colors=chosen.colors,
        tints=chosen.tints(share),
        background=chosen.background,
        ink=chosen.ink,
        edge=color(EDGE),
        opacity=chosen.opacity,
        line=max(1.0, max(stage.width, stage.height) / 250) if chosen.line is None else chosen.line,
        transparent=chosen.transparent,
        pictures=pictures,
    )


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
