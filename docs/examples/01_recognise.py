"""
Does it bound a disk?
=====================

Four closed curves that cross themselves.  One bounds a disk that was stretched and overlapped; three do not, each
for a reason of its own.
"""

import matplotlib.pyplot as plt
import numpy as np

import tween
from tween import gallery, plot

t = np.linspace(0, 2 * np.pi, 80, endpoint=False)
curves = {
    "pretzel": gallery.curve("pretzel").points,
    "eight": np.stack([np.sin(2 * t), np.sin(t)], axis=1),
    "limaçon": np.stack([np.cos(t) + 1.2 * np.cos(2 * t), np.sin(t) + 1.2 * np.sin(2 * t)], axis=1),
    "twisted band": np.array([(0, -1), (3, 1), (6, -1), (6, 1), (3, -1), (0, 1)]),
}

# %%
# "No" is an answer, and not an error.  It comes with its reason.

for name, points in curves.items():
    answer = tween.decompose(points)
    print(f"{name:<13} {'bounds a disk' if answer else answer.reason}")

# %%
# The darker, the more layers of the disk lie over each other.

plot.use_style()
figure, axes = plt.subplots(2, 2, figsize=(6, 4.2))
for ax, (name, points) in zip(axes.flat, curves.items(), strict=True):
    plot.draw_shape(points, ax, color=plot.SOURCE if tween.decompose(points) else plot.FAILURE)
    ax.set_title(name)

# %%
# A curve that bounds a disk has many triangulations.  They are counted, exactly.

print(tween.decompose(curves["pretzel"]).count)
