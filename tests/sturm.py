"""Straight motion by brute force: polynomials with whole coefficients, and Sturm's theorem.  Imports nothing of tween.

Legend: a polynomial is a tuple of whole numbers, the constant first, not 0 at the end; only its signs matter, so it may
be multiplied by positive numbers; ``s`` from 0 to 1.
"""

from collections.abc import Iterable, Iterator, Sequence
from fractions import Fraction
from functools import cache
from itertools import pairwise, zip_longest
from math import gcd, lcm
from typing import NamedTuple

import oracle

Polynomial = tuple[int, ...]
Root = tuple[Polynomial, Fraction, Fraction]


class Found(NamedTuple):
    """The first instant at which a rule is broken, between two fractions; what is broken there, to 50 bits."""

    low: Fraction
    high: Fraction
    elements: frozenset[tuple[str, int]]


def trimmed(p: Iterable[int]) -> Polynomial:
    p = list(p)
    while p and p[-1] == 0:
        p.pop()
    return tuple(p)


def minus(p: Polynomial, q: Polynomial) -> Polynomial:
    return trimmed(a - b for a, b in zip_longest(p, q, fillvalue=0))


def product(p: Polynomial, q: Polynomial) -> Polynomial:
    return trimmed(sum(p[i] * q[k - i] for i in range(len(p)) if 0 <= k - i < len(q)) for k in range(len(p) + len(q)))


def sign_of(p: Polynomial, s: Fraction) -> int:
    above, below = s.numerator, s.denominator
    return oracle.sign(sum(c * above**i * below ** (len(p) - i) for i, c in enumerate(p)))


def whole(p: Sequence[Fraction]) -> Polynomial:
    factor = Fraction(lcm(*(c.denominator for c in p)), gcd(*(c.numerator for c in p)) or 1)
    return trimmed(int(c * factor) for c in p)


@cache
def divided(p: Polynomial, q: Polynomial) -> tuple[Polynomial, Polynomial]:
    """Return quotient and remainder."""
    left, quotient = [Fraction(c) for c in p], [Fraction(0)] * max(len(p) - len(q) + 1, 0)
    for place in reversed(range(len(quotient))):
        quotient[place] = left[-1] / q[-1]
        left = [c - quotient[place] * q[i - place] if i >= place else c for i, c in enumerate(left)][:-1]
    return whole(quotient), whole(left)


def derivative(p: Polynomial) -> Polynomial:
    return trimmed(i * c for i, c in enumerate(p))[1:]


def common_divisor(p: Polynomial, q: Polynomial) -> Polynomial:
    while q:
        p, q = q, divided(p, q)[1]
    return p


@cache
def sturm_chain(p: Polynomial) -> list[Polynomial]:
    chain = [p, derivative(p)]
    while chain[-1]:
        chain.append(tuple(-c for c in divided(chain[-2], chain[-1])[1]))
    return chain[:-1]


def count_roots(p: Polynomial, low: Fraction, high: Fraction) -> int:
    """Count the roots in (low, high] of a polynomial without double roots, by Sturm's theorem."""

    def changes(s: Fraction) -> int:
        signs = [sign for q in sturm_chain(p) if (sign := sign_of(q, s))]
        return sum(a != b for a, b in pairwise(signs))

    return changes(low) - changes(high)


def single(p: Polynomial) -> Polynomial:
    """Return the polynomial with the same roots, none of them double."""
    return divided(p, common_divisor(p, derivative(p)))[0] if p else p


def roots(p: Polynomial) -> Iterator[Root]:
    """Yield, for each root of p in (0, 1), a polynomial and (low, high] in which it has this root alone."""
    p = single(p)
    for end in (0, 1):
        while p and sign_of(p, Fraction(end)) == 0:
            p = divided(p, (-end, 1))[0]
    stack = [(Fraction(0), Fraction(1))] if p else []
    while stack:
        low, high = stack.pop()
        count = count_roots(p, low, high)
        if count == 1:
            yield p, low, high
        elif count > 1:
            stack += [((low + high) / 2, high), (low, (low + high) / 2)]


def sign_at(d: Polynomial, root: Root) -> int:
    """Return the sign of d at a root of another polynomial."""
    p, low, high = root
    shared = common_divisor(p, d)
    if len(shared) > 1 and count_roots(single(shared), low, high):
        return 0
    while count_roots(single(d), low, high):
        low, high = halved(p, low, high)
    return sign_of(d, high)


def halved(p: Polynomial, low: Fraction, high: Fraction) -> tuple[Fraction, Fraction]:
    """Return the half of (low, high] in which p, which changes its sign at each root, has its one root there."""
    middle = (low + high) / 2
    at_middle, at_high = sign_of(p, middle), sign_of(p, high)
    return (low, middle) if at_high and at_middle in (0, at_high) else (middle, high)


def moving(a: Sequence[int], b: Sequence[int]) -> list[Polynomial]:
    return [trimmed([x, y - x]) for x, y in zip(a, b, strict=True)]


def cross(u, w) -> Polynomial:
    return minus(product(u[0], w[1]), product(u[1], w[0]))


def inner(u, w) -> Polynomial:
    return minus(product(u[0], w[0]), tuple(-c for c in product(u[1], w[1])))


def first_breach(start, end, triangles) -> Found | None:
    """Return where, between two frames that are valid, triangles vanish or edges at a vertex point the same way."""
    n = len(start)
    exact = oracle.integers([*start, *end])
    places = [moving(a, b) for a, b in zip(exact[:n], exact[n:], strict=True)]

    def edge(i: int, j: int) -> list[Polynomial]:
        return [minus(q, p) for p, q in zip(places[i], places[j], strict=True)]

    events = []
    for t, (i, j, k) in enumerate(triangles):
        events += [(("triangle", t), root) for root in roots(cross(edge(i, j), edge(i, k)))]
    for v in range(n):
        u, w = edge(v, (v + 1) % n), edge(v, v - 1)
        events += [(("vertex", v), root) for root in roots(cross(u, w)) if sign_at(inner(u, w), root) > 0]
    return earliest(events)


def earliest(events: list[tuple[tuple[str, int], Root]]) -> Found | None:
    """Return the first of several events, to 60 bits, and which are not later than that, to 50 bits."""
    first, tie, sharp = Fraction(1), 1 + Fraction(1, 2**50), []
    for element, (p, low, high) in sorted(events, key=lambda event: event[1][2]):
        while high - low > high / 2**60 and low <= first * tie:
            low, high = halved(p, low, high)
        first = min(first, high)
        sharp.append((low, high, element))
    if not sharp:
        return None
    low, high, _ = min(sharp)
    return Found(low, high, frozenset(element for other, _, element in sharp if other <= high * tie))
