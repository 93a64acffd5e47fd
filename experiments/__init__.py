"""Studies: one module each, `python -m experiments.NAME`, results in results/."""
