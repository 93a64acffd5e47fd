"""How a film looks: its colours and its outline, from those that were chosen, and which choices there are."""

from math import isfinite
from typing import Any, NamedTuple

import numpy as np
from matplotlib.colors import is_color_like, to_rgb, to_rgba
from numpy.typing import NDArray

from tween.choices import SIZES, STYLES, Style
from tween.colors import INK, SOURCE, TARGET
from tween.geometry.triangulation import Triangulation
from tween.morphing.morph import Morph
from tween.plot.shapes import identity_colors

Color = tuple[int, int, int]

OPACITY = 0.45
"""Of one layer of a disk, unless a colour was chosen for it."""

_SLOWEST, _FASTEST = 0.1, 100  # frames a second
_LONGEST = 30  # seconds of rest; some formats cannot hold a minute
_WIDEST = 100  # pixels of an outline
_LIGHT_INK = "0.9"  # on dark backgrounds
_BRIGHTNESS = (0.2126, 0.7152, 0.0722)  # of red, green and blue


class Look(NamedTuple):
    """Colours, from those that were chosen; made by `look`.

    Attributes
    ----------
    colors : ndarray of int64, shape (n-2, 3)
        Red, green and blue of each triangle, 0 to 255.
    ends : tuple of str
        Colours of the whole shape at the source and at the target.
    background, ink : (int, int, int)
    opacity : float
        Of one layer of the disk.
    line : float or None
        Width of the outline in pixels, 0 for none; None where it was not chosen.
    transparent : bool
    """

    colors: NDArray[np.int64]
    ends: tuple[str, str]
    background: Color
    ink: Color
    opacity: float
    line: float | None
    transparent: bool

    def tints(self, share: NDArray[np.float64]) -> NDArray[np.int64]:
        """Return the colours of shapes at shares of the way from the source to the target.

        Parameters
        ----------
        share : ndarray of float64, shape (k,)

        Returns
        -------
        ndarray of int64, shape (k, 3)
        """
        mixed = (1 - share[:, None]) * _bytes(self.ends[0]) + share[:, None] * _bytes(self.ends[1])
        return np.rint(mixed).astype(np.int64)


def look(T: Triangulation, style: Style, background: str, fill: Any, stroke: Any, width: Any) -> Look:
    """Choose colours where none were chosen.

    Parameters
    ----------
    T : Triangulation
        The source.
    style : {"triangles", "outline", "fill"}
    background : colour
        Or "transparent".
    fill, stroke : colour or None
        Of the disk and of its outline; "none" for no outline.
    width : float or None
        Of the outline, in pixels.

    Returns
    -------
    Look

    Raises
    ------
    ValueError
        Where one is no colour or no width.

    Examples
    --------
    >>> T = Triangulation([[0, 0], [1, 0], [0, 1]], [[0, 1, 2]])
    >>> look(T, "fill", "white", "#ff000080", "none", None).ends, look(T, "fill", "black", None, None, None).ink
    (('#ff000080', '#ff000080'), (230, 230, 230))
    """
    bare = isinstance(stroke, str) and stroke == "none"
    for name, value, right, expected in (
        ("fill", fill, fill is None or _is_color(fill), "a colour such as 'black' or '#00000080'"),
        ("stroke", stroke, stroke is None or bare or _is_color(stroke), "a colour such as 'black', or 'none'"),
        ("width", width, width is None or (_number(width) and 0 < width <= _WIDEST), f"pixels, up to {_WIDEST}"),
    ):
        if not right:
            raise ValueError(f"{name} is {value!r}, expected {expected}")
    line, stroke = (0.0, None) if bare else (width, stroke)
    canvas = "white" if background == "transparent" else background
    dark = float(np.dot(to_rgb(canvas), _BRIGHTNESS)) < 0.4
    whole = stroke if style == "outline" else fill
    colors = np.rint(255 * identity_colors(T)[:, :3]).astype(np.int64)
    return Look(
        colors=colors if fill is None else np.tile(np.rint(_bytes(fill)).astype(np.int64), (len(colors), 1)),
        ends=(SOURCE, TARGET) if whole is None else (whole, whole),
        background=color(canvas),
        ink=color(stroke if stroke is not None else _LIGHT_INK if dark else INK),
        opacity=OPACITY if fill is None else float(to_rgba(fill)[3]),
        line=line,
        transparent=background == "transparent",
    )


def color(name: str) -> Color:
    """Return red, green and blue of a colour, 0 to 255.

    Parameters
    ----------
    name : colour

    Returns
    -------
    (int, int, int)

    Examples
    --------
    >>> color("#ff8000")
    (255, 128, 0)
    """
    red, green, blue = np.rint(_bytes(name)).astype(int).tolist()
    return red, green, blue


def check_options(m: Any, frames: Any, fps: Any, size: Any, style: Any, hold: Any, background: Any) -> None:
    """Name the option that is none, and what was expected.

    Parameters
    ----------
    m, frames, fps, size, style, hold, background
        As for `tween.plot.film.record`.

    Raises
    ------
    ValueError
        For the first one that is none.

    Examples
    --------
    >>> check_options(3, 2, 25, 480, "fill", 0.4, "white")
    Traceback (most recent call last):
    ...
    ValueError: m is <class 'int'>, expected a Morph, as tween.morph makes
    """
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
    return value != "none" and is_color_like(value)


def _opaque(value: Any) -> bool:
    return (isinstance(value, str) and value == "transparent") or (is_color_like(value) and to_rgba(value)[3] == 1)


def _bytes(name: str) -> NDArray[np.float64]:
    return 255 * np.array(to_rgb(name))
