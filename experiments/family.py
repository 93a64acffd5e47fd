"""Curves from fat to thin, and every curve at any number of vertices: what the grid of Table 1 runs on.

The family stands beside the gallery, most of which are strips:

    star k a         r = 1 + a cos k t: k lobes, the deeper the larger a
    star k a over    the same with lobes so broad at their ends that neighbours overlap
    blob i           a smooth random outline, clear of itself
    strip l          a strip of width 1 along a wave of length about l

A name says all: `curve` makes the curve of one, finely; `at` gives it the number of vertices that is wanted.
"""

from functools import cache

import numpy as np
from numpy.typing import NDArray

from experiments import subjects
from experiments.store import rng_for
from tween import Curve, CurveError, Triangulation, decompose, gallery, triangulate
from tween.gallery import ribbon, zigzag
from tween.gallery.generators import evenly, xy
from tween.morphing.matching.simplify import simplify

SEED = 20100
FINE = 384  # vertices of a curve of the family before it is resampled
KINDS = {"star": "star", "blob": "blob", "strip": "strip"}
ZIGZAGS = ("spiral_to_ess", "e_to_l")  # pairs whose remeshed triangulations are compatible because both are zigzags


def names() -> dict[str, str]:
    """Every curve of the grid: name -> kind, the gallery and the letters first."""
    stars = [f"star {k} {a}{over}" for k in range(3, 8) for a in (0.3, 0.5, 0.8) for over in ("", " over")]
    blobs = [f"blob {i}" for i in range(6)]
    strips = [f"strip {length}" for length in (2, 4, 8, 16, 32)]
    return subjects.shapes() | {name: name.split()[0] for name in (*stars, *blobs, *strips)}


@cache
def curve(name: str) -> Curve:
    """The curve of a name, as finely as it is made."""
    kind, *rest = name.split()
    if name in subjects.shapes() or kind not in KINDS:
        return subjects.shape(name)
    if kind == "star":
        return star(int(rest[0]), float(rest[1]), over=len(rest) > 2)
    return blob(name) if kind == "blob" else strip(float(rest[0]))


def star(lobes: int, depth: float, over: bool) -> Curve:
    """A star; where the lobes are to overlap, the angle runs back between their ends."""
    t = 2 * np.pi * (np.arange(FINE) + 0.5) / FINE
    angle = t + over * (2 * np.sin(lobes * t) + 0.9 * np.sin(2 * lobes * t)) / lobes
    return Curve(xy((1 + depth * np.cos(lobes * t)) * np.exp(1j * angle)))


def blob(name: str) -> Curve:
    """A radius with five random waves."""
    t = 2 * np.pi * np.arange(FINE) / FINE
    rng = rng_for(SEED, name)
    waves = [0.25 / k * (rng.normal() * np.cos(k * t) + rng.normal() * np.sin(k * t)) for k in range(2, 7)]
    return Curve(xy((1 + np.sum(waves, axis=0)) * np.exp(1j * t)))


def strip(length: float) -> Curve:
    """A strip of width 1 along two thirds of a wave, with round ends."""
    t = np.linspace(0, 1, FINE // 2 - 20)
    return ribbon(length * np.stack([t, 0.15 * np.sin(4 * np.pi / 3 * t)], axis=1), 1.0, 20)


def at(name: str, n: int) -> Curve:
    """A curve with n vertices that still bounds an immersed disk."""
    return resampled(curve(name), n)


def resampled(given: Curve, n: int) -> Curve:
    """The curve itself if it has n vertices; evenly by arc length; or, where that bounds no disk, simplified."""
    if len(given) == n:
        return given
    closed = np.concatenate([given.points, given.points[:1]])
    try:
        even = Curve(evenly(closed, n + 1)[:-1])
        if decompose(even):
            return even
    except CurveError:
        pass
    T = triangulate(given)
    kept = simplify(T, [n], np.zeros(len(T), dtype=np.bool_))[0].kept
    if len(kept) != n:
        raise CurveError(f"the curve of {len(given)} vertices does not bound a disk with {n}, only with {len(kept)}")
    return Curve(given.points[kept])


def pair_at(name: str, n: int | None) -> tuple[Curve, Curve]:
    """A pair of the gallery with n vertices each, or as it is; zigzags stay zigzags, so that they stay compatible."""
    ends = gallery.pair(name)
    if n is None:
        return ends
    return tuple(zigzag_of(end, n) if name in ZIGZAGS else resampled(end, n) for end in ends)  # type: ignore[return-value]


def zigzag_of(given: Curve, n: int) -> Curve:
    """A zigzag with n vertices along the middle of one."""
    half = (len(given) + 1) // 2
    path = np.empty_like(given.points)
    path[::2], path[1::2] = given.points[:half], given.points[: half - 1 - len(given) : -1]
    middle = 0.5 * (path[1:] + path[:-1])
    length = float(np.hypot(*np.diff(middle, axis=0).T).sum())
    return zigzag(evenly(middle, n), given.area / length)


# Measures of shape


def isoperimetric(points: NDArray[np.float64], area: float) -> float:
    """Squared length of the curve over 4 pi times the disk's area: 1 for a circle, the more the thinner."""
    edges = np.roll(points, -1, axis=0) - points
    return float(np.hypot(*edges.T).sum() ** 2 / (4 * np.pi * area))


def branching(T: Triangulation) -> float:
    """The share of triangles at which the dual tree branches."""
    return float((T.twin >= 0).all(axis=1).mean())
