"""Playback: few frames, straight motion between which stays close to the morph and is verified."""

import numpy as np
import pytest
from numpy.typing import NDArray

from tween import TweenError, certify, gallery, morph, paper_morph, triangulate, verify
from tween.measuring.playback import playback

SQUARE = np.array([(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)])
HALVES = np.array([(0, 1, 2), (0, 2, 3)])


class Scripted:
    """A morph of a square made by hand."""

    events = ()

    def __init__(self, shape) -> None:
        self._shape = shape

    def at(self, times) -> NDArray[np.float64]:
        return np.array([self._shape(t) for t in times], dtype=np.float64)

    def triangles_at(self, t: float) -> NDArray[np.int64]:
        return HALVES


def turned(angle: float) -> NDArray[np.float64]:
    c, s = np.round([np.cos(angle), np.sin(angle)], 14)
    return (SQUARE - 0.5) @ np.array([[c, s], [-s, c]])


def widths_off(m, shown, times) -> float:
    """How far straight motion is from the morph at some times, measured independently."""
    off = 0.0
    for t in times:
        i = min(np.searchsorted(shown.times, t, side="right"), len(shown) - 1) - 1
        s = (t - shown.times[i]) / (shown.times[i + 1] - shown.times[i])
        shape = m.at([t])[0]
        straight = (1 - s) * shown.frames[i] + s * shown.frames[i + 1]
        off = max(off, np.linalg.norm(shape - straight, axis=1).max() / np.ptp(shape, axis=0).max())
    return off


@pytest.mark.parametrize("path", ["slide", "linear", "metric"])
@pytest.mark.parametrize("tolerance", [1e-2, 1e-3])
def test_a_playback_is_close_verified_and_takes_few_frames(path: str, tolerance: float) -> None:
    T = triangulate(gallery.curve("ess"))
    m = morph(T, T.on_disk(), path=path)
    shown = m.playback(tolerance)
    assert shown.certificate.valid and shown.certificate.scope == "playback"
    assert verify(shown.frames, shown.triangles, shown.times, between="linear").valid
    assert (shown.times[0], shown.times[-1]) == (0, 1) and (np.diff(shown.times) > 0).all()
    np.testing.assert_array_equal(shown.frames, m.at(shown.times))
    assert shown.deviation <= tolerance
    assert widths_off(m, shown, np.linspace(0, 1, 777)) <= tolerance
    assert len(shown) <= 2 + 3 * tolerance**-0.5


def test_straight_motion_needs_no_frame_between_the_ends() -> None:
    shown = playback(Scripted(lambda t: (1 + t) * SQUARE), tolerance=1e-6)
    assert shown.times.tolist() == [0, 1]
    assert shown.deviation < 1e-12


def test_no_frame_can_be_left_out() -> None:
    m = Scripted(lambda t: turned(t * t))
    shown = playback(m, tolerance=1e-2)
    for i in range(1, len(shown) - 1):
        fewer = [np.delete(values, i, axis=0) for values in (shown.times, shown.frames, shown.triangles)]
        without = type(shown)(*fewer, shown.tolerance, 0.0, shown.certificate)
        assert widths_off(m, without, np.linspace(0, 1, 500)) > 0.9e-2


def test_frames_are_as_many_as_a_circle_needs() -> None:
    # A chord of angle a lies r (1 - cos(a / 2)) off its arc; a square of side 1 has r = 1 / sqrt(2), width 1 to 1.41.
    shown = playback(Scripted(lambda t: turned(np.pi / 2 * t)), tolerance=1e-3)
    longest = 2 * np.arccos(1 - 1e-3 * 2**0.5)
    assert np.pi / 2 / longest / 1.3 <= len(shown) - 1 <= 2 + np.pi / 2 / longest


def test_where_a_wide_tolerance_would_break_rules_steps_are_shorter() -> None:
    shown = playback(Scripted(lambda t: turned(np.pi * t)), tolerance=10.0)
    assert len(shown) > 2
    assert shown.certificate.valid


def test_flips_are_played_under_either_list() -> None:
    m = morph(*gallery.pair("arrow_to_horseshoe"), path="slide", strategy="paper")
    assert len(m.events) > 50
    shown = m.playback(5e-3)
    assert shown.certificate.valid
    assert (shown.triangles[0] != shown.triangles[-1]).any()
    assert len(shown) < len(m.events)


def test_a_morph_that_is_not_valid_cannot_be_played_and_time_and_rule_are_named() -> None:
    m = paper_morph(*gallery.fan())
    with pytest.raises(TweenError, match=r"cannot be played back from t = 0\.0\d+ on: at t = 0.0\d+ .*vertex 0"):
        m.playback(1e-3)


def test_a_jump_cannot_be_followed() -> None:
    with pytest.raises(TweenError, match=r"at t = 0\.3\d* the morph is too fast to be followed within 0.001"):
        playback(Scripted(lambda t: SQUARE + (t > 0.3)), tolerance=1e-3)


@pytest.mark.parametrize("size", [1e5, 1e7])
@pytest.mark.parametrize("turned", [False, True])
def test_ends_of_very_different_sizes_are_followed_as_close_to_the_small_one_as_shapes_change(size, turned) -> None:
    source, target = (c.points for c in gallery.pair("arrow_to_horseshoe"))
    m = morph(*((target, source * size) if turned else (source * size, target)))
    assert certify(m).valid
    shown = m.playback(2e-3)
    assert verify(shown.frames, shown.triangles, shown.times, between="linear").valid
    assert len(shown) < 200  # and not thousands
    # most frames lie where almost no time is left: there the small shape changes
    gaps = shown.times if turned else 1.0 - shown.times
    assert np.count_nonzero((gaps > 0) & (gaps < 1e-6)) > 35
    assert shown.deviation <= 2e-3


def test_where_doubles_have_no_time_for_what_happens_playing_back_is_refused_with_the_time() -> None:
    source, target = (c.points for c in gallery.pair("arrow_to_horseshoe"))
    m = morph(source * 1e9, target)
    with pytest.raises(TweenError, match=r"from t = 1 - 1.11\d+e-16 on: .*loses its area.* no time in between"):
        m.playback()
    failure = certify(m).first_failure
    assert failure is not None and failure.t == 1.0
    assert len(morph(source, target * 1e9).playback()) < 250  # doubles are denser near 0


def test_flips_at_neighbouring_doubles_leave_no_time_between_them() -> None:
    m = Scripted(lambda t: turned(np.pi / 4 * t))
    m.events = [type("Event", (), {"time": t}) for t in (0.5, np.nextafter(0.5, 1))]
    assert (np.diff(playback(m).times) > 0).all()


def test_frames_can_be_limited() -> None:
    with pytest.raises(TweenError, match=r"4 times lead only to t = 0\.\d+ within 1e-06"):
        playback(Scripted(turned), tolerance=1e-6, most=4)


@pytest.mark.parametrize(
    ("options", "message"), [({"tolerance": 0}, "tolerance is 0"), ({"most": 1}, "at most 1 times")]
)
def test_senseless_limits_are_misuse(options, message: str) -> None:
    with pytest.raises(ValueError, match=message):
        playback(Scripted(turned), **options)
