"""A disk at every size, and the places along its curve."""

import numpy as np
import pytest

from tween import remesh, triangulate
from tween.gallery import curve, random_disk
from tween.morphing.matching.shape import Shape, scaled


@pytest.mark.parametrize("name", ["arrow", "ell"])
def test_the_scaled_disk_has_area_one_about_its_centre(name: str) -> None:
    T = remesh(triangulate(curve(name)))
    x, y = scaled(T).T
    assert 0.5 * np.sum(x * np.roll(y, -1) - y * np.roll(x, -1)) == pytest.approx(1)
    assert np.abs([x.mean(), y.mean()]).max() < 1e-12


def test_positions_stand_in_order_and_on_their_edges() -> None:
    shape = Shape(random_disk(12, np.random.default_rng(3)), np.zeros(12, dtype=bool))
    level = shape.level(9)
    places = np.linspace(0.0, 1.0, 30, endpoint=False)
    p = shape.positions(level, np.append(places, shape.arc[level.kept]))
    assert len(level.kept) == 9 and (p.vertex >= 0).sum() == 9  # no candidate stands on a vertex
    assert (np.diff((p.arc - p.arc[0]) % 1.0) > 0).all()
    ends = np.stack(
        [shape.triangulation.points[level.kept], np.roll(shape.triangulation.points[level.kept], -1, axis=0)]
    )
    a, b = ends[:, p.edge]
    along = np.einsum("ij,ij->i", p.points - a, b - a) / np.einsum("ij,ij->i", b - a, b - a)
    np.testing.assert_allclose(p.points, a + along[:, None] * (b - a), atol=1e-12)
