"""Closing a loop: by a common triangulation of the disks that are meant, or by flips."""

import numpy as np
import pytest

from tween import Triangulation, gallery
from tween.morphing.keyframes import closing, joining
from tween.morphing.keyframes.joining import join
from tween.morphing.keyframes.keyframe import Keyframe


def frames_of(*names: str) -> list[Keyframe]:
    return [Keyframe(gallery.curve(name), name) for name in names]


@pytest.mark.slow
def test_a_loop_without_a_common_triangulation_is_closed_by_flips(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(closing, "_shared", lambda *_: None)
    monkeypatch.setattr(joining, "_PAIRS", ())
    joined = join(frames_of("ell", "arrow", "horseshoe"), True)
    assert [bridge.complete for bridge in joined.bridges].count(False) == 1
    assert joined.holds()


def test_three_corners_on_one_edge_make_no_triangle() -> None:
    """In both shapes vertices 1 and 2 lie on the edge from 0 to 3, once with an error that makes triangles positive."""
    shapes = []
    for bend in (-1e-12, 0.0):
        points = np.array([[0, 0], [1, bend], [2, bend / 3], [3, 0], [3, 2], [0, 2]], dtype=float)
        shapes.append(Triangulation(points, [[0, 1, 5], [1, 2, 5], [2, 4, 5], [2, 3, 4]]))
    found = closing._shared(shapes, (True, True))
    assert found is not None
    assert not {0, 1, 2, 3} >= set(found[0].tolist())
    assert not any({0, 1, 2, 3} >= set(triangle) for triangle in found.tolist())


def test_a_triangulation_of_another_disk_than_the_one_that_is_meant_does_not_close() -> None:
    one, other = Keyframe(gallery.curve("two_disks"), "two disks").disks
    assert (
        closing._shared([one, one], (False, False)) is not None
        or closing._shared([other, other], (False, False)) is not None
    )
    assert closing._shared([one, other], (False, False)) is None
