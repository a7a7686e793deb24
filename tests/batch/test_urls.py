"""Tables behind URLs: memory:// in this process, and a real S3 server where LOITER_TEST_S3 names one.

LOITER_TEST_S3 is the address of a server for tests, such as http://127.0.0.1:5000 of `moto_server`; it needs s3fs, and
AWS_ACCESS_KEY_ID and AWS_SECRET_ACCESS_KEY, which may be anything. A bucket is created and deleted.
"""

import os
import sys
from importlib.util import find_spec
from pathlib import Path
from secrets import token_hex

import fsspec
import polars as pl
import pyarrow as pa
import pyarrow.csv
import pyarrow.parquet as pq
import pytest

import loiter
from batch.making import GIVEN, OPTIONS, poses, read, small_parts, stopping, write
from loiter.batch.jobs import parts
from loiter.batch.tables import storage
from loiter.batch.tables.sources import SUCCESS
from loiter.cli.app import main
from loiter.errors import InvalidArgument, MissingPackage, Unfinished

S3 = os.environ.get("LOITER_TEST_S3")


@pytest.fixture(autouse=True)
def _small_parts(tmp_path, monkeypatch):
    small_parts(monkeypatch)
    monkeypatch.chdir(tmp_path)


def s3_root(monkeypatch):
    if not (S3 and find_spec("s3fs")):
        pytest.skip("no S3 server: LOITER_TEST_S3 gives the address of one, and it needs s3fs")
    monkeypatch.setenv("AWS_ENDPOINT_URL", S3)
    bucket = f"loiter-{token_hex(4)}"
    store = fsspec.filesystem("s3", skip_instance_cache=True)
    store.mkdir(bucket)
    return store, f"s3://{bucket}/tables"


# Without a server one test alone is skipped.
@pytest.fixture(params=["memory", "s3"] if S3 else ["memory"])
def root(request, monkeypatch):
    """A URL below which there is nothing yet."""
    if request.param == "memory":
        yield f"memory://{token_hex(4)}"
        return
    store, url = s3_root(monkeypatch)
    yield url
    store.rm(url.split("/")[2], recursive=True)


@pytest.fixture
def expected(root):
    """The rows that each output must have, of a table of ten parts at `root`/in.parquet."""
    write(poses(1000), Path("in.parquet"), 100)
    put("in.parquet", f"{root}/in.parquet")
    loiter.batch.run("in.parquet", "expected.parquet", **GIVEN)
    return read(Path("expected.parquet"))


def put(local, url):
    store, path = fsspec.core.url_to_fs(url)
    store.pipe_file(path, Path(local).read_bytes())


def content(url):
    store, path = fsspec.core.url_to_fs(url)
    return store.cat_file(path)


def below(url):
    """The names of all files below a URL."""
    store, path = fsspec.core.url_to_fs(url)
    store.invalidate_cache()
    return sorted(name.removeprefix(path).strip("/") for name in store.find(path))


def rows_of(url):
    parts = [name for name in below(url) if name.endswith(".parquet")]
    return [row for name in parts for row in pq.read_table(pa.BufferReader(content(f"{url}/{name}"))).to_pylist()]


@pytest.mark.parametrize("target", ["out/", "sub/out.parquet/"])
def test_a_dataset_behind_a_url(root, expected, target):
    summary = loiter.batch.run(f"{root}/in.parquet", f"{root}/{target}", **GIVEN)
    assert (summary.rows, summary.parts) == (1000, 10)
    out = f"{root}/{target.rstrip('/')}"
    assert rows_of(out) == expected
    first, *others = below(out)
    assert first == SUCCESS
    assert len(others) == 10
    assert loiter.batch.run(f"{root}/in.parquet", f"{root}/{target}", **GIVEN).resumed_parts == 10


@pytest.mark.parametrize("kind", [".parquet", ".csv", ".csv.gz"])
def test_a_file_behind_a_url(root, expected, kind):
    loiter.batch.run("in.parquet", f"here{kind}", **GIVEN)
    loiter.batch.run(f"{root}/in.parquet", f"{root}/out{kind}", **GIVEN)
    assert content(f"{root}/out{kind}") == Path(f"here{kind}").read_bytes()
    assert below(root) == ["in.parquet", f"out{kind}"]


@pytest.mark.parametrize("kind", [".csv", ".csv.gz"])
def test_csv_behind_a_url(root, kind):
    write(poses(300), Path("plain.csv"))
    Path("in.csv.gz").write_bytes(pa.compress(Path("plain.csv").read_bytes(), "gzip", asbytes=True))
    Path("in.csv").write_bytes(Path("plain.csv").read_bytes())
    put(f"in{kind}", f"{root}/in{kind}")
    loiter.batch.run(f"in{kind}", "expected.csv", **GIVEN)
    loiter.batch.run(f"{root}/in{kind}", f"{root}/out.csv", **GIVEN)
    assert content(f"{root}/out.csv") == Path("expected.csv").read_bytes()
    assert below(root) == [f"in{kind}", "out.csv"]


@pytest.mark.parametrize("source", ["data", "data/", "data/*.parquet", "data/part.?.parquet"])
def test_a_dataset_or_a_pattern_behind_a_url_is_the_input(root, source):
    table = poses(300)
    for i in range(3):
        write(table.slice(100 * i, 100), Path("part.parquet"))
        put("part.parquet", f"{root}/data/part.{i}.parquet")
    Path("empty").touch()
    put("empty", f"{root}/data/_SUCCESS") if "*" not in source else None
    loiter.batch.run(f"{root}/{source}", "out.parquet", **GIVEN)
    assert [row["id"] for row in read(Path("out.parquet"))] == list(range(300))


@pytest.mark.parametrize("target", ["out/", "out.parquet"])
def test_a_stopped_job_resumes_from_the_parts_behind_the_url(root, expected, target):
    with stopping(4, OSError(5, "")), pytest.raises(Unfinished, match=f"4 finished parts stay in {root}/out"):
        loiter.batch.run(f"{root}/in.parquet", f"{root}/{target}", workers=1, **GIVEN)
    assert "out.parquet" not in below(root)
    summary = loiter.batch.run(f"{root}/in.parquet", f"{root}/{target}", **GIVEN)
    assert summary.resumed_parts == 4
    assert (rows_of(f"{root}/out") if target == "out/" else None) in (expected, None)
    left = [name for name in below(root) if "part-" in name or "job" in name]
    assert len(left) == (10 if target == "out/" else 0)


def test_an_upload_that_fails_leaves_nothing(root, expected, monkeypatch):
    store, _ = fsspec.core.url_to_fs(root)
    with monkeypatch.context() as patch:
        # An error of the library of a store need not be an OSError.
        def fail(*arguments, **options):
            raise RuntimeError("no such bucket today")

        async def fail_later(*arguments, **options):
            fail()

        is_async = hasattr(store, "_put_file")
        patch.setattr(type(store), "_put_file" if is_async else "put_file", fail_later if is_async else fail)
        type(store).clear_instance_cache()
        with pytest.raises(Unfinished, match="RuntimeError: no such bucket today; no part was finished"):
            loiter.batch.run("in.parquet", f"{root}/out/", **GIVEN)
    # Each store object has its own copy of the method.
    type(store).clear_instance_cache()
    assert below(root) == ["in.parquet"]


def test_an_input_that_changes_meanwhile_is_reported(root, expected, monkeypatch):
    solve = parts.solve_part
    write(poses(1000, seed=3), Path("other.parquet"), 100)

    def solve_part(job, part, *tick):
        counts = solve(job, part, *tick)
        if part.number == 9:
            put("other.parquet", f"{root}/in.parquet")
        return counts

    monkeypatch.setattr("loiter.batch.jobs.job.solve_part", solve_part)
    with pytest.raises(InvalidArgument, match="it changed while it was read"):
        loiter.batch.run(f"{root}/in.parquet", f"{root}/out.parquet", workers=1, **GIVEN)
    assert "out.parquet" not in below(root)


def test_parts_of_another_job_are_refused_behind_a_url(root, expected):
    loiter.batch.run("in.parquet", f"{root}/out/", **GIVEN)
    with pytest.raises(InvalidArgument, match="it has parts of a job with another input, option or program"):
        loiter.batch.run("in.parquet", f"{root}/out/", turn="cw", **GIVEN)
    put("in.parquet", f"{root}/out/mine.parquet")
    with pytest.raises(InvalidArgument, match=r"it has a file mine\.parquet, which this job did not write"):
        loiter.batch.run("in.parquet", f"{root}/out/", **GIVEN)


def test_a_url_without_a_file_is_refused(root, capsys):
    assert main(["batch", f"{root}/no.parquet", "out.parquet", *OPTIONS]) == 2
    line = f"loiter: IN is '{root}/no.parquet': it cannot be read, No such file or directory\n"
    assert capsys.readouterr().err == line
    assert main(["batch", f"{root}/no-*.parquet", "out.parquet", *OPTIONS]) == 2
    assert capsys.readouterr().err == f"loiter: IN is '{root}/no-*.parquet': no file matches\n"


def test_the_output_may_not_be_the_input_behind_a_url(root, expected):
    with pytest.raises(InvalidArgument, match="that is the input"):
        loiter.batch.run(f"{root}/in.parquet", f"{root}/in.parquet", **GIVEN)
    with pytest.raises(InvalidArgument, match="that is in the folder of the input"):
        loiter.batch.run(root, f"{root}/out/", **GIVEN)


def test_unknown_schemes_are_refused(capsys):
    write(poses(5), Path("in.parquet"))
    assert main(["batch", "in.parquet", "ftp://host/out.parquet", *OPTIONS]) == 2
    known = "s3://, gs://, gcs://, az://, abfs://, memory://"
    line = f"loiter: OUT is 'ftp://host/out.parquet': a URL must begin with one of {known}\n"
    assert capsys.readouterr().err == line


@pytest.mark.parametrize(("scheme", "package"), [("s3", "s3fs"), ("gs", "gcsfs"), ("az", "adlfs"), ("abfs", "adlfs")])
def test_a_missing_package_is_named(monkeypatch, scheme, package):
    write(poses(5), Path("in.parquet"))
    monkeypatch.setitem(sys.modules, package, None)
    monkeypatch.delitem(sys.modules["fsspec.registry"]._registry, scheme, raising=False)
    sentence = f"tables behind {scheme}:// need {package}: pip install {package} brings it"
    with pytest.raises(MissingPackage, match=sentence):
        loiter.batch.run("in.parquet", f"{scheme}://bucket/out/", **GIVEN)


def test_a_worker_of_a_cluster_that_lacks_the_file_is_told_apart(root, expected):
    # Each process has its own memory://.
    assert storage.version_of(f"{root}/in.parquet")[0] == Path("in.parquet").stat().st_size
    with pytest.raises(FileNotFoundError):
        storage.version_of(f"{root}/other.parquet")


def test_others_read_a_dataset_in_s3(monkeypatch):
    store, url = s3_root(monkeypatch)
    write(poses(300), Path("in.parquet"), 100)
    loiter.batch.run("in.parquet", f"{url}/out/", **GIVEN)
    options = {"aws_endpoint_url": S3, "aws_allow_http": "true", "aws_region": "us-east-1"}
    assert pl.scan_parquet(f"{url}/out/", storage_options=options).collect().height == 300
    assert pq.read_table(url.removeprefix("s3://") + "/out", filesystem=store).num_rows == 300
    store.rm(url.split("/")[2], recursive=True)


def test_files_that_others_write_meanwhile_are_seen_in_s3(monkeypatch):
    store, url = s3_root(monkeypatch)
    here = storage.folder_at(f"{url}/out")
    store.pipe_file(f"{url}/out/one", b"1")
    assert here.names() == ["one"]
    store.pipe_file(f"{url}/out/two", b"2")
    with storage.open_place(here.place("two")) as file:
        assert file.read() == b"2"
    assert storage.version_of(here.place("two"))[0] == 1
    store.rm(url.split("/")[2], recursive=True)
