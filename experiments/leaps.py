"""How far shapes move within 1e-7 of a flip or an end: no jump that people could see.

Random morphs with a guarantee, of two kinds: *flips*, two random disks of equally many vertices, led through flips;
and *inserted*, random disks of different counts, so that vertices have to be inserted.  Every pair is morphed along
every path, and looked at beside each flip and both ends, at distances of 1e-13 to 1e-7 on either side.

    python -m experiments.leaps OUT.jsonl --seeds 0 1000

appends a line a morph; seeds that stand in the file already are passed over.  At the end it prints what the file
holds, for each kind and path.
"""

from typing import Any

import numpy as np
import pandas as pd

from experiments.seeds import asked, collected
from tween import Curve, Morph, gallery, morph
from tween.choices import PATHS, Strategy
from tween.errors import GuaranteeError

KINDS = ("flips", "inserted")
BESIDE = 10.0 ** -np.array([7.0, 8.0, 9.0, 10.0, 11.0, 12.0, 13.0])
FEWEST, MOST = 5, 15  # vertices


def ends(kind: str, seed: int) -> tuple[Curve, Curve, Strategy]:
    """Two curves, and the strategy by which to morph them: through flips, or else matched in half of the cases."""
    rng = np.random.default_rng([21, KINDS.index(kind), seed])
    n, m = (int(count) for count in rng.choice(np.arange(FEWEST, MOST), 2, replace=False))
    through: Strategy = "paper" if kind == "flips" or rng.random() < 0.5 else "matched"
    first, second = (gallery.random_disk(count, rng).curve for count in (n, n if kind == "flips" else m))
    return first, second, through


def largest_move(m: Morph) -> float:
    """How far a vertex moves within 1e-7 of a flip or an end at most, as a share of the larger width."""
    marks = np.unique([0.0, *(event.time for event in m.events), 1.0])
    times = np.clip(marks[:, None] + np.concatenate([-BESIDE, [0.0], BESIDE]), 0.0, 1.0)
    shapes = m.at(times.ravel()).reshape(*times.shape, -1, 2)
    width = max(float(np.ptp(T.points, axis=0).max()) for T in (m.source, m.target))
    return float((shapes.max(axis=1) - shapes.min(axis=1)).max()) / width


def moved(kind: str, seed: int) -> list[dict[str, Any]]:
    """Morph one pair along every path; a row each."""
    first, second, strategy = ends(kind, seed)
    rows = []
    for path in PATHS:
        row: dict[str, Any] = {"kind": kind, "seed": seed, "path": path, "strategy": strategy}
        try:
            m = morph(first, second, path=path, strategy=strategy)
        except GuaranteeError as error:
            rows.append(row | {"result": "refused", "words": str(error)})
        else:
            inserted = int((m.source_vertices < 0).sum() + (m.target_vertices < 0).sum())
            rows.append(
                row | {"result": "given", "flips": len(m.events), "inserted": inserted, "move": largest_move(m)}
            )
    return rows


def summary(rows: list[dict[str, Any]]) -> pd.DataFrame:
    """For each kind and path: morphs, those refused, with flips, and with inserted vertices; and the largest move."""
    table = pd.DataFrame(rows).reindex(columns=["kind", "path", "result", "flips", "inserted", "move"])
    table = table.assign(refused=table["result"] == "refused", flips=table["flips"] > 0, inserted=table["inserted"] > 0)
    groups = table.groupby(["kind", "path"], sort=False)
    found = groups.agg(
        morphs=("result", "size"), refused=("refused", "sum"), flips=("flips", "sum"), inserted=("inserted", "sum")
    )
    return found.assign(move=groups["move"].max()).reset_index()


def main() -> None:
    out, seeds = asked(str(__doc__).splitlines()[0])
    rows = collected(out, seeds, lambda seed: [row for kind in KINDS for row in moved(kind, seed)])
    print(summary(rows).to_string(index=False))


if __name__ == "__main__":
    main()
