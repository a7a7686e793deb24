"""One Parquet file from the row groups of others: the footer is what pyarrow would write."""

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
import pytest
from hypothesis import given
from hypothesis import strategies as st

from batch.making import poses, scenes, write
from loiter.batch.tables import joined, parquet_footer
from loiter.batch.tables.joined import open_joined
from loiter.batch.tables.parquet_footer import Items, Value, decode, encode, joined_footer


def footer_of(path):
    with path.open("rb") as file:
        return joined._footer(file)[1]


def tables():
    rows = 300
    table = scenes(rows)
    words = pa.array(["a", "b", None] * (rows // 3))
    extra = {
        "camera": words.dictionary_encode(),
        "text": words,
        "tags": pa.array([[1, 2], None, []] * (rows // 3)),
        "place": pa.array([{"x": 1.0, "y": None}] * rows),
        "seen": pa.array([None] * rows, pa.timestamp("us", "UTC")),
        "price": pa.array(range(rows)).cast(pa.decimal128(25, 2)),
        "flag": pa.array([True, False, None] * (rows // 3)),
        "small": pa.array(np.arange(rows) % 100, pa.int8()),
    }
    for name, column in extra.items():
        table = table.append_column(name, column)
    return [table.replace_schema_metadata({"made by": "somebody"}).slice(start, 100) for start in (0, 100, 200)]


OPTIONS = {
    "default": {},
    "page index": {"write_page_index": True},
    "old": {"version": "1.0", "compression": "gzip"},
    "plain": {"use_dictionary": False, "compression": None, "write_statistics": False},
    "new": {"data_page_version": "2.0", "compression": "zstd", "column_encoding": None, "store_schema": False},
}


@pytest.mark.parametrize("options", OPTIONS.values(), ids=OPTIONS)
def test_a_joined_file_is_the_parts_one_after_another(tmp_path, options):
    parts = tables()
    paths = [tmp_path / f"{i}.parquet" for i in range(3)]
    for part, path in zip(parts, paths, strict=True):
        pq.write_table(part, path, row_group_size=40, **options)
    out = tmp_path / "out.parquet"
    with open_joined(".parquet", str(out), parts[0].schema) as append:
        for path in paths:
            append(str(path))
    assert pq.read_table(out).equals(pa.concat_tables(map(pq.read_table, paths)))
    metadata = pq.read_metadata(out)
    assert (metadata.num_rows, metadata.num_row_groups) == (300, 9)
    assert metadata.metadata == pq.read_metadata(paths[0]).metadata
    groups = [pq.read_metadata(path).row_group(i) for path in paths for i in range(3)]
    for i, group in enumerate(groups):
        for j in range(group.num_columns):
            before, after = group.column(j).to_dict(), metadata.row_group(i).column(j).to_dict()
            moved = {name for name in before if before[name] != after[name]}
            assert moved <= {"file_offset", "data_page_offset", "dictionary_page_offset"}
    # The bytes of the pages are those of the parts, and nothing lies between them.
    content = out.read_bytes()
    pages = b"".join(path.read_bytes()[4 : -8 - len(footer_of(path))] for path in paths)
    assert content[4:].startswith(pages)
    assert len(content) == 4 + len(pages) + len(footer_of(out)) + 8


def test_one_part_alone_is_not_changed(tmp_path):
    path = write(poses(100), tmp_path / "in.parquet", 30)
    with open_joined(".parquet", str(tmp_path / "out.parquet"), poses(1).schema) as append:
        append(str(path))
    assert (tmp_path / "out.parquet").read_bytes() == path.read_bytes()


def test_a_copy_without_the_help_of_the_system(tmp_path, monkeypatch):
    path = write(poses(1000), tmp_path / "in.parquet")
    monkeypatch.delattr("os.copy_file_range", raising=False)
    monkeypatch.setattr(joined, "_COPY_BYTES", 1000)
    with open_joined(".parquet", str(tmp_path / "out.parquet"), poses(1).schema) as append:
        append(str(path))
    assert (tmp_path / "out.parquet").read_bytes() == path.read_bytes()


def test_more_row_groups_than_ordinals():
    group = {1: Value(9, Items(12, [])), 3: Value(6, 1), 7: Value(4, 0)}
    file = {3: Value(6, 1), 4: Value(9, Items(12, [group]))}
    whole = decode(joined_footer([encode(file)] * 32_769, [0] * 32_769))
    assert whole[3].value == 32_769
    first, *_, last_but_one, last = whole[4].value.values
    assert (first[7].value, last_but_one[7].value, 7 in last) == (0, 32_767, False)


@pytest.mark.parametrize("content", [b"", b"\x15", b"\x18\x05ab", b"\x1b\x00\x00", b"\x00\x00", b"\x19\x2c\x15"])
def test_bytes_that_are_no_footer_are_refused(content):
    with pytest.raises(ValueError, match=r"Thrift protocol|unknown way"):
        joined_footer([content], [0])


numbers = st.integers(-(1 << 63), (1 << 63) - 1)
values = st.deferred(
    lambda: st.one_of(
        st.builds(Value, st.just(6), numbers),
        st.builds(Value, st.just(8), st.binary(max_size=300)),
        st.builds(Value, st.just(7), st.tuples(st.floats(allow_nan=False))),
        st.builds(Value, st.sampled_from([1, 2]), st.none()),
        st.builds(Value, st.just(3), st.integers(0, 255)),
        st.builds(Value, st.just(12), structures),
        st.builds(Value, st.just(9), st.builds(Items, st.just(6), st.lists(numbers, max_size=20))),
    )
)
structures = st.dictionaries(st.integers(-3, 40), values, max_size=4)


@given(structures)
def test_what_is_written_is_read_back(fields):
    assert decode(encode(fields)) == fields


@given(st.binary(max_size=60))
def test_any_bytes_are_read_or_refused(content):
    try:
        parquet_footer.decode(content)
    except ValueError:
        pass
    except KeyError as error:
        raise AssertionError from error
