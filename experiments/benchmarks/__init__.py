"""Times, beside peers in one process: `tasks` at usual sizes, `scaling` up to 100,000 vertices."""
