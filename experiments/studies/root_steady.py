"""The paper's third open question: does the triangle that the motion spreads from matter, and is the central one best?

Where the root places the shapes it also decides how large they are on the way, and AR and Var measure that too; see
`.roots`.  Placed steadily, every root gives shapes of the same areas in all, and only the shapes differ.  For every
curve of the gallery and every letter, remeshed and morphed to its disk along both of the paper's paths, every triangle
is the root once: AR at three tolerances, and Var.

Rule, stated before the numbers: the central root is better than a typical one in a measure where it is below the
median of all roots on more curves than not, and a sign test gives less than 0.05 for that; ties are left out.  It is
*best* on a curve where no other root is better.

Writes results/root_steady.csv, a row a curve, path and measure, and results/root_steady_summary.csv.
"""

from typing import Any

import numpy as np
import pandas as pd
from scipy.stats import binomtest

from experiments.measures import MEASURES, measures, percentile
from experiments.store import RESULTS, compute, rng_for, write_csv
from experiments.subjects import shape, shapes
from tween import area_matrix, triangulate
from tween.geometry.dual_tree import disk_center
from tween.morphing.strategy import morph_compatible

PARAMETERS: dict[str, Any] = {
    "seed": 20100,
    "frames": 100,
    "paths": ["slide", "linear"],
    "tolerances": [1e-4, 1e-6, 1e-9],
    "resamples": 2000,
}


def work(name: str) -> list[dict[str, Any]]:
    """The rows of one curve, a row a path and measure."""
    T = triangulate(shape(name))
    disk = T.on_disk()
    centre = disk_center(T, disk)
    rows = []
    for path in PARAMETERS["paths"]:
        found = []
        for root in range(len(T.triangles)):
            m = morph_compatible(T, disk, path=path, guarantee=False, placement="steady", root=root)
            found.append(measures(area_matrix(m, PARAMETERS["frames"]), PARAMETERS["tolerances"]))
        for measure, values in zip(MEASURES, np.array(found).T, strict=True):
            rows.append({"curve": name, "path": path, "measure": measure, "roots": len(found)} | placed(values, centre))
    return rows


def placed(values: np.ndarray[Any, Any], centre: int) -> dict[str, float]:
    """A root's value among all roots' values."""
    least, median, largest = np.quantile(values, [0, 0.5, 1])
    return {
        "center": values[centre],
        "min": least,
        "median": median,
        "max": largest,
        "percentile": percentile(values[centre], values),
    }


def table(rows: list[dict[str, Any]]) -> pd.DataFrame:
    """The rows, rounded to digits that processors agree on."""
    result = pd.DataFrame(rows)
    for column in ("center", "min", "median", "max"):
        result[column] = result[column].map(lambda v: float(f"{v:.3g}"))
    result["percentile"] = result["percentile"].round(3)
    return result


def summary(rows: pd.DataFrame) -> pd.DataFrame:
    """On how many curves the central root is below the median root, above it, and best; and how much roots differ."""
    found = []
    for (path, measure), of in rows.groupby(["path", "measure"], sort=False):
        below, above = int((of.center < of["median"]).sum()), int((of.center > of["median"]).sum())
        test = binomtest(below, below + above)
        low, high = test.proportion_ci(method="wilson")
        rng = rng_for(PARAMETERS["seed"], f"root steady, {path} {measure}")
        drawn = rng.choice(of.percentile.to_numpy(), (PARAMETERS["resamples"], len(of)))
        places = np.quantile(np.median(drawn, axis=1), [0.025, 0.975])
        found.append(
            {
                "path": path,
                "measure": measure,
                "curves": len(of),
                "below_median": below,
                "above_median": above,
                "share_below": below / (below + above),
                "share_low": low,
                "share_high": high,
                "sign_test": test.pvalue,
                "best": int((of.center == of["min"]).sum()),
                "percentile": of.percentile.median(),
                "percentile_low": places[0],
                "percentile_high": places[1],
                "worst_over_best": (of["max"] / of["min"]).median(),
                "center_over_best": (of.center / of["min"]).median(),
            }
        )
    result = pd.DataFrame(found)
    numbers = result.columns[5:]
    result[numbers] = result[numbers].map(lambda v: float(f"{v:.3g}"))
    return result


def main() -> None:
    rows = [row for part in compute("root_steady", PARAMETERS, list(shapes()), work) for row in part]
    found = table(rows)
    write_csv(RESULTS / "root_steady.csv", found)
    write_csv(RESULTS / "root_steady_summary.csv", summary(found))
    print("root_steady: every root of 34 curves -> results/root_steady.csv, results/root_steady_summary.csv")


if __name__ == "__main__":
    main()
