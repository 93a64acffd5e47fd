"""All figures, registered by importing the modules that draw them."""

import json
from collections.abc import Sequence
from typing import Any

from joblib import Parallel, delayed

from experiments.figures import article
from experiments.figures.paper import compatible, gallery, immersions, incompatible
from experiments.figures.registry import DRAWINGS, drawn, save
from experiments.figures.studies import claims, grid, guarantee, matching, quality, roots, scaling, table_1
from experiments.store import FIGURES, write_json

__all__ = [
    "DRAWINGS",
    "article",
    "claims",
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
    "save_some",
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
    _write(summaries)


def save_some(names: Sequence[str]) -> None:
    """Draw and save the named figures alone; the summaries of those that are no more are dropped."""
    unknown = [name for name in names if name not in DRAWINGS]
    if unknown:
        raise ValueError(f"there is no figure {', '.join(unknown)}; there are {', '.join(sorted(DRAWINGS))}")
    known = json.loads((FIGURES / "drawn.json").read_text(encoding="utf-8"))
    summaries = {name: known[name] for name in known if name in DRAWINGS} | {name: save(name) for name in names}
    _write(dict(sorted(summaries.items())))


def _write(summaries: dict[str, Any]) -> None:
    write_json(FIGURES / "drawn.json", summaries)
    captions = {name: {"of": DRAWINGS[name].of, "caption": DRAWINGS[name].caption} for name in sorted(summaries)}
    write_json(FIGURES / "captions.json", captions)


def _save(name: str) -> list[dict[str, Any]]:
    """As `save`; a worker that looks for this function imports, and so registers, every figure."""
    return save(name)
