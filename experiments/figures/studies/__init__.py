"""What the studies found, drawn from results/; and what a study is about, drawn from a curve or two."""
