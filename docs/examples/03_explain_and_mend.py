"""
See what is wrong, and mend it
==============================

Somebody drew a star in one stroke, and at its points the pen curled.  No disk has this outline.  What is in the
way, and what would mend it?
"""

import matplotlib.pyplot as plt
import numpy as np

import tween
from tween import plot

t = np.linspace(0, 2 * np.pi, 120, endpoint=False)
z = 3 * np.cos(t) + 2j * np.sin(t) + 1.2 * np.exp(1j - 3j * t)
drawn = np.stack([z.real, z.imag], axis=1)
answer = tween.decompose(drawn)
explanation = answer.explain()
print(explanation)

# %%
# Each suggestion carries the mended curve, and has been checked: it bounds a disk.  The first one takes away the
# least.

best = explanation.suggestions[0]
print(best.what, f"loses {best.share:.0%} of the area,", "bounds a disk:", bool(tween.decompose(best.curve)))

plot.use_style()
figure, axes = plt.subplots(1, 2, figsize=(6.4, 2.8))
plot.draw_explanation(explanation, axes[0])
axes[0].set_title("red is in the way", fontsize=9.5)
plot.draw_shape(best.curve, axes[1])
axes[1].set_title("mended")
