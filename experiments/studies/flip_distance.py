"""Flip sequences beside the true flip distance, which is known for small polygons by search.

For every pair of triangulations of the n-gon, n = 4 to 9: crossings, length of the sequence of Section 6.2,
and the distance in the flip graph.  Writes results/flips.csv.
"""

from collections import deque
from typing import Any

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from experiments.store import RESULTS, compute, write_csv
from tween import Triangulation, decompose
from tween.morphing.incompatible.flip_sequence import count_crossings, flip_sequence
from tween.triangulating.flips import flip

SIZES = [str(n) for n in range(4, 10)]


def polygon(n: int) -> NDArray[np.float64]:
    angle = 2 * np.pi * np.arange(n) / n
    return np.stack([np.cos(angle), np.sin(angle)], axis=1)


def flip_graph(n: int) -> tuple[list[Triangulation], list[list[int]]]:
    """All triangulations of the n-gon, found by flipping, and the neighbours of each."""
    found = [decompose(polygon(n)).arbitrary()]
    number = {found[0].canonical.tobytes(): 0}
    neighbours: list[list[int]] = []
    for T in found:
        near = []
        for a, b in T.diagonals.tolist():
            other = flip(T, (a, b))
            key = other.canonical.tobytes()
            if key not in number:
                number[key] = len(found)
                found.append(other)
            near.append(number[key])
        neighbours.append(near)
    return found, neighbours


def distances(neighbours: list[list[int]], start: int) -> list[int]:
    reached, front = {start: 0}, deque([start])
    while front:
        here = front.popleft()
        for there in neighbours[here]:
            if there not in reached:
                reached[there] = reached[here] + 1
                front.append(there)
    return [reached[i] for i in range(len(neighbours))]


def work(size: str) -> dict[str, Any]:
    found, neighbours = flip_graph(int(size))
    # A rotation of both changes nothing: sources with the smallest key among their rotations stand for all.
    keys = [min(T.rolled(k).canonical.tobytes() for k in range(len(T))) for T in found]
    sources = [i for i, T in enumerate(found) if T.canonical.tobytes() == keys[i]]
    rows = []
    for i in sources:
        orbit = keys.count(keys[i])
        for j, distance in enumerate(distances(neighbours, i)):
            if i != j:
                S, T = found[i], found[j]
                rows.append((orbit, distance, len(flip_sequence(S, T)), count_crossings(S, T)))
    weight, true, length, crossings = np.array(rows, dtype=np.float64).T
    return {
        "n": int(size),
        "triangulations": len(found),
        "pairs": int(weight.sum()),
        "crossings_mean": np.average(crossings, weights=weight),
        "distance_mean": np.average(true, weights=weight),
        "sequence_mean": np.average(length, weights=weight),
        "shortest_share": np.average(length == true, weights=weight),
        "most_over": int((length - true).max()),
        "never_over_crossings": bool((length <= crossings).all()),
    }


def main() -> None:
    rows = compute("flips", {"sizes": SIZES}, SIZES, work)
    write_csv(RESULTS / "flips.csv", pd.DataFrame(rows).round(4))
    print("flips: all pairs of triangulations of up to 9 vertices -> results/flips.csv")


if __name__ == "__main__":
    main()
