"""Time and memory of what once took far too much of either: each in a process of its own, largest memory told.

Times are no result that `make reproduce` could find again, so nothing is written.
"""

import argparse
import resource
import subprocess
import sys
import time
from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from experiments.benchmarks.scaling import looped_ribbon, smooth
from tween import Curve, decompose, gallery, morph, triangulate

_Points = NDArray[np.float64]


def comb(n: int) -> _Points:
    """n/4 teeth of height n/4, turned by 40 degrees, so that the boxes of all teeth overlap."""
    teeth = n // 4
    x, high = np.arange(2.0 * teeth), np.resize([0, teeth, teeth, 0], 4 * teeth)
    points = np.concatenate([[[0, -1]], np.stack([np.repeat(x, 2), high], axis=1), [[2 * teeth - 1, -1]]])[::-1]
    c, s = np.cos(np.radians(40)), np.sin(np.radians(40))
    return points @ np.array([[c, s], [-s, c]])


def spiral(n: int) -> _Points:
    """A corridor along a rectangular spiral, which has few ears at a time."""
    k = np.arange(n // 2 - 1)
    steps = (2.0 * (k // 2 + 1))[:, None] * np.array([(1, 0), (0, 1), (-1, 0), (0, -1)])[k % 4]
    return gallery.ribbon(np.concatenate([[[0.0, 0.0]], np.cumsum(steps, axis=0)]), 0.9).points


def convex(n: int) -> _Points:
    angle = 2 * np.pi * np.arange(n) / n
    return np.stack([np.cos(angle), np.sin(angle)], axis=1)


def ribbon_to_disks(n: int) -> None:
    morph(looped_ribbon(n), smooth("five_disks", n), strategy="paper")


def disks_to_horseshoe(n: int) -> None:
    morph(smooth("two_disks", n), smooth("horseshoe", n), strategy="paper")


TASKS: dict[str, tuple[Callable[[int], object], int, int]] = {
    "comb": (lambda n: triangulate(Curve(comb(n))), 400, 100_000),
    "spiral": (lambda n: triangulate(Curve(spiral(n))), 400, 100_000),
    "count of convex": (lambda n: decompose(convex(n)).count, 50, 1_000),
    "ribbon to disks": (ribbon_to_disks, 300, 20_000),
    "disks to horseshoe": (disks_to_horseshoe, 300, 20_000),
}
"""What is done, at which size it is compiled, and at which it is timed."""


def timed(name: str) -> None:
    """Compile at a small size, then tell seconds on the clock and of the processor, and largest memory."""
    work, small, large = TASKS[name]
    work(small)
    start, used = time.perf_counter(), time.process_time()
    work(large)
    seconds, used = time.perf_counter() - start, time.process_time() - used
    memory = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 2**20
    print(f"{name:<20} n = {large:>7,} {seconds:8.2f} s, {used:8.2f} s of one core, {memory:5.2f} GiB", flush=True)


def main() -> None:
    parser = argparse.ArgumentParser(
        prog="python -m experiments.benchmarks.hard_curves", description=__doc__.split("\n")[0]
    )
    parser.add_argument("task", nargs="?", choices=list(TASKS), help="only this one, in this process")
    task = parser.parse_args().task
    if task:
        timed(task)
        return
    for name in TASKS:
        subprocess.run([sys.executable, "-m", "experiments.benchmarks.hard_curves", name], check=True)


if __name__ == "__main__":
    main()
