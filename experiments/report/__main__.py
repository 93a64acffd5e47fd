"""Write the page."""

import sys
from pathlib import Path

from experiments.report.page import MissingResultsError, page
from experiments.report.tables import key_tables
from experiments.store import RESULTS, write_text


def main(results: Path = RESULTS) -> int:
    try:
        text = page(results)
    except MissingResultsError as error:
        print(f"report: {error}", file=sys.stderr)
        return 1
    target = results / "report.html"
    write_text(target, text)
    absent = [study.name for study in key_tables(results) if study.table is None]
    if absent:
        print(f"report: not yet run, so left out: {', '.join(absent)}")
    print(f"report: {len(text.encode()) / 1e6:.1f} MB, open {target}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
