"""
Clean a noisy stroke
====================

A shaky hand traces a horseshoe and goes on past the place where it began.  The stroke crosses itself hundreds of
times.  `tween.clean` makes a curve of it, and moves nothing by more than it is told.
"""

import matplotlib.pyplot as plt
import numpy as np

import tween
from tween import gallery, plot

rng = np.random.default_rng(1)
outline = gallery.curve("horseshoe").insert_vertices(900).points
stroke = np.concatenate([outline, outline[:50]]) + rng.normal(0, 0.03, (950, 2))
print(len(tween.Curve(stroke).crossings), "crossings; bounds a disk:", bool(tween.decompose(stroke)))

# %%
# ``smooth`` is the farthest that anything may move, in the unit of the points.

curve = tween.clean(stroke, smooth=0.2)
print(curve.changes)

# %%
# Before and after.

plot.use_style()
figure, (left, right) = plt.subplots(1, 2, figsize=(6.4, 2.6))
left.plot(*stroke.T, color=plot.FAILURE, linewidth=0.5)
left.set_aspect("equal")
left.set_axis_off()
left.set_title("drawn")
plot.draw_shape(curve, right)
right.set_title("cleaned")
