"""All vertices spread by a coarse correspondence: both curves keep their shapes and get equally many vertices."""

import numpy as np
import oracle
import pytest

from tween.gallery import random_disk
from tween.morphing.matching.given import Landmarks
from tween.morphing.matching.levels import first_level
from tween.morphing.matching.shape import Shape
from tween.morphing.matching.spread import spread

NO_LANDMARKS = Landmarks(np.empty(0, dtype=np.int64), np.empty(0, dtype=np.int64))


def shape(n: int, seed: int) -> Shape:
    return Shape(random_disk(n, np.random.default_rng(seed)), np.zeros(n, dtype=bool))


@pytest.mark.parametrize("guided", [False, True])
@pytest.mark.parametrize("seed", range(3))
def test_every_vertex_of_both_has_a_partner_and_the_shapes_stay(seed: int, guided: bool) -> None:
    S, T = shape(20, seed), shape(16, seed + 30)
    coarse = first_level(S, T, (10, 10), (1, 1), NO_LANDMARKS, 0.0)[0] if guided else None
    c, *meshes = spread(S, T, coarse)
    assert len(meshes[0]) == len(meshes[1]) == len(c.source_arc)
    for mesh, whole, vertices in zip(meshes, (S, T), (c.source_vertices, c.target_vertices), strict=True):
        own = vertices >= 0
        points = whole.triangulation.points
        np.testing.assert_array_equal(mesh.validate().points[own], points[vertices[own]])
        assert sorted(vertices[own]) == list(range(len(whole)))
        assert float(oracle.area(mesh.points)) == pytest.approx(float(oracle.area(points)), rel=1e-12)
    assert ((c.source_vertices >= 0) | (c.target_vertices >= 0)).all()
