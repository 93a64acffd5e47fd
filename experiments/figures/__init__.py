"""The figures of the paper, and ours: `python -m experiments.figures` draws them all into results/figures/."""
