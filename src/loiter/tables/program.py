"""The command of the room of tables."""

from loiter.cli.command import PLANS, Command

COMMANDS = (
    Command(
        "batch",
        "loiter.tables.command:batch",
        PLANS,
        50,
        help="""Plan the fastest entry for every row of a table: Parquet or CSV, any size.

IN has the columns east_m, north_m and heading_deg. It may have orbit_east_m, orbit_north_m and orbit_radius_m; turn (cw, ccw or either); airspeed_m_s; max_bank_deg, min_turn_radius_m or max_turn_rate_deg_s; wind_speed_m_s and wind_from_deg; and orbit_velocity_east_m_s and orbit_velocity_north_m_s. Values without a column come from options; all are needed except the turn, the wind and the circle's velocity.

OUT has the rows and the columns of IN, in their order, and then duration_s, word, turn (the direction of the plan, cw or ccw, in place of the turn of IN), join_east_m, join_north_m, join_heading_deg, duration_1_s, duration_2_s, duration_3_s and status. A bad row gets nan or empty fields and a status other than ok; the job goes on. Lines of CSV files that are no rows are left out and counted; --rejects lists them.

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
)
