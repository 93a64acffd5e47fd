"""Everything in order: studies, figures, animations, notebooks, report; says what it does and how long each step took.

The times go to .cache/reproduce_times.json, for the report: they are no results.
"""

import os
import subprocess
import sys
from time import perf_counter

from experiments.store import ROOT, write_json

TIMES = ROOT / ".cache" / "reproduce_times.json"
STEPS = {
    "table1": "Table 1, every curve to the disk",
    "figure11": "Table 1, the paper's four columns",
    "sensitivity": "what the verdict on Table 1 depends on",
    "table1_formats": "Table 1 in the paper's layout",
    "pairs": "every pair of curves",
    "pivots": "pivots matched or not",
    "flips": "flip sequences beside the flip distance",
    "roots": "every root triangle",
    "guarantee": "the guarantee, and what others use",
    "claims": "the verdict on every claim",
    "figures": "figures",
    "animations": "animations",
    "notebooks": "notebooks",
    "report": "the report",
}


def run(module: str) -> float:
    """Run a module of this package in a process of its own; returns how many seconds it took."""
    environment = dict(os.environ)
    if module == "notebooks":  # with any other backend a notebook's figures would silently be lost
        environment["MPLBACKEND"] = "module://matplotlib_inline.backend_inline"
    start = perf_counter()
    finished = subprocess.run([sys.executable, "-m", f"experiments.{module}"], cwd=ROOT, env=environment)
    if finished.returncode:
        print(f"reproduce: {module} failed; what was finished is kept, and the next run goes on", file=sys.stderr)
        sys.exit(finished.returncode)
    return perf_counter() - start


def main() -> None:
    times: list[dict[str, str | float]] = []
    spent = 0.0
    for number, (module, what) in enumerate(STEPS.items(), start=1):
        print(f"reproduce: {number} of {len(STEPS)}, {what}", flush=True)
        seconds = run(module)
        spent += seconds
        times.append({"step": what, "seconds": round(seconds, 1)})
        write_json(TIMES, times)
    print(f"reproduce: done in {spent / 60:.1f} minutes")
    print(f"reproduce: read {(ROOT / 'results' / 'report.html').relative_to(ROOT)}; the story is in notebooks/")


if __name__ == "__main__":
    try:
        main()
    except KeyboardInterrupt:
        print("reproduce: interrupted; what was finished is kept, and the next run goes on", file=sys.stderr)
        sys.exit(130)
