r"""Where shapes stand: how large, how turned and where in the plane each shape of a motion is placed.

Most paths fix a shape up to a similarity only.  The paper lets the root triangle place it; then shapes swell, drift and
turn with one triangle's fortunes.  The *steady* placement depends on no root:

    size      the total area changes linearly
    place     the centre of mass of the vertices moves linearly
    turn      no net rotation: with y the vertices about their centre, the sum of y x dy vanishes, but for the rotation
              that is left over at the end, which is spread evenly over time

A similarity changes no angle and turns no triangle over, so it can break no guarantee.

The rotation of a motion is integrated from shape to shape: from y to y' it is the angle that fits them best, the
argument of the sum of conj(y) y'; the error of the sum over steps of size h is of the order of h**2, smooth in time.
Comparing steps of h and of 2 h takes that error away, up to h**4.  Between the times looked at a cubic spline serves.

Legend: ``t`` time; ``y`` points about their centre, as complex numbers; ``phi`` the accumulated rotation.
"""

from functools import cached_property
from itertools import pairwise
from typing import NamedTuple

import numpy as np
from numba import njit
from numpy.typing import NDArray
from scipy.interpolate import CubicSpline

from tween.morphing.compatible.guarantee.rounding import Doubt, Placing
from tween.morphing.motion import Motion
from tween.morphing.plan import Plan

_STEPS, _FEWEST_STEPS = 512, 32  # by which the rotation is integrated, in each stretch without flips
_AT_ONCE = 2**21  # vertices times shapes that are looked at for it


class Steady:
    """A `Motion` placed steadily.

    Parameters
    ----------
    motion : Motion
        At times 0 and 1 exactly its source and its target.
    keeps_size : bool
        Whether the sizes of its shapes stay as they are, and only place and turn are made steady.

    Notes
    -----
    The first call looks at up to 513 shapes; then O(n) a shape.
    """

    def __init__(self, motion: Motion, keeps_size: bool) -> None:
        self._motion, self._keeps_size = motion, keeps_size
        self.stages, self.events = motion.stages, motion.events

    def at(self, t: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return the shapes at many times.

        Parameters
        ----------
        t : ndarray of float64, shape (k,)
            From 0 to 1.

        Returns
        -------
        ndarray of float64, shape (k, n, 2)
            At times 0 and 1 exactly the source and the target.
        """
        shapes = self._motion.at(t)
        _place(shapes, t, self._turn.at(t), self._ends, self._keeps_size)
        return shapes

    def first_doubt(self, placing: Placing) -> Doubt | tuple[float, float]:
        """Prove what the motion before it was placed can prove, allowing for the errors of placing.

        Parameters
        ----------
        placing : Placing

        Returns
        -------
        Doubt, or (float, float)
        """
        return self._motion.first_doubt(placing)

    def plans(self) -> list[Plan]:
        """Tell what the motion is made of; where shapes stand does not matter for that.

        Returns
        -------
        list of Plan
        """
        return self._motion.plans()

    @cached_property
    def _ends(self) -> NDArray[np.float64]:
        """Centre and area at times 0 and 1, (2, 3)."""
        ends = self._motion.at(np.array([0.0, 1.0]))
        return np.array([[*shape.mean(axis=0), _area(shape)] for shape in ends])

    @cached_property
    def _turn(self) -> "_Turn":
        breaks = np.unique([0.0, *(start for start, _ in self.stages), 1.0])
        n = self._motion.at(np.array([0.0])).shape[1]
        steps = _STEPS if n * _STEPS <= _AT_ONCE else _FEWEST_STEPS
        return _integrated(self._motion, breaks, steps)


class _Turn(NamedTuple):
    """How far to turn the shapes of a motion: a spline over each stretch between breaks."""

    breaks: NDArray[np.float64]
    splines: list[CubicSpline]

    def at(self, t: NDArray[np.float64]) -> NDArray[np.float64]:
        number = np.clip(np.searchsorted(self.breaks, t, side="right") - 1, 0, len(self.splines) - 1)
        angle = np.empty(len(t))
        for i in np.unique(number):
            here = number == i
            angle[here] = self.splines[i](t[here])
        return angle


def _integrated(motion: Motion, breaks: NDArray[np.float64], steps: int) -> _Turn:
    """Take the rotation of a motion away, and what is then left over at the end evenly."""
    stretches, phi = [], 0.0
    for start, stop in pairwise(breaks):
        share = steps * (stop - start)
        times = np.linspace(start, stop, 4 * max(1, int(np.ceil(share / 4))) + 1)
        angle = phi + _rotation(_about_centres(motion, times))
        phi = angle[-1]
        stretches.append((times, angle))
    left_over = phi - 2 * np.pi * np.ceil(phi / (2 * np.pi) - 0.5)
    return _Turn(breaks, [CubicSpline(times, times * left_over - angle) for times, angle in stretches])


def _about_centres(motion: Motion, times: NDArray[np.float64]) -> NDArray[np.complex128]:
    """Shapes about their centres."""
    shapes = motion.at(times)
    z: NDArray[np.complex128] = np.ascontiguousarray(shapes).view(np.complex128)[..., 0]
    return z - z.mean(axis=1, keepdims=True)


def _rotation(y: NDArray[np.complex128]) -> NDArray[np.float64]:
    """The accumulated rotation of shapes, (k, n), k - 1 being a multiple of 4; by steps of one and of two."""
    single = np.concatenate([[0.0], np.cumsum(_turns(y[:-1], y[1:]))])
    double = np.concatenate([[0.0], np.cumsum(_turns(y[:-2:2], y[2::2]))])
    excess = (single[::2] - double) / 3.0
    places = np.arange(len(single))
    return np.asarray(single + CubicSpline(places[::2], excess)(places))


def _turns(y: NDArray[np.complex128], after: NDArray[np.complex128]) -> NDArray[np.float64]:
    """The angles by which rotating the first shapes fits the second ones best."""
    return np.asarray(np.angle((y.conj() * after).sum(axis=1)))


@njit(cache=True)
def _area(shape):
    """The signed area of a curve, about its first vertex so that nothing large cancels."""
    total = 0.0  # layers add up, so for an immersed disk this is the area of its triangles, and positive
    for i in range(1, len(shape) - 1):
        ax, ay = shape[i, 0] - shape[0, 0], shape[i, 1] - shape[0, 1]
        bx, by = shape[i + 1, 0] - shape[0, 0], shape[i + 1, 1] - shape[0, 1]
        total += ax * by - ay * bx
    return 0.5 * total


@njit(cache=True)
def _place(shapes, t, angle, ends, keeps_size):
    """Move, turn and scale shapes in place; at times 0 and 1 they stay to the last bit."""
    n = shapes.shape[1]
    for f in range(len(shapes)):
        if t[f] == 0.0 or t[f] == 1.0:
            continue
        scale = 1.0
        if not keeps_size:
            scale = np.sqrt(((1.0 - t[f]) * ends[0, 2] + t[f] * ends[1, 2]) / _area(shapes[f]))
        # one rotation and scale for the whole shape: a similarity, which keeps every angle
        c, s = scale * np.cos(angle[f]), scale * np.sin(angle[f])
        x0, y0 = shapes[f, :, 0].mean(), shapes[f, :, 1].mean()
        x1 = (1.0 - t[f]) * ends[0, 0] + t[f] * ends[1, 0]
        y1 = (1.0 - t[f]) * ends[0, 1] + t[f] * ends[1, 1]
        for i in range(n):
            x, y = shapes[f, i, 0] - x0, shapes[f, i, 1] - y0
            shapes[f, i, 0], shapes[f, i, 1] = x1 + (c * x - s * y), y1 + (s * x + c * y)
