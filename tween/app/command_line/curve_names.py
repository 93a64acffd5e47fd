"""Shapes by the words that people type: files, and the curves that come with tween.

drawing.svg         a file              letter:S              handwriting
gallery:horseshoe   a named curve       pair:e_to_l/source    an end of a named pair
"""

from pathlib import Path
from typing import Any

from tween import gallery
from tween.errors import FileError
from tween.geometry.curve import Curve
from tween.io.read_write import read_curve, read_stroke

_ENDS = ("source", "target")


def read_shape(word: str, select: str | None = None, tolerance: float | None = None, pen: float | None = None) -> Curve:
    """Read a curve from a file, or take one that comes with tween.

    Parameters
    ----------
    word : str
        A path, ``gallery:NAME``, ``letter:X`` or ``pair:NAME/source``.
    select : str, optional
        Which curve of a file that has several.
    tolerance : float, optional
        How far the polygon may lie from the curves of an SVG file, in its units, see `tween.read_curve`.
    pen : float, optional
        How wide to draw the line that the file holds, see `tween.io.read_stroke`; without it, the line is the
        curve itself.

    Returns
    -------
    Curve

    Raises
    ------
    FileError
        Where there is no such file, or no curve in it.
    CurveError
        Where there is no curve of that name, or the points are none that tween can treat.

    Examples
    --------
    >>> read_shape("letter:e")
    Curve(62 vertices, turning number 1)
    """
    kind, _, name = word.partition(":")
    if kind in ("gallery", "letter", "pair"):
        if select is not None:
            raise FileError(f"{word} is one curve: there is nothing to select by {select!r}")
        return _named(kind, name)
    if word in gallery.names() and not Path(word).exists():
        raise FileError(f"there is no file {word!r}; the curve that comes with tween is gallery:{word}")
    return read_curve(word, select, tolerance) if pen is None else read_stroke(word, pen, select, tolerance)


def _named(kind: str, name: str) -> Curve:
    if kind != "pair":
        return gallery.curve(name) if kind == "gallery" else gallery.letter(name)
    name, _, end = name.partition("/")
    pair = gallery.pair(name)
    if end not in _ENDS:
        raise FileError(f"pair:{name} is two curves: add /source or /target")
    return pair[_ENDS.index(end)]


def full_name(word: str) -> str:
    """Put the kind before the name of a curve that comes with tween.

    Parameters
    ----------
    word : str
        With the kind or without.

    Returns
    -------
    str
        As `read_shape` takes it; no check that there is such a curve.

    Examples
    --------
    >>> full_name("horseshoe"), full_name("S"), full_name("e_to_l/source"), full_name("letter:S")
    ('gallery:horseshoe', 'letter:S', 'pair:e_to_l/source', 'letter:S')
    """
    if len(word) == 1:
        return f"letter:{word}"
    if ":" in word:
        return word
    return f"pair:{word}" if word.partition("/")[0] in gallery.pairs() else f"gallery:{word}"


def describe(word: str) -> dict[str, Any]:
    """Describe a curve, or a pair, that comes with tween.

    Parameters
    ----------
    word : str
        With its kind, see `full_name`.

    Returns
    -------
    dict
        name, vertices (of a pair two numbers) and about, a sentence.

    Raises
    ------
    TweenError
        Where there is none of that name.

    Examples
    --------
    >>> describe("gallery:ell")
    {'name': 'gallery:ell', 'vertices': 47, 'about': 'A tapering letter L: a single reflex corner.'}
    """
    kind, _, name = word.partition(":")
    if kind not in ("gallery", "letter", "pair"):
        raise FileError(f"{word!r} does not come with tween; expected gallery:NAME, letter:X or pair:NAME")
    pair, _, end = name.partition("/")
    if kind == "pair" and not end:
        vertices: Any = [len(curve) for curve in gallery.pair(pair)]
    else:
        vertices = len(read_shape(word))
    if kind == "pair":
        about = gallery.describe_pair(pair)
    else:
        about = gallery.describe(name) if kind == "gallery" else f"A handwritten {name}."
    return {"name": word, "vertices": vertices, "about": about}


def everything() -> dict[str, list[dict[str, Any]]]:
    """Describe all that comes with tween.

    Returns
    -------
    dict
        Under curves, letters and pairs what `describe` says of each.

    Examples
    --------
    >>> {part: len(entries) for part, entries in everything().items()}
    {'curves': 15, 'letters': 19, 'pairs': 7}
    """
    kinds = {"curves": "gallery:", "letters": "letter:", "pairs": "pair:"}
    names = {"curves": gallery.names(), "letters": gallery.letters(), "pairs": gallery.pairs()}
    return {part: [describe(kind + name) for name in names[part]] for part, kind in kinds.items()}


def line(entry: dict[str, Any], width: int = 0) -> str:
    """Write what `describe` says as a line.

    Parameters
    ----------
    entry : dict
    width : int
        Characters for the name.

    Returns
    -------
    str

    Examples
    --------
    >>> line(describe("gallery:ell"))
    'gallery:ell        47  A tapering letter L: a single reflex corner.'
    """
    vertices = entry["vertices"]
    size = str(vertices) if isinstance(vertices, int) else f"{vertices[0]}, {vertices[1]}"
    return f"{entry['name']:<{width}}  {size:>8}  {entry['about']}"


def listing() -> str:
    """List all that comes with tween, for people.

    Returns
    -------
    str
        A line for each, below a heading for each kind.
    """
    parts = everything()
    width = max(len(entry["name"]) for entries in parts.values() for entry in entries)
    heads = {"pairs": "pairs, two curves each: add /source or /target to the name"}
    blocks = []
    for part, entries in parts.items():
        lines = [f"  {line(entry, width)}" for entry in entries]
        head = f"{heads.get(part, part):<{width + 4}}"
        blocks.append("\n".join([f"{head}vertices" if part == "curves" else head.rstrip(), *lines]))
    return "\n\n".join(blocks)
