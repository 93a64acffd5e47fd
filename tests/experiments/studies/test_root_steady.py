"""The root under steady placement: places among all roots, and the committed rows."""

import numpy as np
import pandas as pd
import pytest

from experiments.store import RESULTS
from experiments.studies import root_steady
from experiments.subjects import shapes

TABLE = pd.read_csv(RESULTS / "root_steady.csv")


def test_a_root_has_its_place_among_all() -> None:
    placed = root_steady.placed(np.array([3.0, 1.0, 2.0, 4.0]), 1)
    assert placed == {"center": 1, "min": 1, "median": 2.5, "max": 4, "percentile": pytest.approx(0.125)}


def test_ties_with_the_median_are_left_out_of_the_sign_test() -> None:
    numbers = {"center": [1.0, 2.0, 2.0], "min": 1.0, "median": 2.0, "max": 3.0, "percentile": 0.5}
    rows = pd.DataFrame({"curve": list("abc"), "path": "slide", "measure": "Var", "roots": 3} | numbers)
    row = root_steady.summary(rows).iloc[0]
    assert (row.below_median, row.above_median, row.best) == (1, 0, 1)


@pytest.mark.slow
def test_the_committed_rows_of_a_curve_are_what_the_code_gives() -> None:
    found = root_steady.table(root_steady.work("arrow"))
    committed = TABLE[TABLE.curve == "arrow"].reset_index(drop=True)
    pd.testing.assert_frame_equal(found, committed, rtol=0.011, atol=0.02, check_dtype=False)


def test_the_committed_table_is_complete() -> None:
    assert list(TABLE.curve.unique()) == list(shapes())
    assert len(TABLE) == 34 * len(root_steady.PARAMETERS["paths"]) * len(root_steady.MEASURES)
