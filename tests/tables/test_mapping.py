"""Columns with the users' own names and units, places on Earth, and frames of Polars and Arrow."""

import csv
import math
from pathlib import Path

import numpy as np
import pandas as pd
import polars as pl
import pyarrow as pa
import pyarrow.parquet as pq
import pytest
from hypothesis import given
from hypothesis import strategies as st

import loiter
from loiter import Orbit, Turn, plan
from loiter.cli.app import main
from loiter.errors import InvalidArgument
from loiter.files.columns import mapped_columns
from loiter.geo import LocalFrame
from tables.making import GIVEN, UAV, poses, read, scenes, write

OWN = {
    "east_m": "X_East [ft]",
    "north_m": "Y (KM)",
    "heading_deg": "hdg(rad)",
    "airspeed_m_s": "TAS_kt",
    "orbit_radius_m": "range_NM",
    "wind_speed_m_s": "wind_km_h",
    "max_turn_rate_deg_s": "rate [rad/s]",
    "turn": "side",
}
# By the definitions of the international foot, mile, nautical mile and knot.
SIZES = {
    "X_East [ft]": 0.3048,
    "Y (KM)": 1000.0,
    "hdg(rad)": 180.0 / math.pi,
    "TAS_kt": 1852.0 / 3600.0,
    "range_NM": 1852.0,
    "wind_km_h": 1.0 / 3.6,
    "rate [rad/s]": 180.0 / math.pi,
    "side": 1.0,
}


@pytest.fixture(autouse=True)
def _there(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)


def own_table(rows):
    """Random scenes under the names and in the units of `OWN`, and the same scenes in those of loiter."""
    table = scenes(rows, "max_turn_rate_deg_s")
    table = table.append_column("wind_speed_m_s", pa.array(np.linspace(0.0, 3.0, rows)))
    table = table.append_column("wind_from_deg", pa.array(np.linspace(0.0, 360.0, rows)))
    columns = {}
    for name in table.column_names:
        own = OWN.get(name, name)
        column = table.column(name).to_pylist()
        columns[own] = column if own == "side" else [value / SIZES.get(own, 1.0) for value in column]
    return pa.table(columns), table


@pytest.mark.parametrize("kind", [".csv", ".parquet"])
def test_columns_of_users_give_what_those_of_loiter_give(kind):
    own, plain = own_table(200)
    loiter.tables.run(write(own, Path(f"own{kind}")), "own_out.parquet", columns=OWN)
    loiter.tables.run(write(plain, Path("plain.parquet")), "out.parquet")
    mine, theirs = pq.read_table("own_out.parquet"), pq.read_table("out.parquet")
    # Carried columns are as they were, and none is lost.
    assert mine.column_names[: len(own.column_names)] == own.column_names
    assert mine.column("word").to_pylist() == theirs.column("word").to_pylist()
    assert mine.column("status").to_pylist() == theirs.column("status").to_pylist()
    np.testing.assert_allclose(mine.column("duration_s"), theirs.column("duration_s"), rtol=1e-9)


REFUSED = {
    "another kind": ({"east_m": "hdg(rad)"}, "gives east_m the column 'hdg(rad)' in rad, but its unit must be m, cm"),
    "another kind at the end": ({"east_m": "TAS_kt"}, "in kt, but its unit must be m, cm, mm, km, ft or NM: 'TAS_kt"),
    "no unit": ({"east_m": "X [cubit]"}, "the column 'X [cubit]' in cubit, but its unit must be m"),
    "stated and wrong": (
        {"heading_deg": "plain [ft]"},
        "the column 'plain' in ft, but its unit must be deg, rad, cdeg",
    ),
    "no column": ({"east_m": "X_Est [ft]"}, "the column 'X_Est [ft]', which the table does not have: is it 'X_East"),
    "no quantity": ({"height_m": "plain"}, "has 'height_m', which is not one of east_m, north_m"),
}
NAMES = ["X_East [ft]", "hdg(rad)", "TAS_kt", "X [cubit]", "plain", "X [UTM]", "roll_rate_z"]


@pytest.mark.parametrize(("given_columns", "why"), REFUSED.values(), ids=REFUSED)
def test_columns_that_do_not_fit_are_refused(given_columns, why):
    with pytest.raises(InvalidArgument) as raised:
        mapped_columns(NAMES, given_columns)
    assert why in str(raised.value)


@pytest.mark.parametrize(
    ("quantity", "text", "name", "factor"),
    [
        ("east_m", "plain", "plain", 1.0),
        ("east_m", "plain [ft]", "plain", 0.3048),
        ("east_m", "plain (feet)", "plain", 0.3048),
        ("east_m", "X_East [ft] [m]", "X_East [ft]", 1.0),
        ("east_m", "X [UTM] [km]", "X [UTM]", 1000.0),
        ("east_m", "roll_rate_z", "roll_rate_z", 1.0),
    ],
)
def test_a_unit_may_be_stated(quantity, text, name, factor):
    column = mapped_columns(NAMES, {quantity: text})[quantity]
    assert (column.name, column.factor) == (name, factor)


# The definitions of the units, by the ends of names; MAVLink's among them.
ENDS = {
    "east_m": {
        "_cm": 0.01,
        "_mm": 0.001,
        "_km ": 1000.0,
        " km": 1000.0,
        "-yd": 0.9144,
        "_kilometers": 1000.0,
        "_m": 1.0,
    },
    "heading_deg": {"_cdeg": 0.01, "_mrad": 180.0 / math.pi / 1000.0, "_°": 1.0, "_degrees": 1.0},
    "latitude_deg": {"_degE7": 1e-7, "_e7": 1e-7},
    "airspeed_m_s": {"_cm_s": 0.01, " cm/s": 0.01, "_fpm": 0.3048 / 60.0, "_ft_min": 0.3048 / 60.0, "_km/h": 1.0 / 3.6},
    "max_turn_rate_deg_s": {"_cdeg_s": 0.01, " rad per s": 180.0 / math.pi},
    "hold_s": {"_ms": 0.001, "_minutes": 60.0, "_h": 3600.0},
}
PLAIN = ("x_position", "x_utm", "x_gps_raw", "psi_true", "roll_rate_z", "h", "s", "x_")


@pytest.mark.parametrize(("quantity", "end"), [(quantity, end) for quantity, ends in ENDS.items() for end in ends])
def test_a_unit_at_the_end_of_a_name_is_converted_or_refused(quantity, end):
    for other in ENDS:
        if ENDS[other].get(end) is not None:
            column = mapped_columns([f"v{end}"], {other: f"v{end}"})[other]
            assert column.factor == pytest.approx(ENDS[other][end], rel=1e-15)
        elif (quantity, other) not in {("heading_deg", "latitude_deg"), ("latitude_deg", "heading_deg")}:
            with pytest.raises(InvalidArgument, match="but its unit must be"):
                mapped_columns([f"v{end}"], {other: f"v{end}"})


@pytest.mark.parametrize(
    ("quantity", "name", "factor"),
    [("east_m", "cm", 0.01), ("airspeed_m_s", "km_h", 1.0 / 3.6), ("hold_s", "min", 60.0)],
)
def test_a_name_may_be_a_unit_alone(quantity, name, factor):
    assert mapped_columns([name], {quantity: name})[quantity].factor == factor


@pytest.mark.parametrize("name", ["x_in", "x_mil", "x_hPa", "x_Hz", "x_m_s_s"])
def test_units_that_no_quantity_has_are_refused(name):
    for quantity in ENDS:
        with pytest.raises(InvalidArgument, match="but its unit must be"):
            mapped_columns([name], {quantity: name})


@pytest.mark.parametrize("name", PLAIN)
def test_a_plain_word_is_in_the_unit_of_the_quantity(name):
    assert {mapped_columns([name], {quantity: name})[quantity].factor for quantity in ENDS} == {1.0}


def test_blanks_around_the_name_of_a_column_do_not_count():
    table = "east_m ,north_m, heading_deg,turn ,wind_speed_m_s ,wind_from_deg \n-400,120,90,ccw,5,270\n"
    Path("in.csv").write_text(table)
    Path("plain.csv").write_text(table.replace(" ", ""))
    for name in ("in", "plain"):
        loiter.tables.run(f"{name}.csv", f"{name}_out.csv", **GIVEN)
    [found], [plain] = read(Path("in_out.csv")), read(Path("plain_out.csv"))
    assert (found["duration_s"], found["turn"], found["status"]) == (plain["duration_s"], "ccw", "ok")


@given(
    st.lists(st.text("xyz_[]()mftrad kn/s", max_size=12), unique=True, max_size=4), st.text("xy_[]()mft ", max_size=9)
)
def test_a_mapping_gives_a_column_of_the_table_or_a_refusal(names, text):
    try:
        found = mapped_columns(names, {"east_m": text})
    except InvalidArgument:
        return
    assert found["east_m"].name in names
    assert found["east_m"].factor in {1.0, 1000.0, 0.3048, 1852.0, 0.1, 0.001}


# Latitude and longitude of a circle, near the equator, the date line and a pole.
CENTRES = [(47.1, 8.23), (0.0, 179.9999), (-33.9, 18.4), (89.99, 30.0)]


@pytest.mark.parametrize(("lat", "lon"), CENTRES)
@pytest.mark.parametrize("by_row", [False, True])
def test_places_on_earth_are_planned_as_the_local_frame_has_them(lat, lon, by_row):
    frame = LocalFrame(lat, lon)
    table = poses(40)
    places = [
        frame.place(loiter.Pose(*pose)) for pose in zip(*(table.column(i).to_pylist() for i in (1, 2, 3)), strict=True)
    ]
    columns = {"lat": [p.latitude_deg for p in places], "lon": [p.longitude_deg for p in places]}
    columns["hdg [rad]"] = np.radians([p.heading_deg for p in places])
    circles = {"orbit_latitude_deg": [lat] * 40, "orbit_longitude_deg": [lon] * 40, "orbit_radius_m": [80.0] * 40}
    write(pa.table(columns | (circles if by_row else {})), Path("in.csv"))
    shared = {"aircraft": UAV, "turn": "cw"} | ({} if by_row else {"orbit": Orbit(0.0, 0.0, 80.0), "origin": frame})
    mapped = {"latitude_deg": "lat", "longitude_deg": "lon", "heading_deg": "hdg [rad]"}
    loiter.tables.run("in.csv", "out.parquet", columns=mapped, **shared)
    for row, place in zip(read(Path("out.parquet")), places, strict=True):
        best = plan(frame.pose(*place), Orbit(0.0, 0.0, 80.0, Turn.CW), UAV)
        joined = frame.place(best.join)
        assert row["duration_s"] == pytest.approx(best.duration_s, abs=1e-6)
        assert (row["join_latitude_deg"], row["join_longitude_deg"]) == pytest.approx(joined[:2], abs=1e-9)
        assert math.cos(math.radians(row["join_heading_deg"] - joined.heading_deg)) == pytest.approx(1.0, abs=1e-9)
        assert "join_east_m" not in row


def test_places_that_cannot_be_planned_have_a_status():
    rows = ["47.1,8.23,90", "48.5,8.23,90", "97,8.23,90", ",8.23,90", "47.1,8.23,north"]
    Path("in.csv").write_text("\n".join(["latitude_deg,longitude_deg,heading_deg", *rows]))
    loiter.tables.run("in.csv", "out.csv", origin=LocalFrame(47.1, 8.231), **GIVEN)
    assert [row["status"] for row in read(Path("out.csv"))] == ["ok", "out_of_range", *["bad_pose"] * 3]


@pytest.mark.parametrize(
    ("header", "options", "why"),
    [
        (
            "lat,lon,heading",
            ["--orbit", "0", "0", "80"],
            "map latitude_deg='lat', longitude_deg='lon', heading_deg='hea",
        ),
        ("x [ft],y [ft],yaw", ["--orbit", "0", "0", "80"], "map east_m='x [ft]', north_m='y [ft]', heading_deg='yaw'"),
        (
            "latitude_deg,longitude_deg,heading_deg",
            ["--orbit", "0", "0", "80"],
            "--orbit-lla is needed: positions are in degrees",
        ),
        ("latitude_deg,longitude_deg,heading_deg", [], "--orbit-lla is needed: the table has no columns orbit_lat"),
        ("east_m,north_m,heading_deg", ["--orbit-lla", "47", "8", "80"], "--orbit-lla is given, but the table has no"),
        (
            "east_m,north_m,heading_deg",
            ["--orbit", "0", "0", "80", "--map", "turn"],
            "--map is 'turn': it must be like",
        ),
        (
            "east_m,north_m,heading_deg",
            ["--orbit", "0", "0", "80", "--map", "turn=a", "--map", "turn=b"],
            "--map gives turn twice",
        ),
        (
            "east_m,north_m,heading_deg",
            ["--orbit", "0", "0", "80", "--orbit-lla", "47", "8", "80"],
            "--orbit and --orbit-lla are given",
        ),
    ],
)
def test_tables_of_places_and_mappings_that_do_not_fit_are_refused(capsys, header, options, why):
    Path("in.csv").write_text(f"{header}\n1,2,3\n")
    assert main(["batch", "in.csv", "out.csv", "--airspeed", "18", "--bank", "35", *options]) == 2
    [line] = capsys.readouterr().err.splitlines()
    assert why in line
    assert not Path("out.csv").exists()


def test_the_command_takes_names_with_blanks_and_units():
    own, _ = own_table(3)
    write(own, Path("own.csv"))
    options = [word for quantity, column in OWN.items() for word in ("--map", f"{quantity}={column}")]
    assert main(["batch", "own.csv", "out.csv", *options]) == 0
    with Path("out.csv").open(newline="") as file:
        assert [row["status"] for row in csv.DictReader(file)] == ["ok"] * 3


def test_frames_of_polars_and_arrow_are_planned_as_those_of_pandas():
    table = scenes(300)
    expected = loiter.tables.plan(table.to_pandas())
    polars = loiter.tables.plan(pl.from_arrow(table))
    assert isinstance(polars, pl.DataFrame)
    assert polars.columns == list(expected)
    for column in ("duration_s", "word", "turn", "status", "id"):
        assert polars[column].cast(pl.String).to_list() == expected[column].astype(str).tolist()
    arrow = loiter.tables.plan(table)
    assert isinstance(arrow, pa.Table)
    assert arrow.to_pandas().equals(expected)
    [batch] = table.combine_chunks().to_batches()
    assert pa.Table.from_batches([loiter.tables.plan(batch)]).equals(arrow.combine_chunks())
    assert loiter.tables.plan(table.slice(0, 0)).schema == arrow.schema
    assert loiter.tables.plan(pl.from_arrow(table.slice(0, 0))).schema == polars.schema


def test_frames_take_mapped_columns():
    frame = pd.DataFrame({"x [ft]": [-400.0 / 0.3048], "y": [0.12], "psi": [90.0]})
    columns = {"east_m": "x [ft]", "north_m": "y [km]", "heading_deg": "psi"}
    expected = loiter.tables.plan(
        pd.DataFrame({"east_m": [-400.0], "north_m": [120.0], "heading_deg": [90.0]}), **GIVEN
    )
    for kind in (frame, pa.table(frame), pl.from_pandas(frame)):
        [duration] = loiter.tables.plan(kind, columns=columns, **GIVEN)["duration_s"]
        assert float(duration if not isinstance(duration, pa.Scalar) else duration.as_py()) == pytest.approx(
            expected["duration_s"][0]
        )


def test_a_lazy_frame_of_polars_is_refused_with_the_remedy():
    with pytest.raises(InvalidArgument, match="is of type LazyFrame: collect\\(\\) makes a data frame of it"):
        loiter.tables.plan(pl.LazyFrame({"east_m": [1.0]}), **GIVEN)
