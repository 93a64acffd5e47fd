"""Vertices inserted on boundary edges: a triangulated disk stays one, whatever lies where on the edges."""

import numpy as np
import pytest

from tween import Triangulation, gallery, triangulate
from tween.morphing.keyframes.subdivision import subdivided


def spread(T: Triangulation, counts: np.ndarray, rng: np.random.Generator) -> tuple[np.ndarray, np.ndarray]:
    """Points with so many more after each vertex, at shares drawn at random; and the new number of each vertex."""
    points, vertices = [], []
    for i, count in enumerate(counts.tolist()):
        vertices.append(len(points))
        a, b = T.points[i], T.points[(i + 1) % len(T)]
        shares = np.concatenate([[0.0], np.sort(rng.uniform(0.01, 0.99, count))])
        points += list(a + shares[:, None] * (b - a))
    return np.array(points), np.array(vertices)


@pytest.mark.parametrize("most", [1, 2, 7])
@pytest.mark.parametrize("shape", ["triangle", "square", "loop"])
def test_a_disk_stays_a_disk_and_its_triangles_are_cut_not_changed(shape: str, most: int) -> None:
    rng = np.random.default_rng(most)
    points = {"triangle": [[0, 0], [2, 0], [0, 1]], "square": [[0, 0], [1, 0], [1, 1], [0, 1]]}
    T = triangulate(points.get(shape, gallery.curve("loop")))
    for _ in range(20):
        counts = rng.integers(0, most + 1, len(T))
        grown, vertices = spread(T, counts, rng)
        triangles = subdivided(T.triangles, vertices, len(grown))
        U = Triangulation(grown, triangles)
        assert len(triangles) == len(grown) - 2
        assert U.areas.min() > 1e-9 * T.areas.min()
        assert U.areas.sum() == pytest.approx(T.areas.sum())
        again = Triangulation(grown, np.roll(triangles, 1, axis=0))
        np.testing.assert_array_equal(again.canonical, U.canonical)
        assert U.dual.shape == (len(grown) - 3, 2)


def test_without_inserted_vertices_the_triangles_keep_their_rows() -> None:
    T = triangulate(gallery.curve("ess"))
    np.testing.assert_array_equal(subdivided(T.triangles, np.arange(len(T)), len(T)), T.triangles)


def test_vertices_may_start_anywhere() -> None:
    T = triangulate(gallery.curve("ess"))
    n = len(T)
    np.testing.assert_array_equal(subdivided(T.triangles, (np.arange(n) + 5) % n, n), (T.triangles + 5) % n)
