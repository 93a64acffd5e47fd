"""The best correspondence and the best common triangulation together: one table over pairs of chords."""
