"""A real server: `loiter serve` in a process of its own, on a free port."""

import json
import socket
import subprocess
import sys
from contextlib import contextmanager, suppress

# A server whose constants are others, as {"limits.BODY_S": 0.3}: nobody wants to wait for the real ones.
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
    """The port of a server and its process; `limits__BODY_S=0.3` sets a constant."""
    named = {name.replace("__", "."): value for name, value in constants.items()}
    code = RUN.format(constants=named, options=options)
    with subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE, stderr=subprocess.PIPE) as process:
        try:
            yield int(process.stdout.readline().rstrip(b"/\n").rpartition(b":")[2]), process
        finally:
            process.terminate()


@contextmanager
def connected(port):
    """A connection whose reads end after a while."""
    with socket.create_connection(("127.0.0.1", port), timeout=20) as wire:
        yield wire


def answered(wire):
    """Every byte until the connection ends."""
    said = []
    with suppress(ConnectionResetError):
        while more := wire.recv(65536):
            said.append(more)
    return b"".join(said)


def heard(wire):
    """Everything that is said until the connection ends: status, headers, body; None where nothing is."""
    said = answered(wire)
    if not said:
        return None
    head, _, body = said.partition(b"\r\n\r\n")
    first, *lines = head.decode().split("\r\n")
    headers = {name.lower(): value.strip() for name, _, value in (line.partition(":") for line in lines)}
    return int(first.split()[1]), headers, body


def asking(body, path="/api/plan", more=""):
    """A request with a body, as bytes."""
    kind = "Content-Type: application/json\r\n"
    return f"POST {path} HTTP/1.1\r\nHost: x\r\n{kind}Content-Length: {len(body)}\r\n{more}\r\n".encode() + body


def encoded(scene):
    return json.dumps(scene).encode()
