"""Every error is a TweenError, and a ValueError where the input is at fault."""

import inspect
import pickle

import pytest

import tween
from tween import errors
from tween.errors import TweenError

# Of these no single input is at fault: what is asked of a morph is more than doubles can give.
BEYOND_DOUBLES = {errors.MotionError, errors.GuaranteeError}
EVERY = [e for _, e in inspect.getmembers(errors, inspect.isclass) if not issubclass(e, Warning)]


def test_there_is_one_root_of_all_errors_and_most_others_are_faults_of_the_input() -> None:
    assert len(EVERY) >= 5
    for error in EVERY:
        assert issubclass(error, TweenError)
        assert issubclass(error, ValueError) == (error not in BEYOND_DOUBLES | {TweenError})


@pytest.mark.parametrize("error", EVERY, ids=lambda e: e.__name__)
def test_an_error_comes_back_from_another_process_as_it_was(error: type[TweenError]) -> None:
    back = pickle.loads(pickle.dumps(error("edge 7-8 has zero length")))
    assert type(back) is error
    assert str(back) == "edge 7-8 has zero length"


@pytest.mark.parametrize(
    ("ask", "error"),
    [
        (lambda: tween.decompose([(0, 0), (0, 0), (1, 1)]), errors.CurveError),
        (lambda: tween.Triangulation([(0, 0), (1, 0), (0, 1)], [(0, 2, 1)]).validate(), errors.TriangulationError),
        (lambda: tween.triangulate([(0, 0), (2, 2), (2, 0), (0, 2)]), errors.NotSelfOverlappingError),
        (lambda: tween.read_curve("there is no such file.csv"), errors.FileError),
    ],
    ids=["curve", "triangles", "no disk", "file"],
)
def test_each_is_raised_by_what_its_name_says_and_caught_by_the_root(ask, error: type[TweenError]) -> None:
    with pytest.raises(TweenError) as caught:
        ask()
    assert type(caught.value) is error
