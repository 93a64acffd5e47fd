"""The best triangulation: the table with costs in the place of counts, and the walk along its best splits.

Legend: a *pair* and its *splits* as in `.splits`.
"""

import numpy as np
from numba import njit


@njit(cache=True)
def best_splits(first, left, right, costs, largest_counts):
    """The first split of least cost of every pair; -1 where it has none."""
    pairs = first.size - 1
    value, best = np.zeros(pairs), np.full(pairs, -1, np.int64)
    if largest_counts:  # an edge of the curve must not count: 0 in a sum, -inf in a maximum
        value[:] = -np.inf
    for pair in range(pairs):  # children have smaller numbers, so their values are final
        for s in range(first[pair], first[pair + 1]):
            if largest_counts:
                total = max(costs[s], value[left[s]], value[right[s]])
            else:
                total = costs[s] + value[left[s]] + value[right[s]]
            # strictly less, so the first one is kept in a tie; and some split is taken even if all cost infinitely much
            if best[pair] < 0 or total < value[pair]:
                best[pair], value[pair] = s, total
    return best


@njit(cache=True)
def follow(whole, ends, apex, left, right, best, count):
    """The triangles of the chosen splits."""
    chosen = np.empty((count, 3), np.int64)
    stack = np.empty(2 * count + 2, np.int64)
    stack[0], size, t = whole, 1, 0
    while size > 0:
        size -= 1
        pair = stack[size]
        s = best[pair]
        if s >= 0:  # else an edge of the curve
            chosen[t, 0], chosen[t, 1], chosen[t, 2] = ends[pair, 0], apex[s], ends[pair, 1]
            t += 1
            stack[size], stack[size + 1] = right[s], left[s]
            size += 2
    return chosen
