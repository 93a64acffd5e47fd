"""Where studies keep their results: whole files or none, and checkpoints of what is done so far."""

import hashlib
import json
import os
import shutil
import sys
import time
import zlib
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import IO, Any

import numpy as np
import pandas as pd
from joblib import Parallel, delayed
from tqdm import tqdm

if sys.platform == "win32":
    import msvcrt
else:
    import fcntl

ROOT = Path(__file__).resolve().parent.parent
RESULTS = ROOT / "results"
FIGURES = RESULTS / "figures"

_BEYOND_THE_TEXT = 2**20  # the byte that is locked on Windows, where nobody can read what is locked


@contextmanager
def replacing(path: Path) -> Iterator[Path]:
    """Offer a file beside the path to write to, then rename it: nobody ever meets half a file."""
    path.parent.mkdir(parents=True, exist_ok=True)
    temporary = path.with_name(f".{os.getpid()}.{path.name}")
    try:
        yield temporary
        os.replace(temporary, path)
    finally:
        temporary.unlink(missing_ok=True)


def write_text(path: Path, text: str) -> None:
    with replacing(path) as temporary:
        temporary.write_text(text, encoding="utf-8", newline="\n")


def write_csv(path: Path, table: pd.DataFrame) -> None:
    write_text(path, table.to_csv(index=False, lineterminator="\n"))


def write_json(path: Path, content: Any) -> None:
    write_text(path, json.dumps(content, indent=1) + "\n")


def save_figure(figure: Any, name: str) -> Path:
    """Save as PNG and as PDF without the metadata that would change their bytes; returns the path of the PNG."""
    png, pdf = FIGURES / f"{name}.png", FIGURES / f"{name}.pdf"
    with replacing(png) as temporary:
        figure.savefig(temporary, format="png", metadata={"Software": None})
    with replacing(pdf) as temporary:
        figure.savefig(temporary, format="pdf", metadata={"Creator": None, "Producer": None, "CreationDate": None})
    return png


def rng_for(seed: int, name: str) -> np.random.Generator:
    """A generator for each name, so that the order of work does not matter."""
    return np.random.default_rng([seed, zlib.crc32(name.encode())])


@contextmanager
def alone(study: str) -> Iterator[None]:
    """Hold a study's lock; where another run holds it, say so and wait until that run is done or has died.

    The system lets go of the lock of a process that ends, however it ends, so none is ever stale.  The file tells
    the holder's number; it stays, as removing it would let a third run lock another file of the same name.
    """
    path = ROOT / ".cache" / "studies" / f"{study}.lock"
    path.parent.mkdir(parents=True, exist_ok=True)
    with open(path, "a+", encoding="utf-8") as file:
        if not _lock(file, wait=False):
            file.seek(0)
            print(f"{study}: process {file.read().strip() or 'unknown'} is at it; waiting until it is done", flush=True)
            _lock(file, wait=True)
        file.truncate(0)
        file.write(f"{os.getpid()}\n")
        file.flush()
        yield


def _lock(file: IO[str], wait: bool) -> bool:
    """Lock a file, or return False where it is locked already and one does not wait; closing it unlocks."""
    try:
        if sys.platform == "win32":
            file.seek(_BEYOND_THE_TEXT)
            msvcrt.locking(file.fileno(), msvcrt.LK_NBLCK, 1)
        else:
            fcntl.flock(file, fcntl.LOCK_EX | (0 if wait else fcntl.LOCK_NB))
    except OSError:
        if not wait:
            return False
        time.sleep(1)
        return _lock(file, wait)
    return True


class Checkpoint:
    """Finished parts of a study, kept until the whole is done.

    The parts are kept under a key of the parameters and of every line of code in tween and
    experiments: what another version of the code computed is never taken up.
    """

    def __init__(self, study: str, parameters: dict[str, Any]) -> None:
        digest = hashlib.sha256(json.dumps(parameters, sort_keys=True).encode())
        for folder in ("tween", "experiments"):
            for source in sorted((ROOT / folder).rglob("*.py")):
                digest.update(source.read_bytes())
        self._study = ROOT / ".cache" / "studies" / study
        self._folder = self._study / digest.hexdigest()[:16]

    def _path(self, part: str) -> Path:
        return self._folder / f"{part.encode().hex()}.json"

    def load(self, part: str) -> Any | None:
        path = self._path(part)
        return json.loads(path.read_text(encoding="utf-8")) if path.exists() else None

    def save(self, part: str, content: Any) -> None:
        write_json(self._path(part), content)

    def clear(self) -> None:
        """Forget all parts, older versions' too."""
        shutil.rmtree(self._study, ignore_errors=True)


def compute(study: str, parameters: dict[str, Any], parts: Sequence[str], work: Callable[[str], Any]) -> list[Any]:
    """Work on the parts of a study on all cores, and return what they give, in their order.

    What is finished is kept, and after an interruption only the rest is computed; once the whole is
    done nothing is kept, so that a study that is run again is computed again.  One run at a time: see `alone`.
    """
    with alone(study):
        return _compute(study, parameters, parts, work)


def _compute(study: str, parameters: dict[str, Any], parts: Sequence[str], work: Callable[[str], Any]) -> list[Any]:
    checkpoint = Checkpoint(study, parameters)
    todo = [part for part in parts if checkpoint.load(part) is None]
    if len(todo) < len(parts):
        print(f"{study}: {len(parts) - len(todo)} of {len(parts)} parts were finished before; going on with the rest")
    finished = Parallel(n_jobs=-1, return_as="generator_unordered")(delayed(_labelled)(work, part) for part in todo)
    for part, result in tqdm(finished, total=len(todo), desc=study, unit="part", disable=None):
        checkpoint.save(part, result)
    results = [checkpoint.load(part) for part in parts]
    checkpoint.clear()
    return results


def _labelled(work: Callable[[str], Any], part: str) -> tuple[str, Any]:
    return part, work(part)
