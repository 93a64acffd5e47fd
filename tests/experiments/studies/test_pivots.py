"""Pivots matched or not: the committed rows of one pair are what the code gives."""

import pandas as pd

from experiments.store import RESULTS
from experiments.studies import pivots

TABLE = pd.read_csv(RESULTS / "pivots.csv")


def test_the_committed_rows_are_what_the_code_gives() -> None:
    found = pivots.table(pivots.work("ell_to_two_loops"))
    rows = TABLE[TABLE.pair == "ell_to_two_loops"].reset_index(drop=True)
    exact = ["pair", "n", "match", "crossings", "flips", "AR_1e-4"]
    pd.testing.assert_frame_equal(found[exact], rows[exact], check_dtype=False)


def test_no_way_to_match_has_fewer_crossings_than_the_fewest() -> None:
    crossings = TABLE.pivot(index="pair", columns="match", values="crossings")
    assert (crossings["fewest crossings"] == crossings.min(axis=1)).all()
