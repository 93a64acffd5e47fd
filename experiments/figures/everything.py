"""All figures, registered by importing the modules that draw them."""

from experiments.figures import compatible, gallery, guarantee, immersions, incompatible, roots, scale, table_1
from experiments.figures.registry import DRAWINGS, drawn, save_all

__all__ = [
    "DRAWINGS",
    "compatible",
    "drawn",
    "gallery",
    "guarantee",
    "immersions",
    "incompatible",
    "roots",
    "save_all",
    "scale",
    "table_1",
]
