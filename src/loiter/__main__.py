"""The program: `loiter`, and `python -m loiter` for environments whose programs are not on the path."""

import sys

from loiter.cli.status import INTERRUPTED


def main() -> int:
    """Import the command line and run it; an interrupt during the imports gets a sentence too."""
    try:
        from loiter.cli import app

        return app.main()
    except KeyboardInterrupt:
        print("loiter: interrupted", file=sys.stderr)  # noqa: T201
        return INTERRUPTED


if __name__ == "__main__":
    sys.exit(main())
