"""Triangles for frames that come without."""

import numpy as np
import pytest

from tween import find_triangles, gallery, morph, verify
from tween.errors import NotSelfOverlappingError

SQUARE = np.array([(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)])


def test_triangles_are_found_for_frames_without() -> None:
    source, target = gallery.pair("e_to_l")
    m = morph(source, target, strategy="common")
    frames = m.at(m.playback(1e-2).times)
    triangles = find_triangles(frames)
    assert triangles.shape == (len(frames), len(m.source) - 2, 3)
    assert verify(frames, triangles, between="linear").valid


def test_a_frame_that_bounds_no_disk_has_no_triangles() -> None:
    with pytest.raises(NotSelfOverlappingError, match="frame 1 bounds no immersed disk: turning number"):
        find_triangles([SQUARE, [[0, 0], [2, 2], [2, 0], [0, 2]]])


def test_a_list_is_kept_as_long_as_it_holds() -> None:
    dented = SQUARE.copy()
    dented[2] = 0.25, 0.25
    lists = find_triangles([SQUARE, 2 * SQUARE, dented, SQUARE])
    assert (lists[1:] == lists[1]).all()
    assert verify([SQUARE, 2 * SQUARE, dented, SQUARE], lists, between="linear").valid
