"""Where a certificate looks: at times between which played motion holds, and rules seem safe from being broken.

Legend: as in `tween.measuring.certificate`.
"""

from itertools import pairwise
from math import pi
from typing import Any

import numpy as np
from numba import njit
from numpy.typing import NDArray

from tween.measuring.frame_check import Checked, check
from tween.measuring.played import broken

_SMALLEST_STEP = 2.0**-20  # of time; refinement goes no further
_MOST_ANGLES = 2_000_000  # vertices times frames; refinement stops there


def samples(bounds: NDArray[np.float64], frames: int) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
    """Choose the first frames: evenly spaced ones, both ends of each stage, and one between.

    Parameters
    ----------
    bounds : ndarray of float64, shape (stages + 1,)
        When each stage begins, and 1.
    frames : int

    Returns
    -------
    t : ndarray of float64, shape (k,)
    stage : ndarray of int64, shape (k,)
    """
    even = np.linspace(0.0, 1.0, frames)
    stages = []
    for a, b in pairwise(bounds):
        inner = even[(a < even) & (even < b)]
        stages.append(np.unique([a, b, *(inner if len(inner) else [0.5 * (a + b)])]))
    return np.concatenate(stages), np.repeat(np.arange(len(stages)), [len(times) for times in stages])


def refine(shape: Any, lists: NDArray[np.int64], checked: Checked) -> tuple[Checked, str]:
    """Bisect the intervals in doubt.

    Parameters
    ----------
    shape : Morph
    lists : ndarray of int64, shape (stages, m, 3)
    checked : Checked
        The first frames.

    Returns
    -------
    checked : Checked
        With those between.
    words : str
        What is known of the morph itself.
    """
    most = _MOST_ANGLES // checked.sums.shape[1]
    while not checked.faults[:, 0].any():
        doubtful = _doubtful(checked.t, checked.stage, checked.sums, checked.heights)
        steady = np.flatnonzero(checked.stage[:-1] == checked.stage[1:])
        bent = [f for f, _ in broken(checked, lists, steady)]
        doubt = np.union1d(np.flatnonzero(doubtful), bent).astype(np.intp)
        start, end = checked.t[doubt], checked.t[doubt + 1]
        middle = 0.5 * (start + end)
        # what is played has to hold however close to an end shapes change; the estimate has an end sooner
        wide = doubt[(end - start >= 2 * _SMALLEST_STEP) | (np.isin(doubt, bent) & (start < middle) & (middle < end))]
        if not len(doubt):
            return checked, "the morph itself breaks no rule between them at the rates of change measured (an estimate)"
        left = f"{len(doubt)} of the intervals stay in doubt as to the morph itself"
        if not len(wide):
            return checked, f"down to the smallest step {left}"
        if len(checked.t) + len(wide) > most:
            return checked, f"at the limit of {most} frames {left}"
        t = 0.5 * (checked.t[wide] + checked.t[wide + 1])
        checked = checked.merged(check(t, checked.stage[wide], shape.at(t), lists))
    return checked, ""


@njit(cache=True)
def _doubtful(t, stage, sums, heights):
    """Whether, between each frame and the next, an angle sum may reach 2 pi or a height 0."""
    doubt = np.zeros(t.size - 1, np.bool_)
    for f in range(t.size - 1):
        if stage[f] == stage[f + 1]:  # else a flip: one instant, looked at before and after
            doubt[f] = _may_rise(t, stage, sums, 1.0, f, 2.0 * pi) or _may_rise(t, stage, heights, -1.0, f, 0.0)
    return doubt


@njit(cache=True)
def _may_rise(t, stage, values, sign, f, limit):
    """Whether sign times a value may reach the limit at the rates seen between frames f - 1 to f + 2."""
    # the fastest of three intervals, as a single one may straddle a peak and seem slow
    first, last = max(f - 1, 0), min(f + 1, t.size - 2)
    for v in range(values.shape[1]):
        rate = 0.0
        for g in range(first, last + 1):
            if stage[g] == stage[f] and stage[g + 1] == stage[f]:
                rate = max(rate, abs(values[g + 1, v] - values[g, v]) / (t[g + 1] - t[g]))
        # lines of this slope, up from both ends, meet at half this sum: no peak is higher
        if 0.5 * (sign * (values[f, v] + values[f + 1, v]) + rate * (t[f + 1] - t[f])) >= limit:
            return True
    return False
