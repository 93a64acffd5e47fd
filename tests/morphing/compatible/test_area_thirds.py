"""Third vertices along the path "area": by area and difference of angles; the same whether all are wanted or some."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from tween.gallery import random_disk
from tween.morphing.compatible.area_thirds import area_apex, area_third, area_thirds
from tween.morphing.compatible.layout import root_base
from tween.morphing.compatible.leg import Leg
from tween.morphing.compatible.paths import base_angles


def leg_of(seed):
    T = random_disk(20, np.random.default_rng(seed))
    return Leg(T, T.on_disk().points, "area", 0, guarantee=True)


@given(st.floats(-4, 5), st.floats(-12, 1))
def test_height_and_difference_of_angles_determine_a_triangle(x, magnitude) -> None:
    z = complex(x, 10.0**magnitude)
    a, b, c = base_angles(np.array([z]))[0]
    # the angles are known to some units of rounding, of which a flat triangle makes that over its height
    rounding = max(1e-9, 1e-15 / z.imag)
    assert abs(area_apex(z.imag, 2 * a + c, 2 * b + c) - z) < rounding * max(1, abs(z))


@pytest.mark.parametrize("seed", range(4))
def test_the_third_vertex_has_the_height_of_its_area(seed):
    leg = leg_of(seed)
    path = leg.area_path
    for i in np.flatnonzero(path.blend == 0):
        for t in (0.0, 0.4, 1.0):
            z = area_third(i, 4.0, t, *path)
            assert z.imag == pytest.approx(((1 - t) * path.areas[i, 0] + t * path.areas[i, 1]) / 4.0, rel=1e-9)


@pytest.mark.parametrize("seed", range(4))
def test_they_are_those_that_are_laid_out_and_only_where_asked_for(seed):
    leg, t = leg_of(seed), np.linspace(0, 1, 9)
    cells = np.random.default_rng(seed).random((len(leg._corners), 8)) < 0.5
    for i in range(len(cells) - 1, -1, -1):
        for child in leg._children[i][leg._children[i] >= 0]:
            cells[i] |= cells[child]
    e = root_base(leg._start[0], leg._end[0], False, t)
    _, laid = leg._lay_out(t, leg.area_path)
    found = area_thirds(leg._children, e, t, *leg.area_path, cells)
    there = np.zeros(found.shape, dtype=bool)
    there[:, :-1] |= cells
    there[:, 1:] |= cells
    np.testing.assert_array_equal(found[there], laid[there])
    assert (found[~there] == 0).all() and (~there).any()
