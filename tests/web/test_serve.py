"""`loiter serve` as a program: its address, its messages, its end."""

import asyncio
import logging
import signal
import socket
import subprocess
import sys
from pathlib import Path

import httpx
import pytest
import uvicorn

from loiter.cli.app import main
from loiter.errors import MissingPackage
from loiter.web import serve
from loiter.web.app import create_app
from loiter.web.server import Server, listening_socket
from web.serving import connected, run_async, serving
from web.test_api import STILL


@pytest.mark.parametrize("end", [signal.SIGINT, signal.SIGTERM])
def test_it_prints_its_address_and_ends_cleanly(end):
    with serving() as (port, process):
        assert httpx.post(f"http://127.0.0.1:{port}/api/plan", json=STILL, timeout=30.0).status_code == 200
        # An open connection does not delay the end.
        with connected(port):
            process.send_signal(end)
            assert process.wait(20) == 0
        assert (process.stdout.read(), process.stderr.read()) == (b"", b"")


def test_an_answer_under_way_is_finished_first():
    with serving() as (port, process), httpx.Client(timeout=30.0) as client:
        with client.stream("GET", f"http://127.0.0.1:{port}/api/synthesis?cells=400") as response:
            process.terminate()
            response.read()
        assert response.json()["radius"] == 1.0
        assert process.wait(20) == 0


class Late:
    """A connection that is accepted after the server has begun to close the others."""

    def __init__(self, connections):
        self.connections, self.transport, self.shutdowns = connections, self, 0

    def is_closing(self):
        return False

    def shutdown(self):
        self.shutdowns += 1
        if self.shutdowns > 1:
            self.connections.discard(self)


def test_a_connection_accepted_while_it_ends_does_not_delay_the_end(caplog):
    async def scenario():
        config = uvicorn.Config(create_app(), lifespan="off", log_config=None, timeout_graceful_shutdown=5)
        config.load()
        server = Server(config)
        server.lifespan, server.servers = config.lifespan_class(config), []
        late = Late(server.server_state.connections)
        server.server_state.connections.add(late)
        await asyncio.wait_for(server.shutdown(), 4.0)
        return late.shutdowns

    assert run_async(scenario()) == 2
    # A test before may have switched on the server's own notices.
    assert not [record for record in caplog.records if record.levelno >= logging.WARNING]


@pytest.mark.skipif(not Path("/proc/net/tcp").exists(), reason="a file of Linux")
def test_it_listens_on_this_machine_alone():
    with serving() as (port, _):
        rows = [line.split() for line in Path("/proc/net/tcp").read_text().splitlines()[1:]]
    # State 0A listens; addresses are hexadecimal, the last byte first.
    listening = {row[1] for row in rows if row[3] == "0A"}
    assert f"0100007F:{port:04X}" in listening
    assert f"00000000:{port:04X}" not in listening


def test_it_warns_where_others_can_reach_it(monkeypatch):
    lines = []
    monkeypatch.setattr("uvicorn.Server.run", lambda *_, **__: None)
    serve(host="0.0.0.0", port=0, announce=lines.append)
    assert lines[0].startswith("http://0.0.0.0:")
    assert lines[1:] == ["Other machines can reach this service: it asks for no user name and no password."]


@pytest.mark.parametrize("host", ["127.0.0.1", "localhost", "127.0.0.2"])
def test_it_does_not_warn_on_loopback(monkeypatch, host):
    lines = []
    monkeypatch.setattr("uvicorn.Server.run", lambda *_, **__: None)
    serve(host=host, port=0, announce=lines.append)
    assert len(lines) == 1


@pytest.mark.parametrize("host", ["127.0.0.1:{port}", "LOCALHOST:{port}", "localhost", "[::1]:{port}", "me.localhost"])
def test_names_of_this_machine_are_answered(port, host):
    response = httpx.get(f"http://127.0.0.1:{port}/healthz", headers={"host": host.format(port=port)})
    assert response.status_code == 200


@pytest.mark.parametrize(
    "host",
    [
        "evil.example",
        "evil.example:{port}",
        "127.0.0.1.evil.example",
        "localhost.evil.example",
        "192.168.0.7",
        "[",
        "x y",
    ],
)
@pytest.mark.parametrize("path", ["/", "/healthz", "/static/main.js", "/openapi.json"])
def test_other_hosts_are_refused_on_loopback(port, host, path):
    """A site whose name points to 127.0.0.1 is for browsers the same origin as the service: DNS rebinding."""
    host = host.format(port=port)
    response = httpx.get(f"http://127.0.0.1:{port}{path}", headers={"host": host})
    assert response.status_code == 421
    assert response.json()["detail"].startswith(f"the request is for the host {host!r}")
    assert response.headers["content-security-policy"]


def test_other_hosts_are_answered_where_other_machines_may_come():
    with serving("--host", "0.0.0.0") as (port, _):
        response = httpx.get(f"http://127.0.0.1:{port}/healthz", headers={"host": "loiter.example"})
    assert response.status_code == 200


def test_answers_are_sent_at_once():
    with listening_socket("127.0.0.1", 0) as listener:
        assert listener.proto == socket.IPPROTO_TCP

        async def sends_at_once():
            accepted = asyncio.Future()
            handled = await asyncio.start_server(lambda _, writer: accepted.set_result(writer), sock=listener)
            _, writer = await asyncio.open_connection(*listener.getsockname())
            option = (await accepted).get_extra_info("socket").getsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY)
            for one in (writer, accepted.result(), handled):
                one.close()
                await one.wait_closed()
            return option

        assert run_async(sends_at_once())


@pytest.fixture
def refused(capsys):
    def refused(*options):
        status = main(["serve", *options])
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
    ("options", "sentence"),
    [
        (["--port", "70000"], "--port is 70000: it must be a whole number from 0 to 65535"),
        (["--port", "-1"], "--port is -1"),
        (["--port", "http"], "--port is 'http': it must be a whole number"),
        (["--host", "no.such.host.invalid"], "--host is 'no.such.host.invalid': it is not an address of this machine"),
        (["--host", "192.0.2.1"], "192.0.2.1"),
        (["--cors", "*"], "--cors is '*': it must be an origin such as"),
        (["--cors", "http://localhost:8000/"], "--cors is 'http://localhost:8000/'"),
        (["--cors", "localhost"], "--cors is 'localhost'"),
    ],
)
def test_a_bad_address_or_origin_is_refused(refused, options, sentence):
    assert sentence in refused(*options)


@pytest.mark.parametrize("package", ["fastapi", "uvicorn"])
def test_a_missing_package_is_named_with_how_to_install_it(monkeypatch, package):
    monkeypatch.setitem(sys.modules, package, None)
    with pytest.raises(
        MissingPackage,
        match=rf'needs {package}: pip install "loiter\[web\]" brings it .in a checkout: pip install "\.\[web\]".',
    ):
        serve()


def test_importing_the_package_does_not_load_the_framework():
    code = "import loiter, sys; loiter.web.serve; print({'fastapi', 'uvicorn', 'pydantic'} & set(sys.modules))"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout == "set()\n"
