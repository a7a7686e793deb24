"""A real server: `loiter serve` in a separate process, on a free port."""

import asyncio
import json
import socket
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager, suppress

# A server with other constants, such as {"limits.BODY_TIMEOUT_S": 0.3}, so that tests need not wait for the real ones.
RUN = """
import sys
from importlib import import_module
for name, value in {constants!r}.items():
    module, _, constant = name.rpartition(".")
    setattr(import_module("loiter.web." + module), constant, value)
from loiter.cli.app import main
sys.exit(main(["serve", "--port", "0", *{options!r}]))
"""


@contextmanager
def serving(*options, **constants):
    """The port of a server and its process; `limits__BODY_TIMEOUT_S=0.3` sets a constant."""
    named = {name.replace("__", "."): value for name, value in constants.items()}
    code = RUN.format(constants=named, options=options)
    with subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE, stderr=subprocess.PIPE) as process:
        try:
            yield int(process.stdout.readline().rstrip(b"/\n").rpartition(b":")[2]), process
        finally:
            process.terminate()


@contextmanager
def connected(port):
    """A connection whose reads time out after 20 s."""
    with socket.create_connection(("127.0.0.1", port), timeout=20) as connection:
        yield connection


def read_all(connection):
    """Every byte until the connection ends."""
    chunks = []
    with suppress(ConnectionResetError):
        while chunk := connection.recv(65536):
            chunks.append(chunk)
    return b"".join(chunks)


def read_response(connection):
    """Status, headers and all further bytes until the connection ends; None where nothing arrives."""
    received = read_all(connection)
    if not received:
        return None
    head, _, body = received.partition(b"\r\n\r\n")
    first, *lines = head.decode().split("\r\n")
    headers = {name.lower(): value.strip() for name, _, value in (line.partition(":") for line in lines)}
    _, status, *_ = first.split()
    return int(status), headers, body


def encode_request(body, path="/api/plan", headers=""):
    """A request with a body, as bytes."""
    kind = "Content-Type: application/json\r\n"
    return (
        f"POST {path} HTTP/1.1\r\nHost: localhost\r\n{kind}Content-Length: {len(body)}\r\n{headers}\r\n".encode() + body
    )


def encode_scene(scene):
    """A scene as the bytes of a body."""
    return json.dumps(scene).encode()


def run_async(coroutine):
    """The result of a coroutine, run in a thread: the browser, which is open meanwhile, has the loop of this one."""
    with ThreadPoolExecutor(1) as pool:
        return pool.submit(asyncio.run, coroutine).result()
