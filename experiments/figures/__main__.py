"""Draw every figure, or those that are named: ``python -m experiments.figures figure_04_interiors verdicts``."""

import sys

from experiments.figures.everything import save_all, save_some

if len(sys.argv) > 1:
    save_some(sys.argv[1:])
else:
    save_all()
