"""CSV tables as people and programs write them, also with errors."""

import csv
import gzip
import io

import numpy as np
import pyarrow as pa
import pyarrow.csv as pacsv
import pyarrow.parquet as pq
import pytest

import loiter
from batch.making import ADDED, GIVEN
from loiter.batch.tables import files, ingest
from loiter.errors import InvalidArgument

HEADER = "id,east_m,north_m,heading_deg\n"


@pytest.fixture
def solved(tmp_path):
    """Solves a table given as text or bytes; gives the rows of the output and the summary."""

    def run(content, suffix=".csv", **given):
        source, target = tmp_path / f"in{suffix}", tmp_path / "out.csv"
        source.write_bytes(content.encode() if isinstance(content, str) else content)
        summary = loiter.batch.run(source, target, **{**GIVEN, **given})
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
    written = ["", "x", "nan", "inf", "-Infinity", "1e999", "1_0", "0x10", "1,5", "90m", "--1", "90 60", "١", "NULL"]
    lines = [f'{i},"{text}",60,100\n{i},90,60,100\n' for i, text in enumerate(written)]
    rows, summary = solved(HEADER + "".join(lines))
    assert statuses(rows) == ["bad_pose", "ok"] * len(written)
    assert summary.statuses == {"ok": len(written), "bad_pose": len(written)}
    # Text is carried over as it stands.
    assert [row["east_m"] for row in rows[::2]] == written
    assert all(row[name] == "" for row in rows[::2] for name in ADDED if name != "status")


@pytest.mark.parametrize("begin", ["", "\ufeff", "\n", "\r\n"])
@pytest.mark.parametrize("header", ["east_m,north_m,heading_deg", '"east_m",north_m,"heading_deg"'])
@pytest.mark.parametrize("end", ["", "\n", "\r\n", "\r", "\n\n"])
@pytest.mark.parametrize("packed", [False, True])
def test_a_header_alone_is_a_table_of_no_rows(solved, begin, header, end, packed):
    content = (begin + header + end).encode()
    rows, summary = solved(gzip.compress(content), ".csv.gz") if packed else solved(content)
    assert (rows, summary.rows) == ([], 0)


@pytest.mark.parametrize("line_end", ["\n", "\r\n", "\r"])
@pytest.mark.parametrize("last", ["90,60,100", '90,60,"100"', '"90,60,100', "90,60"])
def test_the_last_line_counts_with_an_end_or_without(solved, line_end, last):
    text = line_end.join(["east_m,north_m,heading_deg", "90,60,100", last])
    rows, _ = solved(text)
    assert rows == solved(text + line_end)[0]
    assert statuses(rows) == ["ok", "ok" if last.endswith(("100", '"100"')) and last.count('"') != 1 else "malformed"]


def test_a_line_with_the_wrong_number_of_fields_keeps_its_place(solved, tmp_path):
    lines = ["0,90,60,100", "1,90,60", "2,90,60,100", "3,90,60,100,5", "4", "5,90,60,100", "6,90,60,100,"]
    rows, summary = solved(HEADER + "\n".join(lines))
    assert statuses(rows) == ["ok", "malformed", "ok", "malformed", "malformed", "ok", "malformed"]
    # The fields that can be told apart are kept, whatever is missing.
    assert [row["id"] for row in rows] == ["0", "1", "2", "3", "4", "5", "6"]
    assert [row["heading_deg"] for row in rows] == ["100", "", "100", "100", "", "100", "100"]
    assert all(row[name] == "" for row in rows if row["status"] == "malformed" for name in ADDED if name != "status")
    assert summary.rows == 7
    assert summary.first_malformed == f"line 3 of {tmp_path / 'in.csv'} has 3 fields, not 4 as the header"


@pytest.mark.parametrize("every", [1, 2, 3, 50])
def test_malformed_lines_keep_their_places_in_large_files(tmp_path, monkeypatch, every):
    monkeypatch.setattr(ingest, "BLOCK_BYTES", 1000)
    monkeypatch.setattr(ingest, "BATCH_ROWS", 64)
    monkeypatch.setattr(files, "PART_ROWS", 200)
    random = np.random.default_rng(every)
    # Lone ones, runs that are longer than a block of text, and some at either end.
    bad = (random.random(2000) < 1.0 / every) | (np.arange(2000) // 300 == 3) | (np.arange(2000) % 1999 == 0)
    lines = [f"{i},90,60" if b else f"{i},90,60,{i % 360}" for i, b in enumerate(bad)]
    (tmp_path / "in.csv").write_text(HEADER + "\n\n".join(lines))
    summary = loiter.batch.run(tmp_path / "in.csv", tmp_path / "out.parquet", workers=2, **GIVEN)
    rows = pq.read_table(tmp_path / "out.parquet").to_pylist()
    assert [int(row["id"]) for row in rows] == list(range(2000))
    assert [row["status"] == "malformed" for row in rows] == bad.tolist()
    assert summary.statuses.get("malformed") == bad.sum()


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


def test_a_quote_that_is_never_closed_affects_only_its_own_line(solved, monkeypatch):
    monkeypatch.setattr(ingest, "BLOCK_BYTES", 5000)
    good, stray = (
        [f"{i},90,60,100" for i in range(3000)],
        {7: '7,"90,60,100', 900: '"900,90,60,100', 2999: '2999,90,60,"100'},
    )
    # One in the midst of a field is none, and one that is closed some lines later belongs to a field.
    fine = {8: '5" mast,90,60,100', 901: '"a\nb\n""c""\n",90,60,100', 2000: '"",90,60,"100"'}
    written = [{**stray, **fine}.get(i, line) for i, line in enumerate(good)]
    rows, summary = solved(HEADER + "\n".join(written))
    assert [i for i, row in enumerate(rows) if row["status"] != "ok"] == list(stray)
    assert summary.statuses == {"ok": 2997, "malformed": 3}
    assert (rows[8]["id"], rows[901]["id"], rows[2000]["id"]) == ('5" mast', 'a\nb\n"c"\n', "")


@pytest.mark.parametrize(("lines", "expected"), [(100, ["ok", "ok"]), (101, ["malformed"] * 101 + ["ok"])])
def test_a_quote_that_is_closed_more_than_100_lines_later_counts_as_never_closed(solved, lines, expected):
    assert statuses(solved(HEADER + '"' + "a\n" * (lines - 1) + '",90,60,100\n1,90,60,100')[0]) == expected


@pytest.mark.parametrize("block", [1, 7, 64, 1000])
def test_the_same_text_in_blocks_of_any_size_gives_the_same_rows(solved, monkeypatch, block):
    text = HEADER + '0,1,2,3\n"a\n\n,b",1,2,3\r\n' * 20 + '0,"1,2,3\n' + "1,2,3,4\n" * 150 + '"q"",1,2,3'
    monkeypatch.setattr(ingest, "BLOCK_BYTES", block)
    rows, _ = solved(text)
    assert [row["id"] for row in rows] == ["0", "a\n\n,b"] * 20 + ["0"] + ["1"] * 150 + ['q",1,2,3']
    assert [i for i, status in enumerate(statuses(rows)) if status == "malformed"] == [40, 191]


def test_bytes_that_are_not_utf_8_affect_only_their_own_line(solved):
    lines = [b"0,90,60,100", b"caf\xe9,90,60,100", "Grüße,90,60,100".encode(), b"3,90,\xff,100"]
    rows, _ = solved(HEADER.encode() + b"\n".join(lines))
    assert statuses(rows) == ["ok", "malformed", "ok", "malformed"]
    assert [row["id"] for row in rows] == ["0", "", "Grüße", "3"]


def test_gzip_in_several_members(solved):
    text = [HEADER + "0,90,60,100\n", "1,90,60,100\n", "2,90,60,100\n"]
    rows, _ = solved(b"".join(gzip.compress(part.encode()) for part in text), ".csv.gz")
    assert [row["id"] for row in rows] == ["0", "1", "2"]


def test_compressed_output_tells_neither_name_nor_time(tmp_path):
    (tmp_path / "in.csv").write_text(HEADER + "0,90,60,100\n")
    for name in ("one.csv.gz", "two.csv.gz"):
        loiter.batch.run(tmp_path / "in.csv", tmp_path / name, **GIVEN)
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
        (HEADER.replace("id", "Größe").encode("cp1252"), ".csv", "0xf6 after 'Gr'; if it is Windows-1252, iconv"),
        (b"id,east_m\n", ".csv.gz", "Not a gzipped file"),
        (PACKED[:-100], ".csv.gz", "ended before the end-of-stream marker"),
        (PACKED[:-8] + bytes(8), ".csv.gz", "CRC check failed"),
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


def test_rejected_lines_are_kept_with_their_numbers_in_the_file(tmp_path, monkeypatch):
    monkeypatch.setattr(ingest, "LONGEST", 2000)
    monkeypatch.setattr(ingest, "BLOCK_BYTES", 500)
    written = HEADER.splitlines()
    written += ["", "0,90,60,100", '"a', '",90,60,100', "", "2,90,60"]
    written += [f"{i},90,60,100" for i in range(500)] + ['"no end,90,60,100', "x" * 2001, "3,90,60,100,,"]
    content = "\r\n".join(written).encode() + b"\r\ncaf\xe9,90,60,100\r\n"
    (tmp_path / "in.csv").write_bytes(content)
    summary = loiter.batch.run(
        tmp_path / "in.csv", tmp_path / "out.csv", rejects=tmp_path / "rejects.csv", workers=1, **GIVEN
    )
    place = str(tmp_path / "in.csv")
    assert rejected(tmp_path / "rejects.csv") == [
        (place, "7", "has 3 fields, not 4 as the header", "2,90,60"),
        (place, "508", "has a quote that is never closed", '"no end,90,60,100'),
        (place, "509", "is longer than 2,000 bytes", "x" * 2001),
        (place, "510", "has 6 fields, not 4 as the header", "3,90,60,100,,"),
        (place, "511", "is not UTF-8", "caf\\xe9,90,60,100"),
    ]
    # What an editor shows as these lines.
    shown = content.decode("utf-8", "backslashreplace").splitlines()
    assert all(shown[int(number) - 1] == text for _, number, _, text in rejected(tmp_path / "rejects.csv"))
    assert summary.first_malformed == f"line 7 of {place} has 3 fields, not 4 as the header"
    assert summary.statuses == {"ok": 502, "malformed": 5}


def test_rejected_lines_of_several_files_count_in_each(tmp_path):
    for name, rows in {"a": "0,1,2,3\n", "b": "1\n0,90,60,100\n", "c": "\n\n2,90\n"}.items():
        (tmp_path / f"{name}.csv").write_text(HEADER + rows)
    loiter.batch.run(str(tmp_path / "*.csv"), tmp_path / "out.parquet", rejects=tmp_path / "rejects.txt", **GIVEN)
    assert [row[:2] for row in rejected(tmp_path / "rejects.txt")] == [
        (str(tmp_path / "b.csv"), "2"),
        (str(tmp_path / "c.csv"), "4"),
    ]


def test_rejected_lines_are_written_again_when_nothing_else_is_left_to_do(tmp_path):
    (tmp_path / "in.csv").write_text(HEADER + "0,90,60,100\n1\n")
    for _ in range(2):
        loiter.batch.run(tmp_path / "in.csv", f"{tmp_path / 'out'}/", rejects=tmp_path / "rejects.csv", **GIVEN)
        assert [row[1:] for row in rejected(tmp_path / "rejects.csv")] == [
            ("3", "has 1 field, not 4 as the header", "1")
        ]
        (tmp_path / "rejects.csv").unlink()


def test_rejects_are_refused_where_they_would_destroy_or_mean_nothing(tmp_path):
    (tmp_path / "in.csv").write_text(HEADER + "0,90,60,100\n")
    before = (tmp_path / "in.csv").read_bytes()
    for rejects in ("in.csv", "out.csv"):
        with pytest.raises(InvalidArgument, match="that is the input or the output"):
            loiter.batch.run(tmp_path / "in.csv", tmp_path / "out.csv", rejects=tmp_path / rejects, **GIVEN)
    loiter.batch.run(tmp_path / "in.csv", tmp_path / "out.parquet", **GIVEN)
    with pytest.raises(InvalidArgument, match="a Parquet file has no malformed lines"):
        loiter.batch.run(tmp_path / "out.parquet", tmp_path / "b.csv", rejects=tmp_path / "r.csv", **GIVEN)
    assert (tmp_path / "in.csv").read_bytes() == before


def test_a_huge_field_affects_only_its_own_line(solved):
    rows, summary = solved(HEADER + f"0,90,60,100\n{'x' * (1 << 24)},90,60,100\n2,90,60,100\n")
    assert statuses(rows) == ["ok", "malformed", "ok"]
    assert "line 3" in summary.first_malformed
    assert "is longer than" in summary.first_malformed


# Parquet has no timestamps in whole seconds.
VALUES = {
    "whole": (["1", "-2", "", "40000000000"], pa.int64()),
    "number": (["1", "2.5", "1e3", "NA"], pa.float64()),
    "flag": (["true", "false", "", "true"], pa.bool_()),
    "day": (["2026-01-31", "", "2026-02-01", "2026-02-02"], pa.date32()),
    "moment": (["2026-01-31 12:00:00", "2026-01-31T12:00:01", "", ""], pa.timestamp("ms")),
    "fine_moment": (["2026-01-31 12:00:00.5", "2026-01-31 12:00:01", "", ""], pa.timestamp("ns")),
    "text": (["1", "2", "x", ""], pa.string()),
    "mixed": (["1", "true", "2", "3"], pa.string()),
    "clock": (["12:00:00", "", "", ""], pa.string()),
}


def test_columns_have_in_parquet_the_types_that_a_reader_of_csv_would_infer(tmp_path, monkeypatch):
    monkeypatch.setattr(files, "PART_ROWS", 2)
    # A malformed line, whose fields stand in wrong columns, says nothing on their types.
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow([*VALUES, "east_m", "north_m", "heading_deg"])
    rows = list(zip(*(values for values, _ in VALUES.values()), strict=True))
    writer.writerows([*row, 90, 60, 100] for row in rows)
    (tmp_path / "in.csv").write_text(text.getvalue() + "no number,90,60\n")
    loiter.batch.run(tmp_path / "in.csv", tmp_path / "out.parquet", **GIVEN)
    found = pq.read_table(tmp_path / "out.parquet")
    assert {name: found.schema.field(name).type for name in VALUES} == {name: t for name, (_, t) in VALUES.items()}
    # An independent reader, which alone knows times of day.
    alone = pacsv.read_csv(io.BytesIO(text.getvalue().encode()))
    for name in VALUES.keys() - {"clock", "text", "mixed"}:
        assert found.column(name).slice(0, 4).to_pylist() == alone.column(name).to_pylist()
    assert found.column("whole").to_pylist()[-1] is None
    assert found.column("text").to_pylist() == ["1", "2", "x", "", None]
