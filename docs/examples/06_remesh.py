"""
Triangulate, remesh, and look at the tree
=========================================

Every triangulation of an immersed disk without inner vertices hangs together as a tree.  One is drawn at random,
out of all; flips turn it into the constrained Delaunay triangulation, whose tree is simpler.
"""

import matplotlib.pyplot as plt
import numpy as np

import tween
from tween import gallery, plot

curve = gallery.curve("three_lobes")
drawn = tween.decompose(curve).sample(np.random.default_rng(3))
delaunay = tween.remesh(drawn)
print(f"{len(curve)} vertices, {len(drawn.triangles)} triangles in each")

# %%
# Above, triangles coloured by their place along the disk; below, the trees, with a node where three branches meet
# or one ends.

plot.use_style()
figure, axes = plt.subplots(2, 2, figsize=(6, 5.2))
for column, (title, T) in zip(axes.T, {"drawn at random": drawn, "remeshed": delaunay}.items(), strict=True):
    plot.draw_triangulation(T, column[0])
    column[0].set_title(title)
    plot.draw_shape(T, column[1], alpha=0.15)
    plot.draw_dual_tree(T, column[1], simplified=True)
