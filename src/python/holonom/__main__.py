"""The command line: ``python -m holonom simulate scene.json``."""

import signal
import sys

from . import _core


def main() -> None:
    """Runs the command line and exits with its code."""
    # The command line has a handler of its own, which writes the results so far.
    signal.signal(signal.SIGINT, signal.SIG_DFL)
    sys.exit(_core.main(["holonom", *sys.argv[1:]]))


if __name__ == "__main__":
    main()
