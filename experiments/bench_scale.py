"""Time recognition, triangulation and morphs from 1,000 to 100,000 vertices, beside peers in one process.

The peer for triangulation is pythoncdt (C++, constrained Delaunay triangulation of a simple polygon of the same size),
where it is installed: `pip install tween[bench]`.  That for morphs is numpy's straight-line interpolation.
"""

import argparse
import resource
from collections.abc import Callable
from functools import partial
from importlib import import_module
from importlib.util import find_spec
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import CubicSpline

from experiments.bench import SEED, Timing, report, seconds, spiral_strip
from tween import Curve, Triangulation, decompose, gallery, morph, triangulate

cdt: Any = import_module("pythoncdt") if find_spec("pythoncdt") else None

SIZES = (1_000, 3_000, 10_000, 30_000, 100_000)


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
    "five-turn spiral strip": partial(spiral_strip, turns=5.0),
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


def large() -> list[Timing]:
    """All curves at 100,000 vertices; the spiral strip is simple, so the peer takes it for all of them."""
    simple = CURVES["five-turn spiral strip"](SIZES[-1]).points
    timings = []
    for name, make in CURVES.items():
        curve = make(SIZES[-1])
        task = f"recognise and triangulate {name}, n = {len(curve)}, {len(curve.crossings)} crossings"
        timing = Timing(task, partial(recognise, curve.points), repeats=3)
        timings.append(timing._replace(peer="pythoncdt", theirs=partial(peer, simple)) if cdt else timing)
    return timings


def morphs() -> list[Timing]:
    T = triangulate(CURVES["five-turn spiral strip"](SIZES[-1]))
    D = T.on_disk()
    times = np.linspace(0, 1, 100)[:, None, None]
    return [
        Timing(
            f"slide morph, n = {len(T)}, 100 frames",
            lambda: morph(T, D).frames(100),
            "numpy straight lines",
            lambda: (1 - times) * T.points + times * D.points,
            repeats=3,
        )
    ]


def middling() -> list[Timing]:
    rng = np.random.default_rng(SEED)
    timings = []
    for n in (1000, 2000):
        shapes = {"random disk": gallery.random_disk(n, rng).curve, "two-turn spiral strip": spiral_strip(n)}
        for name, curve in shapes.items():
            timings.append(Timing(f"recognise and triangulate {name}, n = {n}", partial(recognise, curve.points)))
    return timings


def growth() -> None:
    """Print the exponent of the time in n, fitted by least squares to the logarithms."""
    for name, make in CURVES.items():
        times = [seconds(partial(recognise, make(n).points), 5) for n in SIZES]
        exponent = np.polyfit(np.log(SIZES), np.log(times), 1)[0]
        print(f"{f'time grows like n^{exponent:.2f}':<30} recognise and triangulate {name}, 1,000 to 100,000")


def main() -> None:
    argparse.ArgumentParser(prog="python -m experiments.bench_scale", description=__doc__.split("\n")[0]).parse_args()
    decompose(smooth("five_disks", 300)).immersions()  # compiles
    for group in (middling, large, morphs):
        for timing in group():
            report(timing)
    growth()
    print(f"largest memory: {resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 2**20:.2f} GiB")


if __name__ == "__main__":
    main()
