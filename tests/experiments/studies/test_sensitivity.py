"""What the verdict on Table 1 depends on, and the shortcut by which the study of Table 1 morphs to the disk."""

import numpy as np
import pandas as pd
import pytest

from experiments import figure11, sensitivity, store, table1
from tween import area_matrix, decompose, gallery, morph, remesh
from tween.morphing.compatible.leg import root_triangle
from tween.morphing.compatible.paths import Path


@pytest.mark.parametrize("path", ["linear", "slide", "angle"])
@pytest.mark.parametrize("name", ["ell", "pretzel", "letter R"])
def test_the_quick_way_to_the_disk_is_the_morphs_to_the_last_bit(name: str, path: Path) -> None:
    d = decompose(table1.shape(name))
    T = [remesh(d.arbitrary()), *d.sample(np.random.default_rng(1), 4)]
    disk = T[0].on_disk().points
    way = table1.ToDisk(T[0].points, disk, 40)
    for t in T:
        expected = area_matrix(morph(t, t.moved(disk), path=path), 40)
        assert np.array_equal(way.area_matrix(t, path, root_triangle("disk-center", t, t.moved(disk))), expected)


def test_a_morph_over_the_disk_meets_both_ends() -> None:
    a = figure11.remeshed("e_to_l").alignment
    S, T = (decompose(shape.curve).sample(np.random.default_rng(2)) for shape in (a.source, a.target))
    A = figure11.over_the_disk(S, T)
    assert A.shape == (len(S.triangles), figure11.WAYS["frames"])
    assert A[:, 0] * S.areas.sum() == pytest.approx(S.areas)
    assert np.sort(A[:, -1]) * S.areas.sum() == pytest.approx(np.sort(T.areas))


def test_slides_are_counted_as_the_path_makes_them() -> None:
    T = remesh(decompose(gallery.curve("horseshoe")).arbitrary())
    assert 0 < sensitivity.count_slides(T, T.on_disk().points) < len(T.triangles)
    assert sensitivity.count_slides(T, T.points) == 0


def test_every_curve_is_below_at_or_above_in_every_setting() -> None:
    table = pd.read_csv(store.RESULTS / "sensitivity.csv")
    assert (table[["below", "equal", "above"]].sum(axis=1) == len(table1.shapes())).all()
    assert (table.groupby(["factor", "setting"]).size() == len(sensitivity.MEASURES)).all()
    assert len(table) == len(sensitivity.MEASURES) * len(
        {*sensitivity.SETTINGS, *sensitivity.UNITS, *sensitivity.ARBITRARY}
    )


def test_straight_morphs_of_the_flips_table_have_a_common_triangulation() -> None:
    flips = pd.read_csv(store.RESULTS / "table1_flips.csv")
    pairs = pd.read_csv(store.RESULTS / "pairs.csv").query("path == 'slide'").merge(flips, on=["source", "target"])
    assert len(pairs) == len(flips)
    assert (pairs.common == "pivots").all() and (pairs.flips_x == pairs.flips_y).all()
    assert (pairs["flipped_AR_1e-4"] == pairs["AR_1e-4"]).all()
