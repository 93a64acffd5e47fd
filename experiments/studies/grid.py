"""Table 1, the grid: everything that the paper leaves open, curve by curve and pair by pair.

    path         linear, slide
    pace         time, the motion's own clock; speed, the vertices at constant root mean square speed
    tolerance    of the rank: 1e-2 to 1e-12, and the default of MATLAB's `rank` in double and in single precision
    frames       25, 50, 100, 200, 400
    n            vertices of each curve: 24, 48, 96, 192
    arbitrary    the median of a uniform sample (of a pair also a low and a high quantile), the first and the last split

All curves of `experiments.family` are morphed to their disks (results/grid_disk.csv), and our stand-ins for the
paper's four columns from curve to curve (results/grid_pairs.csv), remeshed beside arbitrary. An area matrix is
computed once for each curve, triangulation, path, pace, n and number of frames, and gives all tolerances; the number
of frames is varied at one n, and n at 100 frames. Between two curves "own" is a triangulation drawn for each, and
"common" one that is valid in both; the zigzags of the paper's rows 1 and 3 stay zigzags at every n, so that they stay
compatible, but for a handful of flips at 192 vertices.

What the law of `.grid_law` needs stands in results/grid_shapes.csv: measures of shape, and for each triangulation the
height of the rooted dual tree, the number of triangles that slide, and the number of "deep" slides: those that spare a
propagation edge to be shortened by more than 1 %.

A rank is written only where perturbing the areas does not move it, see `measures.certain_ranks`; a median of ranks,
where the medians of the least and of the largest possible ranks agree.  Ranks of relative tolerance have no unit; Var
is given in squared areas of the source, and areas are given to convert it.  It takes ten minutes of one core, so
`reproduce` recomputes a sample only, see `.grid_sample`.
"""

import argparse
from collections.abc import Callable, Iterator, Sequence
from typing import Any

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from experiments import family
from experiments.measures import certain_ranks, shortening, slid
from experiments.store import RESULTS, compute, rng_for, write_csv
from tween import (
    Decomposition,
    Morph,
    Triangulation,
    area_matrix,
    decompose,
    frame_variance,
    gallery,
    paper_morph,
    remesh,
)
from tween.choices import Pace, Path
from tween.errors import CurveError
from tween.geometry.dual_tree import rooted
from tween.morphing.compatible.leg import root_triangle
from tween.morphing.strategy import morph_compatible

PARAMETERS: dict[str, Any] = {
    "seed": 20100,
    "samples": 24,
    "sizes": [24, 48, 96, 192],
    "frames": [25, 50, 100, 200, 400],
    "n": 96,  # at which the number of frames is varied; a pair's own number of vertices where it is 0
    "default_frames": 100,
}
PATHS: tuple[Path, ...] = ("linear", "slide")
PACES: tuple[Pace, ...] = ("time", "speed")
TOLERANCES = ("1e-2", "1e-3", "1e-4", "1e-5", "1e-6", "1e-7", "1e-8", "1e-9", "1e-10", "1e-11", "1e-12")
RANKS = [*(f"AR_{rtol}" for rtol in TOLERANCES), "AR_double", "AR_single"]
COUNTED = ("height", "slides", "deep")
DEEP = 0.01  # by which a deep slide keeps a propagation edge from being shortened
ROWS = (1, 3, 4, 7)
LEAST_VARIANCE = 1e-14  # a smaller one is rounding, and written as this
PAIR, OWN_N = "row ", 0
QUANTILES = {"low": 0.05, "median": 0.5, "high": 0.95}
Measured = tuple[list[int], list[int], float]
Array = NDArray[np.float64]


def parts() -> list[str]:
    """What is computed at once: a curve, or a pair, with a number of vertices."""
    subjects = [*family.names(), *(f"{PAIR}{row}" for row in ROWS)]
    sizes = {
        name: PARAMETERS["sizes"] if name in family.names() else [OWN_N, *PARAMETERS["sizes"]] for name in subjects
    }
    return [f"{name} @{n}" for name in subjects for n in sizes[name]]


def work(part: str) -> dict[str, list[dict[str, Any]]]:
    """The rows of a part, by the table that they go to; none where the curve cannot have so few vertices."""
    name, size = part.split(" @")
    if name.startswith(PAIR):
        return {"pairs": pair_rows(int(name.removeprefix(PAIR)), int(size))}
    curve = family.at(name, int(size))
    d = decompose(curve)
    T = {"remeshed": remesh(d.arbitrary()), "first": d.arbitrary(), "last": d.arbitrary("last")}
    drawn = d.sample(rng_for(PARAMETERS["seed"], part), PARAMETERS["samples"])
    return {"disk": disk_rows(name, int(size), T, drawn), "shapes": [shape_row(name, T, drawn)]}


def frame_counts(n: int, at: int) -> list[int]:
    """At one number of vertices all numbers of frames, else the default."""
    return PARAMETERS["frames"] if n == at else [PARAMETERS["default_frames"]]


def measured(A: Array) -> Measured:
    """Least and largest ranks, and Var."""
    return *certain_ranks(A, [float(rtol) for rtol in TOLERANCES]), frame_variance(A)


def cells(values: Sequence[Measured], q: float) -> dict[str, Any]:
    """A quantile of some area matrices' measures; a rank None where it is not certain."""
    least, most = (np.quantile([v[i] for v in values], q, axis=0, method="inverted_cdf") for i in (0, 1))
    ranks = [int(a) if a == b else None for a, b in zip(least, most, strict=True)]
    variance = float(np.quantile([v[2] for v in values], q, method="inverted_cdf"))
    return dict(zip(RANKS, ranks, strict=True)) | {"Var": float(f"{max(variance, LEAST_VARIANCE):.3g}")}


def each_setting() -> Iterator[tuple[Path, Pace]]:
    for path in PATHS:
        for pace in PACES:
            yield path, pace


# To the disk


def disk_rows(name: str, n: int, T: dict[str, Triangulation], drawn: Sequence[Triangulation]) -> list[dict[str, Any]]:
    """A row for each path, pace, number of frames and kind of triangulation."""
    disk, frames = T["remeshed"].on_disk().points, frame_counts(n, PARAMETERS["n"])
    rows = []
    for path, pace in each_setting():

        def measure(t: Triangulation, path: Path = path, pace: Pace = pace) -> list[Measured]:
            m = morph_compatible(t, t.moved(disk), path, guarantee=False, placement="root", pace=pace)
            return [measured(area_matrix(m, k)) for k in frames]

        single = {kind: measure(t) for kind, t in T.items()}
        sample = [measure(t) for t in drawn]
        for i, k in enumerate(frames):
            about = {"curve": name, "n": n, "path": path, "pace": pace, "frames": k}
            rows += [about | {"triangulation": kind} | cells([values[i]], 0.5) for kind, values in single.items()]
            rows.append(about | {"triangulation": "uniform"} | cells([values[i] for values in sample], 0.5))
    return rows


def shape_row(name: str, T: dict[str, Triangulation], drawn: Sequence[Triangulation]) -> dict[str, Any]:
    """Measures of the curve, and of its triangulations the height of the rooted tree and the number of slides."""
    R = T["remeshed"]
    disk, area = R.on_disk().points, float(R.areas.sum())
    row = {"curve": name, "kind": family.names()[name], "n": len(R)}
    row |= {"area": f"{area:.5g}", "isoperimetric": f"{family.isoperimetric(R.points, area):.4g}"}
    row |= {"branching": f"{family.branching(R):.4f}"}
    counted = {kind: [counts(t, disk)] for kind, t in T.items()} | {"uniform": [counts(t, disk) for t in drawn]}
    for i, label in enumerate(COUNTED):
        for kind, values in counted.items():
            row[f"{label}_{kind}"] = int(np.quantile([v[i] for v in values], 0.5, method="inverted_cdf"))
    return row


def counts(T: Triangulation, target: Array) -> tuple[int, int, int]:
    """The height of the dual tree from the usual root, how many triangles slide, and how many by much."""
    tree = rooted(T, root_triangle("disk-center", T, T.moved(target)))
    deep = shortening(T, target) > DEEP
    return int(tree.depth.max()), int(slid(T, target).any(axis=1).sum()), int(deep.sum())


# From curve to curve


def pair_rows(row: int, n: int) -> list[dict[str, Any]]:
    """The rows of one of the paper's columns with n vertices for each curve, or, n being 0, its own number."""
    try:
        ends = family.pair_at(gallery.pairs()[row - 1], n or None)
    except CurveError:
        return []
    kinds = arbitrary(ends, rng_for(PARAMETERS["seed"], f"{PAIR}{row} @{n}"))
    frames, rows = frame_counts(n, OWN_N), []
    for path, pace in each_setting():
        found = {"remeshed": [matrices(paper_morph(*ends, path, pace=pace), frames)]}
        for kind, drawn in kinds.items():
            found[kind] = [matrices(paper_morph(S, T, path, shifts=0, pace=pace), frames) for S, T in drawn]
        for i, k in enumerate(frames):
            about = {"row": row, "n": n, "path": path, "pace": pace, "frames": k}
            for kind, values in found.items():
                quantiles = QUANTILES if len(values) > 1 else {"": 0.5}
                for label, q in quantiles.items():
                    which = f"{kind}_{label}".rstrip("_")
                    steps = np.quantile([v[0] for v in values], q, axis=0, method="inverted_cdf").astype(int).tolist()
                    some = [v[1][i] for v in values]
                    counted = {"flips": steps[0], "slides": None if steps[0] else steps[1]}
                    rows.append(about | {"triangulation": which} | counted | cells(some, q))
    return rows


def matrices(m: Morph, frames: Sequence[int]) -> tuple[list[int], list[Measured]]:
    """The numbers of flips and, without flips, of slides; and the measures for each number of frames."""
    slides = 0 if m.events else counts(m.source, m.target.points)[1]
    return [len(m.events), slides], [measured(area_matrix(m, k)) for k in frames]


def arbitrary(ends: tuple[Any, Any], rng: np.random.Generator) -> dict[str, list[tuple[Triangulation, Triangulation]]]:
    """Pairs of arbitrary triangulations under the correspondence of the remeshed ones: kind -> pairs."""
    a = paper_morph(*ends).alignment
    own = [decompose(T.curve) for T in (a.source, a.target)]
    take: dict[str, Callable[[Decomposition], Triangulation]]
    take = {"first": lambda d: d.arbitrary(), "last": lambda d: d.arbitrary("last")}
    kinds = {kind: [(choose(own[0]), choose(own[1]))] for kind, choose in take.items()}
    drawn = [d.sample(rng, PARAMETERS["samples"]) for d in own]
    kinds["own"] = list(zip(*drawn, strict=True))
    joint = decompose(a.source.curve, a.target.curve)
    if joint:
        shared = joint.sample(rng, PARAMETERS["samples"])
        kinds["common"] = [(S, Triangulation(a.target.points, S.triangles)) for S in shared]
    return kinds


def tables(results: Sequence[dict[str, list[dict[str, Any]]]]) -> dict[str, pd.DataFrame]:
    """All rows by table, ranks as whole numbers or nothing."""
    found = {}
    for name in ("disk", "pairs", "shapes"):
        table = pd.DataFrame([row for result in results for row in result.get(name, [])])
        for column in {*RANKS, "slides"} & set(table):
            table[column] = table[column].astype("Int64")
        found[name] = table
    return found


def main() -> None:
    argparse.ArgumentParser(prog="python -m experiments.studies.grid", description=__doc__.split("\n")[0]).parse_args()
    names = parts()
    found = tables(compute("grid", PARAMETERS, names, work))
    write_csv(RESULTS / "grid_disk.csv", found["disk"])
    write_csv(RESULTS / "grid_pairs.csv", found["pairs"])
    write_csv(RESULTS / "grid_shapes.csv", found["shapes"])
    print(
        f"grid: {len(found['disk'])} rows to the disk, {len(found['pairs'])} from curve to curve "
        "-> results/grid_disk.csv, results/grid_pairs.csv, results/grid_shapes.csv"
    )


if __name__ == "__main__":
    main()
