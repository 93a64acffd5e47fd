r"""Ways along the path "area" on which the angles at no vertex reach 2 pi.

The area of a triangle and the length of its base leave one freedom: where its third vertex stands along a parallel to
the base.  The path "area" moves the difference d of its angles at the base linearly from source to target.  Any other
motion of d keeps the areas just as well, so with a guarantee d becomes a cubic,

    d(t) = (1-t)^3 d0 + 3 (1-t)^2 t p + 3 (1-t) t^2 q + t^3 d1

and p and q, constants of each triangle, are chosen so that every vertex keeps a part of what it has left below 2 pi:
the *twists*.  They are found by least squares over a few times: where a vertex has too much, its triangles give way by
as much as their angles there react to d,

    da/dd = r^2/(1+r^2)      db/dd = -1/(1+r^2)      dc/dd = (1-r^2)/(1+r^2)      r = sin a / sin b,

and all is laid out again.  Where no twists are found that can be proved (`area_bounds`), the triangles at the vertices
in doubt are *blended* with the path "angle", along which no sum exceeds those of the two ends: more and more, in
steps, until all is proved.  Blended triangles lose the linear areas, and with all triangles blended entirely the path
is "angle"; so this ends.  Twists and blending are constants, so the motion is as smooth as without.

Legend: ``m`` triangles in tree order; ``k`` times; ``excess`` of a sum of angles over what is wanted.
"""

from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from tween.morphing.compatible.guarantee.sum_search import vertex_sums

_TIMES = np.linspace(0.0, 1.0, 34)[1:-1]  # at which excesses are looked at
_PATIENCE = 12  # rounds of twisting that make nothing better
_MOST_ROUNDS = 4096  # and of all: one disk of 50 vertices in a hundred would go on, for a gain in the last digits
_KEPT = 0.125  # of what a vertex has left below 2 pi is kept by twisting
_BLENDS = (0.125, 0.375, 1.0)


class AreaPath(NamedTuple):
    """The path "area" of m triangles.

    Attributes
    ----------
    areas : ndarray of float64, shape (m, 2)
        Twice the area at both ends.
    above, below : ndarray of float64, shape (m, 4)
        pi plus, and minus, the difference of the angles at the base, as a cubic in Bernstein form.
    blend : ndarray of float64, shape (m,)
        The weight of the path "angle".
    first, last : ndarray of float64, shape (m, 3)
        Angles at both ends.
    """

    areas: NDArray[np.float64]
    above: NDArray[np.float64]
    below: NDArray[np.float64]
    blend: NDArray[np.float64]
    first: NDArray[np.float64]
    last: NDArray[np.float64]

    def twisted(self, twists: NDArray[np.float64]) -> "AreaPath":
        """Move p and q of every triangle, (m, 2), but leave both angles at the base some room."""
        room = 0.5 * np.minimum(self.above, self.below)[:, [0, 3]].min(axis=1, keepdims=True)
        above, below = self.above.copy(), self.below.copy()
        moved = np.clip(twists, room - above[:, 1:3], below[:, 1:3] - room)
        above[:, 1:3] += moved
        below[:, 1:3] -= moved
        return self._replace(above=above, below=below)


def straight_area_path(areas: NDArray[np.float64], first: NDArray[np.float64], last: NDArray[np.float64]) -> AreaPath:
    """The path along which the difference of the angles at the base is linear.

    Parameters
    ----------
    areas : ndarray of float64, shape (m, 2)
    first, last : ndarray of float64, shape (m, 3)

    Returns
    -------
    AreaPath
    """
    cubics = []
    for s in (0, 1):
        p, q = (2 * angles[:, s] + angles[:, 2] for angles in (first, last))
        cubics.append(np.stack([p, (2 * p + q) / 3, (p + 2 * q) / 3, q], axis=1))
    return AreaPath(areas, cubics[0], cubics[1], np.zeros(len(areas)), first, last)


def kept_below_full_turn(
    path: AreaPath,
    corners: NDArray[np.int64],
    left: NDArray[np.float64],
    angles_at: Callable[[NDArray[np.float64], AreaPath], NDArray[np.float64]],
    doubtful: Callable[[AreaPath], NDArray[np.bool_]],
) -> AreaPath:
    """Twist the path, and blend where that does not do.

    Parameters
    ----------
    path : AreaPath
    corners : ndarray of int, shape (m, 3)
    left : ndarray of float64, shape (2, n)
        What vertices have left below 2 pi at both ends.
    angles_at : callable
        From times, shape (k,), and a path to the angles, shape (m, 3, k).
    doubtful : callable
        From a path to the vertices, shape (n,), that are not proved to stay below 2 pi.

    Returns
    -------
    AreaPath
    """
    goal = 2 * np.pi - _KEPT * ((1 - _TIMES) * left[0][:, None] + _TIMES * left[1][:, None])
    if (_excess(corners, angles_at(_TIMES, path), 2 * np.pi) > 0).any() or doubtful(path).any():
        path = _twisted(path, corners, goal, angles_at)
    while True:
        over = (_excess(corners, angles_at(_TIMES, path), 2 * np.pi) >= 0).any(axis=1)
        over = over if over.any() else doubtful(path)
        touched = np.asarray(over)[corners].any(axis=1)
        if not touched.any() or (path.blend[touched] == 1.0).all():
            return path
        path = path._replace(blend=np.where(touched, _more(path.blend), path.blend))


def _more(blend: NDArray[np.float64]) -> NDArray[np.float64]:
    """The next step of blending."""
    steps = np.array(_BLENDS)
    return steps[np.minimum(np.searchsorted(steps, blend, side="right"), len(steps) - 1)]


def _excess(
    corners: NDArray[np.int64], angles: NDArray[np.float64], goal: NDArray[np.float64] | float
) -> NDArray[np.float64]:
    """By how much sums of angles, (m, 3, k), exceed the goal, (n, k)."""
    return np.asarray(vertex_sums(corners, angles, len(corners) + 2)) - goal


def _twisted(
    path: AreaPath,
    corners: NDArray[np.int64],
    goal: NDArray[np.float64],
    angles_at: Callable[[NDArray[np.float64], AreaPath], NDArray[np.float64]],
) -> AreaPath:
    """Twist until nothing exceeds the goal, or no better path is found soon: one on which fewer vertices reach 2 pi."""
    t = _TIMES
    basis = np.stack([3 * t * (1 - t) ** 2, 3 * t**2 * (1 - t)])
    count = np.bincount(corners.ravel())
    twists, best, least, since = np.zeros((len(corners), 2)), path, (np.inf, np.inf), 0
    for _ in range(_MOST_ROUNDS):
        now = path.twisted(twists)
        angles = angles_at(t, now)
        excess = np.maximum(_excess(corners, angles, goal), 0.0)
        fault = ((_excess(corners, angles, 2 * np.pi) > 0).any(axis=1).sum(), excess.max())
        since += 1
        if fault < least:
            best, least, since = now, fault, 0
        if not excess.max() > 0 or since == _PATIENCE:
            break
        share = np.sin(angles[:, 0]) ** 2
        share /= share + np.sin(angles[:, 1]) ** 2
        reacts = np.stack([share, share - 1, 1 - 2 * share], axis=1)
        pull = (excess[corners] * reacts).sum(axis=1) @ basis.T
        weight = ((excess[corners] > 0) * reacts**2 * count[corners][..., None]).sum(axis=1)
        twists = twists - pull / (weight @ (basis**2).T + 1e-9)
        twists = np.clip(twists, -np.pi, np.pi)
    return best
