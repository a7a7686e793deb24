"""`loiter warm-up`: everything compiled beforehand that would otherwise be compiled when it is first needed."""

from loiter.cli import report
from loiter.compiled import announce_with, objects, warming
from loiter.errors import InvalidArgument


def warm_up() -> None:
    """Compile for this machine, once, what commands would otherwise compile when they first need it."""
    announce_with(lambda sentence: report.write_now(f"{sentence[0].upper()}{sentence[1:]}."))
    for part in warming.warm_up():
        report.write_now(f"{part.name}: {f'compiled in {part.seconds:.0f} s' if part.compiled else 'compiled already'}")
    if not warming.is_kept():
        raise InvalidArgument(
            "cache", f"folder {str(objects.folder())!r} cannot be written: every process compiles anew"
        )
    report.write_now(f"The machine code is in {objects.folder()}; commands load it in a tenth of a second.")
