"""Curves to try things on: named ones, strips along a path, random disks, handwriting."""

from tween.gallery.curves import curve, describe, describe_pair, names, pair, pairs
from tween.gallery.generators import GRID, fan, random_disk, ribbon, zigzag
from tween.gallery.handwriting import PEN, letter, letters

__all__ = [
    "GRID",
    "PEN",
    "curve",
    "describe",
    "describe_pair",
    "fan",
    "letter",
    "letters",
    "names",
    "pair",
    "pairs",
    "random_disk",
    "ribbon",
    "zigzag",
]
