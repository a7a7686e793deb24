"""Exit statuses of the program, and the end of its output."""

import os
import sys
from contextlib import suppress

CHECK_FAILED = 1
USAGE_ERROR = 2
LINK_FAILED = 3
INTERRUPTED = 130  # 128 + SIGINT, as shells report it


def abandon_output() -> None:
    """Send what is still to be printed nowhere: otherwise the interpreter would fail when it flushes its buffers."""
    with suppress(OSError, ValueError):
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
