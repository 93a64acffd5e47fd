"""What the studies measure: Table 1's rank and variance with its parameters, swelling, places among others, slides."""

from collections.abc import Iterable, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from tween import Morph, Triangulation, area_matrix, frame_variance
from tween.choices import Path, Root
from tween.geometry.dual_tree import rooted
from tween.morphing.compatible.leg import root_triangle
from tween.morphing.compatible.paths import slides
from tween.morphing.strategy import morph_compatible

# Of Table 1.
PARAMETERS: dict[str, Any] = {
    "seed": 20100,
    "samples": 1000,
    "frames": 100,
    "paths": ["linear", "slide"],
    "pace": "time",
    "tolerances": [1e-4, 1e-6, 1e-9],
    "root": "disk-center",
    "disk": "equal area, vertices spaced by arc length",
}
RANKS = ["AR_1e-4", "AR_1e-6", "AR_1e-9"]  # at those tolerances
MEASURES = [*RANKS, "Var"]
QUANTILES = {"min": 0.0, "q05": 0.05, "q25": 0.25, "median": 0.5, "q75": 0.75, "q95": 0.95, "max": 1.0}


def measures(A: NDArray[np.float64], tolerances: Iterable[float] = PARAMETERS["tolerances"]) -> list[float]:
    """AR at every tolerance, then Var, of an area matrix."""
    singular = np.linalg.svd(A, compute_uv=False)
    limits = np.array(list(tolerances)) * singular[0]
    return [*(singular[:, None] > limits).sum(axis=0).tolist(), frame_variance(A)]


def certain_ranks(A: NDArray[np.float64], tolerances: Sequence[float]) -> tuple[list[int], list[int]]:
    """The least and the largest rank that an area matrix may have once its areas are perturbed, tolerance by tolerance.

    After the tolerances come the two defaults of MATLAB's `rank`, max(m, k) eps(norm(A)) in double and in single
    precision.  Areas are perturbed by 1e-12 of their size, at random; at MATLAB's double default, which lies below
    that, by 1e-14, some fifty roundings.  A singular value moves by no more than the norm of what was added, and that
    norm is about the largest row's norm plus the largest column's, times the perturbation.
    """
    singular = np.linalg.svd(A, compute_uv=False)
    most = float(singular[0])
    matlab = [max(A.shape) * float(np.spacing(most)), max(A.shape) * float(np.spacing(np.float32(most)))]
    at = np.array([*(rtol * most for rtol in tolerances), *matlab])
    size = np.linalg.norm(A, axis=1).max() + np.linalg.norm(A, axis=0).max()
    moved = size * np.array([*[1e-12] * len(tolerances), 1e-14, 1e-12])
    return tuple((singular[:, None] > limit).sum(axis=0).tolist() for limit in (at + moved, at - moved))


def swelling(A: NDArray[np.float64]) -> float:
    """The largest total area of all frames over that of the larger end, from an area matrix; 1 at least."""
    total = A.sum(axis=0)
    return float(total.max() / max(total[0], total[-1]))


def steady_sizes(A: NDArray[np.float64]) -> NDArray[np.float64]:
    """By what factor steady placement changes the lengths of each frame, so that the whole area changes linearly."""
    total = A.sum(axis=0)
    return np.asarray(np.sqrt(np.linspace(total[0], total[-1], len(total)) / total))


def edge_factors(frames: NDArray[np.float64], sizes: NDArray[np.float64] | float = 1.0) -> tuple[float, float]:
    """How far edges of the curve leave the range of their lengths at both ends.

    The first factor is that of the edge that grows most beyond the longer of its ends, 1 at least; the second that of
    the edge that shrinks most below the shorter of them, 1 at most.  Each of the frames, (k, n, 2), may be resized.
    """
    edges = np.roll(frames, -1, axis=1) - frames
    lengths = np.hypot(edges[..., 0], edges[..., 1]) * np.reshape(sizes, (-1, 1))
    low, high = np.minimum(lengths[0], lengths[-1]), np.maximum(lengths[0], lengths[-1])
    return float((lengths / high).max()), float((lengths / low).min())


def percentile(value: float, distribution: NDArray[np.float64]) -> float:
    """Share of the distribution below a value, ties counted half."""
    return float(np.mean(distribution < value) + 0.5 * np.mean(distribution == value))


def areas_to_disk(
    T: Triangulation,
    disk: NDArray[np.float64],
    path: Path,
    frames: int = PARAMETERS["frames"],
    root: Root | None = None,
) -> NDArray[np.float64]:
    """The area matrix of the morph to a disk, see `morph_to_disk`."""
    return area_matrix(morph_to_disk(T, disk, path, root), frames)


def morph_to_disk(T: Triangulation, disk: NDArray[np.float64], path: Path, root: Root | None = None) -> Morph:
    """The morph to a disk, vertex i to vertex i, in the morph's own time, placed by the root."""
    root = PARAMETERS["root"] if root is None else root
    return morph_compatible(T, T.moved(disk), path, guarantee=False, placement="root", root=root, pace="time")


def usual_root(T: Triangulation, disk: NDArray[np.float64]) -> int:
    """The root of the morph to a disk, found once for all paths."""
    return root_triangle(PARAMETERS["root"], T, T.moved(disk))


def hung(T: Triangulation, disk: NDArray[np.float64]) -> tuple[NDArray[np.int64], NDArray[np.bool_]]:
    """Corners a, b, c of each triangle, ab its base, and whether ca and bc are propagation edges; the root as usual."""
    tree = rooted(T, usual_root(T, disk))
    slots = (tree.base[:, None] + np.arange(3)) % 3
    corners, across = (np.take_along_axis(values, slots, axis=1) for values in (T.triangles, T.twin))
    return corners, across[:, [2, 1]] >= 0


def slid(T: Triangulation, disk: NDArray[np.float64]) -> NDArray[np.bool_]:
    """Whether "slide" replaces part of the third vertex's straight path by an arc about a, and about b; (n-2, 2)."""
    corners, propagates = hung(T, disk)
    a, b, c = np.moveaxis((np.stack([T.points, disk]) @ np.array([1, 1j]))[:, corners], 2, 0)
    z = (c - a) / (b - a)
    return slides(z[0], z[1], propagates)


def shortening(T: Triangulation, disk: NDArray[np.float64]) -> NDArray[np.float64]:
    """By which share of its shorter end each triangle's straight path would shorten a propagation edge; (n-2,).

    The larger of the two edges' shares; 0 where the path is straight anyway.
    """
    corners, propagates = hung(T, disk)
    a, b, c = np.moveaxis((np.stack([T.points, disk]) @ np.array([1, 1j]))[:, corners], 2, 0)
    ends = ((c - a) / (b - a))[..., None] - np.array([0.0, 1.0])
    step = ends[1] - ends[0]
    foot = np.clip((-ends[0] * step.conj()).real / np.maximum(np.abs(step) ** 2, np.finfo(float).tiny), 0.0, 1.0)
    share = 1.0 - np.abs(ends[0] + foot * step) / np.abs(ends).min(axis=0)
    return np.asarray(np.where(propagates, share, 0.0).max(axis=1))
