"""What the studies morph: the curves of the gallery and the letters, their pairs, polygons; and the paper's numbers."""

from itertools import combinations
from typing import Any

import numpy as np
from numpy.typing import NDArray

from tween import Curve, Triangulation, decompose, gallery
from tween.triangulating.flips import flip

# Table 1 as printed; the curves of Figure 11 are unpublished, units and tolerance not stated.
PAPER: dict[str, list[Any]] = {
    "curve": ["Figure 11, row 1", "Figure 11, row 3", "Figure 11, row 4", "Figure 11, row 7"],
    "AR_remeshed": [7, 17, 10, 23],
    "AR_arbitrary": [31, 42, 13, 36],
    "Var_remeshed": [0.01, 0.01, 0.007, 0.007],
    "Var_arbitrary": [0.11, 0.02, 0.008, 0.03],
}
LETTER, BETWEEN = "letter ", " - "  # how the name of a letter starts; between the names of two curves


def shapes() -> dict[str, str]:
    """Every curve: name -> kind."""
    letters = {f"{LETTER}{letter}": "letter" for letter in gallery.letters()}
    return {name: "constructed" for name in gallery.names()} | letters


def shape(name: str) -> Curve:
    return gallery.letter(name.removeprefix(LETTER)) if name.startswith(LETTER) else gallery.curve(name)


def pairs(names: Any = None) -> list[str]:
    """Every pair of curves: of those named, or of all."""
    return [f"{a}{BETWEEN}{b}" for a, b in combinations(shapes() if names is None else names, 2)]


def both(pair: str) -> tuple[Curve, Curve]:
    """The two curves of a pair, which may also be named as a row of Figure 11."""
    if BETWEEN not in pair:
        return gallery.pair(pair)
    first, second = pair.split(BETWEEN)
    return shape(first), shape(second)


def polygon(n: int) -> NDArray[np.float64]:
    angle = 2 * np.pi * np.arange(n) / n
    return np.stack([np.cos(angle), np.sin(angle)], axis=1)


def flip_graph(n: int) -> tuple[list[Triangulation], list[list[int]]]:
    """All triangulations of the n-gon, found by flipping, and the neighbours of each."""
    found = [decompose(polygon(n)).arbitrary()]
    number = {found[0].canonical.tobytes(): 0}
    neighbours: list[list[int]] = []
    for T in found:
        near = []
        for a, b in T.diagonals.tolist():
            other = flip(T, (a, b))
            key = other.canonical.tobytes()
            if key not in number:
                number[key] = len(found)
                found.append(other)
            near.append(number[key])
        neighbours.append(near)
    return found, neighbours
