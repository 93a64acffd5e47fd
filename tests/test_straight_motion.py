"""Straight motion between frames: that every instant of it is decided exactly, and what a broken one is called."""

import os
import subprocess
import sys
from fractions import Fraction
from itertools import islice
from pathlib import Path

import numpy as np
import oracle
import pytest
import sturm
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray

from tween import verify
from tween.measuring.straight_motion import Breach, breaches

ROOT = Path(__file__).resolve().parent.parent
SQUARE = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)]
HALVES, OTHER_HALVES = [(0, 1, 2), (0, 2, 3)], [(0, 1, 3), (1, 2, 3)]
PAIRS = int(os.environ.get("STRAIGHT_PAIRS", "3000"))  # against Sturm's theorem; 100,000 were run once


# Pairs of frames, exactly or nearly at fault


def fan(count: int) -> list[tuple[int, int, int]]:
    """Return triangles around a hub, vertex 0."""
    return [(0, i, i + 1) for i in range(1, count + 1)]


def coefficients(grid: NDArray[np.int64]):
    """Return the coefficients, 1, x, x**2, of cross and inner product of the outer edges (N, frame, edge, xy)."""
    u, w, v, z = grid.reshape(-1, 4, 2).transpose(1, 2, 0)
    pairs = (u, w), (u, z), (v, w), (v, z)
    cross = [a[0] * b[1] - a[1] * b[0] for a, b in pairs]
    inner = [a[0] * b[0] + a[1] * b[1] for a, b in pairs]
    return [(p[0], p[1] + p[2], p[3]) for p in (cross, inner)]


def kinds_of_edges(grid: NDArray[np.int64]):
    """Return masks of the edges that make a quadratic special."""
    (c0, m, c2), (d0, k, d2) = coefficients(grid)
    root = m**2 - 4 * c0 * c2
    return {
        "a double root inside": (root == 0) & (c0 * m < 0),
        "a double root inside, a triangle": (root == 0) & (c0 > 0) & (m < 0),
        "a root at the start and one inside": (c0 == 0) & (c2 * m < 0),
        "a root at the end and one inside": (c2 == 0) & (c0 * m < 0),
        "roots at both ends": (c0 == 0) & (m != 0) & (c2 == 0),
        "identically zero": (c0 == 0) & (m == 0) & (c2 == 0),
        "two roots inside": (c0 < 0) & (c2 < 0) & (root > 0) & (m > 0),
        "two roots inside, a triangle": (c0 > 0) & (c2 > 0) & (root > 0) & (m < 0),
        "no root, though not of one sign": (c0 < 0) & (c2 < 0) & (root < 0) & (m > 0),
        "no root, though not of one sign, a triangle": (c0 > 0) & (c2 > 0) & (root < 0) & (m < 0),
        "one root, an edge alike": (c0 * c2 < 0) & (np.minimum(d0, d2) > 0),
        "one root, an inner product of both signs": (c0 * c2 < 0) & (d0 * d2 < 0),
        "one sign": (c0 <= 0) & (m <= 0) & (c2 <= 0) & (d0 + k + d2 > 0),
    }


def around(hub, first, last, count: int, size: float) -> NDArray[np.float64]:
    """Return a hub and the ends of its spokes, spread evenly from the first counter-clockwise to the last."""
    start, end = (np.arctan2(y, x) for x, y in (first, last))
    angles = start + (end - start) % (2 * np.pi) * np.arange(1, count) / count
    rim = size * np.stack([np.cos(angles), np.sin(angles)], axis=1)
    return hub + np.array([(0.0, 0.0), first, *np.round(rim * 64) / 64, last])


def is_disk(points: NDArray[np.float64], count: int) -> bool:
    p = oracle.integers(points)
    positive = all(oracle.orient2d(*(p[v] for v in t)) > 0 for t in fan(count))
    return positive and oracle.is_polygon(points) and oracle.turning_number(points) == 1


def pairs(seed: int):
    """Yield the kind of a pair of frames around a hub, the two frames, and the number of triangles."""
    rng = np.random.default_rng(seed)
    while True:
        grid = rng.integers(-4, 5, (2000, 2, 2, 2))
        for kind, mask in kinds_of_edges(grid).items():
            count = 1 if "triangle" in kind else int(rng.integers(3, 9))
            for edges in grid[mask][:6].astype(float):
                hubs, sizes = rng.integers(-1, 2, (2, 2)) * rng.choice([0, 0, 1, 1000]), rng.choice([1.0, 4.0, 5.0], 2)
                pair = [around(hub, *uw, count, r) for hub, uw, r in zip(hubs, edges, sizes, strict=True)]
                frames = nudged(np.stack(pair), rng) * 2.0 ** rng.integers(-190, 185)
                if all(is_disk(frame, count) for frame in frames):
                    yield kind, *frames, count


def nudged(frames: NDArray[np.float64], rng) -> NDArray[np.float64]:
    """Move some coordinates, or none, by a few last bits."""
    ulps = rng.integers(-2, 3, frames.shape) * (rng.random(frames.shape) < rng.choice([0.0, 0.1, 0.5]))
    return np.where(frames == 0, 0.0, frames + ulps * np.spacing(np.abs(frames)))


def agrees(found: Breach | None, truth: sturm.Found | None) -> bool:
    if found is None or truth is None:
        return found is truth is None
    s, *element = found
    near = Fraction(1, 2**51)
    return tuple(element) in truth.elements and truth.low * (1 - near) <= Fraction(s) <= truth.high * (1 + near)


def test_random_pairs_near_every_degeneracy_are_decided_as_by_sturms_theorem() -> None:
    tally = {}
    for kind, start, end, count in islice(pairs(seed=13), PAIRS):
        truth = sturm.first_breach(start, end, fan(count))
        (found,) = breaches(start[None], end[None], np.array([fan(count)]))
        assert agrees(found, truth), (kind, start.tolist(), end.tolist())
        answer = found.kind if found else "valid"
        tally[kind, answer] = tally.get((kind, answer), 0) + 1
    if os.environ.get("STRAIGHT_PAIRS"):
        print(*sorted(tally.items()), sep="\n")
    assert {answer for _, answer in tally} == {"triangle", "vertex", "valid"}
    assert all((kind, "vertex") in tally for kind in ("a double root inside", "two roots inside"))
    assert ("a double root inside, a triangle", "triangle") in tally
    assert ("no root, though not of one sign, a triangle", "valid") in tally
