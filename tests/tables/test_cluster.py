"""A real Dask scheduler and real workers: the same bytes as on one machine, also if workers are lost."""

import gzip
import re
import signal
import subprocess
import sys
import time
from contextlib import ExitStack

import pytest

import loiter
from loiter.tables import cluster, files
from tables.making import ENVIRONMENT, OPTIONS, ORBIT, UAV, poses, small_parts, write

BATCH = """
import sys
from tables.killing import small
from loiter.cli.app import main
small()
sys.exit(main(sys.argv[1:]))
"""


class Cluster:
    """A scheduler on this machine, and workers that may be killed."""

    def __init__(self, stack, place):
        self.stack, self.place, self.workers = stack, place, []
        said = place / "scheduler.txt"
        self.scheduler = self._start(
            "scheduler", "--host", "127.0.0.1", "--port", "0", "--no-dashboard", "--scheduler-file", said
        )
        while not (said.exists() and said.read_text().endswith("}")):
            time.sleep(0.05)
        self.address = re.search(r"tcp://[\d.:]+", said.read_text())[0]

    def work(self):
        """One more worker, a slow one."""
        arguments = [
            "worker",
            self.address,
            "--nthreads",
            "1",
            "--no-nanny",
            "--no-dashboard",
            "--preload",
            "tables.slow",
        ]
        self.workers.append(self._start(*arguments, "--local-directory", self.place))

    def lose(self):
        """Kills a worker."""
        worker = self.workers.pop()
        worker.kill()
        worker.wait()

    def batch(self, *arguments):
        """Starts loiter batch on this cluster, in parts of 500 rows."""
        command = [sys.executable, "-c", BATCH, "batch", *arguments, *OPTIONS, "--scheduler", self.address]
        process = subprocess.Popen(command, stderr=subprocess.PIPE, text=True, cwd=self.place, env=ENVIRONMENT)
        self.stack.callback(self._end, process)
        return process

    def _start(self, *arguments):
        command = [sys.executable, "-m", "dask", *map(str, arguments)]
        log = self.stack.enter_context((self.place / f"log-{arguments[0]}-{len(self.workers)}").open("w"))
        process = subprocess.Popen(command, stdout=log, stderr=log, cwd=self.place, env=ENVIRONMENT)
        self.stack.callback(self._end, process)
        return process

    @staticmethod
    def _end(process):
        process.kill()
        process.wait()
        if process.stderr:
            process.stderr.close()


@pytest.fixture
def place(tmp_path):
    """The folder that everybody works in."""
    return tmp_path


@pytest.fixture
def cluster_here(place):
    """A cluster without workers yet."""
    with ExitStack() as stack:
        yield Cluster(stack, place)


def expected(source, target):
    """What a local run writes."""
    loiter.tables.run(source, target, orbit=ORBIT, aircraft=UAV)
    return target.read_bytes()


def wait_for_parts(process, at, count):
    while len(list(at.glob("part-*.parquet"))) < count:
        assert process.poll() is None, process.stderr.read()
        time.sleep(0.02)


@pytest.fixture(autouse=True)
def _small_parts(monkeypatch):
    small_parts(monkeypatch, 500, 500, 100)


def test_without_a_scheduler_one_sentence_says_so(tmp_path):
    write(poses(5), tmp_path / "in.parquet")
    arguments = ["batch", "in.parquet", "out.parquet", *OPTIONS, "--scheduler", "tcp://127.0.0.1:9"]
    command = [sys.executable, "-c", BATCH, *arguments]
    done = subprocess.run(command, capture_output=True, text=True, cwd=tmp_path, env=ENVIRONMENT)
    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr == "loiter: --scheduler is 'tcp://127.0.0.1:9': no Dask scheduler answers there\n"
    assert [path.name for path in tmp_path.iterdir()] == ["in.parquet"]


def test_a_scheduler_without_workers_is_reported(cluster_here, place):
    write(poses(5), place / "in.parquet")
    process = cluster_here.batch("in.parquet", "out.parquet")
    _, err = process.communicate()
    assert process.returncode == 2
    assert err == f"loiter: --scheduler is {cluster_here.address!r}: it has no workers\n"
    assert not (place / "out.parquet.parts").exists()


def test_a_lost_workers_parts_are_done_by_the_others(cluster_here, place):
    write(poses(20_000), place / "in.parquet", 500)
    bytes_here = expected(place / "in.parquet", place / "out-here.parquet")
    for _ in range(2):
        cluster_here.work()
    process = cluster_here.batch("in.parquet", "out.parquet")
    wait_for_parts(process, place / "out.parquet.parts", 6)
    cluster_here.lose()
    _, err = process.communicate()
    assert process.returncode == 0, err
    assert err.startswith("20,000 rows in ")
    assert (place / "out.parquet").read_bytes() == bytes_here
    assert not (place / "out.parquet.parts").exists()


def parts_of(dataset):
    return {path.name: path.read_bytes() for path in dataset.glob("*.parquet")}


def test_a_dataset_is_written_by_the_workers(cluster_here, place):
    write(poses(20_000), place / "in.parquet", 500)
    loiter.tables.run(place / "in.parquet", f"{place}/here/", orbit=ORBIT, aircraft=UAV)
    for _ in range(2):
        cluster_here.work()
    process = cluster_here.batch("in.parquet", "out/")
    wait_for_parts(process, place / "out", 6)
    cluster_here.lose()
    _, err = process.communicate()
    assert process.returncode == 0, err
    assert parts_of(place / "out") == parts_of(place / "here")
    assert [path.name for path in (place / "out").iterdir() if path.suffix != ".parquet"] == ["_SUCCESS"]


def test_workers_that_see_other_urls_cannot_take_part(cluster_here, place):
    # Each process has its own memory://.
    write(poses(2000), place / "in.parquet", 500)
    cluster_here.work()
    process = cluster_here.batch("in.parquet", "memory://out/")
    _, err = process.communicate()
    assert process.returncode == 2
    assert re.fullmatch(
        r"loiter: --scheduler has a worker tcp://\S+ that cannot take part: it does not see memory://out/_temporary; "
        r"workers need a file system shared with this machine\n",
        err,
    ), err


def test_csv_is_read_in_here_and_solved_there(cluster_here, place):
    write(poses(2000), place / "in.csv")
    text_here = gzip.decompress(expected(place / "in.csv", place / "out-here.csv.gz"))
    cluster_here.work()
    process = cluster_here.batch("in.csv", "out.csv.gz")
    _, err = process.communicate()
    assert process.returncode == 0, err
    # The parts, each compressed by itself, have other sizes here.
    assert gzip.decompress((place / "out.csv.gz").read_bytes()) == text_here


def test_a_job_begun_on_a_cluster_goes_on_without_it(cluster_here, place):
    write(poses(20_000), place / "in.parquet", 500)
    bytes_here = expected(place / "in.parquet", place / "out-here.parquet")
    cluster_here.work()
    process = cluster_here.batch("in.parquet", "out.parquet")
    wait_for_parts(process, place / "out.parquet.parts", 3)
    process.send_signal(signal.SIGINT)
    _, err = process.communicate()
    assert process.returncode == 130
    assert re.fullmatch(r"loiter: interrupted; [^\n]*\n", err), err
    # What a worker still had in hand may yet be finished; it is of the same job.
    summary = loiter.tables.run(place / "in.parquet", place / "out.parquet", orbit=ORBIT, aircraft=UAV)
    assert summary.resumed_parts >= 3
    assert (place / "out.parquet").read_bytes() == bytes_here


def test_a_worker_that_sees_other_files_cannot_take_part(tmp_path):
    source = files.locate("source", str(write(poses(5), tmp_path / "in.parquet")))
    work, mark = (files.locate("target", str(tmp_path / name)) for name in ("", "mark"))
    size = source.info.size
    (tmp_path / "mark").touch()
    assert cluster._worker_problem(mark, work, source, size, loiter.__version__) == ""
    assert "has loiter" in cluster._worker_problem(mark, work, source, size, "0.0.1")
    assert f"see {source.text}" in cluster._worker_problem(mark, work, source, size + 1, loiter.__version__)
    (tmp_path / "mark").unlink()
    assert f"see {work.text}" in cluster._worker_problem(mark, work, source, size, loiter.__version__)


def test_when_every_worker_is_lost_another_may_join(cluster_here, place):
    write(poses(10_000), place / "in.parquet", 500)
    bytes_here = expected(place / "in.parquet", place / "out-here.parquet")
    cluster_here.work()
    process = cluster_here.batch("in.parquet", "out.parquet")
    wait_for_parts(process, place / "out.parquet.parts", 2)
    cluster_here.lose()
    cluster_here.work()
    _, err = process.communicate()
    assert process.returncode == 0, err
    assert (place / "out.parquet").read_bytes() == bytes_here


def test_a_scheduler_that_goes_is_reported_and_what_is_finished_is_kept(cluster_here, place):
    write(poses(20_000), place / "in.parquet", 500)
    cluster_here.work()
    process = cluster_here.batch("in.parquet", "out.parquet")
    wait_for_parts(process, place / "out.parquet.parts", 2)
    cluster_here.scheduler.kill()
    _, err = process.communicate()
    assert process.returncode == 2
    [line] = err.splitlines()
    assert line.startswith("loiter: the job stopped: ")
    assert "finished parts stay in" in line
