"""What the studies measure: Table 1's rank and variance with its parameters, places among others, and slides."""

from collections.abc import Iterable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from tween import Triangulation, area_matrix, frame_variance
from tween.choices import Path, Root
from tween.geometry.dual_tree import rooted
from tween.measuring.metrics import rank_of
from tween.morphing.compatible.leg import root_triangle
from tween.morphing.compatible.paths import slides
from tween.morphing.strategy import morph_compatible

# Of Table 1.
PARAMETERS: dict[str, Any] = {
    "seed": 20100,
    "samples": 1000,
    "frames": 100,
    "paths": ["linear", "slide"],
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
    return [*(rank_of(singular, rtol) for rtol in tolerances), frame_variance(A)]


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
    """The area matrix of the morph to a disk, vertex i to vertex i."""
    root = PARAMETERS["root"] if root is None else root
    m = morph_compatible(T, T.moved(disk), path, guarantee=False, placement="root", root=root)
    return area_matrix(m, frames)


def hung(T: Triangulation, disk: NDArray[np.float64]) -> tuple[NDArray[np.int64], NDArray[np.bool_]]:
    """Corners a, b, c of each triangle, ab its base, and whether ca and bc are propagation edges; the root as usual."""
    tree = rooted(T, root_triangle(PARAMETERS["root"], T, T.moved(disk)))
    slots = (tree.base[:, None] + np.arange(3)) % 3
    corners, across = (np.take_along_axis(values, slots, axis=1) for values in (T.triangles, T.twin))
    return corners, across[:, [2, 1]] >= 0


def slid(T: Triangulation, disk: NDArray[np.float64]) -> NDArray[np.bool_]:
    """Whether "slide" replaces part of the third vertex's straight path by an arc about a, and about b; (n-2, 2)."""
    corners, propagates = hung(T, disk)
    a, b, c = np.moveaxis((np.stack([T.points, disk]) @ np.array([1, 1j]))[:, corners], 2, 0)
    z = (c - a) / (b - a)
    return slides(z[0], z[1], propagates)
