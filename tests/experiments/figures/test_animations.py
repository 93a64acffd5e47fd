"""The animations: their times are denser while flips happen, their colours are few, and there is one for every pair."""

import numpy as np
import pytest
from PIL import Image

from experiments.figures import animations
from tween import gallery, paper_morph


@pytest.mark.parametrize("name", ["e_to_l", "arrow_to_horseshoe"])
def test_a_third_of_the_frames_shows_the_flips(name: str) -> None:
    m = paper_morph(*gallery.pair(name))
    times = animations.times(m, 31)
    assert times[0] == 0 and times[-1] == 1 and (np.diff(times) > 0).all()
    flips = [event.time for event in m.events]
    if flips:
        early = flips[0] + flips[-1] < 1
        during = times <= flips[-1] if early else times >= flips[0]
        assert during.sum() == pytest.approx(31 / 3, abs=1)
    else:
        assert np.ptp(np.diff(times)) == pytest.approx(0)


def test_few_colours_are_the_same_in_all_frames() -> None:
    noise = np.random.default_rng(0).integers(0, 256, (2, 40, 40, 3), dtype=np.uint8)
    found = animations.in_few_colors([Image.fromarray(frame) for frame in noise], 16)
    assert found[0].getpalette() == found[1].getpalette()
    assert len(np.unique([np.asarray(frame) for frame in found])) <= 3 + 16


def test_every_pair_has_an_animation_that_is_small_enough() -> None:
    files = {path.stem: path.stat().st_size for path in animations.FOLDER.glob("*.gif")}
    assert set(files) == {*gallery.pairs(), *animations.MATCHED}
    assert max(files.values()) <= animations.PARAMETERS["limit"]
