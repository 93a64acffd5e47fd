"""Figures and animations, as if drawn by one hand; only here matplotlib is imported."""

from tween.colors import EDGE, FAILURE, INK, PIVOT, RANDOM, SOURCE, TARGET, TREE
from tween.plot.animation import save_animation
from tween.plot.explanation import draw_explanation, save_explanation
from tween.plot.measures import draw_angle_sums, draw_area_matrix, draw_singular_values, draw_winding
from tween.plot.notebook import slider
from tween.plot.shapes import (
    draw_dual_tree,
    draw_filmstrip,
    draw_shape,
    draw_spine,
    draw_triangulation,
    identity_colors,
    regions,
    use_style,
    winding_number,
)

__all__ = [
    "EDGE",
    "FAILURE",
    "INK",
    "PIVOT",
    "RANDOM",
    "SOURCE",
    "TARGET",
    "TREE",
    "draw_angle_sums",
    "draw_area_matrix",
    "draw_dual_tree",
    "draw_explanation",
    "draw_filmstrip",
    "draw_shape",
    "draw_singular_values",
    "draw_spine",
    "draw_triangulation",
    "draw_winding",
    "identity_colors",
    "regions",
    "save_animation",
    "save_explanation",
    "slider",
    "use_style",
    "winding_number",
]
