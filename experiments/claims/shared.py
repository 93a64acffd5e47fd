"""What the measurements of several sections share: their parameters, angles, and how a curve turns."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from tween import Decomposition, Morph, Triangulation
from tween.triangulating.costs import smallest_angle

Floats = NDArray[np.float64]
PARAMETERS: dict[str, Any] = {
    "seed": 20100,
    "frames": 101,
    "boundary_frames": 21,
    "draws": 40,
    "swaps": 100,
    "sliver_degrees": 5,
    "noticeable": 1.01,
    "every_pair": 20,
    "late": 0.9,
    "feature": 0.05,
    "pairs_of_flips": 12,
    "rings": [10, 20, 40],
    "ring_pairs": 200,
    "thirds": 100_000,
    "degrees_up_to": 9,
    "convex": [32, 64, 128],
}


def sorted_angles(T: Triangulation) -> Floats:
    z = (T.points @ np.array([1, 1j]))[T.triangles]
    return np.sort(np.angle((np.roll(z, 1, axis=1) - z) / (np.roll(z, -1, axis=1) - z)), axis=None)


def best_angle(d: Decomposition, points: Floats) -> dict[str, Any]:
    """Whether a remeshed triangulation has the largest smallest angle; how many triangles the table had to look at."""
    best, looked_at = largest_smallest_angle(d, points)
    remeshed = max(sorted_angles(T)[0] for T in d.immersions())
    return {"looked_at": looked_at, "smallest_angle_is_best": bool(best - remeshed < 1e-9)}


def largest_smallest_angle(d: Decomposition, points: Floats) -> tuple[float, int]:
    """The best of all triangulations, and how many triangles the table looks at to find it."""
    looked_at: list[int] = []
    cost = smallest_angle(points)

    def counted(triangles: NDArray[np.int64]) -> Floats:
        looked_at.append(len(triangles))
        return cost(triangles)

    return float(sorted_angles(d.optimal(counted, "max"))[0]), looked_at[0]


def turns(m: Morph) -> Floats:
    """The angle by which the curve turns at every vertex, (n, frames)."""
    z = m.frames(PARAMETERS["frames"]) @ np.array([1, 1j])
    edges = np.roll(z, -1, axis=1) - z
    return np.angle(edges / np.roll(edges, 1, axis=1)).T
