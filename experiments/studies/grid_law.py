"""Table 1, the law: what predicts how much smaller the remeshed rank is, and which settings give the paper's numbers?

The factor is the rank of arbitrary triangulations, the median of a uniform sample, over that of the remeshed one.

Rule, stated before the numbers: a law is fitted on one half of the curves, drawn with the seed, under all four kinds of
triangulation, and judged on the other half.  Its error is the median of |log(predicted / found)|, of ranks and of
factors, given as a ratio less 1.  It predicts the factor where that error is below that of no law, one factor for all
curves, and where it gets the direction right, arbitrary above or below, on at least two thirds.

    height, slides, deep    rank = scale (1 + count)**power, counts of the triangulation, see `.grid`
    isoperimetric           factor = scale (isoperimetric ratio of the curve)**power
    branching               factor = scale (1 + branching triangles of the remeshed dual tree)**power

Writes results/grid_law.csv.  And for the paper's four columns: of all cells of the grid, a setting with one kind of
arbitrary triangulation, those with both of its ranks within 20 %, and those with its factor
(results/grid_columns.csv, by column; results/grid_cells.csv, cell by cell).
"""

import argparse
from typing import Any

import numpy as np
import pandas as pd
from numpy.typing import NDArray
from scipy.stats import spearmanr

from experiments.store import RESULTS, rng_for, write_csv
from experiments.studies.grid import COUNTED, PARAMETERS, RANKS
from experiments.subjects import PAPER

KINDS = ("remeshed", "first", "last", "uniform")
ARBITRARY = {"own_median": "uniform", "first": "first split", "last": "last split", "common_median": "common"}
WITHIN = 0.2
LAWS = (*COUNTED, "isoperimetric", "branching")
Array = NDArray[np.float64]


# The law


def ranks_and_counts(disk: pd.DataFrame, shapes: pd.DataFrame) -> pd.DataFrame:
    """The rows to the disk in the default number of frames, with the counts of their triangulations."""
    counted = pd.concat(
        [
            shapes[["curve", "n", "isoperimetric", "branching"]].assign(
                triangulation=kind, **{name: shapes[f"{name}_{kind}"] for name in COUNTED}
            )
            for kind in KINDS
        ]
    )
    rows = disk[disk.frames == PARAMETERS["default_frames"]]
    return rows.merge(counted, on=["curve", "n", "triangulation"])


def fitting_half(names: list[str]) -> set[str]:
    """The curves on which laws are fitted."""
    order = rng_for(PARAMETERS["seed"], "grid, law").permutation(len(names))
    return {names[i] for i in order[: len(names) // 2]}


def fitted(x: Array, y: Array) -> tuple[float, float]:
    """The scale and the power of y = scale (1 + x)**power, by least squares of logarithms."""
    power, log_scale = np.polyfit(np.log1p(x), np.log(y), 1)
    return float(np.exp(log_scale)), float(power)


def predicted(law: tuple[float, float], x: Array) -> Array:
    """What a law predicts."""
    return np.asarray(law[0] * (1 + x) ** law[1])


def factors(rows: pd.DataFrame, column: str) -> "pd.Series[float]":
    """Logarithm of arbitrary over remeshed, by curve."""
    wide = rows.pivot(index="curve", columns="triangulation", values=column).astype(float)
    return np.log((wide["uniform"] / wide["remeshed"]).dropna())


def judged(rows: pd.DataFrame, rank: str, law: str, half: set[str]) -> dict[str, Any]:
    """Fit one law to one setting, and judge it on the other curves."""
    rows = rows.dropna(subset=[rank]).assign(found=lambda r: r[rank].astype(float))
    mine = rows.curve.isin(half)
    factor, share = factors(rows, "found"), factors(rows[mine], "found")
    test = factor[~factor.index.isin(half)]
    if law in COUNTED:
        p = fitted(rows[mine][law].to_numpy(float), rows[mine].found.to_numpy())
        rows = rows.assign(law=predicted(p, rows[law].to_numpy(float)))
        others = rows[~rows.curve.isin(half)]
        rank_error = error(np.log(others.law / others.found))
        told = factors(others, "law").loc[test.index]
    else:
        measure = rows.groupby("curve")[law].first() - 1 if law == "isoperimetric" else branches(rows)
        p = fitted(measure.loc[share.index].to_numpy(), np.exp(share.to_numpy()))
        rank_error = np.nan
        told = pd.Series(np.log(predicted(p, measure.loc[test.index].to_numpy())), index=test.index)
    clear = test.abs() > 1e-9
    return {
        "scale": f"{p[0]:.3g}",
        "power": f"{p[1]:.3g}",
        "curves": len(test),
        "rank_error": rank_error,
        "factor_error": error(told - test),
        "without_law": error(share.mean() - test),
        "direction": float((np.sign(told) == np.sign(test))[clear].mean()),
        "correlation": float(spearmanr(told, test).statistic),
    }


def branches(rows: pd.DataFrame) -> "pd.Series[float]":
    """By curve the number of triangles at which the remeshed dual tree branches."""
    first = rows.groupby("curve").first()
    return first.branching * (first.n - 2)


def error(logarithms: "pd.Series[float]") -> float:
    """The median error as a ratio less 1."""
    return float(np.expm1(logarithms.abs().median()))


def laws(disk: pd.DataFrame, shapes: pd.DataFrame) -> pd.DataFrame:
    """A row a path, pace, n, tolerance and law; not where many ranks are uncertain."""
    rows = ranks_and_counts(disk, shapes)
    half = fitting_half(list(shapes.curve.unique()))
    found = []
    for (path, pace, n), some in rows.groupby(["path", "pace", "n"], sort=False):
        for rank in RANKS:
            if some[rank].isna().mean() > 0.1:
                continue
            for law in LAWS:
                about = {"path": path, "pace": pace, "n": n, "rank": rank, "law": law}
                found.append(about | judged(some, rank, law, half))
    table = pd.DataFrame(found)
    numbers = ["rank_error", "factor_error", "without_law", "direction", "correlation"]
    table[numbers] = table[numbers].astype(float).round(3)
    return table


# The paper's four columns


def cells(pairs: pd.DataFrame) -> pd.DataFrame:
    """Every cell of the grid: ranks X and Y, and whether they are the paper's, or their factor is."""
    keys = ["row", "n", "path", "pace", "frames"]
    X = pairs[pairs.triangulation == "remeshed"].set_index(keys)
    paper = pd.DataFrame(PAPER, index=[int(name.split()[-1]) for name in PAPER["curve"]])
    found = []
    for kind, label in ARBITRARY.items():
        Y = pairs[pairs.triangulation == kind].set_index(keys)
        for rank in RANKS:
            both = pd.DataFrame({"X": X[rank], "Y": Y[rank]}).dropna().reset_index()
            found.append(both.assign(arbitrary=label, rank=rank))
    table = pd.concat(found, ignore_index=True)
    printed_x, printed_y = (table.row.map(paper[f"AR_{which}"]) for which in ("remeshed", "arbitrary"))
    near_x, near_y = (table.X / printed_x - 1).abs() <= WITHIN, (table.Y / printed_y - 1).abs() <= WITHIN
    near = ((table.Y / table.X) / (printed_y / printed_x) - 1).abs() <= WITHIN
    return table.assign(both=(near_x & near_y).astype(int), factor=near.astype(int)).astype({"X": int, "Y": int})


def by_column(table: pd.DataFrame) -> pd.DataFrame:
    """By column, path and kind of arbitrary triangulation: how many cells reproduce the paper, and their factors."""
    ratio = table.assign(ratio=table.Y / table.X)
    groups = ratio.groupby(["row", "arbitrary", "path"])
    found = groups.agg(cells=("both", "size"), both=("both", "sum"), factor=("factor", "sum")).reset_index()
    for label, q in (("low", 0.05), ("median", 0.5), ("high", 0.95)):
        found[f"ratio_{label}"] = groups.ratio.quantile(q).round(2).to_numpy()
    return found


def main() -> None:
    argparse.ArgumentParser(
        prog="python -m experiments.studies.grid_law", description=__doc__.split("\n")[0]
    ).parse_args()
    disk, shapes, pairs = (pd.read_csv(RESULTS / f"grid_{name}.csv") for name in ("disk", "shapes", "pairs"))
    table, every = laws(disk, shapes), cells(pairs)
    write_csv(RESULTS / "grid_law.csv", table)
    write_csv(RESULTS / "grid_columns.csv", by_column(every))
    write_csv(RESULTS / "grid_cells.csv", every[(every.both > 0) | (every.factor > 0)])
    print(
        f"grid_law: {len(table)} laws fitted, {len(every)} cells of four columns "
        "-> results/grid_law.csv, results/grid_columns.csv, results/grid_cells.csv"
    )


if __name__ == "__main__":
    main()
