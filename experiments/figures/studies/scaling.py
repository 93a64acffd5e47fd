"""How the time to recognise and triangulate a curve grows, and how little of it the table sees."""

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
from matplotlib.figure import Figure

from experiments.figures.registry import WIDTH, drawing
from experiments.store import RESULTS
from tween import plot as draw

# The curves that cross themselves a few times, from dark to light, and what they are compared with.
FEW = {"five-turn spiral strip": "0.1", "two_disks": "0.35", "five_disks": "0.55", "looped ribbon": "0.72"}


@drawing(
    "scaling",
    "ours",
    """Curves of up to 100,000 vertices.  Left, the time to recognise a curve and to find its constrained Delaunay
    triangulation: with few crossings it grows like n; dashed, what pythoncdt (C++) takes for the spiral strip, which is
    a simple polygon.  Right, the vertices that are left when ears and dents are gone, all that the table of Shor and
    Van Wyk has to see.  Random disks cross themselves thousands of times, and next to nothing can go.  Medians, timed
    once on two cores by experiments/benchmarks/scaling.py; make reproduce does not time them anew.""",
)
def scaling() -> Figure:
    """Time, and vertices left, against the number of vertices."""
    table = pd.read_csv(RESULTS / "scaling.csv")
    figure, (time, left) = plt.subplots(1, 2, figsize=(WIDTH, 3.4))
    for name, color in FEW.items():
        rows = table[table["curve"] == name]
        label = name.replace("_", " ")
        time.plot(rows["n"], rows["ms"] / 1e3, color=color, marker="o", markersize=3, linewidth=1, label=label)
        left.plot(rows["n"], rows["left"], color=color, marker="o", markersize=3, linewidth=1)
    peer = table.dropna(subset="pythoncdt_ms")
    same = f"pythoncdt, {peer['curve'].iloc[0]}"
    time.plot(peer["n"], peer["pythoncdt_ms"] / 1e3, color="0.1", linestyle="--", linewidth=1, label=same)
    disks = table[table["curve"] == "random disk"]
    time.plot(
        disks["n"], disks["ms"] / 1e3, color=draw.PIVOT, marker="s", markersize=3, linewidth=1, label="random disks"
    )
    left.plot(disks["n"], disks["left"], color=draw.PIVOT, marker="s", markersize=3, linewidth=1)
    sizes = np.array([table["n"].min(), table["n"].max()])
    left.plot(sizes, sizes, color="0.8", linewidth=0.8, zorder=1)
    left.annotate("all", (3e4, 3e4), (-2, 2), textcoords="offset points", ha="right", color="0.5", fontsize=8)
    for ax in (time, left):
        ax.set(xscale="log", yscale="log", xlabel="vertices")
        ax.minorticks_off()
    time.set(title="seconds")
    left.set(title="vertices that the table sees")
    figure.legend(*time.get_legend_handles_labels(), loc="outside lower center", ncols=3)
    return figure
