"""
Save a film: GIF, SVG, MP4
==========================

The suffix decides.  A GIF plays everywhere, an SVG is sharp at every size, and a video goes into a cut.
"""

from pathlib import Path

import tween
from tween import gallery

m = tween.morph(gallery.letter("e"), gallery.letter("l"))

# %%
# The animation of an SVG runs in any browser, without a script.  Between its shapes every point moves straight, and
# every instant of that has been verified.

tween.save_animation(
    "e_to_l.svg", m, style="fill", fill="#D55E00", stroke="#204A87", width=1.5, size=240, ease="ease-in-out"
)

# %%
# A GIF with a time of its own, as in CSS.  ``size="small"`` makes it as large as fits into 500 kB.

tween.save_animation("e_to_l.gif", m, frames=50, size=200, ease="cubic-bezier(0.7, 0, 0.2, 1)", hold=0.2)

# %%
# Numbered pictures, with a transparent background, for a program that cuts; and a video, which needs the extra
# ``video``.

tween.save_animation("frame_%04d.png", m, frames=24, size=320, background="transparent")
tween.save_animation("e_to_l.mp4", m, frames=60, size=(640, 480), there_and_back=False)
for path in sorted(Path().glob("e_to_l.*")):
    print(f"{path}  {path.stat().st_size / 1000:.0f} kB")
print(len(list(Path().glob("frame_*.png"))), "pictures")

# sphinx_gallery_thumbnail_number = -1
