"""The commands of this room, as the program lists them."""

from loiter.cli.command import FLIGHTS, PLANS, PROGRAM, THEORY, Command

UNREACHED = """  3  the vehicle cannot be reached, does not answer or refuses: the sentence
     says what it has now"""

COMMANDS = (
    Command(
        "plan",
        "loiter.cli.commands.plan:plan",
        PLANS,
        10,
        help="""Plan the fastest entry onto a holding circle: which turns to fly, for how long, and where to peel off.

It needs a start (--pose), a circle (--orbit), the airspeed, and one limit on the turn (--bank, --turn-radius or --turn-rate). Everything else is optional.""",
        examples=r"""
  loiter plan --pose -400 120 90 --orbit 0 0 80 --airspeed 18 --bank 35
  loiter plan --pose -400 120 90 --orbit 0 0 80 --turn cw \
      --airspeed 18 --turn-radius 50 --plot entry.png
  loiter plan --pose -400 120 90 --orbit 0 0 120 --wind 8 250 \
      --airspeed 18 --bank 35 --certify
  loiter plan --pose-lla 47.1 8.2 90 --orbit-lla 47.11 8.23 120 \
      --airspeed 18 --bank 35 --altitude 900 --save entry.plan
  loiter plan --pose-lla 47.1 8.2 90 --orbit-lla 47.11 8.23 120 \
      --airspeed 18 --bank 35 --fence field.plan --margin 20""",
        statuses=("  1  a check failed: --certify or --fence",),
    ),
    Command(
        "leg",
        "loiter.cli.commands.legs:leg",
        PLANS,
        20,
        help="""Plan the fastest way in, round and out of a holding circle: the entry, how long to hold, and where to leave.

It needs what loiter plan needs, and the point to fly to afterwards (--exit-to). The aircraft leaves the circle on the tangent to that point, once the least hold, the turns and the altitude are reached; all of them together take the least time.""",
        examples=r"""
  loiter leg --pose -400 120 90 --orbit 0 0 80 --exit-to 600 0 \
      --airspeed 18 --bank 35 --hold 60 --plot leg.png
  loiter leg --pose -400 120 90 --orbit 0 0 120 --exit-to 600 0 \
      --airspeed 18 --bank 35 --wind 8 250 \
      --altitude 100 --to-altitude 300 --climb-rate 2.5""",
    ),
    Command(
        "fleet",
        "loiter.cli.commands.fleet:fleet",
        PLANS,
        30,
        help="""Plan the entries of several aircraft onto one circle, each into a slot: a place that moves round the circle with the hold.

FILE is a CSV file with a row for each aircraft: its position and heading, in the columns of loiter batch, and a name if it has a column name. They are of one kind, and share the circle, the airspeed, the turn limit and the wind. Their slots pass a place at equal intervals; which aircraft takes which slot brings the last one in soonest.""",
        examples=r"""
  loiter fleet fleet.csv --orbit 0 0 120 --airspeed 18 --bank 35 \
      --separation 100 --plot fleet.png
  loiter fleet fleet.csv --orbit-lla 47.11 8.23 120 --airspeed 18 \
      --bank 35 --wind 8 250 --altitude 900 --save fleet.kml""",
    ),
    Command(
        "batch",
        "loiter.cli.commands.batch:batch",
        PLANS,
        50,
        help="""Plan the fastest entry for every row of a table: Parquet or CSV, any size.

IN has the columns east_m, north_m and heading_deg. It may have orbit_east_m, orbit_north_m and orbit_radius_m; turn (cw, ccw or either); airspeed_m_s; max_bank_deg, min_turn_radius_m or max_turn_rate_deg_s; wind_speed_m_s and wind_from_deg; and orbit_velocity_east_m_s and orbit_velocity_north_m_s. Values without a column come from options; all are needed except the turn, the wind and the circle's velocity.

OUT has the rows and the columns of IN, in their order, and then duration_s, word, turn (the direction of the plan, cw or ccw, in place of the turn of IN), join_east_m, join_north_m, join_heading_deg, duration_1_s, duration_2_s, duration_3_s and status. A bad row gets nan or empty fields and a status other than ok; the job goes on.

IN is a file, a folder of files, a pattern such as 'states-*.parquet' in quotes, or a URL of one of these: s3://, gs:// or az://. OUT is a file, or with a slash at the end, OUT/, a folder of Parquet files (a dataset, as Dask, Spark, DuckDB and Polars read it), or a URL of one of these. Many workers fill a folder faster than a file.

A file is written whole or not at all. Until then finished parts are kept in OUT.parts. In a folder each part is written whole or not at all, and _SUCCESS says that all are there. Run the same command again to continue an interrupted job.""",
        examples=r"""
  loiter batch states.parquet entries/ --orbit 0 0 80 \
      --airspeed 18 --bank 35
  loiter batch states.csv entries.csv --airspeed 18 --turn-radius 50 \
      --wind 8 250 --workers 4
  loiter batch 's3://tables/states-*.parquet' s3://tables/entries/ \
      --orbit 0 0 80 --airspeed 18 --bank 35""",
        statuses=("  130  interrupted; finished parts of a batch job are kept",),
    ),
    Command(
        "upload",
        "loiter.cli.commands.mavlink:upload",
        FLIGHTS,
        80,
        help="""Send the fastest entry to a vehicle as a mission, then read the mission back and compare it item by item.""",
        examples=r"""
  loiter upload --connect udpin:127.0.0.1:14550 --pose-lla 47.1 8.2 90 \
      --orbit-lla 47.11 8.23 120 --airspeed 18 --bank 35 --altitude 900
  loiter upload entry.plan --connect /dev/ttyUSB0,57600""",
        statuses=(UNREACHED,),
        usage="Usage: loiter upload --connect LINK [OPTIONS] [FILE]",
    ),
    Command(
        "watch",
        "loiter.cli.commands.mavlink:watch",
        FLIGHTS,
        90,
        help="""Listen to a vehicle and print, live, the fastest entry from its position.""",
        examples=r"""
  loiter watch --connect udpin:127.0.0.1:14550 \
      --orbit-lla 47.11 8.23 120 --airspeed 18 --bank 35
  loiter watch --connect udpin:127.0.0.1:14550 --reports 10 \
      --orbit-lla 47.11 8.23 --params uav.param""",
        statuses=(UNREACHED,),
    ),
    Command(
        "guide",
        "loiter.cli.commands.guide:guide",
        FLIGHTS,
        100,
        help="""Guide a vehicle in flight onto the circle in least time, then hand it over to its own hold of the circle.

First the vehicle is commanded to hold the circle by its own guidance, the fall-back circle. Then its bank is commanded many times a second: ArduPlane's in GUIDED, PX4's in OFFBOARD; the autopilot holds altitude and airspeed. Once the circle is held steadily, the vehicle confirms that it holds it by its own guidance, and nothing more is sent. The vehicle must be in flight, and it and the circle at least 30 m above home: it is never armed, and never takes off or lands.

Before the first command a summary shows what is taken over and what happens if the link dies, and a question is asked; --yes answers it. Guiding stops at once, and one sentence says why, if the link or the telemetry is lost, the pilot or a failsafe changes the mode, another station commands, the altitude departs, or at Ctrl-C; the vehicle then flies the fall-back circle, or what the pilot wants. Airspeed and bank limit are those of the autopilot's parameters unless options give them. docs/autopilots.md has the details.""",
        examples=r"""
  loiter guide --connect udpin:127.0.0.1:14550 --orbit-lla 47.11 8.23 120
  loiter guide --connect tcp:127.0.0.1:5762 --dry-run \
      --orbit-lla 47.11 8.23 120 --turn ccw --bank 40
  loiter guide --connect udpin:127.0.0.1:14550 --orbit-lla 47.11 8.23 120 \
      --turn cw --airspeed 22 --slot 90 --slot-at 1790000000
  loiter guide --fleet vehicles.csv --orbit-lla 47.11 8.23 120 \
      --airspeed 22 --separation 80
  loiter guide --connect /dev/ttyUSB0,57600 --orbit-lla 47.11 8.23 120 \
      --altitude 900 --keep --log flight.csv""",
        statuses=(
            """  3  the vehicle cannot be reached, does not answer or refuses, or guiding
     had to stop: the sentence says what the vehicle has or does now; of a
     fleet, not all were in their slots at the end""",
            "  130  interrupted; a guided vehicle flies its fall-back circle",
        ),
    ),
    Command(
        "synthesis",
        "loiter.cli.commands.synthesis:synthesis",
        THEORY,
        110,
        help="""Map the optimal synthesis of the reduced plane: the fastest word in each region, and the curves between the regions.""",
        examples=r"""
  loiter synthesis --radius 1.5 --turn cw --plot map.png
  loiter synthesis --plot map.pdf
  loiter synthesis --radius 2 --turn cw --show worth --save map.npz""",
    ),
    Command(
        "figures",
        "loiter.cli.commands.figures:figures",
        THEORY,
        120,
        help="""Draw the seven figures of the paper, and write their captions.""",
        examples=r"""
  loiter figures --out figures --format svg""",
    ),
    Command(
        "completion",
        "loiter.cli.commands.completion:completion",
        PROGRAM,
        130,
        help="""Print a completion script: `eval "$(loiter completion bash)"`.""",
        examples=r"""
  eval "$(loiter completion bash)"
  loiter completion fish > ~/.config/fish/completions/loiter.fish""",
    ),
)
