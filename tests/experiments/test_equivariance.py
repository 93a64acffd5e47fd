"""The same shapes give the same morph wherever they lie: on generic pairs, which leave no choice."""

import numpy as np

from experiments.equivariance import SAME, apart, compared, ends, moved, summary

CHANGES = ("rotation", "scaling", "similarity", "exchange")


def test_on_random_disks_the_morph_moves_with_its_curves() -> None:
    rows = [compared(seed) for seed in (0, 1, 5, 6, 10, 11)]
    assert {row["kind"] for row in rows} == {"disks"}
    assert max(row[change] for row in rows for change in CHANGES) < SAME


def test_the_kinds_of_pairs_take_turns() -> None:
    assert [ends(seed)[0] for seed in range(5)] == ["disks", "disks", "symmetric", "symmetric", "curves"]


def test_the_summary_counts_what_differs() -> None:
    same = dict.fromkeys(CHANGES, 1e-12) | {"seed": 0, "kind": "disks", "path": "area"}
    table = summary([same, same | {"exchange": 0.1}, {"seed": 2, "kind": "disks", "path": "area", "words": "no"}])
    assert table[["pairs", "refused", "rotation", "exchange"]].values.tolist() == [[3, 1, 0, 1]]


def test_shapes_with_other_counts_are_infinitely_far_apart() -> None:
    assert apart(np.zeros((1, 3, 2)), np.zeros((1, 4, 2))) == np.inf
    assert apart(np.zeros((1, 3, 2)), np.ones((1, 3, 2))) == 1


def test_a_quarter_turn_is_counter_clockwise() -> None:
    found = moved(np.array([[1.0, 0.0]]), np.pi / 2, 3.0, np.array([1.0, 0.0]))
    np.testing.assert_allclose(found, [[3.0, 3.0]], atol=1e-15)
