"""Start a server, send it mixed requests from many clients, and print lost answers, response times and memory.

`python -m benchmarks.service --requests 10000 --clients 50`; the exit status is 1 where an answer is lost or wrong.
"""

import argparse
import asyncio
import json
import random
import subprocess
import sys
import time
from collections import Counter
from pathlib import Path
from typing import NamedTuple

UAV = {"airspeed_m_s": 18.0, "max_bank_deg": 35.0}
WIND = {"speed_m_s": 5.0, "from_deg": 250.0}
ORIGIN = {"latitude_deg": 47.0, "longitude_deg": 8.0}


class ServiceRequest(NamedTuple):
    """A request and the status of its correct answer."""

    kind: str
    method: str
    path: str
    body: bytes
    status: int


class Outcome(NamedTuple):
    """The kind of a request, its response time and whether its answer was correct."""

    kind: str
    seconds: float
    good: bool


class Memory(NamedTuple):
    """Resident memory of a process, kB: now, and its peak."""

    resident: int
    peak: int


def scene(rng: random.Random, **more: object) -> bytes:
    """A random scene as the body of a request; `more` are further fields."""
    pose = {"east_m": rng.uniform(-500, 500), "north_m": rng.uniform(-500, 500), "heading_deg": rng.uniform(0, 360)}
    orbit = {"east_m": 0.0, "north_m": 0.0, "radius_m": rng.uniform(100.0, 200.0)}
    return json.dumps({"pose": pose, "orbit": orbit, "aircraft": UAV} | more).encode()


def random_request(rng: random.Random) -> ServiceRequest:
    """One request of a mix such as the page makes, with some that must be refused."""
    [kind] = rng.choices(
        ["plan", "plan in wind", "candidates", "certificate", "synthesis", "export", "page", "bad", "too large"],
        [60, 5, 8, 4, 6, 3, 6, 6, 2],
    )
    if kind == "plan in wind":
        return ServiceRequest(kind, "POST", "/api/plan", scene(rng, wind=WIND), 200)
    if kind == "synthesis":
        return ServiceRequest(kind, "GET", f"/api/synthesis?radius={rng.randint(10, 60) / 10}&cells=80", b"", 200)
    if kind == "export":
        path = f"/api/export/{rng.choice(['geojson', 'kml', 'gpx', 'csv'])}"
        return ServiceRequest(kind, "POST", path, scene(rng, origin=ORIGIN), 200)
    if kind == "page":
        return ServiceRequest(kind, "GET", rng.choice(["/", "/healthz", "/static/styles/layout.css"]), b"", 200)
    if kind == "bad":
        return ServiceRequest(kind, "POST", "/api/plan", scene(rng, tolerance_m=-1.0), 422)
    if kind == "too large":
        return ServiceRequest(kind, "POST", "/api/plan", b'"' + b"x" * 70_000 + b'"', 413)
    return ServiceRequest(kind, "POST", f"/api/{kind}", scene(rng), 200)


async def exchange(
    reader: asyncio.StreamReader, writer: asyncio.StreamWriter, request: ServiceRequest
) -> tuple[int, dict[str, str], bytes]:
    """Send a request; returns status, headers and body of the response."""
    head = f"{request.method} {request.path} HTTP/1.1\r\nHost: localhost\r\n"
    if request.body:
        head += f"Content-Type: application/json\r\nContent-Length: {len(request.body)}\r\n"
    writer.write(head.encode() + b"\r\n" + request.body)
    await writer.drain()
    first, *lines = (await reader.readuntil(b"\r\n\r\n")).decode().split("\r\n")
    headers = {name.lower(): value.strip() for name, _, value in (line.partition(":") for line in lines)}
    _, status, *_ = first.split()
    return int(status), headers, await reader.readexactly(int(headers["content-length"]))


def good(request: ServiceRequest, status: int, headers: dict[str, str], body: bytes) -> bool:
    """Whether the response is the correct answer to this request, not that to another one."""
    if status != request.status or headers["x-content-type-options"] != "nosniff":
        return False
    if request.path != "/api/plan" or status != 200:
        return True
    start, plan = json.loads(request.body)["pose"], json.loads(body)
    first, *_ = *(segment["start"] for segment in plan["segments"]), plan["join"]
    return (first["east_m"], first["north_m"]) == (start["east_m"], start["north_m"])


async def client(port: int, requests: list[ServiceRequest]) -> list[Outcome]:
    """Send the requests one after the other over one connection."""
    reader, writer = await asyncio.open_connection("127.0.0.1", port)
    outcomes = []
    for request in requests:
        began = time.perf_counter()
        try:
            right = good(request, *await exchange(reader, writer, request))
        except (OSError, EOFError) as error:
            print(f"{request.kind}: {error!r}", file=sys.stderr)
            right = False
            reader, writer = await asyncio.open_connection("127.0.0.1", port)
        outcomes.append(Outcome(request.kind, time.perf_counter() - began, right))
    writer.close()
    return outcomes


async def load(port: int, clients: int, requests: int, seed: int) -> list[Outcome]:
    """Send random requests from several clients at once."""
    rng = random.Random(seed)
    mix = [random_request(rng) for _ in range(requests)]
    results = await asyncio.gather(*(client(port, mix[i::clients]) for i in range(clients)))
    return [outcome for outcomes in results for outcome in outcomes]


def memory(pid: int) -> Memory:
    """Resident memory of a process (Linux)."""
    fields = dict(line.split(":", 1) for line in Path(f"/proc/{pid}/status").read_text().splitlines())
    return Memory(*(int(fields[name].removesuffix("kB")) for name in ("VmRSS", "VmHWM")))


def percentile(seconds: list[float], share: float) -> float:
    """The response time, milliseconds, that a share of the answers did not exceed."""
    return sorted(seconds)[min(len(seconds) - 1, int(share * len(seconds)))] * 1e3


def main() -> int:
    parser = argparse.ArgumentParser(prog="python -m benchmarks.service", description=__doc__)
    parser.add_argument("--requests", type=int, default=10_000)
    parser.add_argument("--clients", type=int, default=50)
    options = parser.parse_args()
    command = [sys.executable, "-c", "import sys; from loiter.cli.app import main; sys.exit(main())"]
    with subprocess.Popen([*command, "serve", "--port", "0"], stdout=subprocess.PIPE, text=True) as server:
        assert server.stdout is not None
        _, _, port = server.stdout.readline().rstrip("/\n").rpartition(":")
        # A first run loads modules and fills caches.
        asyncio.run(load(int(port), options.clients, max(200, options.requests // 10), 0))
        before = memory(server.pid)
        began = time.perf_counter()
        outcomes = asyncio.run(load(int(port), options.clients, options.requests, 1))
        seconds, after = time.perf_counter() - began, memory(server.pid)
        server.terminate()
    print_report(outcomes, seconds)
    print(f"memory: {before.resident} kB before, {after.resident} kB after; at most {before.peak} and {after.peak} kB")
    print(f"exit status of the server: {server.returncode}")
    complete = len(outcomes) == options.requests and all(outcome.good for outcome in outcomes)
    return int(not complete or server.returncode != 0)


def print_report(outcomes: list[Outcome], seconds: float) -> None:
    """Print the rate of answers, the lost ones, and response times of each kind."""
    lost = sum(not outcome.good for outcome in outcomes)
    print(f"{len(outcomes)} answers in {seconds:.1f} s, {len(outcomes) / seconds:.0f}/s; lost or wrong: {lost}")
    for kind, count in sorted(Counter(outcome.kind for outcome in outcomes).items()):
        took = [outcome.seconds for outcome in outcomes if outcome.kind == kind]
        shares = ", ".join(f"{name} {percentile(took, share):.0f}" for name, share in (("p50", 0.5), ("p99", 0.99)))
        print(f"  {kind:<13} {count:6}   {shares}, most {max(took) * 1e3:.0f} ms")
    took = [outcome.seconds for outcome in outcomes]
    print(f"  all           {len(took):6}   p50 {percentile(took, 0.5):.0f}, p99 {percentile(took, 0.99):.0f} ms")


if __name__ == "__main__":
    sys.exit(main())
