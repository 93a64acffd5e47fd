"""Pivots that match two curves, and flips from one triangulation to the other (Section 6)."""
