"""Time tween beside peers in one process: medians over repeats, ratios where there is a peer.

A ratio says how many times the peer's time tween takes; below 1 tween is faster.  Compilation happens
before the clock starts.
"""

import argparse
from collections.abc import Callable
from fractions import Fraction
from functools import partial
from statistics import median
from time import perf_counter
from typing import NamedTuple

import numpy as np
from numba import njit
from numpy.typing import NDArray
from scipy.spatial import Delaunay

from experiments.measures import PARAMETERS as TABLE_1
from experiments.store import Checkpoint, compute
from experiments.studies import to_disk
from experiments.subjects import shapes
from tween import (
    Curve,
    Decomposition,
    area_matrix,
    certify,
    decompose,
    gallery,
    match,
    morph,
    paper_morph,
    remesh,
    triangulate,
    verify,
)
from tween.choices import PATHS, Path, Placement
from tween.geometry.predicates import orient2d, turn
from tween.morphing.alignment import align
from tween.morphing.incompatible.flip_sequence import flip_sequence
from tween.morphing.matching.simplify import simplify
from tween.morphing.strategy import morph_compatible
from tween.triangulating.costs import edge_length

SEED = 7


class Timing(NamedTuple):
    """A task, what it is compared with, and the two functions to time."""

    task: str
    ours: Callable[[], object]
    peer: str = ""
    theirs: Callable[[], object] | None = None
    repeats: int = 7


def spiral_strip(n: int, turns: float = 2.0) -> Curve:
    """A dense strip along a spiral."""
    angle = np.linspace(0, 2 * np.pi * turns, n // 2)
    radius = 1 + 0.12 * angle
    return gallery.ribbon(np.stack([radius * np.cos(angle), radius * np.sin(angle)], axis=1), 0.6)


def wave_strip(n: int) -> Curve:
    """A dense strip along two waves."""
    x = np.linspace(0, 4 * np.pi, n // 2)
    return gallery.ribbon(np.stack([x, 2 * np.sin(x)], axis=1), 0.5)


@njit(cache=True)
def textbook_table(points: NDArray[np.float64]) -> bool:
    """The table as a matrix, filled diagonal by diagonal: what one writes after reading the paper."""
    n = len(points)
    holds = np.zeros((n, n), np.bool_)
    for i in range(n - 1):
        holds[i, i + 1] = True
    for length in range(2, n):
        for i in range(n - length):
            j = i + length
            for k in range(i + 1, j):
                if holds[i, k] and holds[k, j] and turn(points, i, k, j) > 0:
                    holds[i, j] = True
                    break
    return bool(holds[0, n - 1])


def fraction_signs(a: NDArray[np.float64], b: NDArray[np.float64], c: NDArray[np.float64]) -> list[bool]:
    exact = [[tuple(map(Fraction, p)) for p in points.tolist()] for points in (a, b, c)]
    return [(q[0] - p[0]) * (r[1] - p[1]) > (q[1] - p[1]) * (r[0] - p[0]) for p, q, r in zip(*exact, strict=True)]


def plain_signs(a: NDArray[np.float64], b: NDArray[np.float64], c: NDArray[np.float64]) -> NDArray[np.float64]:
    u, v = b - a, c - a
    return np.sign(u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0])


def predicates() -> list[Timing]:
    a, b, c = np.random.default_rng(SEED).random((3, 100_000, 2))
    few = a[:2000], b[:2000], c[:2000]
    return [
        Timing("orient2d, 100,000 triples", lambda: orient2d(a, b, c), "numpy, inexact", lambda: plain_signs(a, b, c)),
        Timing("orient2d, 2,000 triples", lambda: orient2d(*few), "Fractions", lambda: fraction_signs(*few)),
    ]


def tables() -> list[Timing]:
    disk = gallery.random_disk(1000, np.random.default_rng(SEED)).curve
    spiral = spiral_strip(1000)
    hundred = decompose(gallery.random_disk(100, np.random.default_rng(SEED)).curve)
    rng = np.random.default_rng(SEED)
    return [
        Timing("table, random_disk(1000)", lambda: decompose(disk), "matrix", lambda: textbook_table(disk.points)),
        Timing(
            f"table, two-turn spiral strip, n = {len(spiral)}",
            lambda: decompose(spiral),
            "matrix",
            lambda: textbook_table(spiral.points),
            repeats=3,
        ),
        Timing("1000 uniform samples, n = 100", lambda: hundred.sample(rng, 1000)),
    ]


def morphs() -> list[Timing]:
    T = decompose(spiral_strip(1000)).arbitrary()
    points, times = T.points, np.linspace(0, 1, 100)
    R = remesh(T)
    D = R.on_disk()

    def straight() -> object:
        return (1 - times)[:, None, None] * R.points + times[:, None, None] * D.points

    return [
        Timing(f"remesh, n = {len(T)}", lambda: remesh(T), "scipy Delaunay of the points", lambda: Delaunay(points)),
        Timing(
            f"slide morph, n = {len(T)}, 100 frames",
            lambda: paper_morph(R, D).frames(100),
            "numpy straight lines",
            straight,
        ),
        Timing(f"area matrix, n = {len(T)}, 100 frames", lambda: area_matrix(paper_morph(R, D))),
    ]


def pairs() -> list[Timing]:
    lobes = gallery.curve("three_lobes").insert_vertices(200)
    spiral = spiral_strip(200)
    ess, loop = (gallery.curve(name).insert_vertices(100) for name in ("ess", "loop"))
    first, second = triangulate(lobes), triangulate(spiral)
    return [
        Timing("align two curves, n = 200", lambda: align(lobes, spiral)),
        Timing("common triangulation over all shifts, n = 100", lambda: align(ess, loop, shifts="all"), repeats=3),
        Timing("flip sequence, n = 200", lambda: flip_sequence(first, second)),
        Timing(
            "incompatible morph, n = 200, 100 frames",
            lambda: paper_morph(lobes, spiral).frames(100),
            "compatible morph to the disk",
            lambda: paper_morph(first, first.on_disk()).frames(100),
            repeats=3,
        ),
    ]


def matches() -> list[Timing]:
    lobes, spiral = (_coarse(gallery.curve(name), 24) for name in ("three_lobes", "spiral_2"))
    first, second = (gallery.curve(name).insert_vertices(100) for name in ("arrow", "horseshoe"))
    large, strip = gallery.random_disk(1000, np.random.default_rng(SEED)).curve, spiral_strip(1000)

    def matched() -> object:
        return morph(first, second).frames(100)

    return [
        Timing("match, 24 vertices and midpoints, exact", lambda: match(lobes, spiral, candidates=1)),
        Timing("match, n = 100", lambda: match(first, second), "matched morph, 100 frames", matched, repeats=3),
        Timing(f"match a random disk, a spiral strip, n = {len(large)}", lambda: match(large, strip), repeats=1),
        *(
            Timing(
                f"match a spiral strip, a wave, n = {n:,}", partial(match, spiral_strip(n), wave_strip(n)), repeats=1
            )
            for n in (1000, 10_000)
        ),
    ]


def _coarse(curve: Curve, n: int) -> NDArray[np.float64]:
    """A curve with so many of its vertices, that still bounds a disk."""
    T = triangulate(curve)
    return T.points[simplify(T, [n], np.zeros(len(T), dtype=np.bool_))[0].kept]


def guarantees() -> list[Timing]:
    T = remesh(gallery.random_disk(1000, np.random.default_rng(SEED)))
    D = T.on_disk()

    def frames(path: Path, guarantee: bool, placement: Placement = "root") -> NDArray[np.float64]:
        return morph_compatible(T, D, path, guarantee, placement).frames(100)

    plain = paper_morph(T, D)
    return [
        *(
            Timing(
                f"{path} with the guarantee, n = 1000, 100 frames",
                partial(frames, path, True),
                "without",
                partial(frames, path, False),
            )
            for path in PATHS
        ),
        Timing(
            "steady placement, n = 1000, 100 frames",
            partial(frames, "metric", True, "steady"),
            "by the root",
            partial(frames, "metric", True),
        ),
        Timing(
            "verify 100 frames, n = 1000",
            lambda: verify(plain.frames(100), T.triangles),
            "computing them",
            lambda: plain.frames(100),
        ),
        Timing("certify a guaranteed morph, n = 1000", partial(certify, morph_compatible(T, D, path="linear"))),
    ]


def optima() -> list[Timing]:
    disk = gallery.random_disk(300, np.random.default_rng(SEED)).curve
    spiral = decompose(spiral_strip(300))
    five = gallery.curve("five_disks").insert_vertices(200)
    return [
        Timing("least edge length, random disk, n = 300", lambda: decompose(disk).optimal(edge_length(disk.points))),
        Timing(f"least edge length, spiral strip, n = {len(spiral.arbitrary())}", partial(_shortest, spiral)),
        Timing("all immersions of five_disks, n = 200", lambda: decompose(five).immersions()),
    ]


def _shortest(d: Decomposition) -> object:
    return d.optimal(edge_length(d.arbitrary().points))


def whole_table() -> list[Timing]:
    names, samples = list(shapes()), TABLE_1["samples"]

    def study() -> None:
        Checkpoint("bench", {}).clear()
        compute("bench", {}, names, partial(to_disk.study, samples=samples))

    return [Timing(f"Table 1: {len(names)} curves, 1000 samples, 100 frames, both paths", study, repeats=1)]


def seconds(task: Callable[[], object], repeats: int) -> float:
    """Median time of a task, after one run that does not count unless it is to run only once."""
    if repeats > 1:
        task()
    times = []
    for _ in range(repeats):
        start = perf_counter()
        task()
        times.append(perf_counter() - start)
    return median(times)


def report(timing: Timing) -> None:
    ours = seconds(timing.ours, timing.repeats)
    line = f"{timing.task:<62} {_readable(ours):>9}"
    if timing.theirs is not None:
        theirs = seconds(timing.theirs, timing.repeats)
        line += f"   {ours / theirs:8.3g} x {timing.peer} ({_readable(theirs)})"
    print(line, flush=True)


def _readable(t: float) -> str:
    return f"{t:.1f} s" if t >= 10 else f"{t:.2f} s" if t >= 1 else f"{t * 1e3:.2f} ms"


def main() -> None:
    parser = argparse.ArgumentParser(prog="python -m experiments.benchmarks.tasks", description=__doc__.split("\n")[0])
    parser.add_argument("--quick", action="store_true", help="leave out the whole of Table 1")
    groups = (predicates, tables, morphs, pairs, matches, guarantees, optima, whole_table)
    names = [group.__name__ for group in groups]
    parser.add_argument("groups", nargs="*", metavar="group", help=f"some of {', '.join(names)}; all without")
    arguments = parser.parse_args()
    unknown = set(arguments.groups) - set(names)
    if unknown:
        parser.error(f"{', '.join(sorted(unknown))}: expected some of {', '.join(names)}")
    wanted = set(arguments.groups or names) - ({"whole_table"} if arguments.quick else set())
    for group in (group for group in groups if group.__name__ in wanted):
        for timing in group():
            report(timing)


if __name__ == "__main__":
    main()
