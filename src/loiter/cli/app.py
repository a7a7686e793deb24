"""The commands, and `main`, which turns errors into one sentence and an exit status."""

import sys
from collections.abc import Sequence
from typing import Any

from cyclopts import App, CycloptsError, Group, Parameter

import loiter
from loiter.cli.arguments import prepare
from loiter.cli.command import EPILOGUE, PROGRAM, commands
from loiter.cli.command import GROUPS as GROUP_NAMES
from loiter.cli.sentences import sentence
from loiter.cli.status import INTERRUPTED, LINK_FAILED, USAGE_ERROR, abandon_output
from loiter.errors import LinkFailed, LoiterError


def shown_default(value: Any) -> str | None:
    """A default as the help shows it: "0 0" for two numbers; None for flags, whose default is their absence."""
    if isinstance(value, bool) or value in (None, ()):
        return None
    values = value if isinstance(value, tuple) else (value,)
    return " ".join(f"{each:g}" if isinstance(each, float) else str(each) for each in values)


GROUPS = {name: Group(name, sort_key=order) for order, name in enumerate(GROUP_NAMES)}

app = App(
    name="loiter",
    group_commands=GROUPS[PROGRAM],
    version=loiter.__version__,
    version_flags=["--version", "-V"],
    usage="Usage: loiter COMMAND [OPTIONS]",
    default_parameter=Parameter(negative="", show_default=shown_default),
    suppress_keyboard_interrupt=False,
    help_format="plaintext",
    help="""The fastest way onto a holding circle for a fixed-wing aircraft.

An aircraft of constant speed turns left or right, no tighter than its minimum turn radius. The plan joins a circle tangentially in the least time and stays on it, clockwise or counter-clockwise, whichever is sooner. In still air the answer is the fastest extremal of Pontryagin's maximum principle, in closed form: proved to be the optimum (evidence/docs/proof.md). In wind, and onto a circle that moves, a search (branch and bound over the point of joining) finds the answer.

Positions are metres east and north of a local origin of your choice, or WGS84 degrees; headings are degrees clockwise from north. Speeds are in metres per second and lengths in metres, or have a unit: 35kn, 65km/h, 40mph, 3000ft, 2NM. Directions are true, 90 or 90T; magnetic ones, 87M, need --declination. A wind is its speed and the direction that it comes from, 15kn 250, or as in weather reports 250/15kn or 25015KT. Latitudes come before longitudes; with their letters, 47.1N, N47.1, 47°06'N, 47:06:00N or N47 06.0, they cannot be confused. Commas may separate the numbers of an option.

loiter COMMAND --help shows the options of a command.""",
    help_epilogue=EPILOGUE,
)  # fmt: skip


# The module of a command is imported when it runs.
for order, command in enumerate(commands()):
    app.command(
        command.function,
        name=command.name,
        group=GROUPS[command.group],
        sort_key=order,
        usage=command.usage,
        help_epilogue=command.epilogue,
        help=command.help,
    )


def main(arguments: Sequence[str] | None = None, program: App = app) -> int:
    """Run a command line and return the exit status; an error prints one sentence to standard error."""
    try:
        status = program(
            prepare(sys.argv[1:] if arguments is None else arguments),
            exit_on_error=False,
            print_error=False,
            result_action="return_value",
        )
        sys.stdout.flush()
    except (BrokenPipeError, SystemExit):
        # The reader of a pipe, such as `head`, has closed it: no error. In the help, rich raises SystemExit for it.
        abandon_output()
        return 0
    except (LoiterError, CycloptsError, OSError) as error:
        print(f"loiter: {sentence(error)}", file=sys.stderr)  # noqa: T201
        if isinstance(error, OSError):
            abandon_output()
        return LINK_FAILED if isinstance(error, LinkFailed) else USAGE_ERROR
    except KeyboardInterrupt as interrupt:
        # The message of a batch job says which parts are kept.
        if str(interrupt):
            print(f"loiter: {interrupt}", file=sys.stderr)  # noqa: T201
        return INTERRUPTED
    return status or 0
