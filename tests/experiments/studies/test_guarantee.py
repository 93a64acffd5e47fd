"""What the study of the guarantee measures, on motions whose measures are known."""

import numpy as np
import pandas as pd
import pytest

from experiments.store import RESULTS
from experiments.studies import guarantee

SQUARE = np.array([(0, 0), (1, 0), (1, 1), (0, 1)], dtype=np.float64)
FAN = np.array([(0, 1, 2), (0, 2, 3)])
STRETCHED = np.stack([SQUARE * (1 + s, 1) for s in (0.0, 2.0, 1.0)])


def test_a_stretch_distorts_by_its_factor() -> None:
    assert guarantee.distortion(STRETCHED, np.stack([FAN] * 3)) == pytest.approx(3)


def test_triangles_that_are_new_are_measured_from_where_they_appear() -> None:
    other = np.array([(0, 1, 3), (1, 2, 3)])
    assert guarantee.distortion(STRETCHED[[0, 1, 1]], np.stack([FAN, other, other])) == pytest.approx(1)


def test_an_edge_leaves_the_range_between_its_two_lengths_by_a_factor() -> None:
    assert guarantee.overshoot(STRETCHED) == pytest.approx(1.5)
    assert guarantee.overshoot(STRETCHED[[0, 2, 1]]) == pytest.approx(1)


def test_the_way_is_there_and_back() -> None:
    assert guarantee.way(STRETCHED) == pytest.approx((2 + 1) / 2)


def test_every_part_has_subjects_and_every_kind_a_row() -> None:
    kinds = {part.split(": ")[0] for part in guarantee.parts()}
    assert kinds == set(pd.read_csv(RESULTS / "guarantee_summary.csv").kind)
