"""A study runs through joblib, so any backend of joblib's takes it: threads, processes, a cluster."""

import pickle

import joblib
import pytest

import tween
from experiments import store
from experiments.store import compute
from tween import decompose, gallery


def work(name: str) -> int:
    """Count in a worker; what comes back must be JSON."""
    return len(decompose(gallery.curve(name)).immersions())


NAMES = ["ell", "two_disks", "five_disks", "horseshoe"]
EXPECTED = [1, 2, 5, 1]
SQUARE = [(0, 0), (1, 0), (1, 1), (0, 1)]


@pytest.fixture(autouse=True)
def own_checkpoints(tmp_path, monkeypatch) -> None:
    monkeypatch.setattr(store, "ROOT", tmp_path)


@pytest.mark.parametrize("backend", ["sequential", "threading", "loky"])
def test_backends_of_joblib_give_the_same_results_in_the_same_order(backend: str) -> None:
    with joblib.parallel_config(backend=backend):
        assert compute("backends", {"backend": backend}, NAMES, work) == EXPECTED


def test_the_package_itself_can_be_sent_to_workers() -> None:
    copy = pickle.loads(pickle.dumps(tween))
    assert copy is tween
    count = joblib.Parallel(n_jobs=2)(joblib.delayed(lambda name: len(tween.Curve(SQUARE)))(name) for name in "ab")
    assert count == [4, 4]


def test_so_does_a_dask_cluster() -> None:
    distributed = pytest.importorskip("distributed", reason="needs the extra 'cluster': pip install tween[cluster]")
    with (
        distributed.LocalCluster(
            n_workers=2, threads_per_worker=1, dashboard_address=None, host="127.0.0.1"
        ) as cluster,
        distributed.Client(cluster),
        joblib.parallel_config(backend="dask"),
    ):
        assert compute("backends", {"backend": "dask"}, NAMES, work) == EXPECTED
