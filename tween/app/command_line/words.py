"""The words that options take; every other one is refused with what was expected."""

import re
from math import inf

import click

from tween.choices import ROOT_RULES, SIZES


def landmark(text: str) -> tuple[int, ...]:
    """Read the numbers of vertices, one of each curve.

    Parameters
    ----------
    text : str

    Returns
    -------
    tuple of int
    """
    if not re.fullmatch(r"[0-9]+(:[0-9]+)+", text):
        raise click.BadParameter(f"expected the number of a vertex of each curve, such as 12:40, found {text!r}")
    return tuple(map(int, text.split(":")))


def root(text: str) -> str | int:
    """Read where a motion starts.

    Parameters
    ----------
    text : str

    Returns
    -------
    str or int
    """
    if text in ROOT_RULES:
        return text
    try:
        return int(text)
    except ValueError:
        raise click.BadParameter(f"expected {', '.join(ROOT_RULES)} or a whole number, found {text!r}") from None


def size(text: str) -> int | tuple[int, int] | str:
    """Read the size of a film.

    Parameters
    ----------
    text : str

    Returns
    -------
    int, (int, int) or "small"
    """
    if text == "small":
        return text
    found = re.fullmatch(r"([0-9]{2,4})(?:x([0-9]{2,4}))?", text)
    sides = [int(side) for side in found.groups() if side] if found else []
    if not sides or not all(SIZES[0] <= side <= SIZES[1] for side in sides):
        expected = f"pixels from {SIZES[0]} to {SIZES[1]}, such as 480 or 640x480, or small"
        raise click.BadParameter(f"expected {expected}, found {text!r}")
    return sides[0] if len(sides) == 1 else (sides[0], sides[1])


def length(text: str, least: float = 0.0, included: bool = False) -> float:
    """Read a length.

    Parameters
    ----------
    text : str
    least : float
    included : bool
        Whether the least is one.

    Returns
    -------
    float
    """
    try:
        value = float(text)
    except ValueError:
        value = -1.0
    if not (least < value < inf or (included and value == least)):
        raise click.BadParameter(f"expected a {'number, 0 or more' if included else 'positive number'}, found {text!r}")
    return value


def distance(text: str) -> float:
    """Read a length, or 0.

    Parameters
    ----------
    text : str

    Returns
    -------
    float
    """
    return length(text, included=True)
