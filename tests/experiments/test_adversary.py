"""Hard ends: what is given with a guarantee neither breaks nor leaps."""

import numpy as np
import pytest
from numpy.typing import NDArray

from experiments.adversary import examined, fan, tried
from tween import Morph, Triangulation, gallery, morph, paper_morph, verify
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
        assert not examined(m, np.random.default_rng(0), 300)[0].faults.any()
        leapt += largest_move(morph(*ends, path=path, guarantee=False)) > 1e-2
    assert given > 8
    assert leapt > 0 or path in ("linear", "slide", "metric")  # along these, no fan of the first few


def test_the_search_finds_no_moment_that_is_not_valid_among_the_first_seeds() -> None:
    found = [tried(seed, 200) for seed in range(24)]
    assert {row["result"] for row in found} <= {"valid", "refused", "no ends"}
    assert sum(row["result"] == "valid" for row in found) > 8
    assert max(row["jump"] for row in found if "jump" in row) < 1e-3


class Opening:
    """A fan of eight triangles around vertex 0; the angles there add up to more than 2 pi for a moment, at t = 0.3."""

    events = ()
    source = Triangulation(np.zeros((10, 2)), [[0, i, i + 1] for i in range(1, 9)])

    def at(self, t: NDArray[np.float64]) -> NDArray[np.float64]:
        angles = np.linspace(0.0, 1.0, 9) * (2 * np.pi + 1e-8 - (np.reshape(t, (-1, 1)) - 0.3) ** 2)
        rim = np.stack([np.cos(angles), np.sin(angles)], axis=2)
        return np.concatenate([np.zeros((len(rim), 1, 2)), rim], axis=1)

    def stage_at(self, t: NDArray[np.float64]) -> NDArray[np.int64]:
        return np.zeros(len(t), np.int64)

    def triangles_at(self, t: float) -> NDArray[np.int64]:
        return self.source.triangles


def test_a_morph_that_is_broken_for_a_moment_is_found_out_between_the_even_times() -> None:
    m = Opening()
    assert verify(m.at(np.linspace(0, 1, 600)), m.source.triangles).valid
    checked, _ = examined(m, np.random.default_rng(0), 2000)
    assert 2000 <= len(checked.t) < 2100
    assert checked.faults[:, 0].any()


def test_what_is_found_through_flips_is_what_verify_finds_at_the_same_times() -> None:
    m = paper_morph(*gallery.pair("arrow_to_horseshoe"))
    checked, lists = examined(m, np.random.default_rng(0), 200)
    t = checked.t
    again = verify(m.at(t), np.stack([m.triangles_at(x) for x in t]), t)
    assert len(t) >= 200 and len(lists) > 3
    assert again.frames_failed == np.count_nonzero(checked.faults[:, 0])
    assert again.max_angle == checked.sums.max()
    beside = np.abs(t[:, None] - [event.time for event in m.events]).min(axis=1)
    assert np.count_nonzero(beside < 1e-3) > 100


def test_seed_20219_of_which_rounding_leaves_but_noise_is_refused_and_not_looked_at_ever_more_closely() -> None:
    found = tried(20219, 200)
    assert (found["result"], "rounding may need" in found["words"]) == ("refused", True)


def test_seed_22166_whose_triangles_overlap_has_no_disk_and_is_no_end() -> None:
    assert tried(22166, 200)["result"] == "no ends"
