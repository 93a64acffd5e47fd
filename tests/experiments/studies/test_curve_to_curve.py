"""Table 1 for pairs of curves: morphs over the disk, and pairs with and without flips."""

import numpy as np
import pandas as pd
import pytest

from experiments.store import RESULTS
from experiments.studies import curve_to_curve
from tween import decompose


def test_a_morph_over_the_disk_meets_both_ends() -> None:
    a = curve_to_curve.remeshed("e_to_l").alignment
    S, T = (decompose(shape.curve).sample(np.random.default_rng(2)) for shape in (a.source, a.target))
    A = curve_to_curve.over_the_disk(S, T)
    assert A.shape == (len(S.triangles), curve_to_curve.WAYS["frames"])
    assert A[:, 0] * S.areas.sum() == pytest.approx(S.areas)
    assert np.sort(A[:, -1]) * S.areas.sum() == pytest.approx(np.sort(T.areas))


def test_every_morph_is_on_one_clock_and_the_remeshed_rows_are_what_the_code_gives() -> None:
    table = pd.read_csv(RESULTS / "table_1_curve_to_curve.csv")
    assert set(table.pace) == {curve_to_curve.PACE} and set(table.path) == set(curve_to_curve.PATHS)
    for path in curve_to_curve.PATHS:
        row = table[(table.pair == "e_to_l") & (table.path == path) & (table.triangulation == "remeshed")].iloc[0]
        flips, *ranks, variance = curve_to_curve.measure(curve_to_curve.remeshed("e_to_l", path))
        assert [flips, *ranks] == row[curve_to_curve.MEASURES[:-1]].tolist()
        assert variance == pytest.approx(row.Var, rel=1e-3)


def test_straight_morphs_of_the_flips_table_have_a_common_triangulation() -> None:
    flips = pd.read_csv(RESULTS / "table_1_curve_to_curve_flips.csv")
    pairs = pd.read_csv(RESULTS / "pairs.csv").query("path == 'slide'").merge(flips, on=["source", "target"])
    assert len(pairs) == len(flips)
    assert (pairs.common == "pivots").all() and (pairs.flips_x == pairs.flips_y).all()
    assert (pairs["flipped_AR_1e-4"] == pairs["AR_1e-4"]).all()
