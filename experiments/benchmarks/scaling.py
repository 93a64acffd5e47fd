"""Time recognition, triangulation and morphs from 1,000 to 100,000 vertices, beside peers in one process.

Times are no result that `make reproduce` could find again, so results/scaling.csv changes only when one says so.
The peer for triangulation is pythoncdt (C++, constrained Delaunay triangulation of a simple polygon of the same size),
where it is installed: `pip install '.[bench]'`.  That for morphs is numpy's straight-line interpolation.
"""

import argparse
import resource
from collections.abc import Callable
from functools import partial
from importlib import import_module
from importlib.util import find_spec
from typing import Any

import numpy as np
import pandas as pd
from numpy.typing import NDArray
from scipy.interpolate import CubicSpline

from experiments.benchmarks.tasks import SEED, Timing, report, seconds, spiral_strip
from experiments.store import RESULTS, write_csv
from tween import Curve, Triangulation, decompose, gallery, paper_morph, triangulate
from tween.triangulating.reduction import reduce_curve

cdt: Any = import_module("pythoncdt") if find_spec("pythoncdt") else None

SIZES = (1_000, 3_000, 10_000, 30_000, 100_000)
DISK_SIZES = (500, 1_000, 2_000)
DISKS = 9
SIMPLE = "five-turn spiral strip"


def smooth(name: str, n: int) -> Curve:
    """A curve of the gallery, rounded by a periodic spline and sampled densely."""
    points = gallery.curve(name).points
    closed = np.concatenate([points, points[:1]])
    t = np.arange(len(closed))
    return Curve(CubicSpline(t, closed, bc_type="periodic")(np.linspace(0, len(points), n, endpoint=False)))


def looped_ribbon(n: int) -> Curve:
    """A long ribbon with five loops."""
    t = np.linspace(-np.pi, 11 * np.pi, n // 2)
    return gallery.ribbon(np.stack([0.6 * t - 1.5 * np.sin(t), -1.5 * np.cos(t)], axis=1), 0.2)


CURVES: dict[str, Callable[[int], Curve]] = {
    SIMPLE: partial(spiral_strip, turns=5.0),
    "two_disks": partial(smooth, "two_disks"),
    "five_disks": partial(smooth, "five_disks"),
    "looped ribbon": looped_ribbon,
}


def recognise(points: NDArray[np.float64]) -> Triangulation:
    return triangulate(Curve(points))


def peer(points: NDArray[np.float64]) -> object:
    """Triangulate the inside of a simple polygon with pythoncdt, by its fastest way to take arrays."""
    n = len(points)
    edges = np.stack([np.arange(n), (np.arange(n) + 1) % n], axis=1).astype(np.uint32)
    t = cdt.Triangulation(cdt.VertexInsertionOrder.AUTO, cdt.IntersectingConstraintEdges.NOT_ALLOWED, 0.0)
    t.insert_vertices(points)
    t.insert_edges(edges)
    t.erase_outer_triangles()
    return t.triangles_array()


def scaling() -> pd.DataFrame:
    """Recognise and triangulate all curves at all sizes, a row each, printed as they come.

    The spiral strip is a simple polygon, which the peer can take.  Random disks cross themselves so often that little
    can be left out; of each size the median of several is told.
    """
    tasks = [(name, n, [make(n)]) for name, make in CURVES.items() for n in SIZES]
    rng = np.random.default_rng(SEED)
    tasks += [("random disk", n, [gallery.random_disk(n, rng).curve for _ in range(DISKS)]) for n in DISK_SIZES]
    tasks += [("two-turn spiral strip", n, [spiral_strip(n)]) for n in DISK_SIZES[1:]]
    rows = []
    for name, n, curves in tasks:
        row = {
            "curve": name,
            "n": n,
            "crossings": int(np.median([len(curve.crossings) for curve in curves])),
            "left": int(np.median([len(reduce_curve(curve).kept) for curve in curves])),
            "ms": 1e3 * np.median([seconds(partial(recognise, curve.points), 5) for curve in curves]),
            "pythoncdt_ms": np.nan,
        }
        told = (
            f"{name + ',':<23} n = {n:>6}, {row['crossings']:>5} crossings, {row['left']:>5} left  {row['ms']:9.2f} ms"
        )
        if cdt and name == SIMPLE:
            row["pythoncdt_ms"] = 1e3 * seconds(partial(peer, curves[0].points), 5)
            told += f"   {row['ms'] / row['pythoncdt_ms']:8.3g} x pythoncdt ({row['pythoncdt_ms']:.2f} ms)"
        print(told, flush=True)
        rows.append(row)
    return pd.DataFrame(rows)


def growth(table: pd.DataFrame) -> None:
    """Print the exponents of the time in n, fitted by least squares to the logarithms."""
    for name in CURVES:
        of_curve = table[table["curve"] == name]
        exponent = np.polyfit(np.log(of_curve["n"]), np.log(of_curve["ms"]), 1)[0]
        print(f"{name}: from {SIZES[0]:,} to {SIZES[-1]:,} vertices the time grows like n^{exponent:.2f}")
    largest = table[table["n"] == SIZES[-1]]
    ratios = largest["ms"] / largest["pythoncdt_ms"].max()
    print(f"at {SIZES[-1]:,} vertices {ratios.min():.2f} to {ratios.max():.2f} x pythoncdt on a simple polygon")


def morphs() -> list[Timing]:
    T = triangulate(CURVES[SIMPLE](SIZES[-1]))
    D = T.on_disk()
    times = np.linspace(0, 1, 100)[:, None, None]
    return [
        Timing(
            f"slide morph, n = {len(T)}, 100 frames",
            lambda: paper_morph(T, D).frames(100),
            "numpy straight lines",
            lambda: (1 - times) * T.points + times * D.points,
            repeats=3,
        )
    ]


def main() -> None:
    parser = argparse.ArgumentParser(
        prog="python -m experiments.benchmarks.scaling", description=__doc__.split("\n")[0]
    )
    parser.add_argument(
        "--store", action="store_true", help="write results/scaling.csv, which the figure is drawn from"
    )
    arguments = parser.parse_args()
    decompose(smooth("five_disks", 300)).immersions()  # compiles
    table = scaling()
    growth(table)
    for timing in morphs():
        report(timing)
    print(f"largest memory: {resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 2**20:.2f} GiB")
    if arguments.store:
        rounded = table.assign(**{c: table[c].map("{:.3g}".format).replace("nan", "") for c in ("ms", "pythoncdt_ms")})
        write_csv(RESULTS / "scaling.csv", rounded)
        print("wrote results/scaling.csv; `python -m experiments.figures` draws it")


if __name__ == "__main__":
    main()
