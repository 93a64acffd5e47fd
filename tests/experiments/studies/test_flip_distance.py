"""Flip distances by search: those of the pentagon are known."""

import pandas as pd

from experiments.store import RESULTS
from experiments.studies.flip_distance import distances, work
from experiments.subjects import flip_graph


def test_the_triangulations_of_the_pentagon_form_a_ring() -> None:
    _, neighbours = flip_graph(5)
    assert [sorted(distances(neighbours, start)) for start in range(5)] == [[0, 1, 1, 2, 2]] * 5


def test_the_committed_rows_are_what_the_code_gives() -> None:
    table = pd.read_csv(RESULTS / "flip_distance.csv")
    rows = pd.DataFrame([work(str(n)) for n in (4, 5, 6)]).round(4)
    pd.testing.assert_frame_equal(rows, table[table.n <= 6])
