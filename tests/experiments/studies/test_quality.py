"""Does the measure measure quality: correlations on tables that are known, the search, and the committed results."""

import numpy as np
import pandas as pd
import pytest

from experiments import subjects
from experiments.measures import MEASURES
from experiments.store import RESULTS
from experiments.studies import quality
from tween import decompose, gallery, remesh

ROWS = pd.read_csv(RESULTS / "matching.csv")
TABLE = pd.read_csv(RESULTS / "quality.csv")
SEARCH = pd.read_csv(RESULTS / "quality_search.csv")


def test_a_measure_that_ranks_methods_as_a_quality_does_goes_with_it() -> None:
    one = pd.DataFrame({"source": "a", "target": "b", "disks": [61, 60, 50, 0], "Var": [1e-9, 1e-6, 1e-3, 1.0]})
    assert quality.within_pairs(one, "Var", "invalid").tolist() == pytest.approx([1.0])
    assert quality.within_pairs(one.assign(Var=-one.Var), "Var", "invalid").tolist() == pytest.approx([-1.0])
    assert quality.within_pairs(one.assign(disks=61), "Var", "invalid").empty


def test_weights_count_rows_as_often_as_they_say() -> None:
    rng = np.random.default_rng(0)
    values, times = rng.random((9, 2)), rng.integers(0, 4, 9)
    found = quality.weighted_correlation(values, times[:, None].astype(float))
    assert found == pytest.approx(np.corrcoef(np.repeat(values, times, axis=0).T)[0, 1])


def test_a_search_goes_down_to_where_no_flip_improves() -> None:
    T = decompose(gallery.curve("horseshoe")).arbitrary()

    def fewest_obtuse(S: quality.Triangulation) -> tuple[float, float]:
        return (-float(np.sort(S.areas)[0]), float(np.abs(S.triangles[:, 0] - S.triangles[:, 1]).sum()))

    found, looked_at = quality.descend(T, fewest_obtuse, np.random.default_rng(0), 4000)
    assert 0 < looked_at < 4000
    assert fewest_obtuse(found) < fewest_obtuse(T)
    flips = [quality.flip(found, tuple(d)) for d in found.diagonals[quality.flippable(found)].tolist()]
    assert min(map(fewest_obtuse, flips)) >= fewest_obtuse(found)
    assert quality.descend(T, fewest_obtuse, np.random.default_rng(0), 5)[1] == 5


def test_what_differs_by_rounding_ties_and_the_first_is_taken() -> None:
    tied = [(3.0, 2e-6), (3.0, 2e-6 * (1 - 1e-12)), (4.0, 1e-9), (3.0, 2e-6 * (1 + 1e-12))]
    assert quality.lowest(tied) == 0
    assert not any(quality.lower(value, tied[0]) for value in tied)
    assert quality.lowest([*tied, (3.0, 1.9e-6)]) == 4
    assert quality.lowest([*tied, (2.0, 1.0)]) == 4


def test_the_remeshed_row_is_what_the_code_gives() -> None:
    name = quality.curves()[0]
    T = remesh(decompose(subjects.shape(name)).arbitrary())
    row = SEARCH[(SEARCH.curve == name) & (SEARCH.triangulation == "remeshed")].iloc[0]
    assert quality.to_the_disk(T, T.on_disk().points) == pytest.approx(row[MEASURES].tolist(), rel=6e-3)


def test_the_committed_correlations_of_pairs_are_those_of_the_committed_morphs() -> None:
    own = TABLE[TABLE.scope == "methods of one pair"].set_index(["measure", "quality"])
    for measure, what in own.index:
        assert own.loc[(measure, what), "rho"] == pytest.approx(
            quality.within_pairs(ROWS, measure, what).median(), rel=6e-3
        )


def test_a_search_never_ends_above_its_start() -> None:
    for _, of in SEARCH.groupby("curve"):
        by = of.set_index("triangulation")
        for objective, column in (("AR", "AR_1e-4"), ("Var", "Var")):
            assert (
                by.loc[f"{objective}, search from best random", column] <= by.loc[f"{objective}, best random", column]
            )
            assert by.loc[f"{objective}, search from remeshed", column] <= by.loc["remeshed", column]
