"""Does the paper's measure measure quality?  What AR and Var go with, and how low they can be made.

**What they go with.**  Rank correlations (Spearman) of AR at three tolerances and of Var with what else can be said of
a morph, larger being worse for all of them:

    energy       of the map from end to end (symmetric Dirichlet; 4 is the least), where its triangles are the same
    swelling     the largest area on the way over that of the larger end
    path_length  of a vertex, the mean over all vertices, in widths of the larger end
    invalid      of 61 frames those that bound no immersed disk

over three kinds of groups: the pairs of results/matching.csv by method; the methods of one pair, which have the same
two ends, so that the measure has to tell a better morph from a worse one; and random triangulations of one curve,
morphed to its disk along "slide" as for Table 1.  Of many groups the median is given.  Intervals are 95 %, from 2,000
bootstrap samples of curves (the ranks of pairs are taken once).

**How low they can be made.**  On ten curves, drawn with the seed: the least AR (1e-4) and the least Var of 1,000
random triangulations, and a local search by flips from the remeshed one and from the best random one, which takes the
first flip that improves AR (with Var for ties), or Var, until none does.  What is found is measured like the rest.

Writes results/quality.csv, a row a kind of group, measure and quality, and results/quality_search.csv.
"""

from collections.abc import Callable, Iterator
from itertools import product
from typing import Any

import numpy as np
import pandas as pd
from numpy.typing import NDArray
from scipy.stats import rankdata, spearmanr

from experiments.measures import MEASURES, measures, swelling
from experiments.store import RESULTS, compute, rng_for, write_csv
from experiments.studies.matching import METHODS, interval, path_length, resampled_weights
from experiments.subjects import shape, shapes
from tween import Triangulation, area_matrix, decompose, remesh, verify
from tween.morphing.matching.match import energy
from tween.morphing.strategy import morph_compatible
from tween.triangulating.flips import flip, flippable

PARAMETERS: dict[str, Any] = {
    "seed": 20100,
    "frames": 100,
    "disk_frames": 61,
    "curves": 10,
    "random": 1000,
    "measured": 200,
    "evaluations": 2500,
    "resamples": 2000,
}
QUALITIES = ["energy", "swelling", "path_length", "invalid"]
Key = Callable[[list[float]], tuple[float, float]]
OBJECTIVES: dict[str, Key] = {"AR": lambda values: (values[0], values[-1]), "Var": lambda values: (0.0, values[-1])}
# On a symmetric curve triangulations and their mirror images tie, but for rounding, which processors do differently.
ROUNDING = 1e-9


# What they go with


def with_invalid(rows: pd.DataFrame) -> pd.DataFrame:
    """The table of all morphs, frames that bound no disk counted."""
    return rows.assign(invalid=PARAMETERS["disk_frames"] - rows.disks)


def within_pairs(rows: pd.DataFrame, measure: str, quality: str) -> pd.Series:
    """The rank correlation over the methods of each pair; none where one of the two is the same for all."""
    found = {}
    for pair, of in with_invalid(rows).groupby(["source", "target"], sort=False):
        both = of[[measure, quality]].to_numpy(dtype=np.float64)
        both = both[~np.isnan(both).any(axis=1)]
        if len(both) and (both != both[0]).any(axis=0).all():
            # what spearmanr gives, without its test, which takes most of its time
            found[pair] = float(np.corrcoef(rankdata(both, axis=0), rowvar=False)[1, 0])
    pairs = pd.MultiIndex.from_tuples(list(found), names=["source", "target"]) if found else None
    return pd.Series(list(found.values()), index=pairs, dtype=float)


def by_method(rows: pd.DataFrame, draws: pd.DataFrame) -> Iterator[dict[str, Any]]:
    """Correlations over the pairs, for each method."""
    for method, measure, quality in product(METHODS, MEASURES, QUALITIES):
        of = with_invalid(rows[rows.method == method]).set_index(["source", "target"])[[measure, quality]].dropna()
        if len(of) and (of.nunique() > 1).all():
            ranks = rankdata(of.to_numpy(dtype=np.float64), axis=0)
            rho = weighted_correlation(ranks, np.ones((len(of), 1)))[0]
            spread = weighted_correlation(ranks, draws.loc[of.index].to_numpy())
            yield _row(f"pairs: {method}", measure, quality, len(of), rho, interval(spread[np.isfinite(spread)]))


def weighted_correlation(values: NDArray[np.float64], weights: NDArray[np.float64]) -> NDArray[np.float64]:
    """Pearson's correlation of two columns under each column of weights."""
    share = weights / np.maximum(weights.sum(axis=0), 1)
    apart = values[:, :, None] - np.einsum("ij,ik->jk", values, share)
    cov, first, second = (
        np.einsum("ik,ik,ik->k", apart[:, a], apart[:, b], share) for a, b in ((0, 1), (0, 0), (1, 1))
    )
    with np.errstate(invalid="ignore", divide="ignore"):
        return np.asarray(cov / np.sqrt(first * second))


def of_one_pair(rows: pd.DataFrame, draws: pd.DataFrame) -> Iterator[dict[str, Any]]:
    """The median correlation over the methods of one pair."""
    for measure, quality in product(MEASURES, QUALITIES[1:]):
        rho = within_pairs(rows, measure, quality)
        yield _row("methods of one pair", measure, quality, len(rho), rho.median(), median_interval(rho, draws))


def median_interval(values: pd.Series, draws: pd.DataFrame) -> dict[str, float]:
    """The interval of a median over pairs, curves being resampled."""
    order = values.sort_values()
    below = np.cumsum(draws.loc[order.index].to_numpy(), axis=0)
    below = below[:, below[-1] > 0]
    return interval(order.to_numpy()[(below >= below[-1] / 2).argmax(axis=0)])


def of_one_curve(found: pd.DataFrame) -> Iterator[dict[str, Any]]:
    """The median correlation over random triangulations of one curve."""
    for measure, quality in product(MEASURES, QUALITIES):
        own = found[[f"{measure} {quality}"]].dropna().to_numpy()[:, 0]
        if len(own):
            rng = rng_for(PARAMETERS["seed"], f"quality {measure} {quality}")
            spread = np.median(rng.choice(own, (PARAMETERS["resamples"], len(own))), axis=1)
            scope = "triangulations of one curve"
            yield _row(scope, measure, quality, len(own), float(np.median(own)), interval(spread))


def _row(scope: str, measure: str, quality: str, groups: int, rho: float, ci: dict[str, float]) -> dict[str, Any]:
    return {"scope": scope, "measure": measure, "quality": quality, "cases": groups, "rho": rho} | ci


# How low they can be made


def curves() -> list[str]:
    """The curves that are searched, in the order of all."""
    names = list(shapes())
    chosen = rng_for(PARAMETERS["seed"], "quality").choice(len(names), PARAMETERS["curves"], replace=False)
    return [names[i] for i in sorted(chosen.tolist())]


def to_the_disk(T: Triangulation, disk: NDArray[np.float64]) -> list[float]:
    """AR at three tolerances, and Var."""
    m = morph_compatible(T, T.moved(disk), "slide", guarantee=False, placement="root", root="disk-center")
    return measures(area_matrix(m, PARAMETERS["frames"]))


def qualities(T: Triangulation, disk: NDArray[np.float64]) -> dict[str, float]:
    """What else can be said of a morph to the disk."""
    m = morph_compatible(T, T.moved(disk), "slide", guarantee=False, placement="root", root="disk-center")
    frames = m.frames(PARAMETERS["disk_frames"])
    return {
        "energy": energy(m.source, m.target),
        "swelling": swelling(area_matrix(m, PARAMETERS["frames"])),
        "path_length": path_length(frames),
        "invalid": verify(frames, T.triangles).frames_failed,
    }


def lower(a: tuple[float, float], b: tuple[float, float]) -> bool:
    """Whether a, a rank or 0 and a variance, is lower than b by more than rounding."""
    return a[0] < b[0] or (a[0] == b[0] and a[1] < (1 - ROUNDING) * b[1])


def lowest(values: list[tuple[float, float]]) -> int:
    """Where the lowest is; of those that tie, the first."""
    best = 0
    for i, value in enumerate(values):
        best = i if lower(value, values[best]) else best
    return best


def descend(
    T: Triangulation, value: Callable[[Triangulation], tuple[float, float]], rng: np.random.Generator, evaluations: int
) -> tuple[Triangulation, int]:
    """Take the first flip that lowers a value, until none does; returns how many triangulations were looked at.

    Where the evaluations are used up, what was reached is returned.
    """
    best, looked_at = value(T), 0
    improved = True
    while improved:
        improved = False
        for a, b in rng.permutation(T.diagonals[flippable(T)]).tolist():
            if looked_at == evaluations:
                return T, looked_at
            other = flip(T, (a, b))
            found, looked_at = value(other), looked_at + 1
            if lower(found, best):
                T, best, improved = other, found, True
                break
    return T, looked_at


def work(name: str) -> dict[str, Any]:
    """Random triangulations of a curve, the best of them, what a search finds, and what goes with what."""
    rng = rng_for(PARAMETERS["seed"], f"quality {name}")
    d = decompose(shape(name))
    T, drawn = remesh(d.arbitrary()), d.sample(rng, PARAMETERS["random"])
    disk = T.on_disk().points
    values = [to_the_disk(S, disk) for S in drawn]
    rows = [_told(name, "remeshed", T, disk, 0)]
    for objective, key in OBJECTIVES.items():
        least = drawn[lowest([key(value) for value in values])]
        rows.append(_told(name, f"{objective}, best random", least, disk, len(drawn)))

        def value(U: Triangulation, key: Key = key) -> tuple[float, float]:
            return key(to_the_disk(U, disk))

        for start, S in (("remeshed", T), ("best random", least)):
            best, looked_at = descend(S, value, rng, PARAMETERS["evaluations"])
            rows.append(_told(name, f"{objective}, search from {start}", best, disk, looked_at))
    spread = np.array(values)
    about = pd.DataFrame([qualities(S, disk) for S in drawn[: PARAMETERS["measured"]]])
    medians = dict(zip(MEASURES, np.median(spread, axis=0), strict=True)) | about.median().to_dict()
    rows.append({"curve": name, "triangulation": "random, median"} | medians)
    about[MEASURES] = spread[: len(about)]
    rho = {f"{m} {q}": _spearman(about[m], about[q]) for m, q in product(MEASURES, QUALITIES)}
    return {"rows": rows, "correlations": {"curve": name} | rho}


def _told(name: str, which: str, T: Triangulation, disk: NDArray[np.float64], looked_at: int) -> dict[str, Any]:
    own = dict(zip(MEASURES, to_the_disk(T, disk), strict=True)) | qualities(T, disk)
    return {"curve": name, "triangulation": which, "looked_at": looked_at} | own


def _spearman(a: pd.Series, b: pd.Series) -> float | None:
    return float(spearmanr(a, b).statistic) if a.nunique() > 1 and b.nunique() > 1 else None


def rounded(table: pd.DataFrame) -> pd.DataFrame:
    """Floats to three digits, whole numbers as such."""
    result = table.copy()
    for column in result.columns[result.dtypes == np.float64]:
        result[column] = result[column].map("{:.3g}".format, na_action="ignore")
    return result


def main() -> None:
    found = compute("quality", PARAMETERS, curves(), work)
    rows = pd.read_csv(RESULTS / "matching.csv")
    draws = resampled_weights(rows)
    correlations = pd.DataFrame([part["correlations"] for part in found])
    table = pd.DataFrame([*of_one_pair(rows, draws), *of_one_curve(correlations), *by_method(rows, draws)])
    write_csv(RESULTS / "quality.csv", rounded(table))
    search = pd.DataFrame([row for part in found for row in part["rows"]])
    search["looked_at"] = search["looked_at"].astype("Int64")
    write_csv(RESULTS / "quality_search.csv", rounded(search))
    print(f"quality: {len(rows)} morphs, {len(found)} curves -> results/quality.csv, results/quality_search.csv")


if __name__ == "__main__":
    main()
