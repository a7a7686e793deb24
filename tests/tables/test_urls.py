"""Tables behind URLs: memory:// in this process, and a server with the protocol of S3 on this machine."""

import sys
from pathlib import Path
from secrets import token_hex

import fsspec
import pyarrow as pa
import pyarrow.csv
import pyarrow.parquet as pq
import pytest

import loiter
from loiter.cli.app import main
from loiter.errors import InvalidArgument, MissingPackage, Unfinished
from loiter.tables import parts
from loiter.tables.files import SUCCESS
from tables.making import GIVEN, OPTIONS, poses, read, small_parts, stopping, write
from tables.s3 import serve


@pytest.fixture(autouse=True)
def _small_parts(tmp_path, monkeypatch):
    small_parts(monkeypatch)
    monkeypatch.chdir(tmp_path)


@pytest.fixture
def root():
    """A URL below which there is nothing yet."""
    return f"memory://{token_hex(4)}"


@pytest.fixture
def expected(root):
    """The rows that each output must have, of a table of ten parts at `root`/in.parquet."""
    write(poses(1000), Path("in.parquet"), 100)
    put("in.parquet", f"{root}/in.parquet")
    loiter.tables.run("in.parquet", "expected.parquet", **GIVEN)
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
    summary = loiter.tables.run(f"{root}/in.parquet", f"{root}/{target}", **GIVEN)
    assert (summary.rows, summary.parts) == (1000, 10)
    out = f"{root}/{target.rstrip('/')}"
    assert rows_of(out) == expected
    first, *others = below(out)
    assert first == SUCCESS
    assert len(others) == 10
    assert loiter.tables.run(f"{root}/in.parquet", f"{root}/{target}", **GIVEN).resumed_parts == 10


@pytest.mark.parametrize("kind", [".parquet", ".csv", ".csv.gz"])
def test_a_file_behind_a_url(root, expected, kind):
    loiter.tables.run("in.parquet", f"here{kind}", **GIVEN)
    loiter.tables.run(f"{root}/in.parquet", f"{root}/out{kind}", **GIVEN)
    assert content(f"{root}/out{kind}") == Path(f"here{kind}").read_bytes()
    assert below(root) == ["in.parquet", f"out{kind}"]


@pytest.mark.parametrize("kind", [".csv", ".csv.gz"])
def test_csv_behind_a_url(root, kind):
    write(poses(300), Path("plain.csv"))
    Path("in.csv.gz").write_bytes(pa.compress(Path("plain.csv").read_bytes(), "gzip", asbytes=True))
    Path("in.csv").write_bytes(Path("plain.csv").read_bytes())
    put(f"in{kind}", f"{root}/in{kind}")
    loiter.tables.run(f"in{kind}", "expected.csv", **GIVEN)
    loiter.tables.run(f"{root}/in{kind}", f"{root}/out.csv", **GIVEN)
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
    loiter.tables.run(f"{root}/{source}", "out.parquet", **GIVEN)
    assert [row["id"] for row in read(Path("out.parquet"))] == list(range(300))


@pytest.mark.parametrize("target", ["out/", "out.parquet"])
def test_a_stopped_job_resumes_from_the_parts_behind_the_url(root, expected, target):
    with stopping(4, OSError(5, "")), pytest.raises(Unfinished, match=f"4 finished parts stay in {root}/out"):
        loiter.tables.run(f"{root}/in.parquet", f"{root}/{target}", workers=1, **GIVEN)
    assert "out.parquet" not in below(root)
    summary = loiter.tables.run(f"{root}/in.parquet", f"{root}/{target}", **GIVEN)
    assert summary.resumed_parts == 4
    assert (rows_of(f"{root}/out") if target == "out/" else None) in (expected, None)
    left = [name for name in below(root) if "part-" in name or "job" in name]
    assert len(left) == (10 if target == "out/" else 0)


def test_an_upload_that_fails_leaves_nothing(root, expected, monkeypatch):
    def fail(*arguments, **options):
        raise OSError("no such bucket today")

    with monkeypatch.context() as patch:
        patch.setattr("loiter.tables.files.fs.copy_files", fail)
        with pytest.raises(Unfinished, match="no such bucket today; no part was finished"):
            loiter.tables.run("in.parquet", f"{root}/out/", **GIVEN)
    assert below(root) == ["in.parquet"]


def test_an_input_that_changes_meanwhile_is_reported(root, expected, monkeypatch):
    solve = parts.solve_part
    write(poses(1000, seed=3), Path("other.parquet"), 100)

    def solve_part(part, *stopped):
        counts = solve(part, *stopped)
        if "part-00009" in part.place.name:
            put("other.parquet", f"{root}/in.parquet")
        return counts

    monkeypatch.setattr("loiter.tables.parts.solve_part", solve_part)
    with pytest.raises(InvalidArgument, match="it changed while it was read"):
        loiter.tables.run(f"{root}/in.parquet", f"{root}/out.parquet", workers=1, **GIVEN)
    assert "out.parquet" not in below(root)


def test_parts_of_another_job_are_refused_behind_a_url(root, expected):
    loiter.tables.run("in.parquet", f"{root}/out/", **GIVEN)
    with pytest.raises(InvalidArgument, match="it has parts of a job with another input, option or program"):
        loiter.tables.run("in.parquet", f"{root}/out/", turn="cw", **GIVEN)
    put("in.parquet", f"{root}/out/mine.parquet")
    with pytest.raises(InvalidArgument, match=r"it has a file mine\.parquet, which this job did not write"):
        loiter.tables.run("in.parquet", f"{root}/out/", **GIVEN)


def test_a_url_without_a_file_is_refused(root, capsys):
    assert main(["batch", f"{root}/no.parquet", "out.parquet", *OPTIONS]) == 2
    line = f"loiter: IN is '{root}/no.parquet': it cannot be read, No such file or directory\n"
    assert capsys.readouterr().err == line
    assert main(["batch", f"{root}/no-*.parquet", "out.parquet", *OPTIONS]) == 2
    assert capsys.readouterr().err == f"loiter: IN is '{root}/no-*.parquet': no file matches\n"


def test_the_output_may_not_be_the_input_behind_a_url(root, expected):
    with pytest.raises(InvalidArgument, match="that is the input"):
        loiter.tables.run(f"{root}/in.parquet", f"{root}/in.parquet", **GIVEN)
    with pytest.raises(InvalidArgument, match="that is in the folder of the input"):
        loiter.tables.run(root, f"{root}/out/", **GIVEN)


def test_unknown_schemes_are_refused(capsys):
    write(poses(5), Path("in.parquet"))
    assert main(["batch", "in.parquet", "ftp://host/out.parquet", *OPTIONS]) == 2
    known = "s3://, gs://, gcs://, az://, abfs://, memory://"
    line = f"loiter: OUT is 'ftp://host/out.parquet': a URL must begin with one of {known}\n"
    assert capsys.readouterr().err == line


@pytest.mark.parametrize(("scheme", "package"), [("az", "adlfs")])
def test_a_missing_package_is_named(monkeypatch, scheme, package):
    write(poses(5), Path("in.parquet"))
    monkeypatch.setitem(sys.modules, package, None)
    monkeypatch.delitem(sys.modules["fsspec.registry"]._registry, scheme, raising=False)
    sentence = f"tables behind {scheme}:// need {package}: pip install {package} brings it"
    with pytest.raises(MissingPackage, match=sentence):
        loiter.tables.run("in.parquet", f"{scheme}://bucket/out/", **GIVEN)


@pytest.fixture
def objects(monkeypatch):
    """The objects of a store, by bucket and key."""
    server = serve()
    monkeypatch.setenv("AWS_ENDPOINT_URL", f"http://127.0.0.1:{server.server_port}")
    for name in ("AWS_ACCESS_KEY_ID", "AWS_SECRET_ACCESS_KEY", "AWS_EC2_METADATA_DISABLED"):
        monkeypatch.setenv(name, "true")
    yield server.objects
    server.shutdown()
    server.server_close()


@pytest.mark.parametrize("source", ["in.parquet", "in.csv"])
@pytest.mark.parametrize("target", ["out/", "out.parquet", "out.csv"])
def test_a_stopped_job_resumes_in_s3(objects, source, target):
    write(poses(1000), Path(source), 100)
    loiter.tables.run(source, target, **GIVEN)
    objects[f"here/data/{source}"] = Path(source).read_bytes()
    urls = f"s3://here/data/*{Path(source).suffix}", f"s3://here/{target}"
    with stopping(4, OSError(5, "")), pytest.raises(Unfinished, match="4 finished parts stay in s3://here/out"):
        loiter.tables.run(*urls, workers=1, **GIVEN)
    assert "here/out.csv" not in objects
    assert "here/out/_SUCCESS" not in objects
    assert loiter.tables.run(*urls, **GIVEN).resumed_parts == 4
    files = {name for name in objects if not name.endswith(("/", ".parts", "_temporary"))} - {f"here/data/{source}"}
    if target == "out/":
        assert len(files) == 11
        names = sorted(name for name in files if name.endswith(".parquet"))
        here = [row for path in sorted(Path("out").glob("*.parquet")) for row in read(path)]
        there = [row for name in names for row in pq.read_table(pa.BufferReader(objects[name])).to_pylist()]
        assert here == there
    else:
        assert files == {f"here/{target}"}
        assert objects[f"here/{target}"] == Path(target).read_bytes()


def test_what_is_not_in_s3_is_refused(objects, capsys):
    assert main(["batch", "s3://here/no.parquet", "out.parquet", *OPTIONS]) == 2
    line = "loiter: IN is 's3://here/no.parquet': it cannot be read, No such file or directory\n"
    assert capsys.readouterr().err == line


def test_an_upload_that_fails_without_an_error_is_reported(root, expected, monkeypatch):
    monkeypatch.setattr("loiter.tables.files.fs.copy_files", lambda *arguments: None)
    with pytest.raises(Unfinished, match=r"part-0000\d-\w+\.parquet was not uploaded; no part was finished"):
        loiter.tables.run("in.parquet", f"{root}/out/", **GIVEN)
