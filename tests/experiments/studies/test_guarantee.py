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


def test_the_way_is_there_and_back() -> None:
    assert guarantee.way(STRETCHED) == pytest.approx((2 + 1) / 2)


def test_every_part_has_subjects_and_every_kind_a_row() -> None:
    kinds = {part.split(": ")[0] for part in guarantee.parts()}
    assert kinds == set(pd.read_csv(RESULTS / "guarantee_summary.csv").kind)


def test_what_depends_on_the_processor_is_not_written() -> None:
    row = {"Var": 1e-25, "distortion": 1509.0, "swelling": 1.23456, "longest": 2.0, "shortest": 0.5, "way": 1.0}
    written = guarantee.rounded(pd.DataFrame([row])).iloc[0]
    assert written.tolist() == ["<1e-20", "above 1e3", "1.235", "2", "0.5", "1"]


def test_along_angle_shapes_shrink_and_along_slide_they_swell() -> None:
    table = pd.read_csv(RESULTS / "guarantee_summary.csv").query("kind == 'disk' and not guarantee").set_index("path")
    assert table.loc["slide", "swelling"] > 2 > 1.01 > table.loc["angle", "swelling"]
    assert table.loc["angle", "shortest"] < 0.1
    assert table.loc["metric", "longest"] == table.loc["metric", "shortest"] == 1
