"""Restored triangulations are those of the whole curve, Delaunay, and in the order of the table."""

import numpy as np
import pytest
from both_tables import both
from hypothesis import given
from hypothesis import strategies as st
from strategies import disks

from tween import Curve, Triangulation, decompose, gallery
from tween.triangulating.flips import locally_delaunay
from tween.triangulating.reduction import reduce_curve
from tween.triangulating.restoration import restore


def test_restoring_nothing_changes_nothing() -> None:
    curve = Curve([[0, 0], [1, 0], [0, 1]])
    reduction = reduce_curve(curve)
    assert restore(curve.points, reduction, np.array([[0, 1, 2]])).tolist() == [[0, 1, 2]]


@pytest.mark.parametrize("name", ["horseshoe", "three_lobes", "spiral_2"])
def test_restored_triangles_have_the_order_of_the_table(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    whole, reduced = both(gallery.curve(name), monkeypatch)
    (T,) = reduced.immersions()
    assert T.triangles.tolist() == whole._full.delaunay()[0].tolist()
    for rows in (T.triangles, whole.sample(np.random.default_rng(0)).triangles):
        assert rows.tolist() == sorted(rows.tolist(), key=lambda row: (row[0], -row[2]))


def restored(c: Curve, count: int, seed: int) -> list[Triangulation]:
    """Reduce a curve, draw triangulations of what is left, and restore each."""
    reduction = reduce_curve(c)
    rows = decompose(c.points[reduction.kept]).sample(np.random.default_rng(seed), count)
    return [Triangulation(c.points, restore(c.points, reduction, T.triangles)) for T in rows]


@pytest.mark.parametrize("seed", range(40))
def test_whatever_triangulates_the_reduced_curve_is_restored_to_a_disk_of_the_whole(seed: int) -> None:
    rng = np.random.default_rng(seed)
    c = gallery.random_disk(int(rng.integers(5, 60)), rng).curve
    disks = {T.canonical.tobytes() for T in decompose(c).immersions()}
    for T in restored(c, 5, seed):
        assert locally_delaunay(T.validate()).all()
        assert T.canonical.tobytes() in disks


@pytest.mark.parametrize("name", gallery.names())
def test_the_gallery_is_restored_to_the_disks_that_it_bounds(name: str) -> None:
    c = gallery.curve(name)
    disks = {T.canonical.tobytes() for T in decompose(c).immersions()}
    assert {T.validate().canonical.tobytes() for T in restored(c, 60, 0)} == disks


def test_these_curves_have_ears_and_dents_to_restore() -> None:
    dents = np.concatenate([reduce_curve(gallery.curve(name)).dents for name in gallery.names()])
    assert min(np.sum(dents), np.sum(~dents)) > 50


@given(disks(4, 30), st.floats(0.01, 100), st.booleans())
def test_restoring_follows_scaling_and_is_independent_of_the_triangles_given(T, scale: float, last: bool) -> None:
    reduction = reduce_curve(T.curve)
    reduced = decompose(T.points[reduction.kept])
    rows = restore(T.points, reduction, reduced.arbitrary("last" if last else "first").triangles)
    power = 2.0 ** round(np.log2(scale))  # a power of two rounds nothing
    again = restore(power * T.points, reduction, reduced.arbitrary("first").triangles)
    if len(decompose(T.curve).immersions()) == 1:
        assert rows.tolist() == again.tolist()
