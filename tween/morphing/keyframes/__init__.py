"""Morphs through several shapes: one numbering of vertices for all of them."""
