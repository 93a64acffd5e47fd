"""Everything on one page: `python -m experiments.report` writes results/report.html."""
