r"""The product table: the best correspondence and the best common triangulation of two curves at once.

A *node* (x, a) matches a position of the source S with one of the target T, at least one of them a vertex.  A *state*
is a pair of chords, (i, j) of S and (a, b) of T, whose ends are nodes: the part i..j of S is matched with the part
a..b of T.  It costs nothing, or a price of stretch, where both parts are a piece of an edge.  Otherwise a split (i, k,
j) of S and a split (a, c, b) of T divide it:

        k                       c          cost(i j, a b) = energy of the triangles i k j and a c b
      /   \                   /   \                         + cost(i k, a c) + cost(k j, c b)
     i --- j                 a --- b

S is cut open at its vertex 0; T is a ring.  The whole is a pair of ROUND chords (0, k), (a, c), the rest of both curves
from k and c on being a piece of an edge.

Costs count from the least that is possible, twice the areas of both triangles, so they are never negative.  Target
positions that a source position may be matched with lie in its *window*, ``width`` positions from ``low`` on; the
costs of a chord (i, j) make a small matrix, width[i] by width[j].

Legend: ``e`` chord of S; ``f`` chord of T; ``s r`` split of S and of T; ``i k j``, ``a c b`` positions.
"""

from typing import NamedTuple

import numpy as np
from numba import njit
from numpy.typing import NDArray

from tween.geometry.growing import longer, more_rows
from tween.morphing.matching.chords import PIECE, ROUND, Chords, Splits

_TIE = 1e-12  # relative: of costs that differ by less the first is taken, so that rounding decides nothing


class Side(NamedTuple):
    """One curve's share of the table.

    Attributes
    ----------
    chords : Chords
        Of the source only those from a smaller to a larger number.
    splits : Splits
    first : ndarray of int, shape (c + 1,)
        Splits of chord e, or of the target splits with left chord e, are ``first[e] : first[e + 1]``.
    middle : ndarray of int, shape (c,)
        Of the target: where the splits of ROUND chords begin.
    arc : ndarray of float64, shape (p,)
        Positions along the curve, as a share of its length.
    """

    chords: Chords
    splits: Splits
    first: NDArray[np.int64]
    middle: NDArray[np.int64]
    arc: NDArray[np.float64]


class Windows(NamedTuple):
    """Which nodes there are.

    Attributes
    ----------
    low, width : ndarray of int, shape (p,)
        Source position x may be matched with target positions ``low[x] + d``, counted around, d < width[x].
    allowed : ndarray of bool, shape (p, most)
        Whether (x, low[x] + d) is a node.
    """

    low: NDArray[np.int64]
    width: NDArray[np.int64]
    allowed: NDArray[np.bool_]


class Table(NamedTuple):
    """The filled table.

    Attributes
    ----------
    offset : ndarray of int, shape (c,)
        Where the matrix of each source chord begins in `cost`.
    cost : ndarray of float64
        Excess over the least possible energy; infinite where there is no state.
    first, last : ndarray of int, shape (c,)
        The states of source chord e are ``first[e] : last[e]`` of the next two.
    chord : ndarray of int32
        The target chord of every state.
    value : ndarray of float64
        Its cost.
    """

    offset: NDArray[np.int64]
    cost: NDArray[np.float64]
    first: NDArray[np.int64]
    last: NDArray[np.int64]
    chord: NDArray[np.int32]
    value: NDArray[np.float64]


@njit(cache=True)
def fill(source, target, windows, stretch):
    """Fill the table with all states."""
    chords, width = source.chords, windows.width
    count = len(chords.start)
    offset, size, largest = np.empty(count, np.int64), 0, 1
    for e in range(count):
        offset[e] = size
        cells = width[chords.start[e]] * width[chords.end[e]]
        size, largest = size + cells, max(largest, cells)
    cost = np.full(size, np.inf)
    first, last = np.zeros(count, np.int64), np.zeros(count, np.int64)
    chord, value, filled = np.empty(1024, np.int32), np.empty(1024), 0
    via = np.full(largest, -1, np.int32)  # the target chord of each cell of the matrix at hand
    for i in range(len(chords.first) - 2, -1, -1):
        for e in range(chords.first[i], chords.first[i + 1]):
            cells = width[i] * width[chords.end[e]]
            matrix = cost[offset[e] : offset[e] + cells]
            if chords.kind[e] == PIECE:
                _fill_piece(source, target, windows, e, matrix, via, stretch)
            else:
                table = Table(offset, cost, first, last, chord, value)
                _fill_chord(source, target, windows, e, table, matrix, via)
            while filled + cells > len(chord):
                chord, value = longer(chord), longer(value)
            first[e] = filled
            for cell in range(cells):
                if via[cell] >= 0:
                    chord[filled], value[filled], via[cell] = via[cell], matrix[cell], -1
                    filled += 1
            last[e] = filled
    return Table(offset, cost, first, last, chord[:filled].copy(), value[:filled].copy())


@njit(cache=True, inline="always")
def _fill_piece(source, target, windows, e, matrix, via, stretch):
    """A piece of an edge of S matched with pieces of edges of T."""
    i, j = source.chords.start[e], source.chords.end[e]
    low, width, chords, count = windows.low, windows.width, target.chords, len(target.arc)
    for row in range(width[i]):
        if not windows.allowed[i, row]:
            continue
        a = (low[i] + row) % count
        for f in range(chords.first[a], chords.first[a + 1]):
            column = (chords.end[f] - low[j]) % count
            if chords.kind[f] == PIECE and column < width[j] and windows.allowed[j, column]:
                cell = row * width[j] + column
                price = _price(source.arc, i, j, target.arc, a, chords.end[f], stretch)
                if price < matrix[cell]:
                    matrix[cell], via[cell] = price, f


@njit(cache=True, inline="always")
def _price(source_arc, i, j, target_arc, a, b, stretch):
    """Price of a boundary piece: squared difference of its two shares over their sum, times `stretch`."""
    x, y = (source_arc[j] - source_arc[i]) % 1.0, (target_arc[b] - target_arc[a]) % 1.0
    return stretch * (x - y) ** 2 / (x + y) if x + y > 0.0 else 0.0


@njit(cache=True, inline="always")
def _fill_chord(source, target, windows, e, table, matrix, via):
    """All ways to divide a state, for all states of the source chord e."""
    i, j = source.chords.start[e], source.chords.end[e]
    round_chord = source.chords.kind[e] == ROUND
    low, width, count = windows.low, windows.width, len(target.arc)
    low_i, low_j, width_j = low[i], low[j], width[j]
    S, T = source.splits, target.splits
    for s in range(source.first[e], source.first[e + 1]):
        left, right = S.left[s], S.right[s]
        k = source.chords.end[left]
        low_k, beyond = low[k], table.offset[right]
        p1, p2, p12, p_cross = S.first_length[s], S.second_length[s], S.product[s], S.cross[s]
        p_half = S.inverse[s]
        for state in range(table.first[left], table.last[left]):
            f, spent = table.chord[state], table.value[state]
            row = (target.chords.start[f] - low_i) % count * width_j
            c = target.chords.end[f]
            after = beyond + (c - low_k) % count * width_j
            begin = target.middle[f] if round_chord else target.first[f]
            end = target.first[f + 1] if round_chord else target.middle[f]
            for r in range(begin, end):
                column = T.end[r] - low_j
                column += count if column < 0 else 0
                if column >= width_j:
                    continue
                total = spent + table.cost[after + column]
                if total >= matrix[row + column]:
                    continue
                product = p1 * T.second_length[r] + p2 * T.first_length[r] - 2.0 * p12 * T.product[r]
                total += max(product * (p_half + T.inverse[r]) - p_cross - T.cross[r], 0.0)
                if total < matrix[row + column]:
                    matrix[row + column], via[row + column] = total, T.whole[r]


@njit(cache=True)
def wholes(source, target, windows, table, stretch):
    """The best whole for every place of the target where the source's vertex 0 may go: cost, chord of S, chord of T."""
    chords, count = source.chords, len(target.arc)
    cost = np.full(windows.width[0], np.inf)
    found = np.full((windows.width[0], 2), -1, np.int64)
    for e in range(chords.first[0], chords.first[1]):
        if chords.kind[e] != ROUND:
            continue
        for state in range(table.first[e], table.last[e]):
            f = table.chord[state]
            a, c = target.chords.start[f], target.chords.end[f]
            row = (a - windows.low[0]) % count
            total = table.value[state] + _price(
                source.arc, chords.end[e], chords.start[e], target.arc, np.int64(c), a, stretch
            )
            if total < cost[row] - _TIE * (1.0 + total):
                cost[row], found[row, 0], found[row, 1] = total, e, f
    return cost, found


@njit(cache=True)
def follow(source, target, windows, table, e, f):
    """The triangles below a state, as rows i, k, j, a, c, b."""
    triangles, size = np.empty((64, 6), np.int64), 0
    stack = [(np.int64(e), np.int64(f))]
    while len(stack) > 0:
        e, f = stack.pop()
        if source.chords.kind[e] == PIECE:
            continue
        s, r = _divide(source, target, windows, table, e, f)
        left, right = source.splits.left[s], source.splits.right[s]
        if size == len(triangles):
            triangles = more_rows(triangles)
        row = triangles[size]
        row[0], row[1], row[2] = source.chords.start[left], source.chords.end[left], source.chords.end[right]
        left_f, right_f = target.splits.left[r], target.splits.right[r]
        row[3], row[4], row[5] = target.chords.start[left_f], target.chords.end[left_f], target.chords.end[right_f]
        size += 1
        stack.append((np.int64(right), np.int64(right_f)))
        stack.append((np.int64(left), np.int64(left_f)))
    return triangles[:size].copy()


@njit(cache=True, inline="always")
def _divide(source, target, windows, table, e, f):
    """The first split of S and of T, in the order of the table, that give a state its cost."""
    i, j, b = source.chords.start[e], source.chords.end[e], target.chords.end[f]
    S, T, count = source.splits, target.splits, len(target.arc)
    row, column = (target.chords.start[f] - windows.low[i]) % count, (b - windows.low[j]) % count
    wanted = table.cost[table.offset[e] + row * windows.width[j] + column]
    enough = wanted + _TIE * (1.0 + wanted)
    for s in range(source.first[e], source.first[e + 1]):
        left, right = S.left[s], S.right[s]
        k = source.chords.end[left]
        for state in range(table.first[left], table.last[left]):
            g = table.chord[state]
            if target.chords.start[g] != target.chords.start[f]:
                continue
            after = (target.chords.end[g] - windows.low[k]) % count * windows.width[j]
            cell = table.offset[right] + after + column
            for r in range(target.first[g], target.first[g + 1]):
                if T.whole[r] == f:
                    if table.value[state] + table.cost[cell] + _excess(S, s, T, r) <= enough:
                        return np.int64(s), np.int64(r)
    return np.int64(-1), np.int64(-1)  # never: the cost of a state is that of a split


@njit(cache=True, inline="always")
def _excess(S, s, T, r):
    """Symmetric Dirichlet energy of the affine map between two triangles, less twice their areas."""
    product = S.first_length[s] * T.second_length[r] + S.second_length[s] * T.first_length[r]
    product -= 2.0 * S.product[s] * T.product[r]
    return max(product * (S.inverse[s] + T.inverse[r]) - S.cross[s] - T.cross[r], 0.0)
