"""Shapes as a person wishes for them, in the words of the browser, and files that were handed in.

    {"name": "loop"}                                a curve of the gallery, a letter, one given or handed in
    {"stroke": [[x, y], ...]}                       places of the pointer, in units of a field
    {"of": wish, "moved": [[vertex, x, y], ...]}    the same with vertices moved, to places of the field
    {"of": wish, "without": vertex}                 the same without a vertex
    {"of": wish, "mended": number}                  mended as suggested, see `.Explanation`

A wish says all that there is to say, so that what was done is undone by the wish before.
"""

import re
import tempfile
import warnings
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from tween import gallery
from tween.app.playground.hand_drawn import Shape, from_stroke, judge
from tween.errors import CurveError, FileError, NotUsedWarning, TweenError
from tween.geometry.curve import Curve
from tween.io.reading import read_curves

HINT = "Draw a closed curve here: press, go around, let go.  Or choose one above."
SUFFIXES = (".svg", ".geojson", ".json", ".csv", ".npz", ".npy")
"""Of files that may be handed in."""

MOST_VERTICES = 5000
"""Of a curve that is handed in: more could not be moved while one waits."""

_NOTHING = Shape(None, None, HINT)


def granted(wish: Mapping[str, Any], curves: Mapping[str, Curve], brief: bool = False) -> Shape:
    """Make the shape that a person wishes for.

    Parameters
    ----------
    wish : mapping
        See above.
    curves : mapping of str to Curve
        Those that were given or handed in.
    brief : bool
        As in `.judge`.

    Returns
    -------
    Shape
        Where it is none, `words` says why, and `broken` holds the points of one that was changed.

    Examples
    --------
    >>> loop = {"name": "loop"}
    >>> granted(loop, {}).words
    'Bounds an immersed disk. 86 vertices, 4 crossings, 1.7 × 10³³ triangulations.'
    >>> len(granted({"of": loop, "without": 3}, {}).curve)
    85
    """
    try:
        if "of" in wish:
            return _changed(wish, granted(wish["of"], curves, brief=brief and "mended" not in wish), brief)
        if "stroke" in wish:
            return judge(from_stroke(wish["stroke"]), drawn=True, brief=brief)
        name = str(wish.get("name", "draw"))
        return _NOTHING if name == "draw" else judge(_named(name, curves), brief=brief)
    except Exception as error:  # a person at a widget has no use for a traceback
        return _NOTHING._replace(words=in_words(error))


def _named(name: str, curves: Mapping[str, Curve]) -> Curve:
    if name in curves:
        return curves[name]
    return gallery.letter(name) if len(name) == 1 else gallery.curve(name)


def _changed(wish: Mapping[str, Any], base: Shape, brief: bool) -> Shape:
    if base.curve is None:
        return base
    if "mended" in wish:
        suggestions = base.explanation.suggestions if base.explanation is not None else ()
        return judge(suggestions[int(wish["mended"])].curve, base.drawn, base.placement, brief)
    points = base.curve.points.copy()
    if "without" in wish:
        points = np.delete(points, _vertex(wish["without"], len(points)), axis=0)
    for vertex, *place in wish.get("moved", []):
        points[_vertex(vertex, len(points))] = _place(base, place)
    try:
        shape = judge(points, base.drawn, base.placement, brief)
    except CurveError as error:  # what was changed is not lost by it
        return _NOTHING._replace(words=_sentence(error), placement=base.placement, drawn=base.drawn, broken=points)
    return shape._replace(moved="moved" in wish)


def _vertex(number: Any, n: int) -> int:
    if not isinstance(number, int) or not 0 <= number < n:
        raise CurveError(f"vertex is {number!r}, expected one of 0 to {n - 1}")
    return number


def _place(base: Shape, place: list[float]) -> NDArray[np.float64]:
    x, y = place
    return base.placement.back([[x, y]])[0]


def _sentence(error: Exception) -> str:
    text = in_words(error)
    return f"No curve: {text}."


def in_words(error: Exception) -> str:
    """Say what to tell a person about an error.

    Parameters
    ----------
    error : Exception

    Returns
    -------
    str

    Examples
    --------
    >>> in_words(FileError("there is no morph to save yet")), in_words(KeyError("kind"))
    ('there is no morph to save yet', "KeyError: 'kind'")
    """
    return str(error) if isinstance(error, TweenError | ValueError) else f"{type(error).__name__}: {error}"


def handed_in(name: str, data: bytes) -> tuple[dict[str, Curve], str]:
    """Read the curves of a file that was handed in.

    Parameters
    ----------
    name : str
        Of the file; its suffix decides on the format.
    data : bytes
        What it holds.

    Returns
    -------
    curves : dict of str to Curve
        By the name of the file, followed by their own where there are several.
    notes : str
        What of the file is not used; empty where there is nothing.

    Raises
    ------
    FileError, CurveError
        As `.read_curves`, in one line.

    Examples
    --------
    >>> curves, notes = handed_in("triangle.json", b"[[0, 0], [1, 0], [0, 1]]")
    >>> curves
    {'triangle.json': Curve(3 vertices, turning number 1)}
    """
    plain = re.sub(r"[^\w .()+-]", "_", name.replace("\\", "/").rpartition("/")[2])[-80:] or "file"
    with tempfile.TemporaryDirectory() as folder, warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always", NotUsedWarning)
        path = Path(folder) / plain
        path.write_bytes(data)
        try:
            curves = read_curves(path)
        except TweenError as error:
            raise type(error)(str(error).replace(f"{path}", plain)) from None
    for own, curve in curves.items():
        if len(curve) > MOST_VERTICES:
            most = f"more than the {MOST_VERTICES} of a playground; the command tween morph takes it"
            raise FileError(f"{plain}: curve {own[:40]!r} has {len(curve)} vertices, {most}")
    notes = "; ".join(str(warning.message).replace(f"{path}", plain) for warning in caught)
    if len(curves) == 1:
        return {plain: next(iter(curves.values()))}, notes
    return {f"{plain}: {own}": curve for own, curve in curves.items()}, notes
