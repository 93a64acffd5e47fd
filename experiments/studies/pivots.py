"""Figure 9: morphs with and without matched pivots.

For the named pairs and all pairs of constructed curves, path "slide", remeshed triangulations flipped into
each other: crossings, flips, how late the flips are done, AR and Var

    pivots                  when the pivots are matched: the one of the four pairings of spines' ends that crosses least
    four pairings, mean     on the average of the four
    four random, best       at the one with fewest crossings of four renumberings drawn at random: as many tries
    fewest crossings        at the one with fewest crossings of all
    as drawn                when the vertices correspond as the curves are drawn (shift 0)
    spread, median          at the median of eight renumberings spread evenly

What the pivots are good for is not to be told by crossings alone, since these have chosen the pairing.  Writes
results/pivots.csv.
"""

from collections.abc import Iterable
from functools import cache, partial
from typing import Any

import numpy as np
import pandas as pd

from experiments import subjects
from experiments.store import RESULTS, compute, rng_for, write_csv
from tween import area_matrix, area_rank, frame_variance, gallery, paper_morph
from tween.geometry.triangulation import Triangulation
from tween.morphing.alignment import equal_counts
from tween.morphing.incompatible.flip_sequence import crossings_by_shift
from tween.morphing.incompatible.pivots import pivot_shift, pivot_vertex, spine

PARAMETERS: dict[str, Any] = {"frames": 100, "path": "slide", "tolerance": 1e-4, "spread": 8, "seed": 20100}
MEASURES = ["crossings", "flips", "finish", "AR_1e-4", "Var"]


def measure(source: Triangulation, target: Triangulation, shift: int) -> list[float]:
    """Crossings, flips, the smaller of u and v, AR, Var."""
    m = paper_morph(source, target, path=PARAMETERS["path"], shifts=shift)
    A = area_matrix(m, PARAMETERS["frames"])
    finish = min(m.u or 0.0, m.v or 0.0)
    return [m.alignment.crossings, len(m.events), finish, area_rank(A, PARAMETERS["tolerance"]), frame_variance(A)]


def pairings(source: Triangulation, target: Triangulation) -> list[int]:
    """The renumberings that match an end of one spine with an end of the other: four, or fewer where some agree."""
    ends = [[pivot_vertex(T, t) for t in spine(T)[[0, -1]]] for T in (source, target)]
    return sorted({(j - i) % len(source) for i in ends[0] for j in ends[1]})


def work(pair: str) -> list[dict[str, Any]]:
    """A row for each way to match the vertices."""
    first, second, *_ = equal_counts(*subjects.both(pair))
    n = len(first)
    spread = [round(i * n / PARAMETERS["spread"]) for i in range(PARAMETERS["spread"])]
    crossings = crossings_by_shift(first, second, np.arange(n))
    random = rng_for(PARAMETERS["seed"], f"pivots {pair}").choice(n, 4, replace=False)
    of_shift = cache(partial(measure, first, second))  # the rules often choose the same
    paired = [of_shift(k) for k in pairings(first, second)]
    values = {
        "pivots": of_shift(pivot_shift(first, second)[0]),
        "four pairings, mean": np.mean(paired, axis=0).tolist(),
        "four random, best": of_shift(int(random[np.argmin(crossings[random])])),
        "as drawn": of_shift(0),
        "spread, median": np.median([of_shift(k) for k in spread], axis=0).tolist(),
        "fewest crossings": of_shift(int(np.argmin(crossings))),
    }
    return [{"pair": pair, "n": n, "match": match} | dict(zip(MEASURES, v, strict=True)) for match, v in values.items()]


def table(rows: Iterable[dict[str, Any]]) -> pd.DataFrame:
    result = pd.DataFrame(rows)
    result["finish"] = result["finish"].round(6)
    result["Var"] = result["Var"].map("{:.3e}".format)
    return result


def main() -> None:
    pairs = [*gallery.pairs(), *subjects.pairs(gallery.names())]
    rows = [row for part in compute("pivots", PARAMETERS, pairs, work) for row in part]
    write_csv(RESULTS / "pivots.csv", table(rows))
    print(f"pivots: {len(pairs)} pairs, six ways to match -> results/pivots.csv")


if __name__ == "__main__":
    main()
