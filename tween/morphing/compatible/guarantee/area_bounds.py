r"""How large and how small the angles along the path "area" can get between two times: bounds carried down the tree.

Along "area" the shape of a triangle depends on the length L = exp(u) of its base, and so on all its ancestors.  Over
the base from 0 to 1 its height is h = (twice its area) / L^2, and d = a - b, the difference of the angles at the
base, is a cubic in time.  With r = sin a / sin b, the ratio of the edges bc and ca,

    da = sin c r/(1+r^2) dln h + r^2/(1+r^2) dd      db = sin c r/(1+r^2) dln h - 1/(1+r^2) dd

(from h = sin a sin b / sin c).  So a grows with h and with d, b with h and with -d, and c falls with h and with abs(d):
each angle is largest at a corner of the intervals of h and d, exactly.  The length of ca changes at the rate

    u' (1 - 2 K) + K A'/A + k d'      K = r/(1+r^2) (r cos^2 b - cos a cos b + 2 sin a sin b)
                                      k = (cot c (r^2 - 1) - cot b) / (1 + r^2)

of its logarithm; that of bc with a and b exchanged, 1/r for r, and -d.  In hanging order, intervals of u and u' give
intervals of h and the angles, these an interval of the rate of change of each child's u; and from its
values at both times, which are computed, and that rate follows an interval of the child's u, too wide only by the
square of the time between.  So it is with the angles themselves, and with their sums at the vertices.  Nothing is
measured but at the ends of intervals.

A triangle may be *blended*: each angle is the mean, with a constant weight, of that of the path "area" and that of the
path "angle", and so are its rates.

Legend: ``u0 u1`` an interval of u, ``v`` one of u'; ``f`` number of an interval of time.
"""

import math

import numpy as np
from numba import njit

from tween.morphing.compatible.area_thirds import bernstein, foot, turned
from tween.morphing.compatible.paths import third_angle

_FOOT_ERROR = 2.0**-50  # over a base of length 1, however near to 0 the foot is
_SUM_ERROR = 2.0**-46  # of sums of angles
_ROUNDING = 2.0**-40  # of logarithms of lengths, and relative, of heights: more than laying out a deep tree makes


@njit(cache=True)
def with_ancestors(corners, children, vertices):
    """The cells, (m, k-1), of the triangles at some vertices in some intervals, (n, k-1), and of their ancestors."""
    m = len(corners)
    cells = np.zeros((m, vertices.shape[1]), np.bool_)
    for i in range(m - 1, -1, -1):  # children before their parents
        for v in corners[i]:
            cells[i] |= vertices[v]
        for child in children[i]:
            if child >= 0:
                cells[i] |= cells[child]
    return cells


@njit(cache=True)
def area_bounds(children, z, root, times, areas, above, below, blend, first, last, cells):
    """Bounds of angles and of their rates, (m, 3, k-1) each, and (near, far) of the lengths of bases, (m, k-1).

    Parameters: as for laying out, in tree order; z (m, k) and the lengths of the root's base (k) at the times; which
    cells are wanted, (m, k-1), with those of their ancestors: nothing is written for others.
    """
    m, k = z.shape
    low, high = np.empty((m, 3, k - 1)), np.empty((m, 3, k - 1))
    slow, fast = np.empty((m, 3, k - 1)), np.empty((m, 3, k - 1))
    near, far = np.empty((m, k - 1)), np.empty((m, k - 1))
    logs, rates = np.empty((m, k)), np.empty((m, k - 1, 2))
    logs[0] = np.log(root)
    for f in range(k - 1):
        slope = (root[f + 1] - root[f]) / (times[f + 1] - times[f])
        rates[0, f] = _ordered(slope / root[f], slope / root[f + 1])
        near[0, f], far[0, f] = _ordered(logs[0, f], logs[0, f + 1])
    for i in range(m):
        for s in range(2):
            if children[i, s] >= 0:
                for f in range(k):
                    if (f > 0 and cells[i, f - 1]) or (f < k - 1 and cells[i, f]):
                        ratio = abs(1.0 - z[i, f]) if s == 0 else abs(z[i, f])
                        logs[children[i, s], f] = logs[i, f] + math.log(ratio)
        for f in range(k - 1):
            if not cells[i, f]:
                continue
            t0, t1 = times[f], times[f + 1]
            v, growth, turn = (rates[i, f, 0], rates[i, f, 1]), (0.0, 0.0), (0.0, 0.0)
            if blend[i] < 1.0:
                h, growth = _heights(t0, t1, areas[i], logs[i, f], logs[i, f + 1], near[i, f], far[i, f], v)
                turn = _shape(i, f, t0, t1, h, growth, v, above[i], below[i], low, high, slow, fast)
            if blend[i] > 0.0:
                _mix(i, f, t0, t1, blend[i], first[i], last[i], low, high, slow, fast)
            if children[i].max() < 0:
                continue
            a, b, c = (
                _trig(low[i, 0, f], high[i, 0, f]),
                _trig(low[i, 1, f], high[i, 1, f]),
                _trig(low[i, 2, f], high[i, 2, f]),
            )
            for s in range(3 if i == 0 else 2):
                if children[i, s] >= 0:
                    _pass_on(i, s, f, children[i, s], t1 - t0, v, growth, turn, blend[i], a, b, c,
                             slow, fast, logs, rates, near, far)  # fmt: skip
    return low, high, slow, fast, np.exp(near - _ROUNDING), np.exp(far + _ROUNDING)


@njit(cache=True)
def _ordered(p, q):
    return min(p, q), max(p, q)


@njit(cache=True)
def _times(p, q):
    """The product of two intervals."""
    a, b, c, d = p[0] * q[0], p[0] * q[1], p[1] * q[0], p[1] * q[1]
    return min(min(a, b), min(c, d)), max(max(a, b), max(c, d))


@njit(cache=True)
def reach(y0, y1, slow, fast, dt):
    """The least and the greatest value of a function with these values at both ends and rates in an interval."""
    if not fast - slow < math.inf:
        return -math.inf, math.inf
    low, high = _ordered(y0, y1)
    if slow < 0.0 < fast:
        high = max(high, y0 + fast * min(max((y1 - y0 - slow * dt) / (fast - slow), 0.0), dt))
        low = min(low, y0 + slow * min(max((y0 - y1 + fast * dt) / (fast - slow), 0.0), dt))
    return low, high


@njit(cache=True, inline="always")
def _heights(t0, t1, areas, u0, u1, near, far, v):
    """The interval of the height over a base of length 1, and that of the relative growth of the area."""
    area0, area1 = (1 - t0) * areas[0] + t0 * areas[1], (1 - t1) * areas[0] + t1 * areas[1]
    growth = _ordered((areas[1] - areas[0]) / area0, (areas[1] - areas[0]) / area1)
    l0, l1 = math.log(area0), math.log(area1)
    low, high = reach(l0 - 2.0 * u0, l1 - 2.0 * u1, growth[0] - 2.0 * v[1], growth[1] - 2.0 * v[0], t1 - t0)
    low, high = max(min(l0, l1) - 2.0 * far, low), min(max(l0, l1) - 2.0 * near, high)
    return (math.exp(low - _ROUNDING), math.exp(high + _ROUNDING)), growth


@njit(cache=True)
def _blossom(c, r, s, t):
    """The polar form of a cubic in Bernstein form."""
    a, b, d = c[0] + r * (c[1] - c[0]), c[1] + r * (c[2] - c[1]), c[2] + r * (c[3] - c[2])
    a, b = a + s * (b - a), b + s * (d - b)
    return a + t * (b - a)


@njit(cache=True)
def _cubic_range(c, t0, t1):
    p, q = _ordered(bernstein(c, t0), bernstein(c, t1))
    r, s = _ordered(_blossom(c, t0, t0, t1), _blossom(c, t0, t1, t1))
    return min(p, r), max(q, s)


@njit(cache=True, inline="always")
def _cubic_rates(c, t0, t1):
    d = np.array([c[1] - c[0], c[2] - c[1], c[3] - c[2]])
    low, high = math.inf, -math.inf
    for r, s in ((t0, t0), (t0, t1), (t1, t1)):
        a, b = d[0] + r * (d[1] - d[0]), d[1] + r * (d[2] - d[1])
        low, high = min(low, 3.0 * (a + s * (b - a))), max(high, 3.0 * (a + s * (b - a)))
    return low, high


@njit(cache=True)
def _shape(i, f, t0, t1, h, growth, v, above, below, low, high, slow, fast):
    """Write the angles and their rates for heights and differences of angles in intervals; returns that of d'."""
    turn = _cubic_rates(above, t0, t1)
    if not (h[1] < math.inf and h[0] > 0.0):
        low[i, :, f], high[i, :, f] = 0.0, math.pi
        slow[i, :, f], fast[i, :, f] = -math.inf, math.inf
        return turn
    over, under = _cubic_range(above, t0, t1), _cubic_range(below, t0, t1)
    (s0, c0), (s1, c1) = turned(over[0], under[1]), turned(over[1], under[0])  # of the least d, and of the greatest
    few, much = 0.5 + foot(h[0], s0, c0), 0.5 + foot(h[1], s1, c1)
    low[i, 0, f], high[i, 0, f] = math.atan2(h[0], few + _FOOT_ERROR), math.atan2(h[1], much - _FOOT_ERROR)
    other, another = 0.5 + foot(h[0], s1, c1), 0.5 + foot(h[1], s0, c0)
    low[i, 1, f] = math.atan2(h[0], 1.0 - other + _FOOT_ERROR)
    high[i, 1, f] = math.atan2(h[1], 1.0 - another - _FOOT_ERROR)
    low[i, 2, f] = min(third_angle(much, h[1]), third_angle(another, h[1]))
    upright = over[0] <= math.pi <= over[1]
    high[i, 2, f] = third_angle(0.5, h[0]) if upright else max(_third_at_most(few, h[0]), _third_at_most(other, h[0]))
    _rates_of_angles(i, f, (growth[0] - 2.0 * v[1], growth[1] - 2.0 * v[0]), turn, low, high, slow, fast)
    return turn


@njit(cache=True)
def _third_at_most(x, y):
    """The third angle, however the foot was rounded."""
    return third_angle(0.5 + math.copysign(max(abs(x - 0.5) - _FOOT_ERROR, 0.0), x - 0.5), y)


@njit(cache=True, inline="always")
def _rates_of_angles(i, f, rises, turn, low, high, slow, fast):
    """The rates of a, b and c from those of ln h and of d."""
    sa, sb = _sine_range(low[i, 0, f], high[i, 0, f]), _sine_range(low[i, 1, f], high[i, 1, f])
    sc = _sine_range(low[i, 2, f], high[i, 2, f])
    r = sa[0] / sb[1], (sa[1] / sb[0] if sb[0] > 0.0 else math.inf)
    w = _weights(r)
    lift = _times((sc[0] * w[0], sc[1] * w[1]), rises)
    share = r[0] * r[0] / (1.0 + r[0] * r[0]), (1.0 - 1.0 / (1.0 + r[1] * r[1]))
    to_a, to_b = _times(share, turn), _times((1.0 - share[1], 1.0 - share[0]), turn)
    slow[i, 0, f], fast[i, 0, f] = lift[0] + to_a[0], lift[1] + to_a[1]
    slow[i, 1, f], fast[i, 1, f] = lift[0] - to_b[1], lift[1] - to_b[0]
    to_c = _times((2.0 * share[0] - 1.0, 2.0 * share[1] - 1.0), turn)
    slow[i, 2, f], fast[i, 2, f] = -2.0 * lift[1] - to_c[1], -2.0 * lift[0] - to_c[0]


@njit(cache=True)
def _weights(r):
    """The range of r / (1 + r^2), at most 1/2."""
    p, q = _ordered(r[0] / (1.0 + r[0] * r[0]), (1.0 / (1.0 / r[1] + r[1]) if r[1] > 0.0 else 0.0))
    return p, 0.5 if r[0] <= 1.0 <= r[1] else q


@njit(cache=True, inline="always")
def _mix(i, f, t0, t1, weight, first, last, low, high, slow, fast):
    """Blend the bounds with those of the path "angle"."""
    for s in range(3):
        p, q = _ordered((1 - t0) * first[s] + t0 * last[s], (1 - t1) * first[s] + t1 * last[s])
        rate = weight * (last[s] - first[s])
        if weight == 1.0:
            low[i, s, f], high[i, s, f], slow[i, s, f], fast[i, s, f] = p, q, rate, rate
            continue
        low[i, s, f] = (1.0 - weight) * low[i, s, f] + weight * p
        high[i, s, f] = (1.0 - weight) * high[i, s, f] + weight * q
        slow[i, s, f], fast[i, s, f] = (1.0 - weight) * slow[i, s, f] + rate, (1.0 - weight) * fast[i, s, f] + rate


@njit(cache=True, inline="always")
def _pass_on(i, s, f, child, dt, v, growth, turn, blend, a, b, c, slow, fast, logs, rates, near, far):
    """What is known of the length of a child's base: bc for s = 0, ca for s = 1, ab for s = 2."""
    if s == 2:
        logs[child], near[child, f], far[child, f] = logs[0], near[0, f], far[0, f]
        rates[child, f] = rates[0, f]
        return
    opposite = a if s == 0 else b
    if blend > 0.0:
        of, third = _times(opposite[2], (slow[i, s, f], fast[i, s, f])), _times(c[2], (slow[i, 2, f], fast[i, 2, f]))
        rate = v[0] + of[0] - third[1], v[1] + of[1] - third[0]
    elif s == 0:
        rate = _edge_rate(b, a, c, v, growth, (-turn[1], -turn[0]))
    else:
        rate = _edge_rate(a, b, c, v, growth, turn)
    sines, under = opposite[0], c[0]
    far_end = far[i, f] + math.log(sines[1] / under[0]) if under[0] > 0.0 else math.inf
    near_end = near[i, f] + math.log(sines[0] / under[1]) if sines[0] > 0.0 else -math.inf
    reached = reach(logs[child, f], logs[child, f + 1], rate[0], rate[1], dt)
    near[child, f], far[child, f] = max(near_end, reached[0]), min(far_end, reached[1])
    rates[child, f] = rate


@njit(cache=True)
def _sine_range(low, high):
    first, last = math.sin(max(low, 0.0)), math.sin(min(high, math.pi))
    return min(first, last), 1.0 if low < 0.5 * math.pi < high else max(first, last)


@njit(cache=True)
def _trig(low, high):
    """The ranges of sine, cosine and cotangent of an angle within bounds."""
    first, last = math.sin(max(low, 0.0)), math.sin(min(high, math.pi))
    sines = min(first, last), 1.0 if low < 0.5 * math.pi < high else max(first, last)
    cosines = math.cos(high), math.cos(low)
    least = cosines[0] / last if high < math.pi and last > 0.0 else -math.inf
    return sines, cosines, (least, cosines[1] / first if first > 0.0 else math.inf)


@njit(cache=True)
def _edge_rate(a, b, c, v, growth, turn):
    """The rate of the logarithm of ca, given ranges at the angles, and those of u', of A'/A, and of d'."""
    (sa, of_a, _), (sb, of_b, cot_b), (sc, _, cot_c) = a, b, c
    if not (sa[0] > 0.0 and sb[0] > 0.0 and sc[0] > 0.0):
        return -math.inf, math.inf
    r = sa[0] / sb[1], sa[1] / sb[0]
    mixed, squares = _times(of_a, of_b), _ordered(of_b[0] ** 2, of_b[1] ** 2)
    least = 0.0 if of_b[0] < 0.0 < of_b[1] else squares[0]
    k = _times(
        _weights(r),
        (r[0] * least - mixed[1] + 2.0 * sa[0] * sb[0], r[1] * squares[1] - mixed[0] + 2.0 * sa[1] * sb[1]),
    )
    changes, grows = _times(v, (1.0 - 2.0 * k[1], 1.0 - 2.0 * k[0])), _times(growth, k)
    p, q = 1.0 / (1.0 + r[1] * r[1]), 1.0 / (1.0 + r[0] * r[0])
    turned_by, other = _times(cot_c, (1.0 - 2.0 * q, 1.0 - 2.0 * p)), _times(cot_b, (p, q))
    turns = _times((turned_by[0] - other[1], turned_by[1] - other[0]), turn)
    return changes[0] + grows[0] + turns[0], changes[1] + grows[1] + turns[1]


@njit(cache=True)
def largest_sums(corners, z, high, slow, fast, times, cells):
    """Bounds of the sums of angles at each vertex, (n, k-1), from third vertices at the times, (m, k), and rates.

    They are right at vertices all of whose triangles are wanted in an interval, see `area_bounds`.
    """
    m, k = z.shape
    sums, tops = np.zeros((m + 2, k)), np.zeros((m + 2, k - 1))
    slowest, fastest = np.zeros((m + 2, k - 1)), np.zeros((m + 2, k - 1))
    for i in range(m):
        of_a, of_b, of_c = corners[i]
        for f in range(k):
            if (f > 0 and cells[i, f - 1]) or (f < k - 1 and cells[i, f]):
                x, y = z[i, f].real, z[i, f].imag
                sums[of_a, f] += math.atan2(y, x)
                sums[of_b, f] += math.atan2(y, 1.0 - x)
                sums[of_c, f] += third_angle(x, y)
        for f in range(k - 1):
            for s in range(3 if cells[i, f] else 0):
                tops[corners[i, s], f] += high[i, s, f]
                slowest[corners[i, s], f] += slow[i, s, f]
                fastest[corners[i, s], f] += fast[i, s, f]
    for v in range(m + 2):
        for f in range(k - 1):
            reached = reach(sums[v, f], sums[v, f + 1], slowest[v, f], fastest[v, f], times[f + 1] - times[f])[1]
            tops[v, f] = min(tops[v, f] if tops[v, f] >= 0.0 else math.inf, reached + _SUM_ERROR)
    return tops
