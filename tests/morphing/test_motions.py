"""The motion that choices ask for: straight or through flips, placed, paced, and in the caller's numbers."""

import numpy as np
import pytest

from tween import gallery
from tween.morphing.alignment import equal_counts
from tween.morphing.correspondence import aligned
from tween.morphing.motions import Choices, between

TIMES = np.linspace(0, 1, 23)


def alignment(strategy, *names):
    first, second, *origins = equal_counts(*map(gallery.curve, names))
    return aligned(strategy, first, second, origins)


@pytest.mark.parametrize(("names", "flips"), [(("ess", "spiral_1"), False), (("arrow", "horseshoe"), True)])
@pytest.mark.parametrize("placement", ["root", "steady"])
def test_exchanged_it_is_the_same_motion_backwards(names, flips, placement):
    found = alignment("paper" if flips else "common", *names)
    choices = Choices("slide", False, placement, "disk-center")
    m, back = between(found, choices), between(found, choices._replace(exchanged=True))
    assert bool(m.events) == flips
    assert (m(0) == found.source.points).all()
    start = int(np.flatnonzero((m.source.points == back.target.points[0]).all(axis=1))[0])  # numbers are the target's
    assert np.allclose(back.at(TIMES), np.roll(m.at(1 - TIMES), -start, axis=1), rtol=0, atol=1e-11)


def test_at_speed_the_vertices_move_equally_fast():
    found = alignment("common", "ess", "spiral_1")
    speeds = []
    for pace in ("time", "speed"):
        shapes = between(found, Choices("linear", False, "root", "disk-center", pace=pace)).at(np.linspace(0, 1, 101))
        steps = np.sqrt((np.diff(shapes, axis=0) ** 2).sum(axis=2).mean(axis=1))
        speeds.append(steps.max() / steps.min())
    assert speeds[1] < 1.1 < speeds[0]


def test_a_proof_is_promised_only_where_there_is_one():
    choices = Choices("slide", False, "root", "disk-center")
    assert choices.proof == "" and "proved" in choices._replace(guarantee=True).proof
    assert "every angle changes linearly" in choices._replace(path="angle").proof
