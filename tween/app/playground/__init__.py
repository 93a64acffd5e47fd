"""A playground to draw in, in a notebook."""
