"""The command `tween`, as ``python -m tween``."""

import sys

from tween.cli import main

if __name__ == "__main__":
    sys.exit(main())
