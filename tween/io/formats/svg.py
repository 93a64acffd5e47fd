"""The outlines that an SVG drawing holds.

Coordinates are the drawing's user units with y turned upwards: y here is -y there, exactly.
"""

import io
import math
import re
from collections import Counter
from collections.abc import Iterator
from functools import lru_cache
from typing import Any, NamedTuple

import numpy as np
from defusedxml import DefusedXmlException
from defusedxml.ElementTree import iterparse
from numpy.typing import NDArray

from tween.errors import FileError
from tween.io.formats.content import Content, Outline, Pen
from tween.io.formats.svg_path import MOST_POINTS, checked, flattened, numbers, polygon, rectangle
from tween.plural import counted

MOST_ELEMENTS = 100_000
"""Elements that a drawing may hold; those that `use` repeats count each time."""

DEEPEST = 1000
"""Levels to which the elements of a drawing may be nested."""

_Floats = NDArray[np.float64]

_GROUPS = {"svg", "g", "a", "switch"}
_SHAPES = {"path", "polygon", "polyline", "rect", "circle", "ellipse"}
_UNITS = {"": 1, "px": 1, "pt": 4 / 3, "pc": 16, "in": 96, "cm": 96 / 2.54, "mm": 96 / 25.4, "Q": 96 / 101.6}
_LENGTH = re.compile(rf"\s*([-+.0-9eE]+?)({'|'.join(_UNITS)})\s*")
_CALL = re.compile(r"[ \t\r\n,]*([A-Za-z]+)[ \t\r\n]*\(([^()]*)\)")
_LOST = {"text": "text", "image": "image", "line": "line", "foreignObject": "embedded page", "style": "style sheet"}
_PEN = ("fill", "stroke", "stroke-width", "stroke-linecap", "stroke-linejoin", "stroke-miterlimit")


class _Shape(NamedTuple):
    """An element that draws, the transform and the style of all groups it stands in, and its name."""

    element: Any
    matrix: _Floats
    style: dict[str, str]
    name: str


def read_svg(data: bytes, tolerance: float | None = None) -> Content:
    """Find the outlines of a drawing, in its order.

    Parameters
    ----------
    data : bytes
        Of an SVG file.
    tolerance : float, optional
        How far flattened curves may lie from the true ones, in the drawing's units; by default
        `RELATIVE_TOLERANCE` of the larger side of each path.

    Returns
    -------
    Content
        Of a closed outline the last point equals the first.  A shape that `use` repeats goes by the id of the `use`.
        Each subpath of path "a", where it has several, is an outline "a.0", "a.1", ... of its own.  The centres of
        circles that have an id are marks.

    Raises
    ------
    FileError
        Saying what is wrong and in which element.

    Notes
    -----
    Paths, polygons, polylines, rectangles, circles and ellipses are read, with the transforms of their
    groups, and wherever `use` repeats them.  What is not drawn where it stands (definitions, clip paths) is passed
    over.  What is drawn and cannot be read, or is hidden, is counted as unused.  View boxes and style sheets are not
    applied.

    Examples
    --------
    >>> found = read_svg(b'<svg xmlns="http://www.w3.org/2000/svg"><path id="a" d="M0 0H2V-1Z"/></svg>')
    >>> found.outlines[0].points.tolist()
    [[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [0.0, 0.0]]
    """
    unused: Counter[str] = Counter()
    content = Content([], [], {})
    room = MOST_POINTS
    for k, shape in enumerate(list(_shapes(*_parsed(data), unused))):  # counted before any is made
        tag = _tag(shape.element)
        try:
            lines = flattened(_path_data(shape.element, tag), shape.matrix, tolerance, room)
            pen = _pen(shape)
        except FileError as error:
            label = repr(shape.name[:40]) if shape.name else f"(shape {k})"
            raise FileError(f"{tag} {label} {error}") from None
        room -= sum(map(len, lines))
        drawn = [line for line in lines if (line != line[0]).any()]
        unused["empty shape"] += not drawn
        several = bool(shape.name) and len(drawn) > 1
        content.outlines.extend(
            Outline(f"{shape.name}.{i}" if several else shape.name, line, pen) for i, line in enumerate(drawn)
        )
        if tag == "circle" and shape.name and drawn:
            content.marks[shape.name] = _middle(drawn[0])
    if not content.outlines:
        raise FileError(f"draws nothing, expected one of the elements {', '.join(sorted(_SHAPES))}")
    content.unused.extend(counted(number, what) for what, number in unused.items() if number)
    return content


def _middle(line: _Floats) -> tuple[float, float]:
    x, y = ((line.min(axis=0) + line.max(axis=0)) / 2).tolist()
    return x, y


def _pen(shape: _Shape) -> Pen:
    """How the outline is drawn, its width as wide as the transform makes it."""
    style = shape.style
    found = _LENGTH.fullmatch(style.get("stroke-width", "1"))
    widths = numbers(found[1]) if found else []
    scale = math.sqrt(abs(float(np.linalg.det(shape.matrix[:2, :2]))))
    width = widths[0] * _UNITS[found[2]] * scale if found and len(widths) == 1 else 0.0
    limits = numbers(style["stroke-miterlimit"]) if re.fullmatch("[0-9.]+", style.get("stroke-miterlimit", "")) else []
    stroked = style.get("stroke", "none") != "none"
    return Pen(
        width if stroked else 0.0,
        style.get("stroke-linecap", "butt"),
        style.get("stroke-linejoin", "miter"),
        limits[0] if limits else Pen().limit,
        alone=stroked and style.get("fill", "black") == "none",
    )


def elements(data: bytes) -> list[Any]:
    """List all elements of a drawing.

    Parameters
    ----------
    data : bytes
        Of an SVG file.

    Returns
    -------
    list of xml.etree.ElementTree.Element

    Raises
    ------
    FileError
        Where it is no SVG, or too large.
    """
    return list(_parsed(data)[0].iter())


def _parsed(data: bytes) -> tuple[Any, dict[str, Any]]:
    """The root of the drawing, and the elements that have an id."""
    root: Any = None
    by_id: dict[str, Any] = {}
    depth = count = 0
    try:
        for event, element in iterparse(io.BytesIO(data), events=("start", "end")):
            depth += 1 if event == "start" else -1
            count += event == "start"
            if depth > DEEPEST or count > MOST_ELEMENTS:
                raise FileError(f"has more than {DEEPEST} levels or {MOST_ELEMENTS} elements, expected a smaller one")
            root = element if root is None else root
            by_id.setdefault(element.get("id", ""), element)
    except DefusedXmlException:
        raise FileError("declares XML entities, which are not read; save it as plain SVG") from None
    except (SyntaxError, ValueError, LookupError) as error:
        if isinstance(error, FileError):
            raise
        raise FileError(f"is no XML, expected SVG: {error}") from None
    if _tag(root) != "svg":
        raise FileError(f"has the root element {_tag(root)[:40]!r}, expected 'svg'")
    return root, by_id


def _tag(element: Any) -> str:
    return str(element.tag.rpartition("}")[2])


def _shapes(root: Any, by_id: dict[str, Any], unused: Counter[str]) -> Iterator[_Shape]:
    """The elements that draw; what is drawn and cannot be read, or is hidden, is counted."""
    stack, visits = [_Shape(root, np.eye(3), {}, "")], 0
    while stack:
        element, matrix, style, name = stack.pop()
        visits += 1
        if visits > MOST_ELEMENTS:
            raise FileError(f"repeats elements by 'use' to more than {MOST_ELEMENTS}, expected fewer")
        tag, own = _tag(element), _declared(element)
        if own.get("display") == "none":
            unused["hidden element"] += tag in _GROUPS | _SHAPES | _LOST.keys() | {"use"}
            continue
        if tag in _LOST:
            unused[_LOST[tag]] += 1
        with np.errstate(all="ignore"):  # what is too large is refused where it meets a shape
            matrix = matrix @ _transform(element.get("transform", ""))
            if tag == "use":
                matrix = matrix @ _matrix("translate", [_length(element, "x"), _length(element, "y")])
        style = style | {key: own[key] for key in _PEN if own.get(key, "inherit") != "inherit"}
        if tag in _SHAPES:
            yield _Shape(element, matrix, style, name or element.get("id", ""))
        elif tag in _GROUPS:
            stack.extend(_Shape(child, matrix, style, "") for child in reversed(element))
        elif tag == "use":
            name = name or element.get("id", "")
            stack.extend(_Shape(child, matrix, style, name) for child in _repeated(element, by_id))


def _declared(element: Any) -> dict[str, str]:
    """Presentation attributes, and what the attribute style puts in their place."""
    declared = {key: value.strip() for key, value in element.attrib.items() if key in (*_PEN, "display")}
    for declaration in element.get("style", "").split(";"):
        key, _, value = declaration.partition(":")
        declared[key.strip()] = value.partition("!")[0].strip()
    return declared


def _repeated(use: Any, by_id: dict[str, Any]) -> list[Any]:
    reference = use.get("href") or use.get("{http://www.w3.org/1999/xlink}href") or ""
    target = by_id.get(reference[1:]) if reference.startswith("#") else None
    if target is None:
        raise FileError(f"has a 'use' of {reference[:40]!r}, expected '#' and the id of an element")
    return list(reversed(target)) if _tag(target) == "symbol" else [target]


@lru_cache(maxsize=64)
def _transform(text: str) -> _Floats:
    product, at, text = np.eye(3), 0, text.rstrip()
    while at < len(text):
        call = _CALL.match(text, at)
        if not call:
            raise FileError(f"has the transform {text[at : at + 40]!r}, expected one such as 'rotate(30)'")
        product = product @ _matrix(call[1], numbers(call[2]))
        at = call.end()
    return product


def _matrix(name: str, values: list[float]) -> _Floats:
    match name, values:
        case "matrix", [a, b, c, d, e, f]:
            return np.array([[a, c, e], [b, d, f], [0, 0, 1]])
        case "translate", [x, *y] if len(y) <= 1:
            return _matrix("matrix", [1, 0, 0, 1, x, *(y or [0])])
        case "scale", [x, *y] if len(y) <= 1:
            return _matrix("matrix", [x, 0, 0, *(y or [x]), 0, 0])
        case "rotate", [degrees]:
            cosine, sine = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
            return _matrix("matrix", [cosine, sine, -sine, cosine, 0, 0])
        case "rotate", [degrees, x, y]:
            return _matrix("translate", [x, y]) @ _matrix("rotate", [degrees]) @ _matrix("translate", [-x, -y])
        case "skewX", [degrees]:
            return _matrix("matrix", [1, 0, math.tan(math.radians(degrees)), 1, 0, 0])
        case "skewY", [degrees]:
            return _matrix("matrix", [1, math.tan(math.radians(degrees)), 0, 1, 0, 0])
    raise FileError(f"has the transform {name[:40]!r} of {len(values)} numbers, which is none of SVG's")


def _length(element: Any, name: str) -> float:
    """An attribute in pixels; 0 where there is none or it is automatic."""
    text = element.get(name, "0")
    found = _LENGTH.fullmatch("0" if text == "auto" else text)
    values = numbers(found[1]) if found else []
    if not found or len(values) != 1:
        raise FileError(f"has {name} = {text[:40]!r}, expected a number")
    return values[0] * _UNITS[found[2]]


def _path_data(element: Any, tag: str) -> str:
    """Every shape as path data of checked grammar; empty where it draws nothing."""
    if tag == "path":
        return checked(element.get("d", ""))
    if tag in ("polygon", "polyline"):
        return polygon(numbers(element.get("points", "")), closed=tag == "polygon")
    radii = ("r", "r") if tag == "circle" else ("rx", "ry")
    either = next((name for name in radii if name in element.attrib), radii[0])  # one radius is enough for both
    rx, ry = (_length(element, name if name in element.attrib else either) for name in radii)
    if tag == "rect":
        x, y, width, height = (_length(element, name) for name in ("x", "y", "width", "height"))
        return rectangle(x, y, width, height, rx, ry)
    return rectangle(_length(element, "cx") - rx, _length(element, "cy") - ry, 2 * rx, 2 * ry, rx, ry)
