"""All figures, registered by importing the modules that draw them."""

from typing import Any

from joblib import Parallel, delayed

from experiments.figures import article
from experiments.figures.paper import compatible, gallery, immersions, incompatible
from experiments.figures.registry import DRAWINGS, drawn, save
from experiments.figures.studies import grid, guarantee, matching, quality, roots, scaling, table_1
from experiments.store import FIGURES, write_json

__all__ = [
    "DRAWINGS",
    "article",
    "compatible",
    "drawn",
    "gallery",
    "grid",
    "guarantee",
    "immersions",
    "incompatible",
    "matching",
    "quality",
    "roots",
    "save_all",
    "scaling",
    "table_1",
]


def save_all() -> None:
    """Draw and save every figure, with captions.json and drawn.json."""
    names = sorted(DRAWINGS)
    summaries = {}
    for name, summary in zip(
        names, Parallel(n_jobs=-1, return_as="generator")(map(delayed(_save), names)), strict=True
    ):
        summaries[name] = summary
        print(f"figures: {name}.png", flush=True)
    write_json(FIGURES / "drawn.json", summaries)
    captions = {name: {"of": DRAWINGS[name].of, "caption": DRAWINGS[name].caption} for name in names}
    write_json(FIGURES / "captions.json", captions)


def _save(name: str) -> list[dict[str, Any]]:
    """As `save`; a worker that looks for this function imports, and so registers, every figure."""
    return save(name)
