"""Everything: studies, figures, animations, notebooks, report; says what it does and how long each step took.

Two steps run side by side, each as soon as those are done whose results it reads, so that no core is idle while one
of them starts, ends, or has a part that cannot be divided; of those that can begin, the longest does.  Studies share
the cores: on two, each runs in one process, since two more would load all packages and kernels for themselves.  What
is made of them later may have all the cores, as much of it waits for what runs alone.  The times go to
.cache/reproduce_times.json, for the report: they are no results.
"""

import os
import subprocess
import sys
import time
from time import perf_counter
from typing import NamedTuple

from experiments.catalogue import STEPS, STUDIES, Step
from experiments.store import ROOT, write_json

TIMES = ROOT / ".cache" / "reproduce_times.json"
SIDE_BY_SIDE = 2


class Running(NamedTuple):
    """A step, the process that it runs in, when that was started, and its line of the terminal."""

    step: Step
    process: "subprocess.Popen[bytes]"
    start: float
    line: int


def begin(step: Step, line: int) -> Running:
    """Start a step in a process of its own."""
    environment = dict(os.environ) | {"TQDM_POSITION": str(line)}
    if step in STUDIES:
        jobs = max(1, (os.cpu_count() or 1) // SIDE_BY_SIDE)
        # libraries of linear algebra would take all cores, too, where joblib starts no processes that hold them back
        environment |= {"LOKY_MAX_CPU_COUNT": str(jobs), "OPENBLAS_NUM_THREADS": "1", "OMP_NUM_THREADS": "1"}
    if step.name == "notebooks":  # with any other backend a notebook's figures would silently be lost
        environment["MPLBACKEND"] = "module://matplotlib_inline.backend_inline"
    process = subprocess.Popen([sys.executable, "-m", f"experiments.{step.module}"], cwd=ROOT, env=environment)
    return Running(step, process, perf_counter(), line)


def begin_what_can(waiting: list[Step], running: list[Running]) -> None:
    """Start steps that wait for no other, the longest first, as long as there is a free line."""
    unfinished = {step.module for step in waiting} | {one.step.module for one in running}
    can = [step for step in waiting if unfinished.isdisjoint(step.after)]
    for step in sorted(can, key=lambda step: -step.seconds):
        free = set(range(SIDE_BY_SIDE)) - {one.line for one in running}
        if free:
            waiting.remove(step)
            print(
                f"reproduce: {len(STEPS) - len(waiting)} of {len(STEPS)}, {step.title} (about {step.seconds} s)",
                flush=True,
            )
            running.append(begin(step, min(free)))


def next_finished(running: list[Running]) -> Running:
    """Wait for a step and take it from those that run; where it failed, wait for the others and give up."""
    while True:
        for one in running:
            if one.process.poll() is not None:
                running.remove(one)
                if one.process.returncode:
                    print(
                        f"reproduce: {one.step.module} failed; what was finished is kept, and the next run goes on",
                        file=sys.stderr,
                    )
                    while running:
                        running.pop().process.wait()
                    sys.exit(one.process.returncode)
                return one
        time.sleep(0.1)


def run_all() -> list[dict[str, str | float]]:
    """Run every step; returns the time of each, in the order of the catalogue."""
    waiting, running, seconds = list(STEPS), list[Running](), dict[str, float]()
    times: list[dict[str, str | float]] = []
    try:
        while waiting or running:
            begin_what_can(waiting, running)
            one = next_finished(running)
            seconds[one.step.title] = round(perf_counter() - one.start, 1)
            times = [{"step": s.title, "seconds": seconds[s.title]} for s in STEPS if s.title in seconds]
            write_json(TIMES, times)
    finally:
        for one in running:  # none, but after an interrupt
            one.process.terminate()
    return times


def main() -> None:
    start = perf_counter()
    run_all()
    print(f"reproduce: done in {(perf_counter() - start) / 60:.1f} minutes")
    print(f"reproduce: read {(ROOT / 'results' / 'report.html').relative_to(ROOT)}; the story is in notebooks/")


if __name__ == "__main__":
    try:
        main()
    except KeyboardInterrupt:
        print("reproduce: interrupted; what was finished is kept, and the next run goes on", file=sys.stderr)
        sys.exit(130)
