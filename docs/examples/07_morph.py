"""
Morph one curve into another
============================

Two curves are matched, feature by feature, triangulated together, and moved into each other.  At no time does a
shape fold.
"""

import matplotlib.pyplot as plt
import numpy as np

import tween
from tween import gallery, plot

source = gallery.curve("spiral_1")
target = tween.io.fit(gallery.letter("S"), source)  # in the place of the spiral, and as large
m = tween.morph(source, target)
print(m)

# %%
# The film strip: all shapes at one scale.

plot.use_style()
plt.figure(figsize=(7.2, 1.8))
plot.draw_filmstrip(m, np.linspace(0, 1, 6))

# %%
# The frames are an array, for a renderer of your own.

frames = m.frames(60)
print(frames.shape)

# %%
# And the film itself.

tween.save_animation("spiral_to_S.gif", m, frames=50, size=280)

# sphinx_gallery_thumbnail_number = -1
