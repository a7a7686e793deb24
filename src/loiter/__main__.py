"""`python -m loiter`: the command line, for environments whose programs are not on the path."""

import sys

from loiter.cli.app import main

if __name__ == "__main__":
    sys.exit(main())
