"""Section 7, "Discussion": from which triangle should the motion spread?

For every curve of the gallery, every letter and random immersed disks, remeshed and morphed to their disks along both
of the paper's paths, every triangle is the root once.  What a root is like: the height of the dual tree hung from it,
the larger part of the curve on one side of it, its distance from the disk's centre, its area, how much its diagonals
change their lengths.  What its morph is like: AR, Var, excursions and ways of the vertices, total area, frames that
bound no immersed disk.  The root decides how large the shapes on the way are, so some are measured a second time on
shapes scaled to an area that changes linearly ("scaled").  Writes results/roots.csv, a row a root without the random
disks', and results/roots_summary.csv: where the roots by some rules lie among all, and rank correlations.

How large AR can be along "linear": with a root whose base has the length l(t), a triangle whose base is e times the
root's and whose third vertex is z over its base has the area l**2 |e|**2 Im z / 2.  Every z is linear in t, and each
hop down the tree multiplies e by z or 1 - z; only the hop across the root's base does not.  After k such hops the area
is l**2 times a polynomial of degree 2k + 1: all triangles down to there, to *level* k, span at most 2k + 2 dimensions.

Legend: ``t u`` triangles; ``a b c`` their corners, ab the base; ``side`` 0, 1, 2: edge ab, bc, ca.
"""

from collections.abc import Iterable
from fractions import Fraction
from itertools import product, zip_longest
from typing import Any

import numpy as np
import pandas as pd
import shapely
from numpy.typing import NDArray
from scipy.spatial.distance import pdist
from scipy.stats import spearmanr

from experiments.measures import MEASURES as TABLE_1
from experiments.measures import measures, percentile
from experiments.store import RESULTS, compute, rng_for, write_csv
from experiments.subjects import shape, shapes
from tween import Triangulation, area_matrix, frame_variance, paper_morph, remesh, triangulate, verify
from tween.choices import Path
from tween.gallery.generators import random_disk
from tween.geometry.dual_tree import RootedTree, disk_center, hops, rooted, tree_center
from tween.geometry.triangulation import arc_gaps

PARAMETERS: dict[str, Any] = {
    "seed": 20100,
    "frames": 100,
    "paths": ["linear", "slide"],
    "tolerances": [1e-4, 1e-6, 1e-9],
    "random_disks": 30,
    "n": 60,
}
PROPERTIES = ["height", "side", "distance", "area", "stretch"]
KEPT = [*TABLE_1, "Var_scaled", "excursion", "excursion_scaled", "area_max"]
MEASURES = [*KEPT, "area_min", "way_scaled", "unevenness_scaled"]
RULES = ["disk-center", "tree-center", "largest", "least stretched", "deepest leaf"]
PRIME = 2**31 - 1  # leaves 3 when divided by 4: x**2 + y**2 is 0 only for x = y = 0


def subject(name: str) -> Triangulation:
    """A curve of the gallery, a letter, or a random disk, remeshed."""
    if name.startswith("disk "):
        return remesh(random_disk(PARAMETERS["n"], rng_for(PARAMETERS["seed"], name)))
    return triangulate(shape(name))


def properties(T: Triangulation, disk: Triangulation) -> pd.DataFrame:
    """What every triangle is like as a root."""
    return pd.DataFrame(
        {
            "height": [int(hops(T, root).max()) for root in range(len(T.triangles))],
            "side": larger_side(T),
            "distance": distance_from_centre(T, disk),
            "area": T.areas / T.areas.sum(),
            "stretch": stretch(T, disk),
        }
    )


def larger_side(T: Triangulation) -> NDArray[np.float64]:
    """The largest share of the curve's length that lies across one edge of each triangle."""
    gaps = arc_gaps(T.points)
    corners = (np.cumsum(gaps) - gaps)[np.sort(T.triangles, axis=1)]
    return np.asarray(np.diff(np.column_stack([corners, corners[:, 0] + 1]), axis=1).max(axis=1))


def distance_from_centre(T: Triangulation, disk: Triangulation) -> NDArray[np.float64]:
    """Distances of the triangles on the disk from its centre, in radii; 0 for the one that holds it."""
    centre = T.areas @ T.points[T.triangles].mean(axis=1) / T.areas.sum()
    distances = shapely.distance(shapely.Point(centre), shapely.polygons(disk.points[disk.triangles]))
    return np.asarray(distances / np.sqrt(T.areas.sum() / np.pi))


def stretch(T: Triangulation, disk: Triangulation) -> NDArray[np.float64]:
    """By what factor the diagonals of each triangle are longer on the disk, or shorter; the geometric mean."""
    first, second = (lengths(np.roll(S.points[T.triangles], -1, axis=1) - S.points[T.triangles]) for S in (T, disk))
    inner = T.twin >= 0
    return np.asarray(np.exp(np.abs((np.log(second / first) * inner).sum(axis=1) / inner.sum(axis=1))))


def chosen(T: Triangulation, disk: Triangulation, about: pd.DataFrame) -> dict[str, int]:
    """The root by each rule; the last is the worst that a leaf can be."""
    return {
        "disk-center": disk_center(T, disk),
        "tree-center": tree_center(T),
        "largest": int(about["area"].argmax()),
        "least stretched": int(about["stretch"].argmin()),
        "deepest leaf": int(about["height"].argmax()),
    }


def measure(T: Triangulation, disk: Triangulation, path: Path, root: int) -> dict[str, Any]:
    """What the morph from one root is like; lengths in diameters of the source, areas in the source's."""
    m = paper_morph(T, disk, path=path, root=root)
    frames, A = m.frames(PARAMETERS["frames"]), area_matrix(m, PARAMETERS["frames"])
    total = A.sum(axis=0)
    factor = np.sqrt(np.linspace(total[0], total[-1], len(total)) / total)
    centres = frames[:, T.triangles[root]].mean(axis=1, keepdims=True)
    scaled = centres + (frames - centres) * factor[:, None, None]
    ways, diameter = lengths(np.diff(scaled, axis=0)).sum(axis=0), float(pdist(T.points).max())
    return dict(zip(TABLE_1, measures(A, PARAMETERS["tolerances"]), strict=True)) | {
        "Var_scaled": frame_variance(A * factor**2),
        "excursion": excursion(frames) / diameter,
        "excursion_scaled": excursion(scaled) / diameter,
        "area_max": float(total.max()),
        "area_min": float(total.min()),
        "way_scaled": float(ways.mean()) / diameter,
        "unevenness_scaled": float(ways.std() / ways.mean()),
        "frames_failed": verify(frames, T.triangles).frames_failed,
    }


def lengths(vectors: NDArray[np.float64]) -> NDArray[np.float64]:
    return np.hypot(vectors[..., 0], vectors[..., 1])


def excursion(frames: NDArray[np.float64]) -> float:
    """The largest distance of a vertex, in any frame, from the segment between its two ends."""
    along, moved = frames[-1] - frames[0], frames - frames[0]
    squared = np.maximum((along**2).sum(axis=-1), np.finfo(np.float64).tiny)
    share = np.clip((moved * along).sum(axis=-1) / squared, 0.0, 1.0)
    return float(lengths(moved - share[..., None] * along).max())


def parents(T: Triangulation, tree: RootedTree) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """The parent of each triangle, and on which side of it; the root's is -1."""
    across = T.twin[np.arange(len(T.triangles)), tree.base % 3]
    across[tree.order[0]] = -1
    return across // 3, (across - tree.base[across // 3]) % 3


def rank_bounds(T: Triangulation, root: int) -> tuple[int, int]:
    """Two bounds on AR along "linear": 2k + 2 for the lowest level k, and the same for the tree cut anywhere.

    A cut below level k leaves 2k + 2 for the triangles above it, and for each branch below it the least of what
    its cuts leave, or of 1 for its topmost triangle and the least for each branch of that.
    """
    tree = rooted(T, root)
    parent, side = parents(T, tree)
    least: dict[int, int] = {}
    below: dict[int, list[list[int]]] = {t: [] for t in range(len(parent))}  # of each child: least sums by level
    tops: list[list[int]] = []
    for t in tree.order[::-1].tolist():
        sums = _added(below.pop(t))
        least[t] = min(1 + sums[0], *(2 * k + 2 + rest for k, rest in enumerate(sums)))
        own = [least[t], *sums]
        (tops if t == root or side[t] == 0 else below[parent[t]]).append(own)
    sums = _added(tops)
    return min(len(parent), 2 * len(sums) - 2), min(sums[0], *(2 * k + rest for k, rest in enumerate(sums) if k > 0))


def _added(lists: Iterable[list[int]]) -> list[int]:
    """Sums level by level; a level further down there is nothing."""
    sums = [sum(level) for level in zip_longest(*lists, fillvalue=0)]
    return sums if sums and sums[-1] == 0 else [*sums, 0]


def exact_rank(T: Triangulation, disk: Triangulation, root: int) -> int:
    """The rank of the area matrix along "linear" at many times, the coordinates being taken at their word.

    It is computed modulo a prime, where a rank is never larger than the true one: if it equals a bound, that proves it.
    """
    return rank_modulo(areas_modulo(T, disk, root, np.arange(1, len(T.triangles) + 5)))


def areas_modulo(T: Triangulation, disk: Triangulation, root: int, times: NDArray[np.int64]) -> NDArray[np.int64]:
    """Twice the areas of all triangles, over the square of the root's base, modulo the prime."""
    tree = rooted(T, root)
    parent, side = parents(T, tree)
    corners = np.take_along_axis(T.triangles, (tree.base[:, None] + np.arange(3)) % 3, axis=1)
    first, second = (_third(_residues(S.points), corners) for S in (T, disk))
    x, y = (first[..., None] + (second - first)[..., None] % PRIME * times) % PRIME
    factors = np.stack([np.ones_like(x), (1 - x) ** 2 + y**2, x**2 + y**2]) % PRIME  # sums stay below 2**63
    squares = np.ones_like(x)
    for t in tree.order[1:]:
        squares[t] = squares[parent[t]] * factors[side[t], parent[t]] % PRIME
    return np.asarray(squares * y % PRIME)


def _residues(points: NDArray[np.float64]) -> NDArray[np.int64]:
    """Coordinates modulo the prime, (2, n): a double is a fraction whose denominator is a power of 2."""
    fractions = map(Fraction, points.T.ravel().tolist())
    residues = [x.numerator % PRIME * pow(x.denominator, -1, PRIME) % PRIME for x in fractions]
    return np.array(residues, np.int64).reshape(2, -1)


def _third(points: NDArray[np.int64], corners: NDArray[np.int64]) -> NDArray[np.int64]:
    """Third vertices over their bases, (c - a) / (b - a), as real and imaginary parts, (2, m)."""
    a, b, c = (points[:, corners[:, s]] for s in range(3))
    base = (b - a) % PRIME
    norms = (base[0] ** 2 + base[1] ** 2) % PRIME
    inverse = np.array([pow(norm, -1, PRIME) for norm in norms.tolist()], np.int64)
    x, y = (c - a) % PRIME
    real, imaginary = x * base[0] + y * base[1], y * base[0] % PRIME - x * base[1] % PRIME
    return np.stack([real, imaginary]) % PRIME * inverse % PRIME


def rank_modulo(A: NDArray[np.int64]) -> int:
    """The rank of a matrix of residues, by elimination."""
    A, rank = A.copy(), 0
    for column in range(A.shape[1]):
        rows = np.flatnonzero(A[rank:, column])
        if len(rows):
            A[[rank, rank + rows[0]]] = A[[rank + rows[0], rank]]
            A[rank] = A[rank] * pow(int(A[rank, column]), -1, PRIME) % PRIME
            A[rank + 1 :] = (A[rank + 1 :] - A[rank + 1 :, column, None] * A[rank] % PRIME) % PRIME
            rank += 1
    return rank


def study(name: str) -> dict[str, Any]:
    """Everything about one curve: a row a root and path, and the roots by the rules."""
    T = subject(name)
    disk = T.on_disk()
    about = without_noise(properties(T, disk))
    rules = chosen(T, disk, about)
    for root in set(rules.values()):
        ranks = *rank_bounds(T, root), exact_rank(T, disk, root)
        about.loc[root, ["height_bound", "cut_bound", "exact_rank"]] = ranks
    rows = [
        {"curve": name, "root": root, "path": path, **about.loc[root].to_dict(), **measure(T, disk, path, root)}
        for root, path in product(range(len(T.triangles)), PARAMETERS["paths"])
    ]
    return {"rows": rows, "rules": {"curve": name, **rules}}


def joined(results: list[dict[str, Any]]) -> tuple[pd.DataFrame, pd.DataFrame]:
    """All roots, each measure with its percentile among the curve's and ratios to their median and least; the rules."""
    rows = pd.DataFrame([row for result in results for row in result["rows"]])
    whole = ["height", "height_bound", "cut_bound", "exact_rank"]
    rows[whole] = rows[whole].astype("Int64")
    rows[MEASURES] = without_noise(rows[MEASURES])
    rows["set"] = np.where(rows["curve"].str.startswith("disk "), "random", "curves")
    rows["failed"] = (rows["frames_failed"] > 0).astype(float)
    groups = rows.groupby(["curve", "path"], sort=False)
    for m in MEASURES:
        rows[f"percentile {m}"] = groups[m].transform(lambda v: [percentile(x, v.to_numpy()) for x in v])
        rows[f"to_median {m}"] = rows[m] / groups[m].transform("median")
        rows[f"to_best {m}"] = rows[m] / groups[m].transform("min")
    return rows, pd.DataFrame([result["rules"] for result in results])


def by_rule(rows: pd.DataFrame, rules: pd.DataFrame) -> pd.DataFrame:
    """Where the root of each rule lies among all: medians over the curves of each set, and the share of failures."""
    result = []
    for rule in [*RULES, "any"]:
        own = rows if rule == "any" else rows.merge(rules[["curve", rule]].rename(columns={rule: "root"}))
        for (group, path), part in own.groupby(["set", "path"], sort=False):
            about = {"set": group, "path": path, "kind": "rule", "of": rule, "morphs": len(part)}
            result.append(about | {"measure": "failed", "value": part["failed"].mean()})
            for m in MEASURES:
                places = part[f"percentile {m}"]
                medians = {k: part[f"{k} {m}"].median() for k in ("percentile", "to_median", "to_best")}
                quarters = {"best_quarter": int((places <= 0.25).sum()), "worst_quarter": int((places >= 0.75).sum())}
                result.append(about | {"measure": m, "value": part[m].median()} | medians | quarters)
    return pd.DataFrame(result)


def correlations(rows: pd.DataFrame) -> pd.DataFrame:
    """Spearman's rank correlation over the roots of each curve, and its distribution over the curves of each set."""
    keys = ["set", "path", "of", "measure"]
    found = [
        {"set": group, "path": path, "of": p, "measure": m, "rho": float(spearmanr(part[p], part[m]).statistic)}
        for (group, _, path), part in rows.groupby(["set", "curve", "path"], sort=False)
        for p, m in product(PROPERTIES, MEASURES)
        if part[m].nunique() > 1
    ]
    rho = pd.DataFrame(found).groupby(keys, sort=False)["rho"]
    quartiles = rho.quantile([0.25, 0.5, 0.75]).unstack().set_axis(["rho_q25", "rho", "rho_q75"], axis=1)
    positive = rho.agg(lambda r: int((r > 0).sum()))
    return quartiles.assign(kind="correlation", curves=rho.size(), positive=positive).reset_index()


def wide(rows: pd.DataFrame, rules: pd.DataFrame) -> pd.DataFrame:
    """A row a root: the rules that choose it, what it is like, and its measures along both paths."""
    about = ["height_bound", "cut_bound", "exact_rank"]
    keys = ["curve", "root", *PROPERTIES, *about]
    table = rows[rows["path"] == PARAMETERS["paths"][0]][keys]
    for path in PARAMETERS["paths"]:
        own = rows[rows["path"] == path][["curve", "root", *KEPT]]
        table = table.merge(own.rename(columns={m: f"{m} {path}" for m in KEPT}))
    names = rules.melt("curve", var_name="rule", value_name="root").groupby(["curve", "root"])["rule"].agg("; ".join)
    table.insert(2, "rules", [names.get(pair, "") for pair in zip(table["curve"], table["root"], strict=True)])
    return table


def without_noise(table: pd.DataFrame) -> pd.DataFrame:
    """Floats to seven significant digits, so that equal ones compare as equal on every processor."""
    return table.map(lambda x: float(f"{x:.7g}") if isinstance(x, float) else x)


def rounded(table: pd.DataFrame) -> pd.DataFrame:
    """Floats to three significant digits, so that they agree across processors."""
    result = table.copy()
    for column in result.columns[result.dtypes == np.float64]:
        result[column] = result[column].map("{:.3g}".format, na_action="ignore")
    return result


def main() -> None:
    names = [*shapes(), *(f"disk {i}" for i in range(PARAMETERS["random_disks"]))]
    rows, rules = joined(compute("roots", PARAMETERS, names, study))
    write_csv(RESULTS / "roots.csv", rounded(wide(rows[rows["set"] == "curves"], rules)))
    summary = pd.concat([by_rule(rows, rules), correlations(rows)])
    counts = ["morphs", "curves", "best_quarter", "worst_quarter", "positive"]
    summary[counts] = summary[counts].astype("Int64")
    write_csv(RESULTS / "roots_summary.csv", rounded(summary))
    print(f"roots: {len(rows)} morphs from {len(names)} curves -> results/roots.csv, results/roots_summary.csv")


if __name__ == "__main__":
    main()
