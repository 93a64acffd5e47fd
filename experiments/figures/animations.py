"""Figure 11 in motion: each pair of the gallery there and back, as a GIF in results/animations/.

Every shape is as large as the others, as in the figure, and the scale is written beside the time.  The flips come so
close together that evenly spaced times would show two or three shapes while they happen; so a third of the shapes are
spent on them, in slow morph.  One pair is there a second time, matched: there all shapes have one scale.
"""

import argparse
import io
from collections.abc import Iterator
from typing import Any

import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.colors import to_rgb
from matplotlib.figure import Figure
from numpy.typing import NDArray
from PIL import Image

from experiments.figures.rows import bottom, draw_layers, fit, places, reach, scale_label
from experiments.store import RESULTS, compute, replacing
from tween import Morph, Triangulation, gallery, morph, paper_morph
from tween import plot as draw

FOLDER = RESULTS / "animations"
PARAMETERS: dict[str, Any] = {
    "frames": 20,  # from source to target; the way back shows the same ones
    "size": [380, 280],  # pixels
    "colors": [160, 96, 64, 48, 32],  # as many as leave the file below the limit
    "limit": 405_000,  # bytes
    "duration": [70, 900],  # milliseconds of a frame, and of the source and the target
}
SLOW = 1 / 3  # of the frames of a morph that flips, for the time until its last flip
MATCHED = {"matched_arrow_to_horseshoe": "arrow_to_horseshoe"}


def times(m: Morph, count: int) -> NDArray[np.float64]:
    """Times of frames, denser while flips happen."""
    even = np.linspace(0, 1, count)
    if not m.events:
        return even
    first, last = m.events[0].time, m.events[-1].time
    if first + last < 1:
        return np.interp(even, [0, SLOW, 1], [0, last, 1])
    return np.interp(even, [0, 1 - SLOW, 1], [0, first, 1])


def pictures(m: Morph, one_scale: bool = False) -> Iterator[Image.Image]:
    """The frames from source to target: layers, the pivot, the time, and how many flips are done."""
    width, height = PARAMETERS["size"]
    canvas = FigureCanvasAgg(Figure(figsize=(width / 100, height / 100), dpi=100))
    canvas.figure.set_layout_engine("none")
    ax = canvas.figure.add_axes((0.0, 0.08, 1.0, 0.92))
    place, first, pivot = places(m.source), bottom(m), m.alignment.pivot
    flips = np.array([event.time for event in m.events])
    text: dict[str, Any] = {"transform": ax.transAxes, "fontsize": 9}
    everything = m.frames(PARAMETERS["frames"]).reshape(-1, 2)
    for t in times(m, PARAMETERS["frames"]).tolist():
        ax.clear()
        points = m(t)
        draw_layers(ax, Triangulation(points, m.triangles_at(t)), place, first)
        if pivot is not None:
            ax.scatter(points[pivot, 0], points[pivot, 1], s=26, color=draw.PIVOT, linewidths=0, zorder=5)
        fit(ax, everything if one_scale else points)
        done = 0 if t == 0 else int((flips <= t).sum())
        scale = "" if one_scale else scale_label(reach(m.source.points) / reach(points))
        ax.text(0.02, -0.03, f"t = {t:.3f}{scale}", **text)
        ax.text(0.98, -0.03, f"{done} of {len(flips)} flips" if len(flips) else "no flips", ha="right", **text)
        canvas.draw()
        yield Image.fromarray(np.asarray(canvas.buffer_rgba())[..., :3])


def in_few_colors(frames: list[Image.Image], count: int) -> list[Image.Image]:
    """The frames in the same few colours, chosen from all of them; white, the outline's and the pivot's are kept."""
    everything = Image.fromarray(np.concatenate([np.asarray(frame)[::2, ::2] for frame in frames]))
    # Half of them are those that most pixels have, half are spread: a small blue part of a green shape stays blue.
    methods = (Image.Quantize.MEDIANCUT, Image.Quantize.MAXCOVERAGE)
    found = [everything.quantize(count // 2, method=method).getpalette() or [] for method in methods]
    colors = np.array([to_rgb("white"), to_rgb(draw.INK), to_rgb(draw.PIVOT)]) * 255
    colors = np.concatenate([colors, *(np.reshape(palette, (-1, 3))[: count // 2] for palette in found)])
    colors[(colors > 240).all(axis=1)] = 255
    palette = Image.new("P", (1, 1))
    palette.putpalette(colors.round().astype(int).ravel().tolist())
    return [frame.quantize(palette=palette, dither=Image.Dither.NONE) for frame in frames]


def gif(frames: list[Image.Image]) -> bytes:
    """There and back, endlessly, with a rest at both ends."""
    loop = [*frames, *frames[-2:0:-1]]
    step, rest = PARAMETERS["duration"]
    duration = [rest if i in (0, len(frames) - 1) else step for i in range(len(loop))]
    stream = io.BytesIO()
    loop[0].save(stream, format="GIF", save_all=True, append_images=loop[1:], duration=duration, loop=0)
    return stream.getvalue()


def work(name: str) -> int:
    """Write the animation of one pair; returns how many bytes it has."""
    draw.use_style()
    both = gallery.pair(MATCHED.get(name, name))
    frames = list(pictures(morph(*both), one_scale=True) if name in MATCHED else pictures(paper_morph(*both)))
    for count in PARAMETERS["colors"]:
        content = gif(in_few_colors(frames, count))
        if len(content) <= PARAMETERS["limit"]:
            break
    with replacing(FOLDER / f"{name}.gif") as temporary:
        temporary.write_bytes(content)
    return len(content)


def main() -> None:
    argparse.ArgumentParser(
        prog="python -m experiments.figures.animations", description=__doc__.split("\n")[0]
    ).parse_args()
    sizes = compute("animations", PARAMETERS, [*gallery.pairs(), *MATCHED], work)
    print(f"animations: {len(sizes)} morphs, at most {max(sizes) / 1000:.0f} kB each -> results/animations/")


if __name__ == "__main__":
    main()
