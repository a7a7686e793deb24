"""The commands, and `main`, which turns errors into one sentence and an exit status."""

import sys
from collections.abc import Callable, Sequence
from typing import Any, Literal

from cyclopts import App, CycloptsError, Group, Parameter

import loiter
from loiter.cli.arguments import prepare
from loiter.cli.examples import epilogue, program_epilogue
from loiter.cli.sentences import sentence
from loiter.cli.status import INTERRUPTED, LINK_FAILED, USAGE_ERROR, abandon_output
from loiter.errors import LinkFailed, LoiterError


def shown_default(value: Any) -> str | None:
    """A default as the help shows it: "0 0" for two numbers; None for flags, whose default is their absence."""
    if isinstance(value, bool) or value in (None, ()):
        return None
    values = value if isinstance(value, tuple) else (value,)
    return " ".join(f"{each:g}" if isinstance(each, float) else str(each) for each in values)


planning = Group("Plans", sort_key=1)
flights = Group("Flights: simulated, and of vehicles over MAVLink", sort_key=2)
theory = Group("Theory: maps, figures and independent checks", sort_key=3)
program = Group("The program", sort_key=4)

app = App(
    name="loiter",
    group_commands=program,
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
    help_epilogue=program_epilogue("plan", "completion"),
)  # fmt: skip


# The commands of each group in the order of the help: where their functions are, and what they do.
COMMANDS = (
    (
        planning,
        {
            "plan:plan": """Plan the fastest entry onto a holding circle: which turns to fly, for how long, and where to peel off.

It needs a start (--pose), a circle (--orbit), the airspeed, and one limit on the turn (--bank, --turn-radius or --turn-rate). Everything else is optional.""",
            "legs:leg": """Plan the fastest way in, round and out of a holding circle: the entry, how long to hold, and where to leave.

It needs what loiter plan needs, and the point to fly to afterwards (--exit-to). The aircraft leaves the circle on the tangent to that point, once the least hold, the turns and the altitude are reached; all of them together take the least time.""",
            "fleet:fleet": """Plan the entries of several aircraft onto one circle, each into a slot: a place that moves round the circle with the hold.

FILE is a CSV file with a row for each aircraft: its position and heading, in the columns of loiter batch, and a name if it has a column name. They are of one kind, and share the circle, the airspeed, the turn limit and the wind. Their slots pass a place at equal intervals; which aircraft takes which slot brings the last one in soonest.""",
            "legs:land": """Plan the fastest landing by a circle beside the final approach: the entry, the way down, and the approach.

It needs a start with --pose and --altitude, the runway (--runway, --elevation), the circle's --radius, the least length of the final approach (--final), the airspeed, one limit on the turn, and the --descent-rate. The circle touches the final approach, to its right or to its left, and is left at the altitude of the glide slope; side, turns and entry are those with the least time over the threshold.""",
            "batch:batch": """Plan the fastest entry for every row of a table: Parquet or CSV, any size.

IN has the columns east_m, north_m and heading_deg. It may have orbit_east_m, orbit_north_m and orbit_radius_m; turn (cw, ccw or either); airspeed_m_s; max_bank_deg, min_turn_radius_m or max_turn_rate_deg_s; wind_speed_m_s and wind_from_deg; and orbit_velocity_east_m_s and orbit_velocity_north_m_s. Values without a column come from options; all are needed except the turn, the wind and the circle's velocity.

OUT has the rows and the columns of IN, in their order, and then duration_s, word, turn (the direction of the plan, cw or ccw, in place of the turn of IN), join_east_m, join_north_m, join_heading_deg, duration_1_s, duration_2_s, duration_3_s and status. A bad row gets nan or empty fields and a status other than ok; the job goes on.

IN is a file, a folder of files, a pattern such as 'states-*.parquet' in quotes, or a URL of one of these: s3://, gs:// or az://. OUT is a file, or with a slash at the end, OUT/, a folder of Parquet files (a dataset, as Dask, Spark, DuckDB and Polars read it), or a URL of one of these. Many workers fill a folder faster than a file.

A file is written whole or not at all. Until then finished parts are kept in OUT.parts. In a folder each part is written whole or not at all, and _SUCCESS says that all are there. Run the same command again to continue an interrupted job.""",
            "serve:serve": "Serve, over HTTP, plans for programs and a page that shows the plan while you drag the aircraft.",
        },
    ),
    (
        flights,
        {
            "fly:fly": """Simulate flights: a guidance law flies the fastest entry in closed loop, compared with the laws that autopilots use today.

One flight needs the same options as loiter plan; --runs flies from random starts. No vehicle is connected: for that there is loiter guide.""",
            "mavlink:upload": "Send the fastest entry to a vehicle as a mission, then read the mission back and compare it item by item.",
            "mavlink:watch": "Listen to a vehicle and print, live, the fastest entry from its position.",
            "guide:guide": """Guide a vehicle in flight onto the circle in least time, then hand it over to its own hold of the circle.

First the vehicle is commanded to hold the circle by its own guidance, the fall-back circle. Then its bank is commanded many times a second: ArduPlane's in GUIDED, PX4's in OFFBOARD; the autopilot holds altitude and airspeed. Once the circle is held steadily, the vehicle confirms that it holds it by its own guidance, and nothing more is sent. The vehicle must be in flight, and it and the circle at least 30 m above home: it is never armed, and never takes off or lands.

Before the first command a summary shows what is taken over and what happens if the link dies, and a question is asked; --yes answers it. Guiding stops at once, and one sentence says why, if the link or the telemetry is lost, the pilot or a failsafe changes the mode, another station commands, the altitude departs, or at Ctrl-C; the vehicle then flies the fall-back circle, or what the pilot wants. Airspeed and bank limit are those of the autopilot's parameters unless options give them. docs/autopilots.md has the details.""",
        },
    ),
    (
        theory,
        {
            "synthesis:synthesis": "Map the optimal synthesis of the reduced plane: the fastest word in each region, and the curves between the regions.",
            "figures:figures": "Draw the seven figures of the paper, and write their captions.",
        },
    ),
)
# An unknown command is answered with the first eight that are added: the simulator and the service come after them.
LISTED_LATER = ("fly", "serve")


def add_commands(names: Callable[[str], bool]) -> None:
    """Add the commands with these names; the module of a command is imported when it runs."""
    for group, commands in COMMANDS:
        for order, (target, text) in enumerate(commands.items()):
            name = target.partition(":")[2]
            if names(name):
                place = f"loiter.cli.commands.{target}"
                usage = "Usage: loiter upload --connect LINK [OPTIONS] [FILE]" if name == "upload" else None
                app.command(place, group=group, sort_key=order, usage=usage, help_epilogue=epilogue(name), help=text)


add_commands(lambda name: name not in LISTED_LATER)
add_commands(lambda name: name in LISTED_LATER)


@app.command(help_epilogue=epilogue("completion"))
def completion(shell: Literal["bash", "zsh", "fish"], /) -> None:
    """Print a completion script: `eval "$(loiter completion bash)"`.

    Parameters
    ----------
    shell
        The shell for which the script completes commands and options.
    """
    sys.stdout.write(app.generate_completion(shell=shell))


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
