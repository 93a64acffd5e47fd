"""Kernels compiled before they are needed, by doing once, on small curves, what people do."""

import multiprocessing
import os
import signal
import sys
import time
from collections.abc import Callable
from concurrent.futures import ProcessPoolExecutor, as_completed
from types import SimpleNamespace as Options

import click
import numpy as np

from tween import gallery
from tween.choices import PATHS
from tween.geometry.predicates import incircle
from tween.geometry.triangulation import Triangulation
from tween.measuring.certificate import certify, verify
from tween.measuring.find_triangles import find_triangles
from tween.measuring.metrics import area_matrix
from tween.measuring.playback import playback
from tween.morphing.matching.match import match
from tween.morphing.morph import Morph
from tween.morphing.strategy import morph, paper_morph
from tween.triangulating import costs
from tween.triangulating.compatibility import compatible_shift
from tween.triangulating.decomposition import decompose, triangulate
from tween.triangulating.flips import flippable, locally_delaunay
from tween.triangulating.repair.cleaning import clean

_SEVERAL_DISKS, _SMALL, _OTHER = "two_disks", "arrow", "ell"
_LARGE = 400  # vertices, enough for a curve to be reduced


def warmup(options: Options) -> int:
    """Compile all kernels, in several processes.

    Parameters
    ----------
    options : SimpleNamespace
        jobs.

    Returns
    -------
    int
        0.
    """
    start = time.monotonic()
    jobs = min(options.jobs or os.cpu_count() or 1, len(TASKS))
    context = multiprocessing.get_context("spawn")  # what was forked would share locks with the threads of numba
    with ProcessPoolExecutor(jobs, context, initializer=_leave_interrupts_to_the_parent) as workers:
        # workers are started by the first task, and hear what they heard at birth: an interrupt is not for them
        heard = signal.signal(signal.SIGINT, signal.SIG_IGN)
        tasks = [workers.submit(run, name) for name in TASKS]
        signal.signal(signal.SIGINT, heard)
        try:
            with click.progressbar(length=len(tasks), label="compiling kernels", file=sys.stderr) as bar:
                for task in as_completed(tasks):
                    task.result()  # or raise what went wrong there
                    bar.update(1)
        except BaseException:
            workers.shutdown(wait=False, cancel_futures=True)
            for process in multiprocessing.active_children():
                process.terminate()
            raise
    print(f"kernels are compiled, in {time.monotonic() - start:.0f} s; later runs find them in the cache")
    return 0


def _leave_interrupts_to_the_parent() -> None:
    signal.signal(signal.SIGINT, signal.SIG_IGN)


def run(name: str) -> None:
    """Do one of the tasks, compiling the kernels that it needs.

    Parameters
    ----------
    name : str
        One of `TASKS`.
    """
    TASKS[name]()


def _disk(name: str = _OTHER) -> Triangulation:
    return triangulate(gallery.curve(name))


def _to_disk() -> Morph:
    T = _disk()
    return morph(T, T.on_disk())


def _flipping() -> Morph:
    return paper_morph(_disk("ell"), _disk("two_loops"))


def _match() -> None:
    match(gallery.curve(_SMALL), gallery.curve(_OTHER), landmarks=[(0, 12)])
    morph(gallery.curve(_SMALL), gallery.curve(_OTHER))(0.5)


def _recognise() -> None:
    curve = gallery.curve(_SEVERAL_DISKS)
    answer = decompose(curve)
    _ = answer.count, decompose(gallery.curve("horseshoe")).count  # few, and more than doubles can tell apart
    answer.immersions()
    answer.sample(np.random.default_rng(0))
    answer.optimal(costs.edge_length(curve.points))
    answer.optimal(costs.smallest_angle(curve.points), "max")
    answer.optimal(costs.distortion(curve.points, curve.points * [2, 1]))
    answer.optimal(costs.conformal_distortion(curve.points, curve.points * [2, 1]))


def _reduce() -> None:
    for name in ("pretzel", "three_lobes"):
        answer = decompose(gallery.curve(name).insert_vertices(_LARGE))
        answer.arbitrary()
        answer.immersions()


def _follow_paths() -> None:
    T = _disk()
    for path in PATHS:
        for guarantee in (True, False):
            morph(T, T.on_disk(), path=path, guarantee=guarantee).frames(3)
    morph(*gallery.fan()).frames(3)  # needs angle budgets


def _flip() -> None:
    m = _flipping()
    m.frames(3)
    m.reversed().frames(3)
    paper_morph(_disk("ell"), _disk("two_loops"), shifts="all", order="partial").frames(3)
    morph(_disk("ell"), _disk("two_loops"), strategy="paper").frames(3)


def _align() -> None:
    T = _disk()
    compatible_shift(T, T.rolled(3))
    flippable(T)
    locally_delaunay(T)
    incircle([0, 0], [1, 0], [1, 1], [0, 1])
    morph(_disk("arrow"), _disk("convex"), strategy="common").frames(3)
    decompose(gallery.curve("ell"), gallery.curve("ell").points * [2, 1])


def _certify() -> None:
    m = _to_disk()
    certify(m, 3)
    shapes = playback(m).frames
    verify(shapes, find_triangles(shapes), between="linear")
    certify(_flipping(), 3)
    area_matrix(m, 3)


def _repair() -> None:
    outline = gallery.curve(_SMALL).insert_vertices(300).points
    clean(outline + np.random.default_rng(0).normal(0, 0.02, outline.shape))
    decompose([(0, -1), (3, 1), (6, -1), (6, 1), (3, -1), (0, 1)]).explain()


def _draw() -> None:
    from tween.choices import STYLES  # here, as they import matplotlib
    from tween.plot.film import record
    from tween.plot.pixels import picture

    m = _to_disk()
    for style in STYLES:
        picture(record(m, 2, size=64, style=style), 0)


TASKS: dict[str, Callable[[], None]] = {
    "match": _match,
    "recognise": _recognise,
    "follow paths": _follow_paths,
    "reduce": _reduce,
    "flip": _flip,
    "certify": _certify,
    "repair": _repair,
    "align": _align,
    "draw": _draw,
}
"""What people do, those first that take longest."""
