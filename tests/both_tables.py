"""A curve decomposed twice: by the table of all its vertices, and by that of the reduced curve."""

import pytest

from tween import Decomposition, decompose
from tween.triangulating import decomposition as module


def both(points: object, monkeypatch: pytest.MonkeyPatch) -> tuple[Decomposition, Decomposition]:
    """Decompose by the whole table, and by the reduced one."""
    answers = []
    for small in (10**9, 0):
        monkeypatch.setattr(module, "_SMALL", small)
        answers.append(decompose(points))
        assert (answers[-1]._reduced is None) == (small > 0)
    return answers[0], answers[1]
