"""A replication report of a few pages: `python -m experiments.article` writes results/article.pdf."""
