"""What the verdict on Table 1 depends on: every curve counts in every setting."""

import pandas as pd

from experiments.store import RESULTS
from experiments.studies import sensitivity
from experiments.subjects import shapes


def test_every_curve_is_below_at_or_above_in_every_setting() -> None:
    table = pd.read_csv(RESULTS / "sensitivity.csv")
    assert (table[["below", "equal", "above"]].sum(axis=1) == len(shapes())).all()
    assert (table.groupby(["factor", "setting"]).size() == len(sensitivity.MEASURES)).all()
    assert len(table) == len(sensitivity.MEASURES) * len(
        {*sensitivity.SETTINGS, *sensitivity.UNITS, *sensitivity.ARBITRARY}
    )
