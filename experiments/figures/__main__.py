"""Draw every figure."""

from experiments.figures.everything import save_all

save_all()
