"""`make prove`: the lemmas of proof.md, checked in exact algebra and ball arithmetic."""

from typing import Annotated

from cyclopts import Parameter
from rich.console import Console
from rich.progress import track
from rich.table import Table

from evidence.proof.lemmas import LEMMAS, ROUNDING, Finding
from evidence.proof.lemmas import prove as findings_of
from loiter.cli import report
from loiter.cli.status import CHECK_FAILED


def prove(
    *,
    rounding: Annotated[
        bool,
        Parameter(negative="", help="Bound the rounding error of T instead (theorem 4), which takes half a minute."),
    ] = False,
) -> int:
    """Check the lemmas of proof.md on the kernel's own formulas; exit status 1 where one is not certain."""
    lemmas = ROUNDING if rounding else LEMMAS
    results = findings_of(lemmas)
    # The progress goes to standard error, so that standard output contains the result only.
    found = list(track(results, description="prove", total=len(lemmas), console=Console(stderr=True)))
    failures = [finding for finding in found if finding.failure]
    report.write(table(found), *(f"{finding.lemma.section}: {finding.failure}." for finding in failures))
    return CHECK_FAILED if failures else 0


def table(found: list[Finding]) -> Table:
    """A table with a row for each lemma."""
    rows = report.new_table()
    for heading in ("lemma", "statement"):
        rows.add_column(heading)
    for heading in ("cases, boxes", "depth", "seconds"):
        rows.add_column(heading, justify="right")
    rows.add_column("verdict")
    for finding in found:
        section, statement, *_ = finding.lemma
        cases, depth = finding.certainty
        rows.add_row(section, statement, str(cases), str(depth), f"{finding.seconds:.2f}", finding.verdict)
    return rows
