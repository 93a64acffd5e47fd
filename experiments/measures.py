"""What the studies measure: Table 1's rank and variance with its parameters, places among others, and slides."""

from collections.abc import Iterable, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from tween import Triangulation, frame_variance
from tween.choices import Path
from tween.geometry.dual_tree import rooted
from tween.measuring.metrics import rank_of
from tween.morphing.compatible.leg import Leg, root_triangle
from tween.morphing.compatible.paths import slides

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


class ToDisk:
    """The way of one curve's triangulations to one disk, vertex i to vertex i.

    To the last bit what `tween.area_matrix` makes of `tween.morph`.  But these look for the correspondence, and check
    the curve, anew for each of 68000 morphs; here both are known, and one root serves all paths.
    """

    def __init__(self, points: NDArray[np.float64], disk: NDArray[np.float64], frames: int) -> None:
        times = np.linspace(0.0, 1.0, frames)
        # A morph is computed from the shape whose bytes come first, so that it is symmetric.
        self._backwards = points.tobytes() > disk.tobytes()
        self._disk, self._times = disk, 1 - times if self._backwards else times

    def area_matrix(self, T: Triangulation, path: Path, root: int) -> NDArray[np.float64]:
        """Areas of the triangles in all frames, as shares of the source's area, (n-2, frames)."""
        first, last = (T.moved(self._disk), T.points) if self._backwards else (T, self._disk)
        x, y = np.ascontiguousarray(Leg(first, last, path, root).at(self._times).transpose(2, 1, 0))
        a, b, c = T.triangles.T
        return 0.5 * ((x[b] - x[a]) * (y[c] - y[a]) - (y[b] - y[a]) * (x[c] - x[a])) / T.areas.sum()

    def measure(self, T: Triangulation, paths: Sequence[Path]) -> list[list[float]]:
        """AR at every tolerance, then Var, a row a path."""
        root = root_triangle(PARAMETERS["root"], T, T.moved(self._disk))
        return [measures(self.area_matrix(T, path, root)) for path in paths]


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
