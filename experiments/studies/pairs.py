"""Every pair of curves, both ways: does the morph of Section 6 exist, and what is it like?

For all pairs of gallery curves and letters, and both of the paper's paths: crossings, flips, when the
flows have done their last flip, in sequence as in the paper (u, v) and in partial order, and what was checked: ends,
symmetry, positive triangles, continuity.  The morph back is computed for itself, so that it may differ from the one
there: by how much, in sizes of the shapes, is "asymmetry".

    swelling          the largest area on the way over that of the larger end, the root placing the shapes
    longest, shortest by what factors edges of the curve leave the range of their lengths at both ends
    ..._steady        the same, placed steadily, where the swelling is 1

Writes results/pairs.csv.
"""

from typing import Any

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from experiments import subjects
from experiments.measures import edge_factors, steady_sizes, swelling
from experiments.store import RESULTS, compute, write_csv
from tween import Curve, Morph, area_matrix, area_rank, decompose, frame_variance
from tween.geometry.predicates import orient2d
from tween.morphing.alignment import align
from tween.morphing.correspondence import paper_alignment
from tween.morphing.motions import Choices, between

PARAMETERS: dict[str, Any] = {"frames": 100, "paths": ["slide", "linear"], "tolerance": 1e-4}


def common_triangulation(source: Curve, target: Curve) -> str:
    """Under which correspondence a triangulation is valid in both: that of the pivots, another, or none."""
    a = align(source, target)
    if decompose(a.source.curve, a.target.curve):
        return "pivots"
    other = any(decompose(a.source.curve, a.target.rolled(shift).curve) for shift in range(len(a.source)))
    return "other" if other else "none"


def checks(m: Morph, back: Morph, source: Curve, target: Curve) -> dict[str, Any]:
    """Largest errors, relative to the size of the shapes, and whether all triangles are positive."""
    size = max(float(np.ptp(c.points, axis=0).max()) for c in (source, target))
    shapes, returned = m.frames(PARAMETERS["frames"]), back.frames(PARAMETERS["frames"])[::-1]
    steps = [np.abs(np.diff(m.frames(k), axis=0)).max() for k in (401, 801)]
    return {
        "end_error": max(_end_error(m(0), m.source_vertices, source), _end_error(m(1), m.target_vertices, target))
        / size,
        "symmetry_error": float(np.abs(np.roll(returned, -m.alignment.shift, axis=1) - shapes).max()) / size,
        "step_ratio": float(steps[0] / steps[1]),
        "positive": _positive(m, shapes),
    }


def sizes(m: Morph, A: NDArray[np.float64]) -> dict[str, float]:
    """How the whole and its edges swell and shrink, placed by the root and steadily."""
    frames = m.frames(A.shape[1])
    longest, shortest = edge_factors(frames)
    steadily = edge_factors(frames, steady_sizes(A))
    return {
        "swelling": swelling(A),
        "longest": longest,
        "shortest": shortest,
        "longest_steady": steadily[0],
        "shortest_steady": steadily[1],
    }


def _end_error(points: NDArray[np.float64], vertices: NDArray[np.int64], curve: Curve) -> float:
    own = vertices >= 0
    assert own.sum() == len(curve)
    return float(np.abs(points[own] - curve.points[vertices[own]]).max())


def _positive(m: Morph, frames: NDArray[np.float64]) -> bool:
    corners = [f[m.triangles_at(t)] for t, f in zip(np.linspace(0, 1, len(frames)), frames, strict=True)]
    return bool((orient2d(*np.moveaxis(np.array(corners), 2, 0)) > 0).all())


def work(pair: str) -> list[dict[str, Any]]:
    """The rows of one pair, a row a path."""
    names = pair.split(subjects.BETWEEN)
    source, target = subjects.both(pair)
    common = common_triangulation(source, target)
    there, here = paper_alignment(source, target), paper_alignment(target, source)
    rows = []
    for path in PARAMETERS["paths"]:
        choices = Choices(path, False, "root", "disk-center")
        m, back = between(there, choices), between(here, choices)
        partial = between(there, choices._replace(order="partial"))
        A = area_matrix(m, PARAMETERS["frames"])
        rows.append(
            {
                "source": names[0],
                "target": names[1],
                "path": path,
                "n": len(m.source),
                "crossings": m.alignment.crossings,
                "flips": len(m.events),
                "u": m.u,
                "v": m.v,
                "u_partial": partial.u,
                "v_partial": partial.v,
                "common": common,
                "AR_1e-4": area_rank(A, PARAMETERS["tolerance"]),
                "Var": frame_variance(A),
                **sizes(m, A),
                **checks(m, back, source, target),
            }
        )
    return rows


def table(rows: list[dict[str, Any]]) -> pd.DataFrame:
    """The rows, numbers rounded and errors held against a bound, so that they agree across processors."""
    result = pd.DataFrame(rows)
    for column in ("u", "v", "u_partial", "v_partial"):
        result[column] = result[column].astype(float).round(6)
    result["Var"] = result["Var"].map("{:.3e}".format)
    for column in ("swelling", "longest", "shortest", "longest_steady", "shortest_steady"):
        result[column] = result[column].map(lambda v: float(f"{v:.3g}"))
    result["ends_within_1e-12"] = result.pop("end_error") <= 1e-12
    asymmetry = result.pop("symmetry_error")
    result["symmetric_within_1e-9"] = asymmetry <= 1e-9
    result["asymmetry"] = asymmetry.round(3)
    result["step_ratio"] = result["step_ratio"].round(3)
    return result


def main() -> None:
    names = subjects.pairs()
    rows = [row for part in compute("pairs", PARAMETERS, names, work) for row in part]
    write_csv(RESULTS / "pairs.csv", table(rows))
    print(f"pairs: {len(names)} pairs, both ways, both paths -> results/pairs.csv")


if __name__ == "__main__":
    main()
