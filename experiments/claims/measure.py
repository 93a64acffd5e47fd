"""Small measurements for the ledger of claims, where no study has the number: nothing is written.

A part of the work is a kind and what it is about, "ring: 20"; what is measured stands in the file of the section whose
claims it is for, and only what is measured on every curve on its way to its disk is put together here.
"""

from collections.abc import Callable
from functools import partial
from typing import Any

import pandas as pd

import experiments.claims.quality  # noqa: F401, it enters its claims, and has nothing to measure for the ledger alone
from experiments.claims import section_3, section_4, section_5, section_6, section_7
from experiments.claims.shared import PARAMETERS, best_angle
from experiments.store import compute, rng_for
from experiments.subjects import pairs, shape, shapes
from tween import decompose, gallery, paper_morph, remesh


def parts() -> list[str]:
    return [
        *(f"{kind}: {name}" for kind in ("curve", "linear", "slide") for name in shapes()),
        *(f"boundary: {name}" for name in (*shapes(), *gallery.pairs())),
        *(f"flow: {pair}" for pair in pairs()[:: PARAMETERS["every_pair"]]),
        *(f"ring: {n}" for n in PARAMETERS["rings"]),
        *(f"degrees: {n}" for n in range(4, PARAMETERS["degrees_up_to"] + 1)),
        *(f"comparisons: {n}" for n in PARAMETERS["rings"]),
        *(f"table: {n}" for n in PARAMETERS["convex"]),
        *(f"thirds: {spread}" for spread in ("uniform", "normal")),
    ]


def work(part: str) -> dict[str, Any]:
    kind, rest = part.split(": ")
    return {"kind": kind, "part": rest} | WORK[kind](rest)


def measure() -> dict[str, pd.DataFrame]:
    """A table for each kind of part."""
    rows = compute("claims", PARAMETERS, parts(), work)
    return {kind: pd.DataFrame([row for row in rows if row["kind"] == kind]).set_index("part") for kind in WORK}


def curve_to_disk(name: str) -> dict[str, Any]:
    """Everything about one curve, its triangulations, and its morph to the disk along "slide"."""
    rng = rng_for(PARAMETERS["seed"], f"claims {name}")
    d = decompose(shape(name))
    T, drawn = remesh(d.arbitrary()), d.sample(rng, PARAMETERS["draws"])
    D = T.on_disk()
    m = paper_morph(T, D)
    return {
        "n": len(T),
        "swaps_valid": section_4.swapped(drawn[0], rng),
        **section_4.remeshed_one_by_one(drawn[0]),
        **best_angle(d, T.points),
        **section_4.branchings(T, drawn),
        **section_4.slivers_and_places(m, drawn),
        **section_5.at_the_end(m),
        **section_5.non_monotone(T, D),
        **section_6.reflex_vertices(m),
        **section_3.not_additive(T),
        **section_6.spines([T, *drawn]),
        **section_6.leaves(T, drawn),
        **section_7.rank_along_area(T, D),
    }


def pair_on_the_way(pair: str) -> dict[str, Any]:
    """When the flips of a pair come, and whether its morph is symmetric where ties are broken in the same way."""
    return section_7.flips_on_the_way(pair) | {"asymmetry": section_6.asymmetry(pair)}


WORK: dict[str, Callable[[str], dict[str, Any]]] = {
    "curve": curve_to_disk,
    "linear": partial(section_5.lengths_and_areas, path="linear"),
    "slide": partial(section_5.lengths_and_areas, path="slide"),
    "boundary": section_3.boundary_only,
    "flow": pair_on_the_way,
    "ring": section_6.flip_rules,
    "thirds": section_5.third_vertices_at_random,
    "degrees": section_4.degree_sequences,
    "comparisons": section_4.comparisons,
    "table": section_3.table_of_convex,
}
