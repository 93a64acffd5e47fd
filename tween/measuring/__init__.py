"""How good a morph is, by the measures of Table 1, and whether it is one: certificates."""
