"""Matching, a sample again: are the committed rows of results/matching.csv what the code gives?

The study of all pairs takes long, so `reproduce` recomputes 24 of them, drawn with the seed, and stops where a
number differs beyond its rounding: one unit of the last digit written, and one for a rank, where a singular value
may lie just at the tolerance.  What sums the rows up is compared as a whole.  Writes nothing.
"""

import pandas as pd

from experiments import subjects
from experiments.measures import RANKS
from experiments.store import RESULTS, compute, rng_for
from experiments.studies import matching

SAMPLE = 24
KEYS = ["source", "target", "method"]
NUMBERS = [column for column in matching.COLUMNS if column not in KEYS]


def sample() -> list[str]:
    """The pairs that are recomputed, in the order of all pairs."""
    pairs = subjects.pairs()
    chosen = rng_for(matching.PARAMETERS["seed"], "matching, sample").choice(len(pairs), SAMPLE, replace=False)
    return [pairs[i] for i in sorted(chosen.tolist())]


def differences(found: pd.DataFrame, committed: pd.DataFrame) -> list[str]:
    """Every number that differs beyond its rounding, and every row that only one of the two tables has."""
    both = found.merge(committed, on=KEYS, how="outer", suffixes=("", " committed"), indicator="where")
    sides = {"left_only": "new", "right_only": "committed"}
    alone = both[both["where"] != "both"]
    told = [f"{_name(row)}: only in the {sides[row['where']]} table" for _, row in alone.iterrows()]
    both = both[both["where"] == "both"]
    for column in NUMBERS:
        new, old = both[column].astype(float), both[f"{column} committed"].astype(float)
        agree = ((new - old).abs() <= _allowance(column, old)) | (new.isna() & old.isna())
        told += [
            f"{_name(row)}: {column} is {row[column]}, committed {row[f'{column} committed']}"
            for _, row in both[~agree].iterrows()
        ]
    return told


def _allowance(column: str, committed: pd.Series) -> pd.Series:
    """How far a number may lie from the committed one."""
    if column in RANKS:
        return committed * 0 + 1
    if column in ("n", "guaranteed", "flips", "disks"):
        return committed * 0
    return committed.abs() * 1.01 * 10.0 ** (1 - matching.PARAMETERS["digits"])


def _name(row: pd.Series) -> str:
    return ", ".join(row[KEYS])


def main() -> None:
    committed = pd.read_csv(RESULTS / "matching.csv")
    names = sample()
    rows = [row for part in compute("matching_sample", matching.PARAMETERS, names, matching.work) for row in part]
    mine = (committed.source + subjects.BETWEEN + committed.target).isin(names)
    told = differences(matching.table(rows), committed[mine])
    of_all = pd.read_csv(RESULTS / "matching_summary.csv")
    if not matching.summary(committed).equals(of_all):
        told.append("matching_summary.csv does not sum up matching.csv")
    if told:
        raise SystemExit("\n".join(["matching_sample: committed results are not what the code gives", *told]))
    print(f"matching_sample: {len(names)} pairs give the committed rows of results/matching.csv")


if __name__ == "__main__":
    main()
