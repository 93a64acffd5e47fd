"""
Say which features correspond
=============================

An arrow becomes an L.  Which of the two ends of the L shall the tip become?  Left to itself, the match that bends
the least is found.  With a *landmark* you decide.
"""

import matplotlib.pyplot as plt
import numpy as np

import tween
from tween import gallery, plot

arrow, ell = gallery.curve("arrow"), gallery.curve("ell")
tip = int(arrow.points[:, 0].argmax())
free = tween.morph(arrow, ell)
reached = free.target_vertices[free.source_vertices == tip]
print(f"vertex {tip}, the tip, becomes vertex {reached} of the L; -1 is a place on an edge")

# %%
# The landmark: the tip has to become the corner at the far end of the foot.

corner = int((ell.points[:, 0] - ell.points[:, 1]).argmax())
bound = tween.morph(arrow, ell, landmarks=[(tip, corner)])

plot.use_style()
figure, axes = plt.subplots(2, 1, figsize=(6.4, 3.4))
for ax, (title, m) in zip(axes, {"free": free, "with a landmark": bound}.items(), strict=True):
    i = int(np.flatnonzero(m.source_vertices == tip)[0])
    plot.draw_filmstrip(m, np.linspace(0, 1, 6), ax, labels=False, mark=i)
    ax.set_title(f"{title}: the dot is the tip")
