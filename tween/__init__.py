"""Morphing the boundaries of immersed disks.

    points -> Curve -> decompose -> Triangulation -> remesh -> morph -> frames -> metrics

What a user needs first stands here; the folders hold the rest, named after the sections of the paper:

    geometry       points, curves, triangulated disks, and their dual trees
    triangulating  recognising a curve, and its triangulations (Section 4)
    morphing       from one disk to another (Sections 5 and 6)
    measuring      the measures of Table 1, and certificates
    gallery        curves to try things on
    io             files read and written
    plot           figures and animations
    app            the command `tween`, and the playground

After Mukherjee and Gopi, *Tweening Boundary Curves of Non-simple Immersions of a Disk*.
"""

import lazy_loader

# The names are listed in __init__.pyi, for type checkers and for this line: a name is imported when it is first used,
# so that `tween --help` does not wait for numba.
__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
