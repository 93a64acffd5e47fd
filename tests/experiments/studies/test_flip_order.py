"""The order of flips: the lemma and the bound behind the study, and the orders on small shapes."""

import numpy as np
import pandas as pd
import pytest

from experiments.store import RESULTS
from experiments.studies import flip_order
from experiments.subjects import both
from tween import Triangulation
from tween.choices import ORDERS
from tween.morphing.alignment import align
from tween.morphing.incompatible.flip_sequence import flip_sequence
from tween.morphing.incompatible.flow import Flow

DART = np.array([(0, 0), (2, -1), (0.5, 0), (2, 1)])  # vertex 2 is reflex; turned so that 0-2 is its only diagonal
TABLE = pd.read_csv(RESULTS / "flip_order.csv")


def ends(pair: str) -> tuple[Triangulation, Triangulation]:
    a = align(*both(pair))
    return a.source, a.target


def test_along_angle_interior_angles_are_linear_whatever_is_flipped() -> None:
    S, T = ends("ell - letter o")
    flow = Flow(S, flip_sequence(S, T), "angle", "disk-center", "partial")
    start, end = (flip_order.interior_angles(S, points) for points in (S.points, S.on_disk().points))
    reached = flip_order.interior_angles(flow.final, flow.final.points)
    assert len(flow.events) and 0 < flow.end < 1
    np.testing.assert_allclose(reached, (1 - flow.end) * start + flow.end * end, atol=1e-9)


def test_a_reflex_vertex_that_is_to_be_an_ear_has_to_become_convex_first() -> None:
    S = Triangulation(DART, [(0, 1, 2), (0, 2, 3)])
    other = Triangulation(DART, [(0, 1, 3), (1, 2, 3)])
    theta = [flip_order.interior_angles(S, points)[2] for points in (DART, S.on_disk().points)]
    expected = (theta[0] - np.pi) / (theta[0] - theta[1])
    assert flip_order.lower_bound(S, other) == pytest.approx(expected)
    assert flip_order.greedy(S, other, "angle") == (pytest.approx(expected, abs=1e-6), 1)
    assert flip_order.lower_bound(S, S) == 0


@pytest.mark.parametrize("pair", ["ell - letter o", "arrow - horseshoe"])
def test_no_order_is_earlier_than_the_bound(pair: str) -> None:
    S, T = ends(pair)
    bound = flip_order.lower_bound(S, T)
    times = [Flow(S, flip_sequence(S, T), "angle", "disk-center", order).end for order in ORDERS]
    assert min(*times, flip_order.greedy(S, T, "angle")[0]) >= bound - 1e-9


def test_flips_undone_lead_to_the_other_triangulation() -> None:
    S, T = ends("arrow - horseshoe")
    flow = Flow(S, flip_order.reversed_sequence(S, T), "slide", "disk-center", "sequential")
    assert np.array_equal(flow.final.canonical, T.canonical)


def test_divided_flips_never_lead_farther_than_the_better_of_both_flows() -> None:
    S, T = ends("ell - letter o")
    u, v = (Flow(a, flip_sequence(a, b), "slide", "disk-center", "sequential").end for a, b in ((S, T), (T, S)))
    assert flip_order.divided(S, T, "slide") <= min(u, v) + 1e-12


def test_in_the_committed_table_the_bound_holds_and_the_sample_is_as_stated() -> None:
    angle = TABLE[TABLE.path == "angle"]
    for letter in "uv":
        for way in flip_order.WAYS[:3]:
            assert (angle[f"{letter}_{way}"] >= angle[f"{letter}_bound"] - 1e-6).all()
    assert list(angle.pair) == flip_order.sample()
    assert len(angle) == flip_order.PARAMETERS["pairs"]
