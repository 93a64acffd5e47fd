"""The studies: what they keep, what they resume, and that results/ is what the code gives."""

import json
from pathlib import Path

import joblib
import numpy as np
import pandas as pd
import pytest

from experiments import store, table1
from tween import Triangulation, decompose, remesh

TABLE = store.RESULTS / "table1.csv"


def test_a_percentile_counts_ties_half() -> None:
    assert table1.percentile(2.0, np.array([1.0, 2.0, 2.0, 3.0])) == 0.5
    assert table1.percentile(0.0, np.array([1.0, 2.0])) == 0.0
    assert table1.percentile(9.0, np.array([1.0, 2.0])) == 1.0


def test_a_failed_write_leaves_the_old_file_and_no_other(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    path = tmp_path / "table.csv"
    store.write_text(path, "old")

    def fail(*_: object) -> None:
        raise OSError("disk full")

    monkeypatch.setattr(store.os, "replace", fail)
    with pytest.raises(OSError, match="disk full"):
        store.write_text(path, "new")
    assert path.read_text() == "old"
    assert list(tmp_path.iterdir()) == [path]


def test_an_interrupted_study_computes_only_what_is_left(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(store, "ROOT", tmp_path)
    done: list[str] = []

    def work(part: str) -> str:
        done.append(part)
        if done == ["a", "b"]:
            raise KeyboardInterrupt
        return part.upper()

    with joblib.parallel_config(backend="sequential"):
        with pytest.raises(KeyboardInterrupt):
            store.compute("test", {"seed": 1}, ["a", "b", "c"], work)
        assert store.Checkpoint("test", {"seed": 1}).load("a") == "A"
        assert store.Checkpoint("test", {"seed": 2}).load("a") is None
        assert store.compute("test", {"seed": 1}, ["a", "b", "c"], work) == ["A", "B", "C"]
    assert done == ["a", "b", "b", "c"]
    assert store.Checkpoint("test", {"seed": 1}).load("a") is None


def test_every_name_has_a_generator_of_its_own() -> None:
    draws = {store.rng_for(1, name).random() for name in table1.shapes()}
    assert len(draws) == len(table1.shapes())
    assert store.rng_for(1, "ell").random() == store.rng_for(1, "ell").random()


@pytest.mark.parametrize("name", ["ell", "horseshoe", "letter e"])
def test_the_committed_table_is_what_the_code_gives(name: str) -> None:
    table = pd.read_csv(TABLE).set_index(["curve", "path", "triangulation"])
    remeshed = remesh(decompose(table1.shape(name)).arbitrary())
    for path in table1.PARAMETERS["paths"]:
        *ranks, variance = table1.measure(remeshed, remeshed.on_disk().points, path)
        row = table.loc[(name, path, "remeshed")]
        assert row["AR_1e-4"] == ranks[0]
        assert row["Var"] == pytest.approx(variance, rel=1e-3)


def test_the_committed_table_is_complete() -> None:
    table, meta = pd.read_csv(TABLE), json.loads(TABLE.with_suffix(".json").read_text())
    assert list(dict.fromkeys(table["curve"])) == list(table1.shapes())
    assert (table["kind"] == "letter").groupby(table["curve"]).first().sum() >= 12
    assert meta["parameters"] == table1.PARAMETERS
    assert table.groupby(["curve", "path"]).size().unique().tolist() == [3 + len(table1.QUANTILES)]
    for histograms in meta["uniform"].values():
        for histogram in histograms.values():
            assert sum(histogram["AR_1e-4"].values()) == table1.PARAMETERS["samples"]


def test_quantiles_of_the_uniform_samples_are_ordered() -> None:
    table = pd.read_csv(TABLE)
    order = [f"uniform_{q}" for q in table1.QUANTILES]
    for measure in table1.MEASURES:
        wide = table.pivot(index=["curve", "path"], columns="triangulation", values=measure)[order]
        assert (wide.diff(axis=1).iloc[:, 1:] >= 0).all(axis=None)


def test_a_study_of_few_samples_gives_the_same_rows_twice() -> None:
    first, second = (table1.study("ell", 5) for _ in range(2))
    assert table1.table([first]).equals(table1.table([second]))


def test_the_morph_that_is_measured_leads_to_the_disk_of_equal_area() -> None:
    remeshed = remesh(decompose(table1.shape("ell")).arbitrary())
    disk = Triangulation(remeshed.on_disk().points, remeshed.triangles)
    assert disk.areas.sum() == pytest.approx(remeshed.areas.sum(), rel=0.02)
