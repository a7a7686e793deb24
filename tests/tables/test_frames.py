"""Data frames: the same columns as for a file, the index kept, lazily where the frame is lazy."""

import dask
import dask.dataframe as dd
import pandas as pd
import pytest
from pandas.testing import assert_frame_equal

import loiter
from loiter.errors import InvalidArgument
from tables.making import ADDED, GIVEN, ORBIT, poses, read, scenes, write


def test_a_frame_gets_what_a_file_gets(tmp_path):
    table = scenes(500)
    loiter.tables.run(write(table, tmp_path / "in.parquet"), tmp_path / "out.parquet")
    planned = loiter.tables.plan(table.to_pandas())
    assert planned.to_dict("records") == read(tmp_path / "out.parquet")
    assert list(planned) == [name for name in table.column_names if name != "turn"] + ADDED


def test_the_frame_itself_and_its_index_stay_as_they_are():
    frame = poses(50).to_pandas().set_index(pd.Index([7] * 50, name="track"))
    before = frame.copy()
    planned = loiter.tables.plan(frame, turn="cw", **GIVEN)
    assert_frame_equal(frame, before)
    assert planned.index.equals(frame.index)
    assert_frame_equal(planned[frame.columns], frame)
    assert set(planned["turn"]) == {"cw"}
    assert planned["word"].dtype == "category"


def test_missing_values_are_bad_rows():
    frame = scenes(4).to_pandas().astype({"airspeed_m_s": "Float64"})
    frame.loc[0, "east_m"] = float("nan")
    frame.loc[1, "airspeed_m_s"] = pd.NA
    frame.loc[2, "turn"] = None
    assert loiter.tables.plan(frame)["status"].tolist() == ["bad_pose", "bad_aircraft", "bad_turn", "ok"]


@pytest.mark.parametrize(
    ("change", "why"),
    [
        (lambda frame: frame.drop(columns="heading_deg"), "frame has no column heading_deg"),
        (lambda frame: frame.assign(heading_deg="north"), "frame has a column heading_deg of"),
        (lambda frame: frame.assign(heading_deg=[1.0, "north", None] + [0.0] * 7), "frame has a column of mixed types"),
        (lambda frame: frame.assign(word="RSL"), "frame has a column word"),
        (lambda frame: pd.concat([frame, frame[["id"]]], axis=1), "frame has two columns with the same name"),
        (lambda frame: frame.assign(orbit_east_m=0.0), "orbit is given, and by the table's column orbit_east_m too"),
        (
            lambda frame: frame[["id", "east_m"]],
            "frame has no column north_m: it needs east_m, north_m, heading_deg; its columns are id, east_m$",
        ),
        (
            lambda frame: "states.parquet",
            "^frame is of type str: it must be a data frame of pandas, Dask, Polars or Arrow; loiter.tables.run",
        ),
        (lambda frame: frame["east_m"], "^frame is of type Series: it must be a data frame"),
        (lambda frame: dd.from_pandas(frame["east_m"], npartitions=1), "^frame is of type Series: it must be"),
        (lambda frame: frame.to_numpy(), "^frame is of type ndarray: it must be"),
    ],
)
def test_a_frame_that_does_not_fit_is_refused(change, why):
    with pytest.raises(InvalidArgument, match=why):
        loiter.tables.plan(change(poses(10).to_pandas()), **GIVEN)


def test_a_missing_aircraft_is_named_as_the_argument():
    with pytest.raises(
        InvalidArgument, match=r"^aircraft airspeed_m_s is needed: the table has no column airspeed_m_s$"
    ):
        loiter.tables.plan(poses(5).to_pandas().assign(wind_speed_m_s=1.0, wind_from_deg=0.0), orbit=ORBIT)
    with pytest.raises(InvalidArgument, match=r"^aircraft max_bank_deg or another turn limit is needed: "):
        loiter.tables.plan(poses(5).to_pandas(), orbit=ORBIT, aircraft={"airspeed_m_s": 18.0})


def test_a_tolerance_beyond_doubles_is_a_status_of_its_own():
    planned = loiter.tables.plan(poses(5).to_pandas(), tolerance_m=1e20, **GIVEN)
    assert set(planned["status"]) == {"bad_tolerance"}


@pytest.mark.parametrize("columns", ["given", "own"])
def test_a_dask_frame_stays_lazy_and_gives_the_same(columns):
    table, given = (poses(300), GIVEN) if columns == "given" else (scenes(300), {})
    frame = table.to_pandas().set_index("id")
    lazy = loiter.tables.plan(dd.from_pandas(frame, npartitions=4), **given)
    assert isinstance(lazy, dd.DataFrame)
    assert lazy.npartitions == 4
    with dask.config.set(scheduler="threads"):
        found = lazy.compute()
    expected = loiter.tables.plan(frame, **given)
    assert_frame_equal(found, expected)
    # What Dask was told beforehand is what comes.
    assert_frame_equal(lazy._meta, expected.iloc[:0])


def test_a_lazy_frame_that_does_not_fit_is_refused_at_once():
    frame = dd.from_pandas(poses(10).to_pandas(), npartitions=2)
    with pytest.raises(InvalidArgument, match="frame has no column heading_deg"):
        loiter.tables.plan(frame.drop(columns="heading_deg"), **GIVEN)


def test_labels_that_are_no_text_are_carried_along():
    frame = poses(5).to_pandas().rename(columns={"id": 0})
    assert list(loiter.tables.plan(frame, **GIVEN))[:4] == [0, "east_m", "north_m", "heading_deg"]
