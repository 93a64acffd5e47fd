"""Refinement against a lift: the first level's correspondence taken to all vertices in proportion, nothing refined.

The lift is this file's own.  Between two nodes of the first level, the vertices of either curve go onto the other in
proportion along the arcs; then all nodes are triangulated anew, as well as both numberings allow.
"""

from itertools import combinations

import numpy as np
import pytest
from numpy.typing import NDArray

from tween import Curve, gallery, match, remesh, triangulate
from tween.morphing.alignment import common
from tween.morphing.matching.given import Landmarks
from tween.morphing.matching.levels import Correspondence, first_level
from tween.morphing.matching.search import SMALL, even_candidates, sizes_of_levels
from tween.morphing.matching.shape import Shape

Floats = NDArray[np.float64]

SAME = 1e-9  # of a curve's length: nodes as near as that are one
FLAT = 1e-9  # of the shape's area: three nodes on one edge, a triangle by rounding only
ROUNDING = 1e-9  # relative, of energies
SHARE = 0.4  # of the pairs; the other lifts have no triangulation that is valid in both curves
NO_LANDMARKS = Landmarks(np.empty(0, dtype=np.int64), np.empty(0, dtype=np.int64))


def arcs(points: Floats) -> Floats:
    """Where each vertex lies along the curve, and the end of the curve: from 0 to 1."""
    steps = np.linalg.norm(np.roll(points, -1, axis=0) - points, axis=1)
    return np.append(0.0, np.cumsum(steps)) / steps.sum()


def at(points: Floats, places: Floats) -> Floats:
    """The points of a curve at such places."""
    ring = np.append(points, points[:1], axis=0)
    return np.stack([np.interp(places, arcs(points), ring[:, k]) for k in (0, 1)], axis=1)


def lifted_nodes(nodes: Floats, vertices: tuple[Floats, Floats]) -> Floats:
    """Put the remaining vertices of both curves between nodes, which are pairs of places; shape (m, 2)."""
    first = nodes[0]
    ends = np.append((nodes - first) % 1.0, [[1.0, 1.0]], axis=0)
    pairs = [ends]
    for own, places in enumerate(vertices):
        ahead = (places - first[own]) % 1.0
        both = np.stack([ahead, np.interp(ahead, ends[:, own], ends[:, 1 - own])], axis=1)
        pairs.append(both[:, :: 1 if own == 0 else -1])
    every = np.concatenate(pairs)
    every = every[np.lexsort(every.T[::-1])]
    apart = (np.diff(every, axis=0) > SAME).any(axis=1)
    return (every[:-1][apart] + first) % 1.0


def energy(source: Floats, target: Floats, triangles: NDArray[np.int64]) -> float:
    """Symmetric Dirichlet energy: Jacobians of the affine maps both ways, squared and integrated over areas 1."""
    sides, areas = [], []
    for points in (source, target):
        edges = points[triangles[:, 1:]] - points[triangles[:, :1]]
        area = 0.5 * np.linalg.det(edges)
        sides.append(edges / np.sqrt(area.sum()))
        areas.append(area / area.sum())
    there, back = np.linalg.solve(*sides), np.linalg.solve(*sides[::-1])
    return float(areas[0] @ (there**2).sum(axis=(1, 2)) + areas[1] @ (back**2).sum(axis=(1, 2)))


def flattest(points: Floats, triangles: NDArray[np.int64]) -> float:
    """The least area of a triangle, as a share of the shape's."""
    edges = points[triangles[:, 1:]] - points[triangles[:, :1]]
    areas = np.linalg.det(edges)
    return float(areas.min() / areas.sum())


def first_correspondences(source: Curve, target: Curve) -> list[Correspondence]:
    """Those of the first level of the search, the best first; none where simplified curves match nowhere."""
    shapes = [Shape(remesh(triangulate(curve)), np.zeros(len(curve), dtype=bool)) for curve in (source, target)]
    sizes = sizes_of_levels(len(source), len(target), SMALL)[0]
    return first_level(shapes[0], shapes[1], sizes, even_candidates(*sizes), NO_LANDMARKS, 0.0)


def energy_of_lift(source: Curve, target: Curve, coarse: Correspondence) -> float:
    """The least energy of a triangulation of the lift's nodes; infinite where none is valid in both curves."""
    nodes = np.stack([coarse.source_arc, coarse.target_arc], axis=1)
    places = lifted_nodes(nodes, (arcs(source.points)[:-1], arcs(target.points)[:-1])).T
    S, T = (triangulate(at(curve.points, p)) for curve, p in zip((source, target), places, strict=True))
    shared = common(S, T)
    if shared is None or min(flattest(X, shared.triangles) for X in (S.points, T.points)) < FLAT:
        return np.inf
    return energy(S.points, T.points, shared.triangles)


def all_pairs() -> list[tuple[Curve, Curve]]:
    curves = [gallery.curve(name) for name in gallery.names()] + [gallery.letter(name) for name in gallery.letters()]
    return list(combinations(curves, 2))


def compare(pairs: list[tuple[Curve, Curve]]) -> list[tuple[float, float]]:
    """Energies of the match and of the best lift, over the pairs of which at least one lift has a triangulation."""
    compared = []
    for pair in pairs:
        lifts = [energy_of_lift(*pair, coarse) for coarse in first_correspondences(*pair)]
        if min(lifts, default=np.inf) < np.inf:
            a = match(*pair)
            assert a.complete
            compared.append((energy(a.source.points, a.target.points, a.source.triangles), min(lifts)))
    return compared


@pytest.mark.parametrize("name", ["ess", "two_loops", "horseshoe"])
def test_the_lift_onto_a_turned_and_enlarged_copy_that_starts_elsewhere_is_that_copy(name: str) -> None:
    curve = gallery.curve(name)
    copy = Curve(np.roll(2.0 * curve.points @ np.array([[0.6, 0.8], [-0.8, 0.6]]), 17, axis=0))
    assert energy_of_lift(curve, copy, first_correspondences(curve, copy)[0]) == pytest.approx(4.0, abs=1e-9)


def test_the_lift_has_all_vertices_of_both_curves_and_the_first_nodes_in_order() -> None:
    pair = gallery.curve("arrow"), gallery.curve("spiral_1")
    coarse = first_correspondences(*pair)[0]
    nodes = np.stack([coarse.source_arc, coarse.target_arc], axis=1)
    vertices = [arcs(curve.points)[:-1] for curve in pair]
    places = lifted_nodes(nodes, (vertices[0], vertices[1]))
    for own, first in enumerate(nodes.T):
        ahead = np.diff(places[:, own], append=places[0, own]) % 1.0
        assert ahead.min() > 0 and ahead.sum() == pytest.approx(1.0)
        for wanted in (vertices[own], first):
            away = np.abs((places[:, own] - wanted[:, None] + 0.5) % 1.0 - 0.5)
            assert away.min(axis=1).max() < 1e-12
    assert len(places) < len(pair[0]) + len(pair[1]) + len(nodes)


def test_a_match_of_sampled_pairs_of_the_gallery_has_no_more_energy_than_a_lift() -> None:
    pairs = all_pairs()[::23]
    compared = compare(pairs)
    assert len(compared) >= SHARE * len(pairs)
    assert [(own, lift) for own, lift in compared if own > lift * (1 + ROUNDING)] == []


@pytest.mark.slow
def test_a_match_of_any_pair_of_the_gallery_has_no_more_energy_than_a_lift() -> None:
    pairs = all_pairs()
    compared = compare(pairs)
    assert len(pairs) == 561 and len(compared) >= SHARE * len(pairs)
    assert [(own, lift) for own, lift in compared if own > lift * (1 + ROUNDING)] == []
