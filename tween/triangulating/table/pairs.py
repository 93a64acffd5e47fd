"""The pairs of the table of Shor and Van Wyk, their splits, and one walk through them: compiled kernels.

The table keeps, for every vertex i, the list of j for which the pair (i, j) holds, see
`.splits` for the words.  Points are a stack of curves, (c, n, 2), for joint decompositions.

Pairs that no triangulation of the whole curve can use are not worth keeping.  Its turning number is 1, so the
triangles at a vertex fill the curve's interior angle there, which is less than 2 pi; hence a diagonal leaves
either of its ends through that angle.  Where it would not, the pair is left out: of a random disk of 2,000
vertices two thirds of the pairs.
"""

import numpy as np
from numba import njit

from tween.geometry.growing import longer
from tween.geometry.predicates import orient2d_sign, turn


@njit(cache=True, inline="always")
def left_turn(points, i, k, j):
    """Whether i, k, j is a left turn in every curve."""
    for c in range(points.shape[0]):
        if turn(points[c], i, k, j) <= 0:
            return False
    return True


@njit(cache=True, inline="always")
def _reflex(points):
    """Whether the turn at each vertex of each curve is a right turn, shape (c, n)."""
    curves, n = points.shape[:2]
    reflex = np.empty((curves, n), np.bool_)
    for c in range(curves):
        for i in range(n):
            # a straight vertex is not reflex: both half planes of _leaves_inwards are the same there
            reflex[c, i] = turn(points[c], i - 1, i, (i + 1) % n) < 0
    return reflex


@njit(cache=True)
def _leaves_inwards(points, reflex, i, j):
    """Whether the segment from i to j leaves i through the interior angle, in every curve."""
    n = points.shape[1]
    before, after = (i - 1) % n, (i + 1) % n
    for c in range(points.shape[0]):
        past_after, ahead_of_before = turn(points[c], i, after, j) > 0, turn(points[c], i, j, before) > 0
        # an angle below pi is what two half planes share, one above pi is all that either holds
        if not ((past_after or ahead_of_before) if reflex[c, i] else (past_after and ahead_of_before)):
            return False
    return True


@njit(cache=True)
def find_pairs(points, most):
    """Find the pairs that hold: row i is ``ends[first[i]:last[i]]``, ascending; row n-2 comes first.

    Gives up as soon as there are more than ``most``.
    """
    n = points.shape[1]
    # one curve, its coordinates in columns: the turns of the innermost loop are where the time goes
    single, x, y = points.shape[0] == 1, points[0, :, 0].copy(), points[0, :, 1].copy()
    reflex = _reflex(points)
    first, last = np.zeros(n, np.int64), np.zeros(n, np.int64)
    ends = np.empty(8 * n, np.int32)
    size = 0
    # marked by i, so that neither has to be cleared for the next one
    decided_for, holds = np.full(n, -1, np.int64), np.zeros(n, np.bool_)
    for i in range(n - 2, -1, -1):
        first[i] = size
        decided_for[i + 1], holds[i + 1] = i, True
        farthest = i + 1
        for k in range(i + 1, n):  # (i, k) is decided by now, as all its apexes are smaller than k
            if k > farthest:
                break
            if decided_for[k] != i or not holds[k]:
                continue
            if size == ends.size:
                ends = longer(ends)
            ends[size] = k
            size += 1
            for place in range(first[k], last[k]):
                j = np.int64(ends[place])
                if decided_for[j] == i:
                    continue
                if orient2d_sign(x[k], y[k], x[j], y[j], x[i], y[i]) > 0 if single else left_turn(points, i, k, j):
                    # the last edge of the curve leaves through no interior angle: it bounds two
                    is_edge = i == 0 and j == n - 1
                    decided_for[j] = i  # either way: which k found the pair does not matter
                    holds[j] = is_edge or (
                        _leaves_inwards(points, reflex, i, j) and _leaves_inwards(points, reflex, j, i)
                    )
                    if holds[j]:
                        farthest = max(farthest, int(j))
        last[i] = size
        if size > most:  # the caller sees it by the length of ends
            break
    return first, last, ends[:size].copy()


@njit(cache=True, inline="always")
def find_pair(first, last, ends, i, j):
    """The place of pair (i, j) in the table, -1 where it does not hold."""
    low, high = first[i], last[i]  # rows are ascending
    while low < high:
        middle = (low + high) // 2
        if ends[middle] < j:
            low = middle + 1
        else:
            high = middle
    return low if low < last[i] and ends[low] == j else -1


@njit(cache=True)
def walk(points, first, last, ends, n, take_last):
    """The triangulation that takes the first (or last) split everywhere."""
    triangles = np.empty((n - 2, 3), np.int64)
    stack = [(np.int64(0), np.int64(n - 1))]
    for t in range(n - 2):
        i, j = stack.pop()
        while j == i + 1:  # an edge of the curve; n - 2 triangles in all, so the stack is not empty yet
            i, j = stack.pop()
        low, high = first[i], last[i]
        for step in range(high - low):  # ends at a break: a pair that holds has a split
            k = np.int64(ends[high - 1 - step] if take_last else ends[low + step])
            if k < j and find_pair(first, last, ends, k, j) >= 0 and left_turn(points, i, k, j):
                break
        triangles[t, 0], triangles[t, 1], triangles[t, 2] = i, k, j
        stack.append((k, j))
        stack.append((i, k))
    return triangles


@njit(cache=True)
def needed_pairs(points, first, last, ends, pairs):
    """Mark the pairs that a triangulation of the whole curve can need, parents before children."""
    n = points.shape[1]
    needed = np.zeros(len(pairs), np.bool_)
    needed[find_pair(first, last, ends, np.int64(0), np.int64(n - 1))] = True
    total = 0
    # rows of larger i come first, and rows ascend: (i, k) and (k, j) stand before (i, j)
    for pair in range(len(pairs) - 1, -1, -1):
        i, j = pairs[pair]
        if not needed[pair]:
            continue
        for left in range(first[i], pair):  # the part of row i where k < j
            k = ends[left]
            right = find_pair(first, last, ends, k, j)
            if right >= 0 and left_turn(points, i, k, j):
                needed[left] = needed[right] = True
                total += 1
    return needed, total


@njit(cache=True)
def list_splits(points, first, last, ends, pairs, needed, total):
    """List the splits of every needed pair, by ascending apex."""
    splits = np.zeros(len(pairs) + 1, np.int64)
    # counted before, as lists that grow would need twice the memory where it is scarcest
    apex, lefts, rights = np.empty(total, np.int32), np.empty(total, np.int32), np.empty(total, np.int32)
    size = 0
    for pair in range(len(pairs)):
        i, j = pairs[pair]
        if needed[pair]:
            for left in range(first[i], pair):
                k = ends[left]
                right = find_pair(first, last, ends, k, j)
                if right >= 0 and left_turn(points, i, k, j):
                    apex[size], lefts[size], rights[size] = k, left, right
                    size += 1
        splits[pair + 1] = size  # a pair that is not needed has no splits, like an edge of the curve
    return splits, apex, lefts, rights
