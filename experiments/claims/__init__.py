"""What the paper claims, and whether it holds: `python -m experiments.claims` writes results/claims.csv."""
