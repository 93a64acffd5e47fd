"""
A loop of several keyframes
===========================

Four letters, one after the other, and back to the first without a seam: the last frame is the first one, and each
vertex is back where it was.
"""

import matplotlib.pyplot as plt
import numpy as np

import tween
from tween import gallery, plot

letters = [gallery.letter(char) for char in "LOVe"]
s = tween.sequence(letters, loop=True, hold=0.3)
print(s)

# %%
# At the time of a keyframe the shape is that keyframe, exactly.

plot.use_style()
plt.figure(figsize=(7.2, 1.4))
plot.draw_filmstrip(s, np.linspace(0, 1, 9), labels=False)

frames = s.frames(121)
print("no seam:", frames[0].tobytes() == frames[-1].tobytes())
print(tween.certify(s))

# %%
# A GIF that plays for ever.

tween.save_animation("love.gif", s, frames=100, size=240, fill="#0072B2", stroke="none")

# sphinx_gallery_thumbnail_number = -1
