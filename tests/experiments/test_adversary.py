"""Hard ends: what is given with a guarantee neither breaks nor leaps."""

import numpy as np
import pytest

from experiments.adversary import fan, moments, tried
from tween import Morph, Triangulation, morph, verify
from tween.choices import PATHS, Path
from tween.errors import GuaranteeError, TweenError


def fans(count: int) -> list[tuple[Triangulation, Triangulation]]:
    """Pairs of valid fans."""
    found: list[tuple[Triangulation, Triangulation]] = []
    rng = np.random.default_rng(0)
    while len(found) < count:
        ends = fan(rng)
        try:
            for T in ends:
                T.validate()
        except TweenError:
            continue
        found.append(ends)
    return found


def largest_move(m: Morph) -> float:
    """How far a vertex moves within 1e-7 of an end, as a share of the larger width."""
    shapes = m.at([0.0, 1e-12, 1e-9, 1e-7, 1 - 1e-7, 1 - 1e-9, 1 - 1e-12, 1.0]).reshape(2, 4, -1, 2)
    width = max(float(np.ptp(T.points, axis=0).max()) for T in (m.source, m.target))
    return float((shapes.max(axis=1) - shapes.min(axis=1)).max()) / width


@pytest.mark.parametrize("path", PATHS)
def test_a_fan_that_would_open_in_no_time_runs_at_an_even_pace(path: Path) -> None:
    leapt, given = 0, 0
    for ends in fans(30):
        try:
            m = morph(*ends, path=path)
        except GuaranteeError:
            continue
        given += 1
        assert largest_move(m) < 1e-3
        t = moments(m, np.random.default_rng(0), 300)
        assert verify(m.at(t), np.stack([m.triangles_at(x) for x in t]), t).valid
        leapt += largest_move(morph(*ends, path=path, guarantee=False)) > 1e-2
    assert given > 8
    assert leapt > 0 or path in ("linear", "slide", "metric")  # along these, no fan of the first few


def test_the_search_finds_no_moment_that_is_not_valid_among_the_first_seeds() -> None:
    found = [tried(seed, 200) for seed in range(24)]
    assert {row["result"] for row in found} <= {"valid", "refused", "no ends"}
    assert sum(row["result"] == "valid" for row in found) > 8
    assert max(row["jump"] for row in found if "jump" in row) < 1e-3
