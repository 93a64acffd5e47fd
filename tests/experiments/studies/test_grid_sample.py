"""The sample of the grid: always the same, and a changed number is told."""

import pandas as pd
import pytest

from experiments.store import RESULTS
from experiments.studies import grid, grid_sample

TABLES = {name: pd.read_csv(RESULTS / f"grid_{name}.csv") for name in grid_sample.KEYS}


def test_the_sample_is_part_of_the_grid_and_always_the_same() -> None:
    sample = grid_sample.sample()
    assert sample == grid_sample.sample() and set(sample) <= set(grid.parts())
    assert len(sample) == grid_sample.CURVES + grid_sample.PAIRS == len(set(sample))


@pytest.mark.parametrize("name", list(TABLES))
def test_committed_rows_agree_with_themselves(name: str) -> None:
    assert grid_sample.differences(name, TABLES[name], TABLES[name]) == []


@pytest.mark.parametrize(
    ("name", "column", "change"),
    [("disk", "AR_1e-6", 2), ("disk", "Var", 0.1), ("pairs", "flips", 1), ("shapes", "slides_remeshed", 1)],
)
def test_a_changed_number_is_told(name: str, column: str, change: float) -> None:
    changed = TABLES[name].copy()
    changed[column] = changed[column].astype(float)
    changed.loc[7, column] += change
    told = grid_sample.differences(name, TABLES[name], changed)
    assert len(told) == 1 and f"{column} is" in told[0]


def test_a_row_that_the_committed_table_has_not_is_told() -> None:
    assert (
        "not in grid_disk.csv" in grid_sample.differences("disk", TABLES["disk"].iloc[:3], TABLES["disk"].iloc[1:])[0]
    )
