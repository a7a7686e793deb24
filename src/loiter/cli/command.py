"""The commands of the program: each room of the package lists its own, and the program finds them."""

from __future__ import annotations

from collections.abc import Iterator
from importlib import import_module
from pathlib import Path
from typing import NamedTuple

import loiter

PLANS = "Plans"
FLIGHTS = "Flights: simulated, and of vehicles over MAVLink"
THEORY = "Theory: maps and figures"
PROGRAM = "The program"

# Groups in the order of the help.
GROUPS = (PLANS, FLIGHTS, THEORY, PROGRAM)

# The exit statuses of every command, and of the program as a whole.
DONE = "  0  done"
CHECK_FAILED = "  1  a check failed"
REFUSED = """  2  the request cannot be met: one sentence on standard error says why,
     and no file is left half written"""
LINK_FAILED = "  3  the vehicle cannot be reached, does not answer or refuses"
INTERRUPTED = "  130  interrupted"


# The end of the help of the program.
EPILOGUE = "\n".join(
    (
        "Examples",
        "  loiter plan --pose -400 120 90 --orbit 0 0 80 --airspeed 18 --bank 35",
        '  eval "$(loiter completion bash)"',
        "",
        "Exit status",
        *(DONE, CHECK_FAILED, REFUSED, LINK_FAILED, INTERRUPTED),
    )
)


class Command(NamedTuple):
    """A command: its name, its function ("module:name"), what the help says of it, and where that is listed.

    `order` is its place in its group. `examples` are command lines, indented; `statuses` are the exit statuses that it
    has besides 0 and 2, in the words of the help. `usage` replaces the usage that is derived from its options.
    """

    name: str
    function: str
    group: str
    order: int
    help: str
    examples: str
    statuses: tuple[str, ...] = ()
    usage: str | None = None

    @property
    def epilogue(self) -> str:
        """The end of its help: examples and exit statuses."""
        return "\n".join(
            ("Examples" + self.examples, "", "Exit status", *sorted((DONE, REFUSED, *self.statuses), key=_number))
        )


def commands() -> list[Command]:
    """The commands of all rooms that are installed: those in `COMMANDS` of their modules `program`, in order."""
    found = [command for room in _programs() for command in import_module(room).COMMANDS]
    return sorted(found, key=lambda command: (GROUPS.index(command.group), command.order))


def _number(status: str) -> int:
    """The number of an exit status, with which its text begins."""
    return int(status.split()[0])


def _programs() -> Iterator[str]:
    """The modules `program` of the rooms; looking for their files imports no room."""
    for folder in map(Path, loiter.__path__):
        for file in sorted(folder.glob("*/program.py")):
            yield f"loiter.{file.parent.name}.program"
