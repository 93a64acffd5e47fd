"""Every pair of curves: the committed rows of one pair are what the code gives, and there are rows for all."""

import pandas as pd
import pytest

from experiments import subjects
from experiments.store import RESULTS
from experiments.studies import pairs

TABLE = pd.read_csv(RESULTS / "pairs.csv")


@pytest.mark.parametrize("pair", ["ell - ess", "two_disks - letter c"])
def test_the_committed_rows_are_what_the_code_gives(pair: str) -> None:
    found = pairs.table(pairs.work(pair))
    names = pair.split(subjects.BETWEEN)
    rows = TABLE[(TABLE.source == names[0]) & (TABLE.target == names[1])].reset_index(drop=True)
    exact = ["source", "target", "path", "n", "crossings", "flips", "common", "AR_1e-4", "ends_within_1e-12"]
    pd.testing.assert_frame_equal(found[exact], rows[exact])
    pd.testing.assert_frame_equal(found[["u", "v"]], rows[["u", "v"]], rtol=1e-4)


def test_the_committed_table_is_complete() -> None:
    assert len(TABLE) == len(pairs.PARAMETERS["paths"]) * len(subjects.pairs())
    assert TABLE.positive.all()
