"""The law of Table 1: fits find what is there, the committed tables follow from the grid, and the law is one."""

import numpy as np
import pandas as pd
import pytest

from experiments.store import RESULTS
from experiments.studies import grid_law

DISK, SHAPES, PAIRS = (pd.read_csv(RESULTS / f"grid_{name}.csv") for name in ("disk", "shapes", "pairs"))
LAWS = pd.read_csv(RESULTS / "grid_law.csv")


def test_a_law_is_found_where_there_is_one() -> None:
    x = np.arange(30.0)
    law = grid_law.fitted(x, 3 * (1 + x) ** 0.6)
    assert law == pytest.approx((3, 0.6))
    assert grid_law.predicted(law, np.array([7.0])) == pytest.approx(3 * 8**0.6)


def test_half_of_the_curves_are_kept_for_judging() -> None:
    names = list(SHAPES.curve.unique())
    half = grid_law.fitting_half(names)
    assert len(half) == len(names) // 2 and half < set(names)
    assert half == grid_law.fitting_half(names)


def test_the_committed_cells_are_those_of_the_grid() -> None:
    every = grid_law.cells(PAIRS)
    columns = pd.read_csv(RESULTS / "grid_columns.csv")
    pd.testing.assert_frame_equal(grid_law.by_column(every), columns, check_dtype=False)
    kept = every[(every.both > 0) | (every.factor > 0)].reset_index(drop=True)
    pd.testing.assert_frame_equal(kept, pd.read_csv(RESULTS / "grid_cells.csv"), check_dtype=False)


def test_the_committed_law_of_slides_is_what_the_code_gives() -> None:
    rows = grid_law.ranks_and_counts(DISK, SHAPES)
    some = rows[(rows.path == "slide") & (rows.pace == "time") & (rows.n == 96)]
    found = grid_law.judged(some, "AR_1e-9", "slides", grid_law.fitting_half(list(SHAPES.curve.unique())))
    committed = LAWS.query("path == 'slide' and pace == 'time' and n == 96 and rank == 'AR_1e-9' and law == 'slides'")
    for name in ("scale", "power", "factor_error", "direction"):
        assert float(found[name]) == pytest.approx(committed[name].item(), abs=6e-4)


def test_along_slide_the_number_of_slides_predicts_the_factor_and_along_linear_the_height_does_not() -> None:
    at = LAWS.query("pace == 'time' and n == 96").set_index(["path", "rank", "law"])
    slides, height = at.loc[("slide", "AR_1e-9", "slides")], at.loc[("linear", "AR_1e-9", "height")]
    assert slides.factor_error < slides.without_law / 3 and slides.direction > 0.9
    assert height.factor_error > 0.9 * height.without_law


def test_cells_within_a_fifth_of_the_paper_are_marked() -> None:
    every = grid_law.cells(PAIRS)
    row = every[every.row == 1]
    assert ((row.both == 1) == (((row.X / 7 - 1).abs() <= 0.2) & ((row.Y / 31 - 1).abs() <= 0.2))).all()
    assert 0 < row.both.sum() < len(row)
