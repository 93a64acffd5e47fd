"""The command `tween`, as ``python -m tween``."""

import sys

from tween.app.command_line.main import main

if __name__ == "__main__":
    sys.exit(main())
