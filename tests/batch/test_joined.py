"""One file from the parts of a job."""

import gzip

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
import pytest

from batch.making import scenes
from loiter.batch.tables import outputs
from loiter.batch.tables.outputs import csv_header, no_rows, open_joined, open_part


def tables():
    rows = 300
    table = scenes(rows)
    words = pa.array(["a", "b", None] * (rows // 3))
    extra = {
        "camera": words.dictionary_encode(),
        "text": words,
        "long": words.cast(pa.large_string()),
        "tags": pa.array([[1, 2], None, []] * (rows // 3)),
        "place": pa.array([{"x": 1.0, "y": None}] * rows, pa.struct({"x": pa.float64(), "y": pa.string()})),
        "seen": pa.array([None] * rows, pa.timestamp("us", "UTC")),
        "price": pa.array(range(rows)).cast(pa.decimal128(25, 2)),
        "flag": pa.array([True, False, None] * (rows // 3)),
        "small": pa.array(np.arange(rows) % 100, pa.int8()),
        "status": pa.array(["ok"] * rows).dictionary_encode().cast(pa.dictionary(pa.int8(), pa.string())),
    }
    for name, column in extra.items():
        table = table.append_column(name, column)
    return [table.replace_schema_metadata({"made by": "somebody"}).slice(start, 100) for start in (0, 100, 200)]


def write_parts(folder, kind, parts):
    paths = [folder / f"{i}{kind}" for i in range(len(parts))]
    for part, path in zip(parts, paths, strict=True):
        with open_part(kind, str(path), part.schema, ["camera", "text"]) as write:
            for batch in part.to_batches():
                write(batch)
    return paths


def join(folder, kind, parts, paths):
    out = folder / f"out{kind}"
    with open_joined(kind, str(out), parts[0].schema, ["camera", "text"]) as append:
        for path in paths:
            append(str(path))
    return out


def test_a_joined_parquet_file_has_the_rows_types_and_metadata_of_its_parts(tmp_path, monkeypatch):
    monkeypatch.setattr(outputs, "ROW_GROUP_ROWS", 40)
    parts = tables()
    out = join(tmp_path, ".parquet", parts, write_parts(tmp_path, ".parquet", parts))
    joined = pq.read_table(out)
    assert joined.equals(pq.read_table(pa.py_buffer(whole(parts))))
    assert joined.schema.metadata == {b"made by": b"somebody"}
    metadata = pq.read_metadata(out)
    # Of each part, 40 + 40 + 20 rows, the rest with the first of the next one.
    assert max(metadata.row_group(i).num_rows for i in range(metadata.num_row_groups)) < 80


def whole(parts):
    sink = pa.BufferOutputStream()
    pq.write_table(pa.concat_tables(parts), sink, use_dictionary=["camera", "text"])
    return sink.getvalue()


@pytest.mark.parametrize("kind", [".csv", ".csv.gz"])
@pytest.mark.parametrize("size", [7, 1 << 23])
def test_joined_lines_are_those_of_the_parts_after_one_header(tmp_path, monkeypatch, kind, size):
    monkeypatch.setattr(outputs, "_COPY_BYTES", size)
    parts = [part.drop_columns(["tags", "place"]) for part in tables()]
    paths = write_parts(tmp_path, kind, parts)
    content = join(tmp_path, kind, parts, paths).read_bytes()
    trailer = len(outputs._TRAILER.pack(b"", *no_rows().tolist()))
    lines = b"".join(path.read_bytes()[:-trailer] for path in paths)
    header = csv_header(parts[0].schema)
    unpack = gzip.decompress if kind == ".csv.gz" else bytes
    assert unpack(content) == header + unpack(lines)


@pytest.mark.parametrize("kind", [".parquet", ".csv"])
def test_a_part_without_its_end_is_refused(tmp_path, kind):
    parts = [part.drop_columns(["tags", "place"]) for part in tables()]
    [path, *_] = write_parts(tmp_path, kind, parts)
    path.write_bytes(path.read_bytes()[:20])
    with pytest.raises((OSError, ValueError)):
        join(tmp_path, kind, parts, [path])
