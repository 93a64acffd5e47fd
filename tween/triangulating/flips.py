r"""Edge flips, and the remeshing to a constrained Delaunay triangulation (Algorithm 1).

A flip replaces the diagonal ab of a strictly convex quadrilateral a d b c by cd.  The two triangles
keep their rows, and the edge its number:

          c                     c
        /   \                 / | \
       a --- b      ->       a  |  b        rows: (a, b, c), (b, a, d)  ->  (c, d, b), (d, c, a)
        \   /                 \ | /
          d                     d

Legend: ``h`` half-edges as in `.triangulation`; ``a b c d`` the corners above.
"""

from collections.abc import Callable, Iterator

import numpy as np
from numba import njit
from numpy.typing import NDArray

from tween.geometry.predicates import in_circumcircle, turn
from tween.geometry.triangulation import Triangulation


def remesh(T: Triangulation) -> Triangulation:
    """Flip edges until every diagonal is locally Delaunay (Algorithm 1 of the paper).

    Parameters
    ----------
    T : Triangulation
        Any valid triangulation of an immersed disk.

    Returns
    -------
    Triangulation
        The constrained Delaunay triangulation of the same immersed disk: for every diagonal ab with
        triangles abc and bad, d is not inside the circle through a, b, c, exactly.  Unique but for
        cocircular quadruples, which are left as they are found.

    Notes
    -----
    A stack holds all diagonals; one that is popped and found not locally Delaunay is flipped, and the
    four edges around it are pushed again unless they wait in the stack already.  A diagonal that is not
    locally Delaunay has a strictly convex quadrilateral, so every flip is valid, and each makes the
    sorted angles lexicographically larger, so the loop ends.  O(n**2) flips at worst, O(n) as a rule.

    Examples
    --------
    >>> kite = [[0, 0], [2, -1], [4, 0], [2, 1]]
    >>> remesh(Triangulation(kite, [[0, 1, 2], [0, 2, 3]])).diagonals.tolist()
    [[1, 3]]

    References
    ----------
    Mukherjee and Gopi, Section 4 and Algorithm 1.
    """
    triangles, twin = T.triangles.copy(), T.twin.copy()
    _flip_to_delaunay(T.points, triangles, twin)
    return Triangulation(T.points, triangles)._knowing(twin)


def locally_delaunay(T: Triangulation) -> NDArray[np.bool_]:
    """Tell which diagonals are locally Delaunay, exactly.

    Parameters
    ----------
    T : Triangulation

    Returns
    -------
    ndarray of bool, shape (n-3,)
        Row for row with `.Triangulation.diagonals`; True also for cocircular quadruples.

    Examples
    --------
    >>> kite = [[0, 0], [2, -1], [4, 0], [2, 1]]
    >>> locally_delaunay(Triangulation(kite, [[0, 1, 2], [0, 2, 3]]))
    array([False])

    References
    ----------
    Mukherjee and Gopi, Figure 5.
    """
    return ~_rows(not_delaunay, T)


def flippable(T: Triangulation) -> NDArray[np.bool_]:
    """Tell which diagonals have a strictly convex quadrilateral around them, exactly.

    Parameters
    ----------
    T : Triangulation

    Returns
    -------
    ndarray of bool, shape (n-3,)
        Row for row with `.Triangulation.diagonals`.

    Examples
    --------
    >>> dart = [[0, 0], [2, 0], [0.5, 0.5], [0, 2]]
    >>> flippable(Triangulation(dart, [[0, 1, 2], [0, 2, 3]]))
    array([False])
    """
    return _rows(is_convex, T)


def flip(T: Triangulation, diagonal: tuple[int, int]) -> Triangulation:
    """Replace one diagonal by the other diagonal of its quadrilateral.

    Parameters
    ----------
    T : Triangulation
    diagonal : (int, int)
        Ends of the diagonal, in either order.

    Returns
    -------
    Triangulation
        Its other triangles keep their rows, and so does the pair that changed.

    Raises
    ------
    ValueError
        Where there is no such diagonal, or its quadrilateral is not strictly convex.

    Examples
    --------
    >>> square = [[0, 0], [1, 0], [1, 1], [0, 1]]
    >>> flip(Triangulation(square, [[0, 1, 2], [0, 2, 3]]), (2, 0)).diagonals.tolist()
    [[1, 3]]
    """
    h = half_edge(T, diagonal)
    if not is_convex(T.points, T.triangles, T.twin, h):
        a, b, c, d = quadrilateral(T.triangles, T.twin, h)
        raise ValueError(f"diagonal {a}-{b} cannot be flipped: quadrilateral {a}-{d}-{b}-{c} is not strictly convex")
    triangles, twin = T.triangles.copy(), T.twin.copy()
    flip_in_place(triangles, twin, h)
    return Triangulation(T.points, triangles)._knowing(twin)


def flips_to_delaunay(T: Triangulation) -> Iterator[Triangulation]:
    """Remesh step by step: what `remesh` does at once, to watch it.

    Parameters
    ----------
    T : Triangulation
        Any valid triangulation of an immersed disk.

    Yields
    ------
    Triangulation
        T, then what it is after each flip of the first diagonal that is not locally Delaunay; the last one has none.

    Examples
    --------
    >>> kite = [[0, 0], [2, -1], [4, 0], [2, 1]]
    >>> [S.diagonals.tolist() for S in flips_to_delaunay(Triangulation(kite, [[0, 1, 2], [0, 2, 3]]))]
    [[[2, 0]], [[1, 3]]]

    References
    ----------
    Mukherjee and Gopi, Section 4 and Algorithm 1.
    """
    yield T
    while not (good := locally_delaunay(T)).all():
        a, b = T.diagonals[np.argmin(good)].tolist()
        T = flip(T, (a, b))
        yield T


def half_edge(T: Triangulation, diagonal: tuple[int, int]) -> int:
    """Find one of the two half-edges of a diagonal.

    Parameters
    ----------
    T : Triangulation
    diagonal : (int, int)
        Ends in either order.

    Returns
    -------
    int

    Raises
    ------
    ValueError
        Where the triangulation has no such diagonal.
    """
    same = (np.sort(T.diagonals, axis=1) == sorted(diagonal)).all(axis=1)
    if not same.any():
        raise ValueError(f"{diagonal[0]}-{diagonal[1]} is no diagonal of {T!r}")
    return int(T._inner_half_edges()[np.flatnonzero(same)[0]])


def _rows(test: Callable[..., bool], T: Triangulation) -> NDArray[np.bool_]:
    h = T._inner_half_edges()
    return np.array([test(T.points, T.triangles, T.twin, x) for x in h], dtype=np.bool_)


@njit(cache=True, inline="always")
def quadrilateral(triangles, twin, h):
    """Corners a, b, c, d around half-edge h from a to b, for compiled kernels."""
    t, s = h // 3, h % 3
    g = twin[t, s]  # from b to a, so that its third corner is d
    return triangles[t, s], triangles[t, (s + 1) % 3], triangles[t, (s + 2) % 3], triangles[g // 3, (g + 2) % 3]


@njit(cache=True, inline="always")
def not_delaunay(points, triangles, twin, h):
    """Whether half-edge h lies on a diagonal that is not locally Delaunay, exactly, for compiled kernels."""
    a, b, c, d = quadrilateral(triangles, twin, h)
    return in_circumcircle(points, a, b, c, d) > 0  # a, b, c is counter-clockwise, so inside is positive


@njit(cache=True)
def is_convex(points, triangles, twin, h):
    """Whether the quadrilateral around half-edge h is strictly convex, exactly, for compiled kernels."""
    a, b, c, d = quadrilateral(triangles, twin, h)
    # at c and d it is convex anyway: there it has the angles of the two triangles
    return turn(points, d, b, c) > 0 and turn(points, c, a, d) > 0


@njit(cache=True, inline="always")
def _glue(twin, h, g):
    """Let half-edge h lie across half-edge g, which may be -1 for the boundary."""
    twin[h // 3, h % 3] = g
    if g >= 0:
        twin[g // 3, g % 3] = h


@njit(cache=True)
def flip_in_place(triangles, twin, h):
    """Flip the diagonal of half-edge h in writable arrays, for compiled kernels.

    Triangle rows (a, b, c) and (b, a, d) become (c, d, b) and (d, c, a), the new diagonal first.
    """
    a, b, c, d = quadrilateral(triangles, twin, h)
    t, s = h // 3, h % 3
    g = twin[t, s]
    u, r = g // 3, g % 3
    # read before the rows are written; in a tree t and u share one edge only, so none of these lies in t or u
    bc, ca = twin[t, (s + 1) % 3], twin[t, (s + 2) % 3]
    ad, db = twin[u, (r + 1) % 3], twin[u, (r + 2) % 3]
    triangles[t, 0], triangles[t, 1], triangles[t, 2] = c, d, b
    triangles[u, 0], triangles[u, 1], triangles[u, 2] = d, c, a
    for half, other in ((3 * t, 3 * u), (3 * t + 1, db), (3 * t + 2, bc), (3 * u + 1, ca), (3 * u + 2, ad)):
        _glue(twin, half, other)


@njit(cache=True, inline="always")
def _number_edges(twin):
    """Give each diagonal a number: (number of each half-edge, a half-edge of each number)."""
    number, half = np.full(twin.size, -1, np.int64), np.empty(twin.size, np.int64)
    size = 0
    for h in range(twin.size):
        g = twin[h // 3, h % 3]
        if g > h:  # each diagonal once, and no edge of the curve
            number[h], number[g], half[size] = size, size, h
            size += 1
    return number, half[:size]


@njit(cache=True, inline="always")
def _flip_numbered(triangles, twin, number, half, edge):
    """Flip, and carry the edge numbers to the half-edges' new places."""
    h = half[edge]
    t, s = h // 3, h % 3
    g = twin[t, s]
    u, r = g // 3, g % 3
    # the rim, too, since its half-edges in t and u change their slots
    bc, ca = number[3 * t + (s + 1) % 3], number[3 * t + (s + 2) % 3]
    ad, db = number[3 * u + (r + 1) % 3], number[3 * u + (r + 2) % 3]
    flip_in_place(triangles, twin, h)
    # in the order in which flip_in_place writes the rows; half is renewed, as it may name a slot that changed
    for place, carried in ((3 * t, edge), (3 * t + 1, db), (3 * t + 2, bc), (3 * u + 1, ca), (3 * u + 2, ad)):
        number[place] = carried
        if carried >= 0:
            half[carried] = place
    number[3 * u] = edge


@njit(cache=True)
def _flip_to_delaunay(points, triangles, twin):
    """Algorithm 1: pop an edge and mark it; if it is not locally Delaunay, flip it and push its marked rim."""
    number, half = _number_edges(twin)
    stack = np.arange(half.size)  # never overflows: an edge stands on it once at most, marked while it does not
    size = half.size
    marked = np.zeros(half.size, np.bool_)
    while size > 0:
        size -= 1
        edge = stack[size]
        marked[edge] = True
        if not not_delaunay(points, triangles, twin, half[edge]):
            continue
        # convex where it is not locally Delaunay, and each flip makes the sorted angles larger: this ends
        _flip_numbered(triangles, twin, number, half, edge)
        h = half[edge]
        g = twin[h // 3, h % 3]  # h and g have slot 0 after a flip, the rim slots 1 and 2
        for rim in (h + 1, h + 2, g + 1, g + 2):
            other = number[rim]
            if other >= 0 and marked[other]:
                marked[other] = False
                stack[size] = other
                size += 1
