"""Table 1, every curve to its disk: the committed table is complete, and what the code gives."""

import json

import pandas as pd
import pytest

from experiments.measures import MEASURES, PARAMETERS, QUANTILES, areas_to_disk, measures
from experiments.store import RESULTS
from experiments.studies import to_disk
from experiments.subjects import shape, shapes
from tween import Triangulation, decompose, remesh

TABLE = RESULTS / "table_1_to_disk.csv"


@pytest.mark.parametrize("name", ["ell", "horseshoe", "letter e"])
def test_the_committed_table_is_what_the_code_gives(name: str) -> None:
    table = pd.read_csv(TABLE).set_index(["curve", "path", "triangulation"])
    remeshed = remesh(decompose(shape(name)).arbitrary())
    for path in PARAMETERS["paths"]:
        *ranks, variance = measures(areas_to_disk(remeshed, remeshed.on_disk().points, path))
        row = table.loc[(name, path, "remeshed")]
        assert row["AR_1e-4"] == ranks[0]
        assert row["Var"] == pytest.approx(variance, rel=1e-3)


def test_the_committed_table_is_complete() -> None:
    table, meta = pd.read_csv(TABLE), json.loads(TABLE.with_suffix(".json").read_text())
    assert list(dict.fromkeys(table["curve"])) == list(shapes())
    assert (table["kind"] == "letter").groupby(table["curve"]).first().sum() >= 12
    assert meta["parameters"] == PARAMETERS
    assert table.groupby(["curve", "path"]).size().unique().tolist() == [3 + len(QUANTILES)]
    for histograms in meta["uniform"].values():
        for histogram in histograms.values():
            assert sum(histogram["AR_1e-4"].values()) == PARAMETERS["samples"]


def test_quantiles_of_the_uniform_samples_are_ordered() -> None:
    table = pd.read_csv(TABLE)
    order = [f"uniform_{q}" for q in QUANTILES]
    for measure in MEASURES:
        wide = table.pivot(index=["curve", "path"], columns="triangulation", values=measure)[order]
        assert (wide.diff(axis=1).iloc[:, 1:] >= 0).all(axis=None)


def test_a_study_of_few_samples_gives_the_same_rows_twice() -> None:
    first, second = (to_disk.study("ell", 5) for _ in range(2))
    assert to_disk.table([first]).equals(to_disk.table([second]))


def test_the_morph_that_is_measured_leads_to_the_disk_of_equal_area() -> None:
    remeshed = remesh(decompose(shape("ell")).arbitrary())
    disk = Triangulation(remeshed.on_disk().points, remeshed.triangles)
    assert disk.areas.sum() == pytest.approx(remeshed.areas.sum(), rel=0.02)
