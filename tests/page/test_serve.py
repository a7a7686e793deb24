"""`loiter serve`: the page in one request, for this machine alone, until the process is told to end."""

import gzip
import signal
import socket
import subprocess
import sys
from contextlib import contextmanager
from http.client import HTTPConnection
from pathlib import Path

import pytest

from benchmarks.browsing import SCRIPT
from loiter.cli.app import main
from loiter.page.server import BUILT


@contextmanager
def serving(*options, **environment):
    """The port of a server, and its process."""
    command = [SCRIPT, "serve", "--port", "0", *options]
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, **environment) as process:
        try:
            yield int(process.stdout.readline().rstrip(b"/\n").rpartition(b":")[2]), process
        finally:
            process.kill()


@pytest.fixture(scope="module")
def port():
    with serving("--no-browser") as (port, _):
        yield port


def fetch(port, path="/", **headers):
    """The response to a GET request, and its body."""
    connection = HTTPConnection("127.0.0.1", port, timeout=20)
    connection.request("GET", path, headers=headers)
    response = connection.getresponse()
    return response, response.read()


@pytest.mark.parametrize("end", [signal.SIGINT, signal.SIGTERM])
def test_it_prints_its_address_and_ends_at_once(end):
    with serving("--no-browser") as (port, process):
        assert fetch(port)[0].status == 200
        # Neither an open connection nor one that was closed midway delays the end, or is spoken of.
        with socket.create_connection(("127.0.0.1", port)), socket.create_connection(("127.0.0.1", port)) as midway:
            midway.sendall(b"GET / HTTP/1.1\r\nHost: localhost\r\n\r\n")
            midway.close()
            assert fetch(port)[0].status == 200
            process.send_signal(end)
            assert process.wait(5) == 0
        assert (process.stdout.read(), process.stderr.read()) == (b"", b"")


@pytest.mark.parametrize(("path", "name"), [("/", "index.html"), ("/map.html?tiles=x", "map.html")])
def test_files_are_compressed(port, path, name):
    response, body = fetch(port, path)
    assert response.status == 200
    assert response.headers["Content-Encoding"] == "gzip"
    assert response.headers["Content-Type"] == "text/html; charset=utf-8"
    assert gzip.decompress(body) == (BUILT / name).read_bytes()


@pytest.mark.parametrize("path", ["/nothing", "/../server.py", "/%2e%2e/server.py", "/built/index.html"])
def test_nothing_else_is_served(port, path):
    assert fetch(port, path)[0].status == 404


@pytest.mark.parametrize("host", ["127.0.0.1:{port}", "LOCALHOST:{port}", "localhost"])
def test_names_of_this_machine_are_answered(port, host):
    assert fetch(port, Host=host.format(port=port))[0].status == 200


@pytest.mark.parametrize("path", ["/", "/map.html", "/nothing"])
@pytest.mark.parametrize(
    "host", ["evil.example", "evil.example:{port}", "127.0.0.1.evil.example", "localhost.evil.example", "[", ""]
)
def test_other_hosts_are_refused(port, host, path):
    """A site whose name points to 127.0.0.1 is for browsers the same origin as the page: DNS rebinding."""
    response, body = fetch(port, path, Host=host.format(port=port))
    assert response.status == 421
    assert len(body) < 1000


@pytest.mark.skipif(not Path("/proc/net/tcp").exists(), reason="a file of Linux")
def test_it_listens_on_this_machine_alone(port):
    rows = [line.split() for line in Path("/proc/net/tcp").read_text().splitlines()[1:]]
    # State 0A listens; addresses are hexadecimal, the last byte first.
    listening = {row[1] for row in rows if row[3] == "0A"}
    assert f"0100007F:{port:04X}" in listening
    assert f"00000000:{port:04X}" not in listening


def test_it_opens_the_browser(tmp_path):
    opened = tmp_path / "opened"
    browser = tmp_path / "browser"
    browser.write_text(f"#!/bin/sh\necho $1 > {opened}.part && mv {opened}.part {opened}\n")
    browser.chmod(0o755)
    with serving(env={"BROWSER": f"{browser} %s", "PATH": "/usr/bin:/bin"}) as (port, process):
        for _ in range(200):
            if opened.exists():
                break
            with pytest.raises(subprocess.TimeoutExpired):
                process.wait(0.1)
        assert opened.read_text() == f"http://127.0.0.1:{port}/\n"


@pytest.fixture
def refused(capsys):
    def refused(*options):
        status = main(["serve", "--no-browser", *options])
        out, err = capsys.readouterr()
        assert (status, out, err.count("\n")) == (2, "", 1)
        return err

    return refused


def test_a_port_in_use_is_refused(refused):
    with socket.create_server(("127.0.0.1", 0)) as other:
        port = other.getsockname()[1]
        sentence = refused("--port", str(port))
    assert sentence == f"loiter: --port is {port}: 127.0.0.1 cannot be used, Address already in use\n"


@pytest.mark.parametrize(
    ("port", "sentence"),
    [
        ("70000", "--port is 70000: it must be a whole number from 0 to 65535"),
        ("-1", "--port is -1"),
        ("http", "--port is 'http': it must be a whole number"),
    ],
)
def test_a_bad_port_is_refused(refused, port, sentence):
    assert sentence in refused("--port", port)


def test_importing_the_package_does_not_load_the_server():
    code = (
        "import loiter, sys; loiter.plan; print({'http.server', 'webbrowser', 'loiter.page.server'} & set(sys.modules))"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout == "set()\n"
