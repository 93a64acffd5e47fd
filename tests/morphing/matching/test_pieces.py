"""A level matched piece by piece: all vertices, valid disks, and hardly more energy than by one table."""

import numpy as np
import pytest

from tween import Triangulation, gallery, triangulate, verify
from tween.gallery import random_disk
from tween.morphing.matching.given import Landmarks
from tween.morphing.matching.levels import Correspondence, Effort, first_level, next_level
from tween.morphing.matching.match import energy
from tween.morphing.matching.pieces import _Finer, _grown, next_level_in_pieces
from tween.morphing.matching.shape import Shape
from tween.triangulating.flips import remesh

NO_LANDMARKS = Landmarks(np.empty(0, dtype=np.int64), np.empty(0, dtype=np.int64))
WIDE = Effort(16, 6, 0.0, 1, 100)
EFFORTS = (Effort(4, 3, 0.2, 0, 30), Effort(6, 5, 0.0, 0, 60), WIDE)
SIZES, WHOLE = (24, 32, 43, 58, 78, 105, 150), 225


def shape(name: str) -> Shape:
    curve = gallery.curve(name)
    return Shape(remesh(triangulate(curve.insert_vertices(WHOLE - len(curve)))), np.zeros(WHOLE, dtype=bool))


@pytest.fixture(scope="module", params=["arrow-ess", "two_disks-spiral_1"])
def halfway(request) -> tuple[Shape, Shape, Correspondence]:
    """Two shapes, and how they are matched at two thirds of their vertices."""
    S, T = map(shape, request.param.split("-"))
    c = first_level(S, T, (24, 24), (1, 1), NO_LANDMARKS, 0.0)[0]
    for size in SIZES:
        finer = next_level(S, T, (size, size), c, NO_LANDMARKS, WIDE, 0.0)
        assert finer is not None
        c = finer
    return S, T, c


def check(S: Shape, T: Shape, c: Correspondence) -> None:
    for points, vertices, of in ((c.source_points, c.source_vertices, S), (c.target_points, c.target_vertices, T)):
        assert verify(points, c.triangles).valid
        assert sorted(vertices[vertices >= 0]) == list(range(len(of)))
        np.testing.assert_array_equal(points[vertices >= 0], of.triangulation.points[vertices[vertices >= 0]])
    assert ((c.source_vertices >= 0) | (c.target_vertices >= 0)).all()
    meshes = [Triangulation(points, c.triangles) for points in (c.source_points, c.target_points)]
    assert energy(*meshes) == pytest.approx(4.0 + c.cost, rel=1e-9)


def test_a_level_in_pieces_has_all_vertices_and_hardly_more_energy(halfway) -> None:
    S, T, coarse = halfway
    c = next_level_in_pieces(S, T, (WHOLE, WHOLE), coarse, NO_LANDMARKS, EFFORTS)
    whole = next_level(S, T, (WHOLE, WHOLE), coarse, NO_LANDMARKS, WIDE, 0.0)
    assert c is not None and whole is not None
    check(S, T, c)
    assert whole.cost <= c.cost * (1 + 1e-9)  # pinned diagonals only take choices away
    assert c.cost <= 1.1 * whole.cost


def test_a_curve_is_cut_into_connected_pieces_along_diagonals_that_stay_straight(halfway) -> None:
    S, T, coarse = halfway
    finer = _Finer(S, T, (WHOLE, WHOLE), coarse, NO_LANDMARKS)
    piece, twin = finer.cut(EFFORTS[0]), coarse.twin
    labels = np.unique(piece)
    inner = np.flatnonzero(twin >= 0)
    across = piece[inner // 3] != piece[twin[inner] // 3]
    assert len(labels) > 1
    assert across.sum() == 2 * (len(labels) - 1)  # a tree of pieces, each of them connected
    _, rows = finer.positions(EFFORTS[0])
    ends = coarse.triangles.ravel()[inner[across]]
    assert (rows[:, ends] >= 0).all()


def test_a_piece_that_cannot_be_matched_grows_by_its_neighbours_until_none_is_left(halfway) -> None:
    S, T, coarse = halfway
    piece = _Finer(S, T, (WHOLE, WHOLE), coarse, NO_LANDMARKS).cut(EFFORTS[0])
    label = int(piece[-1])
    while len(np.unique(piece)) > 1:
        grown = _grown(piece, coarse.twin, [label])
        assert grown is not None
        label = int(grown.max())
        assert (grown[piece == piece[-1]] == label).all()
        assert (grown == label).sum() > (piece == piece[-1]).sum()
        piece = grown
    assert _grown(piece, coarse.twin, [label]) is None


def test_where_no_effort_matches_a_piece_there_is_no_level(halfway) -> None:
    """All candidates give way to vertices, and of these few lie where the other curve's do."""
    bare = Effort(0, 0, 9.0, 0, 1)
    S, T, coarse = halfway
    assert next_level_in_pieces(S, T, (WHOLE, WHOLE), coarse, NO_LANDMARKS, (bare, bare)) is None


def test_landmarks_are_kept() -> None:
    S = Shape(random_disk(WHOLE, np.random.default_rng(0)), np.zeros(WHOLE, dtype=bool))
    coarse = first_level(S, S, (24, 24), (1, 1), NO_LANDMARKS, 0.0)[0]
    v = coarse.source_vertices[[3, 11]]
    nodes = Landmarks(v, v)
    c = next_level_in_pieces(S, S, (32, 32), coarse, nodes, (WIDE, WIDE))
    assert c is not None
    assert set(zip(v, v, strict=True)) <= set(zip(c.source_vertices, c.target_vertices, strict=True))
