"""Table 1, a sample of the grid again: are the committed rows of results/grid_*.csv what the code gives?

The grid takes long, so `reproduce` recomputes some of its parts, drawn with the seed, and stops where a number differs
beyond its rounding: one for a rank, where a singular value may lie at the edge of what counts as certain, and one unit
of the last digit written for the rest.  What is certain on one processor only is not compared.  Writes nothing.
"""

import argparse

import pandas as pd

from experiments.store import RESULTS, compute, rng_for
from experiments.studies import grid

CURVES, PAIRS = 16, 2  # parts that are recomputed, to the disk and from curve to curve
KEYS = {
    "disk": ["curve", "n", "path", "pace", "frames", "triangulation"],
    "pairs": ["row", "n", "path", "pace", "frames", "triangulation"],
    "shapes": ["curve", "n"],
}
EXACT = ("kind", "flips", "slides", "height", "deep")  # how names of columns start that have to be equal
ROUNDING = 0.011  # of three digits, relative


def sample() -> list[str]:
    """The parts that are recomputed, in the order of all parts."""
    rng, parts = rng_for(grid.PARAMETERS["seed"], "grid, sample"), grid.parts()
    pairs = [part.startswith(grid.PAIR) for part in parts]
    chosen = []
    for of_pairs, count in ((False, CURVES), (True, PAIRS)):
        some = [part for part, is_pair in zip(parts, pairs, strict=True) if is_pair == of_pairs]
        chosen += [some[i] for i in sorted(rng.choice(len(some), count, replace=False).tolist())]
    return chosen


def differences(name: str, found: pd.DataFrame, committed: pd.DataFrame) -> list[str]:
    """Every number of a table that differs beyond its rounding, and every row that the committed table has not."""
    if found.empty:
        return []
    keys = KEYS[name]
    both = found.merge(committed, on=keys, how="left", suffixes=("", " committed"), indicator="where")
    told = [f"{_name(row, keys)}: not in grid_{name}.csv" for _, row in both[both["where"] != "both"].iterrows()]
    both = both[both["where"] == "both"]
    for column in [column for column in found if column not in keys]:
        new, old = both[column], both[f"{column} committed"]
        if column.startswith(EXACT):
            agree = (new == old) | (new.isna() & old.isna())
        else:
            new, old = new.astype(float), old.astype(float)
            allowed = 1.0 if column in grid.RANKS else ROUNDING * old.abs()
            agree = ((new - old).abs() <= allowed) | new.isna() | old.isna()
        told += [
            f"{_name(row, keys)}: {column} is {row[column]}, committed {row[f'{column} committed']}"
            for _, row in both[~agree.astype(bool)].iterrows()
        ]
    return told


def _name(row: pd.Series, keys: list[str]) -> str:
    return ", ".join(str(row[key]) for key in keys)


def main() -> None:
    argparse.ArgumentParser(
        prog="python -m experiments.studies.grid_sample", description=__doc__.split("\n")[0]
    ).parse_args()
    names = sample()
    tables = grid.tables(compute("grid_sample", grid.PARAMETERS, names, grid.work))
    told = []
    for name, table in tables.items():
        told += differences(name, table, pd.read_csv(RESULTS / f"grid_{name}.csv"))
    if told:
        raise SystemExit("\n".join(["grid_sample: committed results are not what the code gives", *told]))
    print(f"grid_sample: {len(names)} parts give the committed rows of results/grid_*.csv")


if __name__ == "__main__":
    main()
