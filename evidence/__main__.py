"""`python -m evidence verify` and `python -m evidence prove`: the evidence for the kernel, as programs."""

import sys

from cyclopts import App

from evidence.prove import prove
from evidence.verify import verify
from loiter.cli.app import main

program = App(
    name="evidence", help="Evidence for the answers of `loiter`, for referees: independent methods and proofs."
)
program.command(verify)
program.command(prove)

if __name__ == "__main__":
    sys.exit(main(sys.argv[1:], program))
