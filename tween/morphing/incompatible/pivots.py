"""Spines, pivots, and the correspondence that matches pivots (Section 6.1).

Legend: ``s t`` triangles, nodes of the dual tree; ``i j`` vertices; ``shift`` as in `tween.compatible_shift`: vertex i
of the source is vertex ``(i + shift) mod n`` of the target.
"""

import heapq

import numpy as np
from numpy.typing import NDArray

from tween.geometry.triangulation import Triangulation
from tween.morphing.incompatible.flip_sequence import crossings_by_shift


def spine(T: Triangulation) -> NDArray[np.int64]:
    """Find the spine: what is left of the dual tree when its short branches are pruned.

    Parameters
    ----------
    T : Triangulation

    Returns
    -------
    ndarray of int, shape (k,)
        Triangles from one end to the other; the end with the smaller corners comes first.

    Notes
    -----
    While there are more than two leaves, the leaf fewest hops from an internal node (one of three
    neighbours) goes, with its path to that node; of several the one with the smaller sorted corners.
    The distances of the leaves that remain only grow, so a heap of lower bounds finds the next one;
    O(n log n).

    Examples
    --------
    >>> hexagon = [[2, 0], [1, 2], [-1, 2], [-2, 0], [-1, -2], [1, -2]]
    >>> spine(Triangulation(hexagon, [[0, 1, 2], [0, 2, 4], [2, 3, 4], [0, 4, 5]])).tolist()
    [3, 1, 2]

    References
    ----------
    Mukherjee and Gopi, Section 6.1.
    """
    neighbours = _neighbours(T)
    corners = [sorted(t) for t in T.triangles.tolist()]
    leaves = [t for t, near in enumerate(neighbours) if len(near) == 1]
    heap = [(0, corners[leaf], leaf, leaf, -1) for leaf in leaves]
    heapq.heapify(heap)
    remaining = len(leaves)
    while remaining > 2:
        hops, key, leaf, node, before = heapq.heappop(heap)
        if len(neighbours[node]) < 3:
            after = next(iter(neighbours[node] - {before}))
            heapq.heappush(heap, (hops + 1, key, leaf, after, node))
        else:
            neighbours[node].discard(before)
            neighbours[before].discard(node)
            remaining -= 1
    ends = sorted((heap[0][2], heap[1][2]), key=corners.__getitem__) if len(heap) > 1 else [0]
    return np.array(_path(neighbours, ends[0]), dtype=np.int64)


def pivot_vertex(T: Triangulation, t: int) -> int:
    """Find the vertex of an end of the spine that its neighbouring triangle does not share.

    Parameters
    ----------
    T : Triangulation
    t : int
        A triangle with one neighbour.

    Returns
    -------
    int
        The vertex opposite its diagonal; of a lone triangle the smallest vertex.

    References
    ----------
    Mukherjee and Gopi, Section 6.1.
    """
    slots = np.flatnonzero(T.twin[t] >= 0)
    return int(T.triangles[t, (slots[0] + 2) % 3]) if len(slots) else int(T.triangles[t].min())


def pivot_shift(first: Triangulation, second: Triangulation) -> tuple[int, int]:
    """Choose, of the four pairings of the spines' ends, the one with fewest crossings.

    Parameters
    ----------
    first, second : Triangulation

    Returns
    -------
    shift, pivot : int
        The pivot is a vertex of the first shape.

    References
    ----------
    Mukherjee and Gopi, Section 6.1.
    """
    sources, targets = ([pivot_vertex(T, t) for t in spine(T)[[0, -1]]] for T in (first, second))
    pairs = [(i, j) for i in sources for j in targets]
    shifts = np.array([(j - i) % len(first) for i, j in pairs])
    best = int(np.argmin(crossings_by_shift(first, second, shifts)))
    return int(shifts[best]), pairs[best][0]


def _neighbours(T: Triangulation) -> list[set[int]]:
    near: list[set[int]] = [set() for _ in range(len(T.triangles))]
    for s, t in T.dual.tolist():
        near[s].add(t)
        near[t].add(s)
    return near


def _path(neighbours: list[set[int]], start: int) -> list[int]:
    path, before = [start], -1
    while after := neighbours[path[-1]] - {before}:
        before = path[-1]
        path.append(next(iter(after)))
    return path
