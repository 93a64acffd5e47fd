"""Table 1 for pairs of curves: the four columns of the paper, Figure 11 rows 1, 3, 4 and 7, on our stand-ins.

X is the morph of the remeshed triangulations (path "slide", pivots matched, gradual flips where they are not
compatible).  Y are arbitrary triangulations under the same correspondence: where the two curves have
common triangulations, uniformly drawn ones, which need no flips; and in any case a uniformly drawn one for each
curve, flipped into each other on the way.  Writes results/table1_columns.csv.
"""

import argparse
from typing import Any

import numpy as np
import pandas as pd

from experiments.store import RESULTS, compute, rng_for, write_csv
from experiments.table1 import PAPER, PARAMETERS, QUANTILES, percentile
from tween import Morph, Triangulation, area_matrix, decompose, frame_variance, gallery, morph
from tween.metrics import rank_of

ROWS = (1, 3, 4, 7)
TOLERANCES = PARAMETERS["tolerances"]
MEASURES = ["flips", *(f"AR_{t:.0e}".replace("e-0", "e-") for t in TOLERANCES), "Var"]
BATCH = 125


def measure(m: Morph) -> list[float]:
    """Flips, AR at every tolerance, Var."""
    A = area_matrix(m, PARAMETERS["frames"])
    singular = np.linalg.svd(A, compute_uv=False)
    return [len(m.events), *(rank_of(singular, rtol) for rtol in TOLERANCES), frame_variance(A)]


def remeshed(name: str) -> Morph:
    return morph(*gallery.pair(name), strategy="paper")


def draw(part: str) -> dict[str, list[list[float]]]:
    """A batch of arbitrary triangulations of one pair: kind -> measures."""
    name, batch = part.rsplit(" ", 1)
    rng = rng_for(PARAMETERS["seed"], part)
    size = min(BATCH, PARAMETERS["samples"] - BATCH * int(batch))
    a = remeshed(name).alignment
    own = [decompose(T.curve).sample(rng, size) for T in (a.source, a.target)]
    drawn = {"own": [measure(morph(S, T, strategy="paper", shifts=0)) for S, T in zip(*own, strict=True)]}
    both = decompose(a.source.curve, a.target.curve)
    if both:
        shared = both.sample(rng, size)
        targets = [Triangulation(a.target.points, S.triangles) for S in shared]
        drawn["common"] = [measure(morph(S, T, shifts=0)) for S, T in zip(shared, targets, strict=True)]
    return drawn


def rows_of(row: int, name: str, drawn: dict[str, list[list[float]]]) -> list[dict[str, Any]]:
    """The rows of one column of the paper's table: remeshed, then the quantiles of the arbitrary ones."""
    about = {"row": row, "pair": name, "n": len(remeshed(name).source)}
    X = measure(remeshed(name))
    rows: list[dict[str, Any]] = [about | {"triangulation": "remeshed"} | dict(zip(MEASURES, X, strict=True))]
    for kind, values in drawn.items():
        columns = np.array(values).T
        places = {f"percentile_{kind}_{m}": percentile(x, c) for m, x, c in zip(MEASURES, X, columns, strict=True)}
        rows[0] |= {key: round(p, 4) for key, p in places.items()}
        for label, q in QUANTILES.items():
            quantiles = np.quantile(columns, q, axis=1, method="inverted_cdf").tolist()
            rows.append(about | {"triangulation": f"{kind}_{label}"} | dict(zip(MEASURES, quantiles, strict=True)))
    return rows


def paper_row(row: int) -> dict[str, Any]:
    """What the paper prints for a row of Figure 11; its curves, units and tolerance are unpublished."""
    place = PAPER["curve"].index(f"Figure 11, row {row}")
    return {key: values[place] for key, values in PAPER.items() if key != "curve"}


def main() -> None:
    argparse.ArgumentParser(prog="python -m experiments.figure11", description=__doc__.split("\n")[0]).parse_args()
    names = {row: gallery.pairs()[row - 1] for row in ROWS}
    batches = range(-(-PARAMETERS["samples"] // BATCH))
    parts = [f"{name} {batch}" for name in names.values() for batch in batches]
    results = dict(zip(parts, compute("figure11", PARAMETERS | {"rows": ROWS}, parts, draw), strict=True))
    rows = []
    for row, name in names.items():
        drawn: dict[str, list[list[float]]] = {}
        for batch in batches:
            for kind, values in results[f"{name} {batch}"].items():
                drawn.setdefault(kind, []).extend(values)
        rows += [r | {f"paper_{k}": v for k, v in paper_row(row).items()} for r in rows_of(row, name, drawn)]
    table = pd.DataFrame(rows)
    table[MEASURES[:-1]] = table[MEASURES[:-1]].astype(int)
    table["Var"] = table["Var"].map("{:.3e}".format)
    write_csv(RESULTS / "table1_columns.csv", table)
    print(f"figure11: {len(ROWS)} columns of Table 1, {PARAMETERS['samples']} draws -> results/table1_columns.csv")


if __name__ == "__main__":
    main()
