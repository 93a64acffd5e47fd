"""Recognising a curve, and its triangulations: arbitrary, random, best, remeshed, compatible (Section 4)."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach(
    __name__,
    submodules={"compatibility", "costs", "decomposition", "flips", "reduction", "repair", "restoration", "table"},
)
