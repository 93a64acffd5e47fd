"""Table 1 again and again: does its verdict depend on what the paper leaves open?

Every curve of the gallery and every letter is morphed to its disk, remeshed and with uniformly drawn triangulations,
while one thing at a time is set otherwise: the path, the number of frames, the disk, the root, the unit of the areas,
and what "arbitrary" means; each at many tolerances of the rank.  On how many curves is the remeshed triangulation
below, at and above the median of the random ones, and by which factor do they differ?  Writes results/sensitivity.csv.

And what the rank counts: how many triangles slide (follow an arc) and how thin they are, in the remeshed triangulation
and in random ones, and whether the rank follows either.  Writes results/table_1_slides.csv.
"""

import argparse
from collections.abc import Callable, Sequence
from typing import Any, Literal, NamedTuple

import numpy as np
import pandas as pd
from numpy.typing import NDArray
from scipy.stats import spearmanr

from experiments.measures import PARAMETERS as TABLE_1
from experiments.measures import measures, morph_to_disk, percentile, slid
from experiments.store import RESULTS, compute, rng_for, write_csv
from experiments.subjects import shape, shapes
from tween import Decomposition, Morph, Triangulation, area_matrix, decompose, remesh
from tween.choices import Path, Root
from tween.triangulating.costs import edge_length, smallest_angle

PARAMETERS: dict[str, Any] = {"seed": TABLE_1["seed"], "samples": 200, "fewer": 100}
TOLERANCES = ("1e-2", "1e-3", "1e-4", "1e-5", "1e-6", "1e-8", "1e-9", "1e-10", "1e-12")
MEASURES = [*(f"AR_{rtol}" for rtol in TOLERANCES), "Var"]
REDUCE: dict[str, Callable[..., Any]] = {"min": np.min, "median": np.median, "max": np.max}
Array = NDArray[np.float64]


class Setting(NamedTuple):
    """How triangulations are morphed to the disk, and in how many frames they are looked at."""

    path: Path = "slide"
    frames: int = 100
    spacing: Literal["arc", "uniform"] = "arc"
    radius: float = 1.0  # of the disk; 1 gives it the area of the curve's own
    root: Root = "disk-center"


DEFAULT, LINEAR = Setting(), Setting(path="linear")
SETTINGS: dict[str, Setting] = {
    "path: slide": DEFAULT,
    "path: linear": LINEAR,
    "path: angle": Setting(path="angle"),
    "path: metric": Setting(path="metric"),
    **{f"frames: {k}": Setting(frames=k) for k in (25, 50, 100, 200, 400)},
    "areas: shares of the source": DEFAULT,
    "disk: spaced by arc length": DEFAULT,
    "disk: evenly spaced": Setting(spacing="uniform"),
    "disk: a quarter of the area": Setting(radius=0.5),
    "disk: four times the area": Setting(radius=2.0),
    "root: disk's centre": DEFAULT,
    "root: tree's centre": Setting(root="tree-center"),
}
UNITS: dict[str, Callable[[Array], Array]] = {
    "areas: shares of the frame": lambda A: A / A.sum(axis=0),
    "areas: shares of the triangle's first": lambda A: A / A[:, :1],
    "areas: change since the source": lambda A: A - A[:, :1],
    "areas: less each triangle's mean": lambda A: A - A.mean(axis=1, keepdims=True),
    "areas: less each frame's mean": lambda A: A - A.mean(axis=0),
}
ARBITRARY = (
    "arbitrary: median of the uniform",
    "arbitrary: best of the uniform",
    "arbitrary: worst of the uniform",
    "arbitrary: first split",
    "arbitrary: last split",
    "arbitrary: longest diagonals",
    "arbitrary: thinnest triangles",
)


def study(name: str) -> dict[str, Any]:
    """One curve under every setting, see `beside_median`; and the row of its slides."""
    d = decompose(shape(name))
    T = [remesh(d.arbitrary()), *d.sample(rng_for(PARAMETERS["seed"], name), PARAMETERS["samples"])]
    fewer = PARAMETERS["fewer"] + 1
    morphs = morphs_to_disk(DEFAULT, T)
    matrices = [area_matrix(m, DEFAULT.frames) for m in morphs]
    values = measured(matrices)
    default = beside_median(values)
    found = {label: default for label, setting in SETTINGS.items() if setting == DEFAULT}
    for label, setting in SETTINGS.items():
        if setting._replace(frames=DEFAULT.frames) != DEFAULT:
            others = morphs_to_disk(setting, T if setting == LINEAR else T[:fewer])
            found[label] = beside_median(measured([area_matrix(m, setting.frames) for m in others]))
        elif setting != DEFAULT:  # the same morphs, looked at in other frames
            found[label] = beside_median(measured([area_matrix(m, setting.frames) for m in morphs[:fewer]]))
    for label, change in UNITS.items():
        found[label] = beside_median(measured([change(A) for A in matrices[:fewer]]))
    return {"settings": found | arbitrary(d, T[0], values), "slides": slides_row(T, values)}


def morphs_to_disk(setting: Setting, T: Sequence[Triangulation]) -> list[Morph]:
    """Morphs of triangulations of one curve, all to one disk."""
    disk = T[0].on_disk(setting.spacing).points
    if setting.radius != 1:
        disk = disk.mean(axis=0) + setting.radius * (disk - disk.mean(axis=0))
    return [morph_to_disk(t, disk, setting.path, setting.root) for t in T]


def measured(matrices: Sequence[Array]) -> Array:
    """AR at every tolerance, then Var, a row a matrix."""
    return np.array([measures(A, map(float, TOLERANCES)) for A in matrices])


def beside_median(values: Array) -> dict[str, list[float]]:
    """The first row, X; the medians of the others, Y; and the shares of these below X."""
    X, columns = values[0].tolist(), values[1:].T
    Y = np.quantile(columns, 0.5, axis=1, method="inverted_cdf").tolist()
    return {"X": X, "Y": Y, "percentile": [percentile(x, c) for x, c in zip(X, columns, strict=True)]}


def arbitrary(d: Decomposition, remeshed: Triangulation, values: Array) -> dict[str, dict[str, list[float]]]:
    """What else "arbitrary" may have meant, and what it would mean at best and at worst."""
    longest, thinnest = edge_length(remeshed.points), smallest_angle(remeshed.points)
    others = [
        d.arbitrary(),
        d.arbitrary("last"),
        d.optimal(lambda triangles: -longest(triangles)),
        d.optimal(lambda triangles: -thinnest(triangles)),
    ]
    morphs = morphs_to_disk(DEFAULT, [remeshed, *others])
    X, *Y = measured([area_matrix(m, DEFAULT.frames) for m in morphs]).tolist()
    drawn = values[1:]
    uniform = [drawn.min(axis=0).tolist(), drawn.max(axis=0).tolist()]
    found = {label: {"X": X, "Y": y} for label, y in zip(ARBITRARY[1:], [*uniform, *Y], strict=True)}
    return {ARBITRARY[0]: beside_median(values)} | found


def slides_row(T: Sequence[Triangulation], values: Array) -> dict[str, float]:
    """Triangles that slide and smallest angles: remeshed, median of the random, rank correlation with the measures.

    Angles in degrees: "thinnest" is that of the thinnest triangle, "typical" that of the median triangle.
    """
    disk = T[0].on_disk().points
    angles = [np.degrees(-smallest_angle(t.points)(t.triangles)) for t in T]
    columns = {
        "slides": np.array([slid(t, disk).any(axis=1).sum() for t in T]),
        "thinnest": np.array([a.min() for a in angles]),
        "typical": np.array([np.median(a) for a in angles]),
    }
    row: dict[str, float] = {"triangles": len(T[0].triangles)}
    for label, column in columns.items():
        row |= {
            f"{label}_remeshed": float(f"{column[0]:.3g}"),
            f"{label}_random": float(f"{np.median(column[1:]):.3g}"),
        }
        for measure in ("AR_1e-4", "AR_1e-6", "AR_1e-9", "Var"):
            drawn = values[1:, MEASURES.index(measure)]
            flat = np.ptp(column[1:]) == 0 or np.ptp(drawn) == 0
            row[f"{label}_{measure}"] = np.nan if flat else round(float(spearmanr(column[1:], drawn).statistic), 3)
    return row


def summary(results: Sequence[dict[str, Any]]) -> pd.DataFrame:
    """Over all curves: a row a setting and measure."""
    rows = []
    labels = [*SETTINGS, *UNITS, *ARBITRARY]
    factors = list(dict.fromkeys(label.split(": ")[0] for label in labels))
    for label in sorted(labels, key=lambda label: factors.index(label.split(": ")[0])):
        found = [result["settings"][label] for result in results]
        X, Y = (np.array([f[key] for f in found]) for key in "XY")
        for i, measure in enumerate(MEASURES):
            ratio = Y[:, i] / X[:, i]
            row = dict(zip(("factor", "setting"), label.split(": "), strict=True)) | {"measure": measure}
            row |= {"below": (ratio > 1).sum(), "equal": (ratio == 1).sum(), "above": (ratio < 1).sum()}
            row |= {f"ratio_{key}": reduce(ratio) for key, reduce in REDUCE.items()}
            row["at_least_double"] = (ratio >= 2).sum()
            if "percentile" in found[0]:
                row["percentile_median"] = np.median([f["percentile"][i] for f in found])
            rows.append(row)
    table = pd.DataFrame(rows)
    ratios = [column for column in table if column.startswith("ratio_")]
    table[ratios] = table[ratios].map(lambda value: float(f"{value:.3g}"))
    return table.round({"percentile_median": 3})


def main() -> None:
    argparse.ArgumentParser(
        prog="python -m experiments.studies.sensitivity", description=__doc__.split("\n")[0]
    ).parse_args()
    names = list(shapes())
    results = compute("sensitivity", PARAMETERS, names, study)
    table = summary(results)
    write_csv(RESULTS / "sensitivity.csv", table)
    of_slides = [{"curve": name} | result["slides"] for name, result in zip(names, results, strict=True)]
    write_csv(RESULTS / "table_1_slides.csv", pd.DataFrame(of_slides))
    print(
        f"sensitivity: {len(names)} curves, {table.groupby(['factor', 'setting']).ngroups} settings "
        "-> results/sensitivity.csv, results/table_1_slides.csv"
    )


if __name__ == "__main__":
    main()
