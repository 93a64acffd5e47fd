"""How checked frames are kept, and faults put into words; verdicts are tested in test_certificate."""

import numpy as np

from tween.measuring.frame_check import check, fault_words

SQUARE = np.array([(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)])
HALVES = np.array([[(0, 1, 2), (0, 2, 3)], [(0, 1, 3), (1, 2, 3)]])


def checked(t, stage, shapes):
    return check(np.array(t, dtype=np.float64), np.array(stage), np.array(shapes, dtype=np.float64), HALVES)


def test_frames_are_measured_each_under_its_own_triangles() -> None:
    found = checked([0, 1, 2], [0, 1, 0], [SQUARE, 2 * SQUARE, SQUARE * [1, -1]])
    np.testing.assert_array_equal(found.faults[:, 0] == 0, [True, True, False])
    np.testing.assert_allclose(found.areas, [0.5, 2.0, -0.5])
    np.testing.assert_allclose(found.sums[:2], np.pi / 2)
    np.testing.assert_allclose(found.heights[:2], [[0.5, 0.5], [0.5, 0.5]])


def test_frames_put_together_are_in_order_of_stage_and_time() -> None:
    found = checked([0, 1], [0, 1], [SQUARE] * 2).merged(checked([0.5, 0.5], [1, 0], [SQUARE, 3 * SQUARE]))
    assert found.stage.tolist() == [0, 0, 1, 1]
    assert found.t.tolist() == [0, 0.5, 0.5, 1]
    assert found.areas.tolist() == [0.5, 4.5, 0.5, 0.5]


def test_a_fault_is_put_into_words() -> None:
    found = checked([0, 1], [0, 1], [SQUARE * [1, -1], [*SQUARE[:3], (np.nan, 0)]])
    assert fault_words(found, HALVES, 0) == ("triangle 0 [0, 1, 2] is not counter-clockwise", 0)
    assert fault_words(found, HALVES, 1)[0].startswith("vertex 3 is (nan, 0.0), expected coordinates")


def test_a_wrong_number_of_triangles_is_told_before_anything_is_measured() -> None:
    found = check(np.zeros(1), np.zeros(1, np.int64), SQUARE[None], HALVES[:1, :1])
    assert fault_words(found, HALVES[:1, :1], 0) == ("there are 1 triangles, expected 2 for 4 vertices", None)
    assert np.isnan(found.areas).all()
