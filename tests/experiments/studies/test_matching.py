"""The study of matching: what it measures on motions that are known, its intervals, and its sample."""

import numpy as np
import pandas as pd
import pytest

from experiments import subjects
from experiments.baselines import straight
from experiments.store import RESULTS
from experiments.studies import matching, matching_sample
from tween import Triangulation, paper_morph

SQUARE = Triangulation(np.array([(0, 0), (1, 0), (1, 1), (0, 1)], dtype=np.float64), [(0, 1, 2), (0, 2, 3)])
TABLE = pd.read_csv(RESULTS / "matching.csv")


def test_paths_are_measured_in_widths_of_the_larger_end() -> None:
    m = straight(SQUARE, SQUARE.moved(2 * SQUARE.points))
    assert matching.path_length(m.frames(5)) == pytest.approx((0 + 1 + np.sqrt(2) + 1) / 4 / 2)


def test_a_shape_turned_inside_out_bounds_no_disk_and_a_square_does() -> None:
    assert matching.bounds_disk(SQUARE.points)
    assert not matching.bounds_disk(SQUARE.points[::-1])
    assert not matching.bounds_disk(SQUARE.points[[0, 2, 1, 3]])


def test_frames_count_where_other_triangles_than_those_in_force_show_a_disk() -> None:
    other = Triangulation(SQUARE.points, [(0, 1, 3), (1, 2, 3)])
    m = straight(other, other.moved([(0, 0), (1, 0), (0.2, 0.2), (0, 1)]))  # a dart: only 0-2 divides it
    assert matching.disks(m, m.frames(5)) == 5


def test_straight_lines_of_a_half_turn_leave_frames_without_a_disk() -> None:
    m = straight(SQUARE, SQUARE.moved(1 - SQUARE.points))
    assert matching.disks(m, m.frames(5)) == 4  # in the middle all vertices meet


def test_energy_is_given_only_where_the_triangles_are_the_same() -> None:
    turned = Triangulation(SQUARE.points, [(0, 1, 3), (1, 2, 3)])
    assert matching.measure(straight(SQUARE, SQUARE))["energy"] == pytest.approx(4)
    assert matching.measure(straight(SQUARE, turned))["energy"] is None
    assert matching.measure(paper_morph(SQUARE, SQUARE))["flips"] == 0


def test_an_interval_holds_the_share_and_shrinks_to_nothing_where_all_agree() -> None:
    pairs = [tuple(pair.split(subjects.BETWEEN)) for pair in subjects.pairs(["a", "b", "c", "d", "e"])]
    draws = matching.resampled_weights(pd.DataFrame(pairs, columns=["source", "target"]))
    index = pd.MultiIndex.from_tuples(pairs)
    half = matching.share(pd.Series(np.arange(10) % 2 == 0, index=index), draws)
    every = matching.share(pd.Series(True, index=index), draws)
    assert half["low"] < half["share"] == 0.5 < half["high"]
    assert every["low"] == every["share"] == every["high"] == 1


def test_the_sample_is_part_of_all_pairs_and_always_the_same() -> None:
    assert matching_sample.sample() == matching_sample.sample()
    assert set(matching_sample.sample()) <= set(subjects.pairs())
    assert len(matching_sample.sample()) == matching_sample.SAMPLE


def test_committed_rows_agree_with_themselves() -> None:
    assert matching_sample.differences(TABLE, TABLE) == []


@pytest.mark.parametrize("column", matching_sample.NUMBERS)
def test_a_changed_number_is_told(column: str) -> None:
    changed = TABLE.copy()
    row = changed.index[(changed.method == "matched") & changed[column].notna()][3]
    changed[column] = changed[column].astype(float)
    changed.loc[row, column] = 1.05 * changed.loc[row, column] + (2 if column in matching.RANKS else 0.001)
    told = matching_sample.differences(TABLE, changed)
    assert len(told) == 1 and f"{TABLE.source[row]}, {TABLE.target[row]}, matched: {column} is" in told[0]


def test_a_row_that_is_missing_is_told() -> None:
    assert "only in the new table" in matching_sample.differences(TABLE, TABLE.iloc[1:])[0]


def test_the_committed_table_has_every_pair_and_nothing_matched_is_flipped() -> None:
    matched = TABLE[TABLE.method == "matched"]
    assert list(matched.source + subjects.BETWEEN + matched.target) == subjects.pairs()
    assert set(TABLE.method) == set(matching.METHODS)
    assert (matched.disks == matching.PARAMETERS["disk_frames"]).all()


def test_the_committed_rows_of_a_pair_are_what_the_code_gives() -> None:
    pair = "ess - spiral_1"
    source, target = pair.split(subjects.BETWEEN)
    mine = TABLE[(TABLE.source == source) & (TABLE.target == target)]
    assert matching_sample.differences(matching.table(matching.work(pair)), mine) == []
