"""All immersed disks of a curve: against remeshed samples, against brute force, and ties."""

import numpy as np
import pytest

from tween import Triangulation, TweenError, decompose, gallery, remesh
from tween.errors import NotSelfOverlappingError
from tween.triangulating.flips import locally_delaunay

CURVES = {name: gallery.curve(name) for name in gallery.names()} | {f"letter {x}": gallery.letter(x) for x in "DJSeoz"}
DISKS = {"two_disks": 2, "five_disks": 5}


def regular(n: int) -> np.ndarray:
    angle = 2 * np.pi * np.arange(n) / n
    return np.stack([np.cos(angle), np.sin(angle)], axis=1)


@pytest.mark.parametrize("name", CURVES)
def test_two_hundred_remeshed_samples_are_the_immersed_disks(name: str) -> None:
    d = decompose(CURVES[name])
    listed = d.immersions()
    assert len(listed) == DISKS.get(name, 1)
    assert all(locally_delaunay(T.validate()).all() for T in listed)
    remeshed = {remesh(T).canonical.tobytes() for T in d.sample(np.random.default_rng(3), 200)}
    assert remeshed == {T.canonical.tobytes() for T in listed}


@pytest.mark.parametrize("seed", range(40))
def test_a_small_disk_has_as_many_immersions_as_its_triangulations_fall_into_classes_by_flips(seed: int) -> None:
    curve = gallery.random_disk(11, np.random.default_rng(seed)).curve
    d = decompose(curve)
    rng, found = np.random.default_rng(seed), {}
    while len(found) < d.count:
        found |= {T.canonical.tobytes(): T for T in d.sample(rng, 100)}
    assert len({remesh(T).canonical.tobytes() for T in found.values()}) == len(d.immersions())


@pytest.mark.parametrize("n", [4, 5, 8, 12, 30, 200])
def test_cocircular_vertices_do_not_multiply_the_answer(n: int) -> None:
    d = decompose(regular(n))
    assert len(d.immersions()) == 1
    assert n > 30 or len(d._full.delaunay()) == 1


@pytest.mark.parametrize("side", [1, 2, 4])
def test_a_square_with_points_along_its_sides_bounds_one_disk(side: int) -> None:
    along = np.arange(side, dtype=float)
    zero, full = np.zeros(side), np.full(side, float(side))
    x = np.concatenate([along, full, full - along, zero])
    y = np.concatenate([zero, along, full, full - along])
    assert len(decompose(np.stack([x, y], axis=1)).immersions()) == 1


def test_the_answer_does_not_depend_on_where_the_curve_starts() -> None:
    points = CURVES["five_disks"].points
    for shift in (1, 17, 50):
        assert len(decompose(np.roll(points, -shift, axis=0)).immersions()) == 5


def test_the_immersions_of_a_curve_can_be_morphed_each_in_its_own_way() -> None:
    first, second = decompose(CURVES["two_disks"]).immersions()
    assert isinstance(first, Triangulation)
    assert first.canonical.tolist() != second.canonical.tolist()


def test_misuse_is_refused() -> None:
    with pytest.raises(NotSelfOverlappingError, match="turning number is 0"):
        decompose([[0, 0], [2, 2], [2, 0], [0, 2]]).immersions()
    with pytest.raises(TweenError, match="2 were decomposed together"):
        decompose(regular(5), regular(5)).immersions()
