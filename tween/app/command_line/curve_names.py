"""Names of the curves that come with tween: ``gallery:horseshoe``, ``letter:S``, ``pair:e_to_l/source``."""

from typing import Any

from tween import gallery
from tween.errors import FileError
from tween.geometry.curve import Curve

_KINDS = ("gallery", "letter", "pair")
_ENDS = ("source", "target")


def is_full(word: str) -> bool:
    """Tell whether a word begins with the kind of a curve that comes with tween.

    Parameters
    ----------
    word : str

    Returns
    -------
    bool
    """
    return word.partition(":")[0] in _KINDS and ":" in word


def named(word: str) -> Curve:
    """Make a curve that comes with tween.

    Parameters
    ----------
    word : str
        ``gallery:NAME``, ``letter:X`` or ``pair:NAME/source``.

    Returns
    -------
    Curve

    Raises
    ------
    FileError, CurveError
        Where there is none of that name; the message says what might be meant.

    Examples
    --------
    >>> named("letter:e")
    Curve(62 vertices, turning number 1)
    """
    kind, _, name = word.partition(":")
    if kind not in _KINDS:
        raise FileError(f"{word!r} does not come with tween; expected gallery:NAME, letter:X or pair:NAME")
    if kind != "pair":
        return gallery.curve(name) if kind == "gallery" else gallery.letter(name)
    name, _, end = name.partition("/")
    pair = gallery.pair(name)
    if end not in _ENDS:
        raise FileError(f"pair:{name} is two curves: add /source or /target")
    return pair[_ENDS.index(end)]


def every_name() -> list[str]:
    """List the full names of all curves that come with tween.

    Returns
    -------
    list of str

    Examples
    --------
    >>> every_name()[0], every_name()[-1]
    ('gallery:convex', 'pair:...')
    """
    ends = [f"pair:{name}/{end}" for name in gallery.pairs() for end in _ENDS]
    return [*(f"gallery:{name}" for name in gallery.names()), *(f"letter:{c}" for c in gallery.letters()), *ends]


def full_name(word: str) -> str:
    """Put the kind before the name of a curve that comes with tween.

    Parameters
    ----------
    word : str
        With the kind or without.

    Returns
    -------
    str
        No check that there is such a curve.

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
    if kind not in _KINDS:
        raise FileError(f"{word!r} does not come with tween; expected gallery:NAME, letter:X or pair:NAME")
    pair, _, end = name.partition("/")
    if kind == "pair" and not end:
        vertices: Any = [len(curve) for curve in gallery.pair(pair)]
    else:
        vertices = len(named(word))
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
