"""The ladder of levels and candidates."""

from itertools import combinations

import numpy as np
import pytest
from numpy.typing import NDArray

from tween import Curve, certify, gallery, match, morph, remesh, triangulate, verify
from tween.gallery import random_disk
from tween.morphing.matching.given import Landmarks
from tween.morphing.matching.search import SMALL, even_candidates, search, sizes_of_levels
from tween.morphing.matching.shape import Shape
from tween.morphing.matching.simplify import simplify


@pytest.mark.parametrize(("n", "m"), [(24, 24), (25, 100), (100, 31), (500, 3)])
def test_levels_grow_to_all_vertices_of_both(n: int, m: int) -> None:
    sizes = np.array(sizes_of_levels(n, m, SMALL))
    assert tuple(sizes[-1]) == (n, m)
    assert (np.diff(sizes, axis=0) >= 0).all() and (np.diff(sizes, axis=0).max(axis=1) > 0).all()
    assert (sizes[0] <= SMALL).all()


@pytest.mark.parametrize(("n", "m"), [(4, 4), (4, 20), (20, 4), (7, 24)])
def test_the_curve_of_fewer_vertices_has_more_candidates(n: int, m: int) -> None:
    positions = [(c + 1) * k for c, k in zip(even_candidates(n, m), (n, m), strict=True)]
    assert min(positions) >= 2 * max(n, m)
    assert max(positions) < min(positions) + 2 * max(n, m)


def shape(n: int, seed: int) -> Shape:
    return Shape(random_disk(n, np.random.default_rng(seed)), np.zeros(n, dtype=bool))


ANGLE = np.linspace(3.0, 15.0, 5000)

NO_LANDMARKS = Landmarks(np.empty(0, dtype=np.int64), np.empty(0, dtype=np.int64))


def test_of_several_disks_the_one_that_matches_best_is_found() -> None:
    one, other = shape(8, 0), shape(8, 1)
    found = search([one, other], [other], NO_LANDMARKS, None)
    assert found.complete and found.disks == (1, 0)
    assert found.levels[-1] == (8, 8, pytest.approx(4.0))


def coarse(curve: Curve) -> NDArray[np.float64]:
    T = remesh(triangulate(curve))
    return T.points[simplify(T, [SMALL], np.zeros(len(T), dtype=bool))[0].kept]


@pytest.mark.slow
def test_every_pair_of_the_gallery_is_matched_exactly_where_it_is_simplified_to_24_vertices() -> None:
    curves = {name: coarse(gallery.curve(name)) for name in gallery.names()}
    curves |= {f"letter {name}": coarse(gallery.letter(name)) for name in gallery.letters()}
    assert {len(points) for points in curves.values()} == {SMALL}
    failed = [pair for pair in combinations(curves, 2) if not match(*map(curves.__getitem__, pair)).exact]
    assert len(curves) == 34 and not failed


@pytest.mark.slow
def test_two_curves_of_ten_thousand_vertices_are_matched_without_flips_and_certified() -> None:
    strip, wave = (
        gallery.ribbon(np.stack(xy, axis=1), width)
        for xy, width in (
            ((ANGLE * np.cos(ANGLE), ANGLE * np.sin(ANGLE)), 1.5),
            ((ANGLE, 2 * np.sin(ANGLE)), 0.5),
        )
    )
    a = match(strip, wave)
    assert len(strip) == len(wave) == 10_000
    assert a.complete and a.energy < 8
    for mesh, rows in ((a.source, a.source_vertices), (a.target, a.target_vertices)):
        assert verify(mesh.points, a.source.triangles).valid
        assert sorted(rows[rows >= 0]) == list(range(10_000))
    assert certify(morph(strip, wave)).valid
