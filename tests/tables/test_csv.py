"""CSV tables as people and programs write them, also with errors."""

import csv
import gzip
import io
from datetime import date, datetime

import pyarrow.parquet as pq
import pytest

import loiter
from loiter.errors import InvalidArgument
from loiter.tables import csv_files
from tables.making import ADDED, GIVEN

HEADER = "id,east_m,north_m,heading_deg\n"


@pytest.fixture
def solved(tmp_path):
    """Solves a table given as text or bytes; gives the rows of the output and the summary."""

    def run(content, suffix=".csv", **given):
        source, target = tmp_path / f"in{suffix}", tmp_path / "out.csv"
        source.write_bytes(content.encode() if isinstance(content, str) else content)
        summary = loiter.tables.run(source, target, **{**GIVEN, **given})
        with target.open(newline="", encoding="utf-8") as file:
            return list(csv.DictReader(file)), summary

    return run


def statuses(rows):
    return [row["status"] for row in rows]


def test_numbers_as_people_write_them(solved):
    written = ["90", "90.0", "+90", "9e1", "9.E+01", " 90 ", '"90"', "0090", "900e-1", "\t90"]
    rows, _ = solved(HEADER + "".join(f"{i},{text},60,100\n" for i, text in enumerate(written)))
    assert statuses(rows) == ["ok"] * len(written)
    assert len({row["duration_s"] for row in rows}) == 1


def test_what_is_no_number_affects_only_its_own_row(solved):
    written = ["", "x", "nan", "inf", "-Infinity", "1e999", "0x10", "1,5", "90m", "--1", "90 60", "١", "NULL"]
    lines = [f'{i},"{text}",60,100\n{i},90,60,100\n' for i, text in enumerate(written)]
    rows, summary = solved(HEADER + "".join(lines))
    assert statuses(rows) == ["bad_pose", "ok"] * len(written)
    assert summary.statuses == {"ok": len(written), "bad_pose": len(written)}
    # Text is carried over as it stands.
    assert [row["east_m"] for row in rows[::2]] == written
    assert all(row[name] == "" for row in rows[::2] for name in ADDED if name != "status")


@pytest.mark.parametrize("begin", ["", "\ufeff", "\n\n"])
@pytest.mark.parametrize("header", ["east_m,north_m,heading_deg", '"east_m",north_m,"heading_deg"'])
@pytest.mark.parametrize("end", ["", "\n", "\r\n", "\r", "\n\n"])
@pytest.mark.parametrize("packed", [False, True])
def test_a_header_alone_is_a_table_of_no_rows(solved, begin, header, end, packed):
    content = (begin.replace("\n", end) + header + end).encode()
    rows, summary = solved(gzip.compress(content), ".csv.gz") if packed else solved(content)
    assert (rows, summary.rows) == ([], 0)


@pytest.mark.parametrize("line_end", ["\n", "\r\n", "\r"])
@pytest.mark.parametrize("last", ["90,60,100", '90,60,"100"', '"90,60,100', "90,60"])
def test_the_last_line_counts_with_an_end_or_without(solved, line_end, last):
    text = line_end.join(["east_m,north_m,heading_deg", "90,60,100", last])
    rows, summary = solved(text)
    assert rows == solved(text + line_end)[0]
    is_good = last.endswith(("100", '"100"')) and last.count('"') != 1
    assert summary.statuses == ({"ok": 2} if is_good else {"ok": 1, "malformed": 1})


def test_a_line_with_the_wrong_number_of_fields_is_left_out_and_counted(solved, tmp_path):
    lines = ["0,90,60,100", "1,90,60", "2,90,60,100", "3,90,60,100,5", "4", "5,90,60,100"]
    rows, summary = solved(HEADER + "\n".join(lines))
    assert [(row["id"], row["status"]) for row in rows] == [("0", "ok"), ("2", "ok"), ("5", "ok")]
    assert (summary.rows, summary.statuses) == (3, {"ok": 3, "malformed": 3})
    assert summary.first_malformed == f"line 3 of {tmp_path / 'in.csv'} has fewer fields than the header"


@pytest.mark.parametrize("end", ["\n", "\r\n", "\r"])
@pytest.mark.parametrize("mark", ["", "\ufeff"])
@pytest.mark.parametrize("last", ["", "end"])
def test_line_ends_and_byte_order_marks(solved, end, mark, last):
    text = mark + HEADER + "0,90,60,100\n\n1,91,60,100" + ("\n" if last else "")
    rows, _ = solved(text.replace("\n", end))
    assert [(row["id"], row["status"]) for row in rows] == [("0", "ok"), ("1", "ok")]


NASTY = [
    "plain",
    "with, comma",
    'with "quotes"',
    "with\nline",
    "with\r\nline",
    "",
    " spaced ",
    '"',
    "Grüße",
    "'",
    "=1+1",
]


def test_quoted_fields_come_back_as_they_were(solved):
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(["a, note", "east_m", "north_m", "heading_deg"])
    writer.writerows([note, 90, 60, 100] for note in NASTY)
    rows, _ = solved(text.getvalue())
    assert [row["a, note"] for row in rows] == NASTY
    assert statuses(rows) == ["ok"] * len(NASTY)


def test_every_quantity_may_be_a_column_of_text(solved):
    header = "east_m,north_m,heading_deg,orbit_east_m,orbit_north_m,orbit_radius_m,turn,airspeed_m_s,max_bank_deg\n"
    good = "90,60,100,0,0,80,cw,18,35\n"
    bad = [
        "90,60,100,,0,80,cw,18,35",
        "90,60,100,0,0,wide,cw,18,35",
        "90,60,100,0,0,80,CW,18,35",
        "90,60,100,0,0,80,,18,35",
    ]
    bad += [
        "90,60,100,0,0,80,cw,fast,35",
        "90,60,100,0,0,80,cw,18,90",
        "90,60,100,0,0,40,cw,18,35",
        "9e99,0,0,0,0,80,cw,18,35",
    ]
    rows, _ = solved(header + good + "\n".join(bad) + "\n" + good.replace("cw", " ccw "), orbit=None, aircraft=None)
    expected = ["bad_orbit", "bad_orbit", "bad_turn", "bad_turn", "bad_aircraft", "bad_aircraft", "radius_too_small"]
    assert statuses(rows) == ["ok", *expected, "out_of_range", "ok"]
    assert [rows[0]["turn"], rows[-1]["turn"]] == ["cw", "ccw"]


@pytest.mark.parametrize("threads", [1, 3])
def test_a_quote_that_is_never_closed_affects_only_its_own_line(solved, threads):
    good = [f"{i},90,60,100" for i in range(3000)]
    stray = {70: '70,"90,60,100', 900: '"900,90,60,100', 2000: '2000,"90"1,60,100', 2999: '2999,90,60,"100'}
    # One in the midst of a field is none, and one that is closed some lines later belongs to a field.
    fine = {8: '5" mast,90,60,100', 9: '"a\nb\n""c""\n",90,60,100', 2001: '"",90,60,"100"'}
    written = [{**stray, **fine}.get(i, line) for i, line in enumerate(good)]
    rows, summary = solved(HEADER + "\n".join(written), workers=threads)
    assert summary.statuses == {"ok": 2996, "malformed": 4}
    found = [row["id"] for row in rows]
    assert found == [{8: '5" mast', 9: 'a\nb\n"c"\n', 2001: ""}.get(i, str(i)) for i in range(3000) if i not in stray]


def test_a_file_full_of_open_quotes_is_refused(solved, tmp_path, monkeypatch):
    monkeypatch.setattr(csv_files, "ATTEMPTS", 1)
    with pytest.raises(InvalidArgument, match="the quote in line 2 is not closed, and neither are others"):
        solved(HEADER + '"1,90,60,100\n2,90,60,100\n')
    assert [path.name for path in tmp_path.iterdir()] == ["in.csv"]


def test_bytes_that_are_not_utf_8_affect_only_their_own_line(solved):
    lines = [b"0,90,60,100", b"caf\xe9,90,60,100", "Grüße,90,60,100".encode(), b"3,90,\xff,100"]
    rows, summary = solved(HEADER.encode() + b"\n".join(lines))
    assert [row["id"] for row in rows] == ["0", "Grüße"]
    assert summary.statuses == {"ok": 2, "malformed": 2}


@pytest.mark.parametrize("separator", [";", "\t", "|"])
def test_other_separators_are_recognised(solved, separator):
    rows, _ = solved((HEADER + "0,90.5,60,100\n").replace(",", separator))
    assert [(row["id"], row["status"]) for row in rows] == [("0", "ok")]


def test_a_comma_may_be_that_of_a_number_where_semicolons_separate(solved):
    [comma], _ = solved("id;east_m;north_m;heading_deg\n0;90,5;60;1e2\n")
    [point], _ = solved(HEADER + "0,90.5,60,100\n")
    assert (comma["duration_s"], comma["east_m"]) == (point["duration_s"], "90,5")


def test_gzip_in_several_members(solved):
    text = [HEADER + "0,90,60,100\n", "1,90,60,100\n", "2,90,60,100\n"]
    rows, _ = solved(b"".join(gzip.compress(part.encode()) for part in text), ".csv.gz")
    assert [row["id"] for row in rows] == ["0", "1", "2"]


def test_compressed_output_tells_neither_name_nor_time(tmp_path):
    (tmp_path / "in.csv").write_text(HEADER + "0,90,60,100\n")
    for name in ("one.csv.gz", "two.csv.gz"):
        loiter.tables.run(tmp_path / "in.csv", tmp_path / name, **GIVEN)
    assert (tmp_path / "one.csv.gz").read_bytes() == (tmp_path / "two.csv.gz").read_bytes()
    assert (tmp_path / "one.csv.gz").read_bytes()[4:8] == bytes(4)


PACKED = gzip.compress(("id,east_m,north_m,heading_deg\n" + "0,90,60,100\n" * 50000).encode())


@pytest.mark.parametrize(
    ("content", "suffix", "why"),
    [
        (b"", ".csv", "no header"),
        (b"\n\n", ".csv", "no header"),
        (HEADER.encode("utf-16"), ".csv", "it is UTF-16: write it as UTF-8"),
        (HEADER.encode("utf-16-le"), ".csv", "it is UTF-16: write it as UTF-8"),
        (HEADER.replace("id", "Größe").encode("cp1252"), ".csv", "the byte 0xf6; if it is Windows-1252, iconv"),
        (HEADER.encode() + b"0,1,2,3\r\n1,2,3,4\n" * 9, ".csv", "its lines have different ends"),
        (b"id,east_m\n", ".csv.gz", "Not a gzipped file"),
        (PACKED[:-100], ".csv.gz", "Unexpected end of GZIP stream"),
        (b"PAR1 no table PAR1", ".parquet", "Parquet"),
        (b"id,east_m\n", ".parquet", "Parquet"),
    ],
)
def test_what_cannot_be_read_is_reported_and_leaves_nothing(solved, tmp_path, content, suffix, why):
    with pytest.raises(InvalidArgument, match=why) as raised:
        solved(content, suffix)
    assert raised.value.argument == "source"
    assert [path.name for path in tmp_path.iterdir()] == [f"in{suffix}"]


def rejected(path):
    with path.open(newline="", encoding="utf-8") as file:
        return [tuple(row.values()) for row in csv.DictReader(file)]


def test_rejected_lines_are_kept_with_their_numbers_in_the_file(tmp_path):
    written = HEADER.splitlines()
    written += ["", "0,90,60,100", '"a', '",90,60,100', "", "2,90,60"]
    written += [f"{i},90,60,100" for i in range(500)] + ['"no end,90,60,100', "3,90,60,100,5"]
    content = "\r\n".join(written).encode() + b"\r\ncaf\xe9,90,60,100\r\n"
    (tmp_path / "in.csv").write_bytes(content)
    summary = loiter.tables.run(
        tmp_path / "in.csv", tmp_path / "out.csv", rejects=tmp_path / "rejects.csv", workers=1, **GIVEN
    )
    place = str(tmp_path / "in.csv")
    assert rejected(tmp_path / "rejects.csv") == [
        (place, "7", "has fewer fields than the header", "2,90,60"),
        (place, "508", "has a quote that is not closed, or text after it", '"no end,90,60,100'),
        (place, "509", "has more fields than the header", "3,90,60,100,5"),
        (place, "510", "is not UTF-8", "caf??90,60,100"),
    ]
    assert summary.first_malformed == f"line 7 of {place} has fewer fields than the header"
    assert summary.statuses == {"ok": 502, "malformed": 4}


def test_rejected_lines_of_several_files_count_in_each(tmp_path):
    for name, rows in {"a": "0,1,2,3\n", "b": "1\n0,90,60,100\n", "c": "\n\n2,90\n"}.items():
        (tmp_path / f"{name}.csv").write_text(HEADER + rows)
    loiter.tables.run(str(tmp_path / "*.csv"), tmp_path / "out.parquet", rejects=tmp_path / "rejects.txt", **GIVEN)
    assert [row[:2] for row in rejected(tmp_path / "rejects.txt")] == [
        (str(tmp_path / "b.csv"), "2"),
        (str(tmp_path / "c.csv"), "4"),
    ]


def test_rejected_lines_are_written_again_when_nothing_else_is_left_to_do(tmp_path):
    (tmp_path / "in.csv").write_text(HEADER + "0,90,60,100\n1\n")
    for _ in range(2):
        loiter.tables.run(tmp_path / "in.csv", f"{tmp_path / 'out'}/", rejects=tmp_path / "rejects.csv", **GIVEN)
        assert [row[1:] for row in rejected(tmp_path / "rejects.csv")] == [
            ("3", "has fewer fields than the header", "1")
        ]
        (tmp_path / "rejects.csv").unlink()


def test_rejects_are_refused_where_they_would_destroy_or_mean_nothing(tmp_path):
    (tmp_path / "in.csv").write_text(HEADER + "0,90,60,100\n")
    before = (tmp_path / "in.csv").read_bytes()
    for rejects in ("in.csv", "out.csv"):
        with pytest.raises(InvalidArgument, match="that is the input or the output"):
            loiter.tables.run(tmp_path / "in.csv", tmp_path / "out.csv", rejects=tmp_path / rejects, **GIVEN)
    loiter.tables.run(tmp_path / "in.csv", tmp_path / "out.parquet", **GIVEN)
    with pytest.raises(InvalidArgument, match="a Parquet file has no malformed lines"):
        loiter.tables.run(tmp_path / "out.parquet", tmp_path / "b.csv", rejects=tmp_path / "r.csv", **GIVEN)
    assert (tmp_path / "in.csv").read_bytes() == before


def test_a_huge_field_affects_only_its_own_line(solved):
    rows, summary = solved(HEADER + f"0,90,60,100\n{'x' * (1 << 24)},90,60,100\n2,90,60,100\n")
    assert statuses(rows) == ["ok", "ok"]
    assert "line 3" in summary.first_malformed
    assert summary.first_malformed.endswith("is too long")


VALUES = {
    "whole": (["1", "-2", "", "40000000000"], [1, -2, None, 40_000_000_000]),
    "number": (["1", "2.5", "1e3", ""], [1.0, 2.5, 1000.0, None]),
    "flag": (["true", "false", "", "true"], [True, False, None, True]),
    "day": (
        ["2026-01-31", "", "2026-02-01", "2026-02-02"],
        [date(2026, 1, 31), None, date(2026, 2, 1), date(2026, 2, 2)],
    ),
    "moment": (
        ["2026-01-31 12:00:00", "2026-01-31T12:00:01", "", ""],
        [datetime(2026, 1, 31, 12), datetime(2026, 1, 31, 12, 0, 1), None, None],
    ),
    "text": (["1", "2", "x", ""], ["1", "2", "x", None]),
    "code": (["007", "008", "", "1"], ["007", "008", None, "1"]),
}


def test_columns_have_in_parquet_the_types_of_all_their_values(tmp_path):
    # A malformed line, whose fields stand in wrong columns, says nothing on their types.
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow([*VALUES, "east_m", "north_m", "heading_deg"])
    writer.writerows([*row, 90, 60, 100] for row in zip(*(written for written, _ in VALUES.values()), strict=True))
    (tmp_path / "in.csv").write_text(text.getvalue() + "no number,90,60\n")
    loiter.tables.run(tmp_path / "in.csv", tmp_path / "out.parquet", **GIVEN)
    found = pq.read_table(tmp_path / "out.parquet")
    for name, (_, values) in VALUES.items():
        assert found.column(name).to_pylist() == values


def test_columns_of_files_that_differ_in_type_are_text(tmp_path):
    for name, value in {"a": "1", "b": "x"}.items():
        (tmp_path / f"{name}.csv").write_text(HEADER + f"{value},90,60,100\n")
    loiter.tables.run(str(tmp_path / "*.csv"), tmp_path / "out.parquet", **GIVEN)
    assert pq.read_table(tmp_path / "out.parquet").column("id").to_pylist() == ["1", "x"]
