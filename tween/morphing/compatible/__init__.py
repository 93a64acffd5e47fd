"""Motion under one triangulation: paths of the third vertex, and what keeps angles below 2 pi (Section 5)."""
