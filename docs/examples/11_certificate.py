"""
Prove that nothing folds
========================

A morph can be checked by a program that knows nothing of how it was made.  It decides, without rounding, whether
every frame bounds an immersed disk, and every instant of the straight motion between the frames.
"""

import matplotlib.pyplot as plt

import tween
from tween import gallery, plot

m = tween.morph(gallery.curve("horseshoe"), gallery.curve("loop"))
print(tween.certify(m))

# %%
# Of frames that anyone made, only the points and the triangles are needed.  Chosen as `tween.playback` chooses
# them, they may be played straight from one to the next.

played = tween.playback(m)
print(tween.verify(played.frames, m.source.triangles, between="linear"))

# %%
# What does fold is seen.  Here is a fan that overlaps itself around its hub on the way, as the morph of the paper
# makes it, and the same with the guarantee.

printed = tween.paper_morph(*gallery.fan())
kept = tween.morph(*gallery.fan(), path="slide", guarantee=True)
print(tween.certify(printed).first_failure)

plot.use_style()
figure, axes = plt.subplots(1, 2, figsize=(6, 2.8))
for ax, (title, way) in zip(axes, {"as printed": printed, "guaranteed": kept}.items(), strict=True):
    shape = way.source.moved(way(0.25))
    valid = tween.verify(way(0.25), shape.triangles).valid
    plot.draw_triangulation(shape, ax)
    ax.scatter(*shape.points[0], s=22, color=plot.PIVOT, zorder=5)
    ax.set_title(f"{title}: {'bounds a disk' if valid else 'overlaps at the hub'}")
