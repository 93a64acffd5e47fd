"""The seven rows of Figure 11, measured: what notebook 05 tells of each, in words and in one table."""

from typing import Any, NamedTuple

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from tween import Certificate, Curve, Morph, certify, gallery, morph, paper_morph
from tween.errors import IncompatibleError

# What the paper's text says about each of its rows.
PAPER = (
    "compatible; Table 1",
    "compatible",
    "compatible; Table 1",
    "incompatible; Table 1",
    "incompatible",
    "incompatible; pivots marked",
    "incompatible; pivots marked; Table 1",
)


class Row(NamedTuple):
    """A pair of curves, its morph as printed, what the checker says of it, and the shift of a common triangulation."""

    source: Curve
    target: Curve
    morph: Morph
    certificate: Certificate
    common: int | None


def row(name: str) -> Row:
    """Morph a pair as printed, certify it, and look for a triangulation that is valid in both curves."""
    source, target = gallery.pair(name)
    m = paper_morph(source, target)
    return Row(source, target, m, certify(m), common_shift(source, target))


def common_shift(source: Curve, target: Curve) -> int | None:
    """The renumbering of the least distorting common triangulation, None where no renumbering has one."""
    try:
        return int(morph(source, target, strategy="common").alignment.shift)
    except IncompatibleError:
        return None


def spells(m: Morph, count: int = 101) -> list[tuple[float, float]]:
    """From when to when the curve crosses itself, looked at evenly spaced times."""
    times = np.linspace(0, 1, count)
    crossed = [len(Curve(points).crossings) > 0 for points in m.at(times)]
    changes = np.diff(np.array([False, *crossed, False], dtype=int))
    first, last = np.flatnonzero(changes == 1), np.flatnonzero(changes == -1) - 1
    return list(zip(times[first].tolist(), times[last].tolist(), strict=True))


def roundness(points: NDArray[np.float64]) -> float:
    """4 pi area over the square of the perimeter, 1 for a circle."""
    perimeter = np.linalg.norm(np.roll(points, -1, axis=0) - points, axis=1).sum()
    return float(4 * np.pi * Curve(points).area / perimeter**2)


def in_words(r: Row) -> str:
    """What there is to know about a row, a line each."""
    m, c, inserted = r.morph, r.certificate, len(r.morph.source) - len(r.source)
    more = f" ({inserted} inserted on the source)" if inserted else ""
    crosses = ", ".join(f"{start:.2f} to {end:.2f}" for start, end in spells(m)) or "never"
    lines = [f"{len(r.source)} and {len(r.target)} vertices{more}; vertex i goes to vertex i + {m.alignment.shift}"]
    if m.events:
        lines += [f"{len(m.events)} flips; u = {m.u:.3f}, v = {m.v:.3f}; the last at t = {m.events[-1].time:.3f}"]
    common = "none" if r.common is None else f"yes, vertex i with vertex i + {r.common}"
    lines += [f"common triangulation: {common}", f"crosses itself: {crosses}"]
    widest = f"{c.max_angle / np.pi:.3f} pi, at t = {c.max_angle_time:.2g}"
    return "\n".join([*lines, f"certified: {c.valid}; largest sum of angles at a vertex {widest}"])


def table(rows: dict[str, Row]) -> pd.DataFrame:
    """All rows beside what the paper says of its own."""
    found = pd.DataFrame([_in_columns(r) for r in rows.values()], index=pd.RangeIndex(1, len(rows) + 1, name="row"))
    found.insert(0, "paper", PAPER)
    found.insert(0, "pair", list(rows))
    return found


def _in_columns(r: Row) -> dict[str, Any]:
    m = r.morph
    last = m.events[-1].time if m.events else None
    return {
        "ours": "compatible" if m.alignment.crossings == 0 else "incompatible; pivots matched",
        "flips": len(m.events),
        "last flip": "" if last is None else f"{last:.3f}",
        "roundness of source": f"{roundness(m(0)):.2f}",
        "at last flip": "" if last is None else f"{roundness(m(last)):.2f}",
        "of target": f"{roundness(m(1)):.2f}",
        "common": r.common is not None,
        "certified": r.certificate.valid,
    }
