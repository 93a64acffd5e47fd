"""Nothing leaps at a flip or an end, along any path; and a leap would be seen."""

import numpy as np
import pytest

from experiments.leaps import KINDS, ends, largest_move, moved, summary
from tween import Morph, gallery, morph
from tween.choices import PATHS


@pytest.fixture(scope="module")
def rows():
    return [row for seed in range(4) for kind in KINDS for row in moved(kind, seed)]


def test_every_morph_of_the_first_seeds_is_given_and_none_leaps(rows) -> None:
    assert {row["result"] for row in rows} == {"given"}
    assert max(row["move"] for row in rows) < 1e-4


def test_the_summary_counts_them(rows) -> None:
    table = summary([*rows, {"kind": "flips", "seed": 9, "path": "area", "result": "refused", "words": "no"}])
    assert list(zip(table["kind"], table["path"], strict=True)) == [(kind, path) for kind in KINDS for path in PATHS]
    assert table["morphs"].tolist() == [4, 4, 4, 5, 4, *[4] * 5]
    assert table["refused"].sum() == 1
    assert (table["flips"][:5] >= 3).all() and (table["inserted"][5:] == 4).all()
    assert table["move"].max() == max(row["move"] for row in rows)


def test_pairs_are_of_the_kind_that_is_asked_for() -> None:
    for seed in range(10):
        first, second, strategy = ends("flips", seed)
        assert len(first) == len(second) and strategy == "paper"
        first, second, _ = ends("inserted", seed)
        assert len(first) != len(second)


class Leaping(Morph):
    """A morph that stands still but for the last instant before its end."""

    def at(self, times):
        late = np.asarray(times) > 1 - 1e-9
        return np.where(late[:, None, None], 1.0, 0.0) * np.ones((len(self.source), 2)) + self.source.points


def test_a_leap_is_seen() -> None:
    T = gallery.random_disk(8, np.random.default_rng(0))
    m = morph(T, T.on_disk())
    still = largest_move(m)
    m.__class__ = Leaping
    assert largest_move(m) > 0.1 > 1e-4 > still
