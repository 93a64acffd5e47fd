"""One level of the matching: landmarks are used, costs are energies, places go to and fro."""

import numpy as np
import pytest

from tween import Triangulation
from tween.gallery import random_disk
from tween.morphing.matching.given import Landmarks
from tween.morphing.matching.levels import Effort, first_level, next_level
from tween.morphing.matching.match import energy
from tween.morphing.matching.shape import Shape

NO_LANDMARKS = Landmarks(np.empty(0, dtype=np.int64), np.empty(0, dtype=np.int64))


def shape(n: int, seed: int) -> Shape:
    return Shape(random_disk(n, np.random.default_rng(seed)), np.zeros(n, dtype=bool))


@pytest.mark.parametrize("seed", range(4))
def test_the_cost_of_a_correspondence_is_its_energy_above_four(seed: int) -> None:
    found = first_level(shape(9, seed), shape(12, seed + 40), (9, 12), (2, 1), NO_LANDMARKS, 0.0)
    costs = [c.cost for c in found]
    assert costs == sorted(costs) and costs
    for c in found:
        meshes = [Triangulation(points, c.triangles) for points in (c.source_points, c.target_points)]
        assert energy(*meshes) == pytest.approx(4.0 + c.cost, rel=1e-9)
        assert ((c.source_vertices >= 0) | (c.target_vertices >= 0)).all()


def test_places_go_to_the_other_curve_and_back() -> None:
    c = first_level(shape(9, 0), shape(12, 40), (9, 12), (2, 1), NO_LANDMARKS, 0.0)[0]
    arc = np.linspace(0, 1, 50, endpoint=False)
    away = (c.to_source(c.to_target(arc)) - arc + 0.5) % 1.0 - 0.5
    np.testing.assert_allclose(away, 0, atol=1e-9)
    np.testing.assert_allclose(c.to_target(c.source_arc), c.target_arc, atol=1e-12)


def test_landmarks_are_nodes() -> None:
    S, T = shape(9, 0), shape(12, 40)
    for i, j in ((0, 3), (4, 4)):
        for c in first_level(S, T, (9, 12), (2, 1), Landmarks(np.array([i]), np.array([j])), 0.0):
            assert c.target_vertices[c.source_vertices == i].tolist() == [j]


def test_a_finer_level_has_all_of_its_vertices() -> None:
    S, T = shape(30, 1), shape(26, 2)
    coarse = first_level(S, T, (12, 12), (1, 1), NO_LANDMARKS, 0.0)[0]
    c = next_level(S, T, (16, 16), coarse, NO_LANDMARKS, Effort(32, 12, 0.0, 2), 0.0)
    assert c is not None
    for vertices, whole in ((c.source_vertices, S), (c.target_vertices, T)):
        assert sorted(vertices[vertices >= 0]) == whole.level(16).kept.tolist()
