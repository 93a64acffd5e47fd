"""Points, curves, triangulated disks and their dual trees, on which everything rests."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach(
    __name__,
    submodules={"angles", "curve", "dual_tree", "faces", "predicates", "triangulation"},
)
