"""What studies keep and resume, and that any backend of joblib's takes them: threads, processes, a cluster."""

import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import joblib
import pytest

import tween
from experiments import store
from experiments.store import compute
from experiments.subjects import shapes
from tween import decompose, gallery


@pytest.fixture
def work() -> Callable[[str], int]:
    """Return a function that goes to a worker whole, as none can import a test; what comes back must be JSON."""

    def immersions(name: str) -> int:
        return len(decompose(gallery.curve(name)).immersions())

    return immersions


NAMES = ["ell", "two_disks", "five_disks", "horseshoe"]
EXPECTED = [1, 2, 5, 1]
SQUARE = [(0, 0), (1, 0), (1, 1), (0, 1)]


@pytest.fixture(autouse=True)
def own_checkpoints(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(store, "ROOT", tmp_path)


@pytest.mark.parametrize("backend", ["sequential", "threading", "loky"])
def test_backends_of_joblib_give_the_same_results_in_the_same_order(backend: str, work: Callable[[str], int]) -> None:
    with joblib.parallel_config(backend=backend):
        assert compute("backends", {"backend": backend}, NAMES, work) == EXPECTED


def test_the_package_itself_can_be_sent_to_workers() -> None:
    count = joblib.Parallel(n_jobs=2)(joblib.delayed(lambda name: len(tween.Curve(SQUARE)))(name) for name in "ab")
    assert count == [4, 4]


def test_so_does_a_dask_cluster(work: Callable[[str], int]) -> None:
    distributed = pytest.importorskip("distributed", reason="needs the extra 'cluster': pip install '.[cluster]'")
    with (
        distributed.LocalCluster(
            n_workers=2, threads_per_worker=1, dashboard_address=None, host="127.0.0.1"
        ) as cluster,
        distributed.Client(cluster),
        joblib.parallel_config(backend="dask"),
    ):
        assert compute("backends", {"backend": "dask"}, NAMES, work) == EXPECTED


# What is kept


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


def test_an_interrupted_study_computes_only_what_is_left() -> None:
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
    draws = {store.rng_for(1, name).random() for name in shapes()}
    assert len(draws) == len(shapes())
    assert store.rng_for(1, "ell").random() == store.rng_for(1, "ell").random()


def test_a_change_in_any_folder_of_the_code_starts_a_study_anew(tmp_path: Path) -> None:
    for folder in ("tween/deep/deeper", "experiments/studies"):
        (tmp_path / folder).mkdir(parents=True)
        store.Checkpoint("test", {}).save("a", 1)
        (tmp_path / folder / "new.py").write_text("x = 1")
        assert store.Checkpoint("test", {}).load("a") is None


# One run at a time

RUN = """
import sys
from pathlib import Path
from experiments import store
store.ROOT = Path(sys.argv[1])
with store.alone("study"):
    print("in", flush=True)
    if sys.argv[2] == "hold":
        sys.stdin.readline()
    print("out", flush=True)
"""


def run(folder: Path, what: str) -> "subprocess.Popen[str]":
    root, pipe = Path(store.__file__).resolve().parent.parent, subprocess.PIPE
    return subprocess.Popen(
        [sys.executable, "-c", RUN, str(folder), what], stdin=pipe, stdout=pipe, text=True, cwd=root
    )


def test_a_second_run_of_a_study_says_so_and_waits_until_the_first_is_done(tmp_path: Path) -> None:
    with run(tmp_path, "hold") as first:
        assert first.stdout is not None and first.stdin is not None
        assert first.stdout.readline() == "in\n"
        with run(tmp_path, "leave") as second:
            assert second.stdout is not None
            assert second.stdout.readline() == f"study: process {first.pid} is at it; waiting until it is done\n"
            assert first.poll() is None
            first.stdin.write("\n")
            first.stdin.flush()
            assert second.stdout.read() == "in\nout\n"
            assert first.stdout.read() == "out\n"


def test_a_run_that_was_killed_holds_no_lock(tmp_path: Path) -> None:
    with run(tmp_path, "hold") as first:
        assert first.stdout is not None and first.stdout.readline() == "in\n"
        first.kill()
        first.wait()
        with run(tmp_path, "leave") as second:
            assert second.communicate()[0] == "in\nout\n"


def test_different_studies_do_not_wait_for_each_other() -> None:
    with store.alone("one"), store.alone("other"):
        pass
