"""The commands, and the one place where an error becomes a sentence and an exit status."""

import os
import sys
from collections.abc import Sequence
from contextlib import suppress
from dataclasses import replace
from pathlib import Path
from typing import Annotated, Literal

from cyclopts import App, CycloptsError, Group, Parameter

import loiter
from loiter.cli import certificates, report
from loiter.cli.sentences import sentence
from loiter.cli.status import CHECK_FAILED, INTERRUPTED, USAGE_ERROR
from loiter.errors import LoiterError
from loiter.planning.model import CALM, Aircraft, Orbit, Pose, Turn, Wind
from loiter.plot import files

app = App(
    name="loiter",
    version=loiter.__version__,
    usage="Usage: loiter COMMAND [OPTIONS]",
    default_parameter=Parameter(negative=""),
    suppress_keyboard_interrupt=False,
    help_format="plaintext",
    help="""The fastest way onto a holding circle for a fixed-wing aircraft.

An aircraft of constant speed turns left or right, no tighter than its turn radius. It is to join a circle tangentially, in the least time, and to stay on it, clockwise or counter-clockwise, whichever is sooner. The answer is exact: the least of the extremals of Pontryagin's maximum principle that can win, in closed form. In wind, and onto a circle that moves, it is found by branch and bound over the point of joining.

Positions are metres east and north of any local origin; headings are degrees clockwise from north.""",
    help_epilogue="""Examples
  loiter plan --pose -400 120 90 --orbit 0 0 80 --airspeed 18 --bank 35
  loiter plan --pose -400 120 90 --orbit 0 0 80 --turn cw \\
      --airspeed 18 --turn-radius 50 --plot entry.png
  loiter plan --pose -400 120 90 --orbit 0 0 120 --wind 8 250 \\
      --airspeed 18 --bank 35
  eval "$(loiter completion bash)"

Exit status
  0  done
  1  a check failed (loiter verify, loiter plan --certify)
  2  the request cannot be met: one sentence on standard error says why,
     and no file is left half written
  130  interrupted; what a batch job has finished is kept""",
)  # fmt: skip

scene = Group("Scene", sort_key=1)
air = Group("Wind, and circles that move", sort_key=3)
aircraft = Group("Aircraft: the airspeed and exactly one limit on the turn", sort_key=2)
output = Group("Output", sort_key=4)


@app.command(name="plan")
def plan_command(
    *,
    pose: Annotated[
        tuple[float, float, float],
        Parameter(group=scene, metavar="EAST NORTH HEADING", help="The aircraft: metres, and degrees from north."),
    ],
    orbit: Annotated[
        tuple[float, float, float],
        Parameter(group=scene, metavar="EAST NORTH RADIUS", help="The circle: its centre and its radius, metres."),
    ],
    turn: Annotated[
        Literal["either", "cw", "ccw"],
        Parameter(group=scene, help="Direction in which the circle is held, seen from above."),
    ] = "either",
    tolerance: Annotated[
        float,
        Parameter(
            group=scene,
            metavar="METRES",
            help="In still air: metres by which a start may lie beyond the last arc and still count as on it, so that noise "
            "does not send the aircraft round again.",
        ),
    ] = 0.0,
    wind: Annotated[
        tuple[float, float] | None,
        Parameter(
            group=air, metavar="SPEED FROM", help="Metres per second, and the compass direction the wind comes from."
        ),
    ] = None,
    orbit_velocity: Annotated[
        tuple[float, float],
        Parameter(
            group=air,
            metavar="EAST NORTH",
            help="How the circle moves over the ground, metres per second; --orbit is where it is at the start.",
        ),
    ] = (0.0, 0.0),
    airspeed: Annotated[float, Parameter(group=aircraft, metavar="M_PER_S", help="True airspeed, metres per second.")],
    bank: Annotated[float | None, Parameter(group=aircraft, metavar="DEGREES", help="Largest bank, degrees.")] = None,
    turn_radius: Annotated[
        float | None, Parameter(group=aircraft, metavar="METRES", help="Smallest turn radius, metres.")
    ] = None,
    turn_rate: Annotated[
        float | None, Parameter(group=aircraft, metavar="DEG_PER_S", help="Largest turn rate, degrees per second.")
    ] = None,
    all_: Annotated[
        bool, Parameter(name="--all", group=output, help="Show every optimal maneuver, where several tie.")
    ] = False,
    json: Annotated[
        bool,
        Parameter(
            group=output,
            help="Print one JSON object, with the losing extremals among its alternatives.",
        ),
    ] = False,
    plot: Annotated[
        Path | None, Parameter(group=output, metavar="FILE", help="Draw the plan to a file: .png, .svg or .pdf.")
    ] = None,
    certify: Annotated[
        bool,
        Parameter(
            group=output,
            help="Prove each maneuver shown by the maximum principle, equation by equation; JSON, and the picture that --plot then draws to FILE-certificate, hold the proof of the first.",
        ),
    ] = False,
) -> int:
    """Plan the fastest entry onto a holding circle: what to fly, for how long, where to peel off."""
    if plot is not None:
        files.check_format(plot)
    uav = Aircraft(airspeed, max_bank_deg=bank, min_turn_radius_m=turn_radius, max_turn_rate_deg_s=turn_rate)
    start, circle = Pose(*pose), Orbit(*orbit, Turn(turn), *orbit_velocity)
    moving_air = CALM if wind is None else Wind(*wind)
    best = loiter.plan_all(start, circle, uav, moving_air, tolerance_m=tolerance)
    # What the other direction would cost is told even where one was asked for.
    known = loiter.candidates(start, replace(circle, turn=Turn.EITHER), uav, moving_air, tolerance_m=tolerance)
    others = [m for m in known if not any(m.turn == b.turn and m.segments == b.segments for b in best)]
    proofs = [loiter.verify.certify(m, tolerance_m=tolerance) for m in (best if all_ else best[:1]) if certify]
    if plot is not None:
        losers = [m for m in others if turn in ("either", m.turn)]
        files.save(plot, best if all_ else best[:1], losers if all_ else [*best[1:], *losers])
        if proofs:
            certificates.save_picture(plot, proofs[0])
    if json:
        proof = {"certificate": proofs[0].to_dict()} if proofs else {}
        report.print_json(report.answer(best, others) | proof)
    else:
        report.print_tables(best, others, everything=all_)
        certificates.print_text(proofs)
    return 0 if all(proof.valid for proof in proofs) else CHECK_FAILED


# Loaded when it is asked for: a single plan needs no arrays.
app.command(
    "loiter.cli.batch:batch",
    help="""Plan the fastest entry of every row of a table: Parquet or CSV, any size.

IN has the columns east_m, north_m and heading_deg. It may have orbit_east_m, orbit_north_m and orbit_radius_m; turn (cw, ccw or either); airspeed_m_s; max_bank_deg, min_turn_radius_m or max_turn_rate_deg_s; wind_speed_m_s and wind_from_deg; and orbit_velocity_east_m_s and orbit_velocity_north_m_s. What no column gives, an option must, but for the turn, the wind and the circle's velocity.

OUT has the columns and the rows of IN, in their order, and then duration_s, word, turn (cw or ccw, in the place of that asked for), join_east_m, join_north_m, join_heading_deg, duration_1_s, duration_2_s, duration_3_s and status. A bad row gets nan, or an empty field, and a status other than ok; it stops nothing.

OUT appears whole or not at all. What is finished is kept in OUT.parts until then: a job that was interrupted goes on from there when the same command is given again.""",
)
app.command(
    "loiter.cli.synthesis:synthesis",
    help="Map the optimal synthesis of the reduced plane: which word wins where, and the curves between the regions.",
)
app.command(
    "loiter.cli.figures:figures", help="Draw the seven figures of the paper from the code, with captions of their own."
)


app.command(
    "loiter.cli.verify:verify",
    help="Compare plans with independent witnesses: search, 50 digits, collocation, reachability.",
)


@app.command
def completion(shell: Literal["bash", "zsh", "fish"], /) -> None:
    """Print a completion script: `eval "$(loiter completion bash)"`.

    Parameters
    ----------
    shell
        The shell that is to complete commands and options.
    """
    sys.stdout.write(app.generate_completion(shell=shell))


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command line; returns the exit status, 2 after one sentence on standard error."""
    try:
        status = app(arguments, exit_on_error=False, print_error=False, result_action="return_value")
        sys.stdout.flush()
    except (BrokenPipeError, SystemExit):
        # Rich turns the first into the second where it prints help.
        # The reader of a pipe has left, as `head` does; nothing is wrong.
        _abandon_output()
        return 0
    except (LoiterError, CycloptsError, OSError) as error:
        print(f"loiter: {sentence(error)}", file=sys.stderr)  # noqa: T201
        if isinstance(error, OSError):
            _abandon_output()
        return USAGE_ERROR
    except KeyboardInterrupt as interrupt:
        # A batch job says what is kept of it.
        if str(interrupt):
            print(f"loiter: {interrupt}", file=sys.stderr)  # noqa: T201
        return INTERRUPTED
    return status or 0


def _abandon_output() -> None:
    # What is still buffered would fail again when the interpreter ends.
    with suppress(OSError, ValueError):
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
