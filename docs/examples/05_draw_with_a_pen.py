"""
Read a drawing, and draw it with a pen
======================================

In a drawing program, a line is a path without a fill, and has a width.  Such a line is no outline yet.  Drawn with
a pen of that width it is: a ribbon, which may cross itself.
"""

from pathlib import Path

import matplotlib.pyplot as plt

import tween
from tween import io, plot

Path("loop.svg").write_text(
    """<svg xmlns="http://www.w3.org/2000/svg" width="240" height="200" viewBox="0 0 120 100">
  <path id="loop" fill="none" stroke="black" stroke-width="7" stroke-linecap="round"
    d="M10 80C40 80 90 70 90 40S70 5 55 20s0 50 35 50a20 20 0 0 0 20-20v-20"/>
</svg>"""
)

# %%
# The pen has the caps and the corners that the file declares; its width is yours.

ribbon = io.read_stroke("loop.svg", width=7)
print(ribbon, len(ribbon.crossings), "crossings")

plot.use_style()
figure, axes = plt.subplots(1, 2, figsize=(6, 2.7))
plot.draw_shape(ribbon, axes[0])
axes[0].set_title("drawn with a pen")
plot.draw_triangulation(tween.triangulate(ribbon), axes[1])
axes[1].set_title("triangulated")

# %%
# ``tolerance`` says how far the polygon may lie from the curves of the file: a larger one gives fewer vertices.

print(io.read_stroke("loop.svg", width=7, tolerance=1))

# sphinx_gallery_thumbnail_number = 2
