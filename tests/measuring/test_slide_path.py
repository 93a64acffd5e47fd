"""The path "slide" enclosed: by code of its own, where the morphs have it."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from tween import gallery, morph, triangulate
from tween.measuring.slide_path import enclosed_slide, outline
from tween.morphing.compatible.paths import third_vertices

places = st.builds(complex, st.floats(-3, 4), st.floats(0.01, 3))


def along(pieces, share: float) -> complex:
    """Where a path is, found by walking along it in small steps."""
    walk = []
    for a, b, end in pieces:
        s = np.linspace(0, 1, 4001)
        if end is None:
            walk.append(a + s * (b - a))
        else:
            start, stop = np.angle(a - end), np.angle(b - end)
            walk.append(end + abs(a - end) * np.exp(1j * (start + s * (stop - start))))
    z = np.concatenate(walk)
    way = np.concatenate([[0.0], np.cumsum(np.abs(np.diff(z)))])
    return complex(np.interp(share * way[-1], way, z.real), np.interp(share * way[-1], way, z.imag))


@given(places, places, st.sampled_from([[], [0], [1], [0, 1]]))
def test_the_path_is_that_of_the_morphs(z1: complex, z2: complex, ends: list[int]) -> None:
    times = np.array([0.0, 0.3, 0.5, 0.9, 1.0])
    propagates = np.array([[0 in ends, 1 in ends]])
    z = third_vertices("slide", np.array([z1]), np.array([z2]), propagates, np.ones(1), times)[0]
    pieces = outline(z1, z2, ends)
    assert np.allclose([along(pieces, t) for t in times], z, atol=1e-4)
    assert {end for _, _, end in pieces} <= {None, *ends}


@pytest.mark.parametrize("width", [0.0, 1e-3, 0.1])
def test_what_slides_stays_in_its_enclosure(width: float) -> None:
    T = triangulate(gallery.curve("pretzel"))
    (plan,) = morph(T.on_disk(), T, path="slide").plans()
    p = np.linspace(0.0, 1.0 - width, 30)
    rows, x, y = enclosed_slide(plan, p, p + width)
    assert len(rows) > 5
    a, b, c = (T.moved(plan.source).points[plan.corners[rows, s]] @ [1, 1j] for s in range(3))
    d, e, f = (plan.target[plan.corners[rows, s]] @ [1, 1j] for s in range(3))
    bases = {tuple(base) for base in plan.corners[1:, :2].tolist()}
    open_ends = np.array([[(u, w) in bases, (w, v) in bases] for u, v, w in plan.corners[rows].tolist()])
    for share in (0.0, 0.4, 1.0):
        z = third_vertices(
            "slide", (c - a) / (b - a), (f - d) / (e - d), open_ends, np.ones(len(rows)), p + share * width
        )
        assert ((x.low <= z.real) & (z.real <= x.high) & (y.low <= z.imag) & (z.imag <= y.high)).all()
