"""The words that options take, each list once; it imports nothing, so that help comes at once."""

from typing import Literal, get_args

Path = Literal["linear", "slide", "angle", "area", "metric"]
PATHS: tuple[Path, ...] = get_args(Path)
RootRule = Literal["disk-center", "tree-center"]
ROOT_RULES: tuple[RootRule, ...] = get_args(RootRule)
Root = RootRule | int
Strategy = Literal["auto", "matched", "common", "paper"]
STRATEGIES: tuple[Strategy, ...] = get_args(Strategy)
Placement = Literal["steady", "root"]
PLACEMENTS: tuple[Placement, ...] = get_args(Placement)
Pace = Literal["auto", "time", "speed"]
PACES: tuple[Pace, ...] = get_args(Pace)
Order = Literal["partial", "sequential"]
ORDERS: tuple[Order, ...] = get_args(Order)
ShiftRule = Literal["pivots", "all"]
SHIFT_RULES: tuple[ShiftRule, ...] = get_args(ShiftRule)
Shifts = ShiftRule | int
Style = Literal["triangles", "outline", "fill"]
STYLES: tuple[Style, ...] = get_args(Style)
Fit = Literal["none", "area", "box"]
FITS: tuple[Fit, ...] = get_args(Fit)
SIZES = (16, 2048)  # pixels that a picture's side may have
