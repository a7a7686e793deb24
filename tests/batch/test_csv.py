"""CSV tables as people and programs write them, also with errors."""

import csv
import gzip
import io

import numpy as np
import pyarrow.parquet as pq
import pytest

import loiter
from batch.making import ADDED, ORBIT, UAV
from loiter.batch.tables import files, ingest, lines
from loiter.errors import InvalidArgument

GIVEN = {"orbit": ORBIT, "aircraft": UAV}
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


def test_a_line_with_the_wrong_number_of_fields_keeps_its_place(solved):
    lines = ["0,90,60,100", "1,90,60", "2,90,60,100", "3,90,60,100,5", "4", "5,90,60,100", "6,90,60,100,"]
    rows, summary = solved(HEADER + "\n".join(lines))
    assert statuses(rows) == ["ok", "malformed", "ok", "malformed", "malformed", "ok", "malformed"]
    assert [row["id"] for row in rows] == ["0", "", "2", "", "", "5", ""]
    assert summary.rows == 7


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
    assert [row["id"] for row in rows] == [None if b else str(i) for i, b in enumerate(bad)]
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
    monkeypatch.setattr(lines, "CHUNK_BYTES", 5000)
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


@pytest.mark.parametrize("chunk", [1, 7, 64, 4096])
def test_repaired_text_is_the_same_in_pieces_of_any_size(monkeypatch, chunk):
    text = (HEADER + '0,1,2,3\n"a\n\n,b",1,2,3\r\n' * 20 + '0,"1,2,3\n' + "1,2,3,4\n" * 150 + '"q"",1,2,3').encode()
    expected = b"".join(lines.repaired_lines(io.BytesIO(text), 4))
    monkeypatch.setattr(lines, "CHUNK_BYTES", chunk)
    assert b"".join(lines.repaired_lines(io.BytesIO(text), 4)) == expected
    assert lines.RepairedLines(io.BytesIO(text), 4).read() == expected
    assert expected == text.replace(b'0,"1,2,3', b",,,,").replace(b'"q"",1,2,3', b",,,,") + b"\n"


def test_bytes_that_are_not_utf_8_affect_only_their_own_line(solved):
    lines = [b"0,90,60,100", b"caf\xe9,90,60,100", "Grüße,90,60,100".encode(), b"3,90,\xff,100"]
    rows, _ = solved(HEADER.encode() + b"\n".join(lines))
    assert statuses(rows) == ["ok", "malformed", "ok", "malformed"]
    assert [row["id"] for row in rows] == ["0", "", "Grüße", ""]


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
        (HEADER.encode("utf-16"), ".csv", "utf-8"),
        (b"id,east_m\n", ".csv.gz", "Not a gzipped file"),
        (PACKED[:-100], ".csv.gz", "Truncated compressed stream"),
        (PACKED[:-8] + bytes(8), ".csv.gz", "incorrect data check"),
        (b"PAR1 no table PAR1", ".parquet", "Parquet"),
        (b"id,east_m\n", ".parquet", "Parquet"),
    ],
)
def test_what_cannot_be_read_is_reported_and_leaves_nothing(solved, tmp_path, content, suffix, why):
    with pytest.raises(InvalidArgument, match=why) as raised:
        solved(content, suffix)
    assert raised.value.argument == "source"
    assert [path.name for path in tmp_path.iterdir()] == [f"in{suffix}"]
