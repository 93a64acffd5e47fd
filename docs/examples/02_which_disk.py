"""
Choose one of several disks
===========================

A curve may bound several disks, which cannot be deformed into each other while the curve stays where it is.  Here
are all, and one of them is chosen for a morph.
"""

import matplotlib.pyplot as plt
import numpy as np

import tween
from tween import gallery, plot

curve = gallery.curve("two_disks")
disks = tween.decompose(curve).immersions()
print(f"one curve, {len(disks)} disks")

# %%
# Colours run along each disk, from one end to the other.  Follow them: in the two disks, other parts are connected.

plot.use_style()
figure, axes = plt.subplots(1, 2, figsize=(6, 2.8))
for i, (ax, T) in enumerate(zip(axes, disks, strict=True)):
    plot.draw_triangulation(T, ax)
    ax.set_title(f"disk {i}")

# %%
# A triangulation in the place of a curve says which disk is meant.

letter = tween.io.fit(gallery.letter("S"), curve)  # in the place of the curve, and as large
m = tween.morph(disks[1], letter)
plt.figure(figsize=(7.2, 1.5))
plot.draw_filmstrip(m, np.linspace(0, 1, 6), labels=False)
print(m)
