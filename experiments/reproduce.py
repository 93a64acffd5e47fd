"""Everything in order: studies, figures, animations, notebooks, report; says what it does and how long each step took.

The times go to .cache/reproduce_times.json, for the report: they are no results.
"""

import os
import subprocess
import sys
from time import perf_counter

from experiments.catalogue import STEPS, Step
from experiments.store import ROOT, write_json

TIMES = ROOT / ".cache" / "reproduce_times.json"


def run(step: Step) -> float:
    """Run a step in a process of its own; returns how many seconds it took."""
    environment = dict(os.environ)
    if step.name == "notebooks":  # with any other backend a notebook's figures would silently be lost
        environment["MPLBACKEND"] = "module://matplotlib_inline.backend_inline"
    start = perf_counter()
    finished = subprocess.run([sys.executable, "-m", f"experiments.{step.module}"], cwd=ROOT, env=environment)
    if finished.returncode:
        print(f"reproduce: {step.module} failed; what was finished is kept, and the next run goes on", file=sys.stderr)
        sys.exit(finished.returncode)
    return perf_counter() - start


def main() -> None:
    times: list[dict[str, str | float]] = []
    spent = 0.0
    for number, step in enumerate(STEPS, start=1):
        print(f"reproduce: {number} of {len(STEPS)}, {step.title} (about {step.seconds} s)", flush=True)
        seconds = run(step)
        spent += seconds
        times.append({"step": step.title, "seconds": round(seconds, 1)})
        write_json(TIMES, times)
    print(f"reproduce: done in {spent / 60:.1f} minutes")
    print(f"reproduce: read {(ROOT / 'results' / 'report.html').relative_to(ROOT)}; the story is in notebooks/")


if __name__ == "__main__":
    try:
        main()
    except KeyboardInterrupt:
        print("reproduce: interrupted; what was finished is kept, and the next run goes on", file=sys.stderr)
        sys.exit(130)
