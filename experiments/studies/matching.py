"""Matching: what do the correspondence and the triangulation do to a morph, over all pairs of curves?

For all 561 pairs of gallery curves and letters, and ten methods:

    paper                    as printed: pivots matched, flips in sequence, path slide, placed by the root
    paper_guaranteed         the same correspondence and flips; path metric, guaranteed, placed steadily
    common                   a triangulation valid in both under some renumbering, where there is one; else as before
    matched                  `tween.morph` as it is
    straight, edge_angle, as_rigid_as_possible
                             what others use, on the paper's correspondence; with "_matched" on that of `matched`

What is measured, of 100 frames unless it says otherwise:

    energy       of the map from end to end, where its triangles are the same in both; 4 is the least
    AR, Var      of Table 1, AR at three tolerances; of a baseline, under the source's triangles
    swelling     the largest area over that of the larger end
    path_length  of a vertex, the mean over all vertices, in widths of the larger end
    disks        of 61 frames those that bound an immersed disk, exactly: under the triangles in force, or else any

The questions are decided by shares of pairs and by medians.  Rules, stated before the numbers: one method is better
than another in a measure where it is smaller on at least two thirds of the pairs and the 95 % interval of that share
lies above a half.  An interval is that of 2,000 bootstrap samples, drawn from the 34 curves and not from the 561
pairs, since pairs that share a curve are not independent; a pair counts as often as both of its curves were drawn.

Writes results/matching.csv, a row a pair and method, and results/matching_summary.csv: distributions with intervals of
their medians, and the shares of pairs on which `matched` is better than each other method.  It takes long, and
`reproduce` recomputes a sample only, see `.matching_sample`.
"""

from collections.abc import Callable, Iterator
from functools import partial
from time import perf_counter
from typing import Any

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from experiments import subjects
from experiments.baselines import BASELINES
from experiments.measures import RANKS, measures, swelling
from experiments.store import RESULTS, compute, rng_for, write_csv
from tween import Curve, CurveError, Morph, area_matrix, decompose, morph, paper_morph, verify
from tween.choices import Strategy
from tween.errors import GuaranteeError, IncompatibleError
from tween.geometry.curve import turning_number
from tween.morphing.matching.match import energy

PARAMETERS: dict[str, Any] = {
    "seed": 20100,
    "frames": 100,
    "disk_frames": 61,
    "resamples": 2000,
    "digits": 3,
}
OURS = ("paper", "paper_guaranteed", "common", "matched")
METHODS = (*OURS, *BASELINES, *(f"{name}_matched" for name in BASELINES))
MEASURES = ["flips", "energy", *RANKS, "Var", "swelling", "path_length", "disks"]
LARGER_IS_BETTER = ("disks",)
LEAST_VARIANCE = 1e-12  # a smaller one is rounding, and written as this
COLUMNS = ["source", "target", "method", "n", "guaranteed", *MEASURES]


def methods(source: Curve, target: Curve) -> Iterator[tuple[str, Morph | None, float]]:
    """Each method's morph, None where there is none, and the seconds that it took to find."""
    found: dict[str, Morph | None] = {}
    for name, make in _OWN.items():
        start = perf_counter()
        try:
            found[name] = make(source, target)
        except IncompatibleError:
            found[name] = None
        yield name, found[name], perf_counter() - start
    for base, suffix in (("paper", ""), ("matched", "_matched")):
        on = found[base]
        assert on is not None
        for name, baseline in BASELINES.items():
            start = perf_counter()
            yield f"{name}{suffix}", baseline(on.source, on.target), perf_counter() - start


def _guaranteed(source: Curve, target: Curve, strategy: Strategy) -> Morph:
    """The morph with the guarantee; where that is refused, which the table says, the same without."""
    try:
        return morph(source, target, strategy=strategy)
    except GuaranteeError:
        return morph(source, target, guarantee=False, strategy=strategy)


_OWN: dict[str, Callable[[Curve, Curve], Morph]] = {
    "paper": paper_morph,
    "paper_guaranteed": partial(_guaranteed, strategy="paper"),
    "common": partial(_guaranteed, strategy="common"),
    "matched": partial(_guaranteed, strategy="auto"),
}


def measure(m: Morph) -> dict[str, Any]:
    """What a morph is like."""
    frames = m.frames(PARAMETERS["disk_frames"])
    A = area_matrix(m, PARAMETERS["frames"])
    return {
        "n": len(m.source),
        "guaranteed": int(bool(m.proof)),
        "flips": len(m.events),
        "energy": energy(m.source, m.target) if np.array_equal(m.source.canonical, m.target.canonical) else None,
        **dict(zip([*RANKS, "Var"], measures(A), strict=True)),
        "swelling": swelling(A),
        "path_length": path_length(frames),
        "disks": disks(m, frames),
    }


def path_length(frames: NDArray[np.float64]) -> float:
    """The mean length of the vertices' paths, in widths of the larger end."""
    steps = np.diff(frames, axis=0)
    width = max(np.ptp(shape, axis=0).max() for shape in (frames[0], frames[-1]))
    return float(np.hypot(steps[..., 0], steps[..., 1]).sum(axis=0).mean() / width)


def disks(m: Morph, frames: NDArray[np.float64]) -> int:
    """How many frames bound an immersed disk: under the triangles in force, or else under any others, exactly."""
    times = np.linspace(0, 1, len(frames))
    triangles = np.array([m.triangles_at(t) for t in times])
    if verify(frames, triangles, times):
        return len(frames)
    return sum(bool(verify(shape, shown)) or bounds_disk(shape) for shape, shown in zip(frames, triangles, strict=True))


def bounds_disk(points: NDArray[np.float64]) -> bool:
    """Whether a polygon, counter-clockwise, bounds any immersed disk, exactly."""
    try:
        return turning_number(points) == 1 and bool(decompose(Curve(points)))
    except CurveError:
        return False


def work(pair: str) -> list[dict[str, Any]]:
    """The rows of one pair, a row a method that has a morph; seconds are for printing only."""
    source, target = subjects.both(pair)
    first, second = pair.split(subjects.BETWEEN)
    rows = []
    for name, m, seconds in methods(source, target):
        if m is not None:
            rows.append({"source": first, "target": second, "method": name} | measure(m) | {"seconds": seconds})
    return rows


def table(rows: list[dict[str, Any]]) -> pd.DataFrame:
    """The rows, rounded to digits that processors agree on."""
    result = pd.DataFrame(rows)[COLUMNS]
    result["Var"] = result["Var"].astype(float).clip(lower=LEAST_VARIANCE)
    for column in ("energy", "Var", "swelling", "path_length"):
        result[column] = result[column].astype(float).map(_rounded)
    return result


def _rounded(value: float) -> float:
    return float(f"{value:.{PARAMETERS['digits']}g}")


# Summary


def summary(rows: pd.DataFrame) -> pd.DataFrame:
    """Distributions by method and measure, and the shares on which `matched` is better, with 95 % intervals."""
    draws = resampled_weights(rows)
    found = []
    for method in METHODS:
        own = rows[rows.method == method].set_index(["source", "target"])
        for name in MEASURES:
            values = own[name].dropna()
            if len(values):
                found.append({"method": method, "measure": name, **distribution(values, draws)})
        found.append({"method": method, "measure": "all_disks", **share(own.disks == PARAMETERS["disk_frames"], draws)})
        if method != "matched":
            found += [_compared(rows, method, name, draws) for name in MEASURES]
    columns = ["method", "measure", "pairs", "min", "q25", "median", "q75", "max", "share", "low", "high"]
    result = pd.DataFrame([row for row in found if row["pairs"]], columns=columns)
    for column in columns[3:]:
        result[column] = result[column].astype(float).map(_rounded)
    return result


def resampled_weights(rows: pd.DataFrame) -> pd.DataFrame:
    """How often each pair counts in each bootstrap sample of the curves; a column a sample."""
    pairs = rows[["source", "target"]].drop_duplicates()
    names = sorted({*pairs.source, *pairs.target})
    rng = rng_for(PARAMETERS["seed"], "matching, bootstrap")
    counts = rng.multinomial(len(names), np.full(len(names), 1 / len(names)), PARAMETERS["resamples"]).T
    number = {name: i for i, name in enumerate(names)}
    weights = counts[pairs.source.map(number)] * counts[pairs.target.map(number)]
    return pd.DataFrame(weights, index=pd.MultiIndex.from_frame(pairs))


def distribution(values: pd.Series, draws: pd.DataFrame) -> dict[str, float]:
    """Least, quartiles and largest, and the interval of the median."""
    quartiles = dict(zip(("min", "q25", "median", "q75", "max"), values.quantile([0, 0.25, 0.5, 0.75, 1]), strict=True))
    order = values.sort_values()
    below = np.cumsum(draws.loc[order.index].to_numpy(), axis=0)
    below = below[:, below[-1] > 0]
    medians = order.to_numpy()[(below >= below[-1] / 2).argmax(axis=0)]
    return {"pairs": len(values), **quartiles, **interval(medians)}


def share(holds: pd.Series, draws: pd.DataFrame) -> dict[str, float]:
    """The share of pairs for which something holds, with its interval."""
    if holds.empty:
        return {"pairs": 0}
    weights = draws.loc[holds.index].to_numpy()
    weights = weights[:, weights.sum(axis=0) > 0]
    shares = holds.to_numpy() @ weights / weights.sum(axis=0)
    return {"pairs": len(holds), "share": float(holds.mean()), **interval(shares)}


def interval(values: NDArray[np.float64]) -> dict[str, float]:
    """The middle 95 % of bootstrap values."""
    low, high = np.quantile(values, [0.025, 0.975]) if len(values) else (np.nan, np.nan)
    return {"low": float(low), "high": float(high)}


def _compared(rows: pd.DataFrame, method: str, name: str, draws: pd.DataFrame) -> dict[str, Any]:
    """The share of pairs on which `matched` is better than a method, ties counted half."""
    wide = rows[rows.method.isin(["matched", method])].pivot(index=["source", "target"], columns="method", values=name)
    wide = wide.dropna()
    sign = -1 if name in LARGER_IS_BETTER else 1
    better = (np.sign(sign * (wide[method] - wide.matched)) + 1) / 2 if len(wide) else pd.Series(dtype=float)
    return {"method": method, "measure": f"matched_better: {name}", **share(better, draws)}


def report_seconds(rows: list[dict[str, Any]]) -> None:
    """Say how long the methods took: times are no results that could be found again."""
    seconds = pd.DataFrame(rows).groupby("method", sort=False).seconds
    for name, of in seconds:
        print(f"matching: {name:<30} {of.median():8.2f} s in the median, {of.max():8.2f} s at most")


def main() -> None:
    names = subjects.pairs()
    rows = [row for part in compute("matching", PARAMETERS, names, work) for row in part]
    found = table(rows)
    write_csv(RESULTS / "matching.csv", found)
    write_csv(RESULTS / "matching_summary.csv", summary(found))
    report_seconds(rows)
    print(f"matching: {len(names)} pairs -> results/matching.csv, results/matching_summary.csv")


if __name__ == "__main__":
    main()
