"""Morphs in numbers that a browser can draw: what is sent is what is there."""

import json
import re

import numpy as np

from tween import certify, gallery, morph
from tween.footage import FRAMES, angle_sums, footage
from tween.stroke import BOX


def test_the_sums_of_angles_are_those_of_the_certificate() -> None:
    m = morph(gallery.curve("three_lobes"), gallery.curve("spiral_2"), strategy="paper")
    assert m.events
    sums = angle_sums(m, np.linspace(0, 1, 100))
    assert sums.max() <= certify(m).max_angle + 1e-9
    assert abs(sums.sum(axis=1) - np.pi * (len(m.source) - 2)).max() < 1e-6
    assert abs(sums[0] - angle_sums(m, np.array([0.0]))[0]).max() == 0


def test_footage_is_json_and_fits_into_the_field() -> None:
    m = morph(gallery.curve("loop"), gallery.letter("S"), strategy="paper")
    seen = json.loads(json.dumps(footage(m)))
    assert len(seen["frames"]) == len(seen["stage"]) == len(seen["areas"]) == len(seen["sums"]) == FRAMES
    assert len(seen["stages"]) == max(seen["stage"]) + 1 > 1
    assert sorted(seen["order"]) == list(range(len(m.source) - 2))
    assert all(0 <= x <= BOX for frame in seen["frames"] for x in frame)
    assert seen["root"] == -1
    assert len(json.dumps(seen)) < 600_000


def test_footage_shows_the_triangles_that_are_in_force() -> None:
    m = morph(gallery.curve("loop"), gallery.letter("S"), strategy="paper")
    seen = footage(m)
    for f, t in enumerate(np.linspace(0, 1, FRAMES)):
        assert seen["stages"][seen["stage"][f]] == m.triangles_at(t).ravel().tolist()


def test_a_refuted_morph_says_when_and_where_and_what_helps() -> None:
    seen = footage(morph(*gallery.fan()))
    assert not seen["valid"]
    assert re.match(r"Bounds no disk at t = 0\.\d+: the angles at vertex 0 add up to", seen["words"])
    assert seen["words"].endswith("With the guarantee it would not.")
    assert max(seen["sums"]) > 2 * np.pi


def test_the_guarantee_is_not_recommended_to_those_who_have_it() -> None:
    refuted = footage(morph(*gallery.fan()), guarantee=True)
    assert "guarantee" not in refuted["words"]
    mended = footage(morph(*gallery.fan(), guarantee=True), guarantee=True)
    assert mended["valid"] and max(mended["sums"]) < 2 * np.pi
