"""Morphs in numbers that a browser can draw: what is sent is what is there."""

import json
import re

import numpy as np

from tween import gallery, morph, paper_morph, triangulate
from tween.app.playground.fields import BOX
from tween.app.playground.footage import FRAMES, footage
from tween.measuring.metrics import angle_sums


def test_the_largest_sum_of_angles_is_shown_with_its_vertex() -> None:
    m = paper_morph(gallery.curve("three_lobes"), gallery.curve("spiral_2"))
    sums = angle_sums(m, np.linspace(0, 1, FRAMES))
    seen = footage(m)
    assert seen["sums"] == sums.max(axis=0).round(4).tolist()
    np.testing.assert_array_equal(sums[seen["worst"], np.arange(FRAMES)], sums.max(axis=0))


def test_footage_is_json_and_fits_into_the_field() -> None:
    m = paper_morph(gallery.curve("loop"), gallery.letter("S"))
    seen = json.loads(json.dumps(footage(m)))
    assert len(seen["frames"]) == len(seen["stage"]) == len(seen["areas"]) == len(seen["sums"]) == FRAMES
    assert len(seen["stages"]) == max(seen["stage"]) + 1 > 1
    assert sorted(seen["order"]) == list(range(len(m.source) - 2))
    assert all(0 <= x <= BOX for frame in seen["frames"] for x in frame)
    assert seen["root"] == -1
    assert len(json.dumps(seen)) < 600_000


def test_the_shapes_of_a_morph_have_one_scale() -> None:
    T = triangulate(gallery.curve("horseshoe"))
    m = morph(T, T.moved(3 * T.points))
    seen = np.reshape(footage(m)["frames"], (FRAMES, -1, 2))
    sizes, real = (np.ptp(shapes, axis=1).max(axis=1) for shapes in (seen, m.frames(FRAMES)))
    np.testing.assert_allclose(sizes / sizes.max(), real / real.max(), atol=2 / BOX)


def test_footage_shows_the_triangles_that_are_in_force() -> None:
    m = paper_morph(gallery.curve("loop"), gallery.letter("S"))
    seen = footage(m)
    for f, t in enumerate(np.linspace(0, 1, FRAMES)):
        assert seen["stages"][seen["stage"][f]] == m.triangles_at(t).ravel().tolist()


def test_a_refuted_morph_says_when_and_where_and_what_helps() -> None:
    seen = footage(paper_morph(*gallery.fan()))
    assert not seen["valid"]
    assert re.match(r"Bounds no disk at t = 0\.\d+: the angles at vertex 0 add up to", seen["words"])
    assert seen["words"].endswith("With the guarantee it would not.")
    assert max(seen["sums"]) > 2 * np.pi


def test_the_guarantee_is_not_recommended_to_those_who_have_it() -> None:
    refuted = footage(paper_morph(*gallery.fan()), guarantee=True)
    assert "guarantee" not in refuted["words"]
    mended = footage(morph(*gallery.fan()), guarantee=True)
    assert mended["valid"] and max(mended["sums"]) < 2 * np.pi
