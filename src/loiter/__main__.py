"""The program: `loiter`, and `python -m loiter` for environments whose programs are not on the path."""

import os
import signal
import sys

from loiter.cli.status import INTERRUPTED


def main() -> int:
    """Import the command line and run it; an interrupt during the imports ends the program at once, without a word."""
    waits = signal.getsignal(signal.SIGINT) is signal.default_int_handler
    if waits:
        # An exception could end in a callback of the import system, which prints it and goes on.
        signal.signal(signal.SIGINT, lambda *_: os._exit(INTERRUPTED))
    from loiter.cli import app

    try:
        if waits:
            signal.signal(signal.SIGINT, signal.default_int_handler)
        return app.main()
    except KeyboardInterrupt:
        return INTERRUPTED


if __name__ == "__main__":
    sys.exit(main())
