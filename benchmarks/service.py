"""Ask a server of its own for mixed answers, many clients at once: none lost, how long they take, how memory grows.

`python -m benchmarks.service --requests 10000 --clients 50`; exits with 1 where an answer is lost or wrong.
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


class Asked(NamedTuple):
    """A request, and the status that it must get."""

    kind: str
    method: str
    path: str
    body: bytes
    status: int


class Answer(NamedTuple):
    kind: str
    seconds: float
    good: bool


def scene(rng: random.Random, **more: object) -> bytes:
    pose = {"east_m": rng.uniform(-500, 500), "north_m": rng.uniform(-500, 500), "heading_deg": rng.uniform(0, 360)}
    orbit = {"east_m": 0.0, "north_m": 0.0, "radius_m": rng.uniform(100.0, 200.0)}
    return json.dumps({"pose": pose, "orbit": orbit, "aircraft": UAV} | more).encode()


def drawn(rng: random.Random) -> Asked:
    """One request of a mix such as a page makes, with some that must be refused."""
    kind = rng.choices(
        ["plan", "plan in wind", "candidates", "certificate", "synthesis", "export", "page", "bad", "too large"],
        [60, 5, 8, 4, 6, 3, 6, 6, 2],
    )[0]
    if kind == "plan in wind":
        return Asked(kind, "POST", "/api/plan", scene(rng, wind=WIND), 200)
    if kind == "synthesis":
        return Asked(kind, "GET", f"/api/synthesis?radius={rng.randint(10, 60) / 10}&cells=80", b"", 200)
    if kind == "export":
        path = f"/api/export/{rng.choice(['geojson', 'kml', 'gpx', 'csv'])}"
        return Asked(kind, "POST", path, scene(rng, origin=ORIGIN), 200)
    if kind == "page":
        return Asked(kind, "GET", rng.choice(["/", "/healthz", "/static/styles/layout.css"]), b"", 200)
    if kind == "bad":
        return Asked(kind, "POST", "/api/plan", scene(rng, tolerance_m=-1.0), 422)
    if kind == "too large":
        return Asked(kind, "POST", "/api/plan", b'"' + b"x" * 70_000 + b'"', 413)
    return Asked(kind, "POST", f"/api/{kind}", scene(rng), 200)


async def exchange(
    reader: asyncio.StreamReader, writer: asyncio.StreamWriter, asked: Asked
) -> tuple[int, dict[str, str], bytes]:
    head = f"{asked.method} {asked.path} HTTP/1.1\r\nHost: localhost\r\n"
    if asked.body:
        head += f"Content-Type: application/json\r\nContent-Length: {len(asked.body)}\r\n"
    writer.write(head.encode() + b"\r\n" + asked.body)
    await writer.drain()
    first, *lines = (await reader.readuntil(b"\r\n\r\n")).decode().split("\r\n")
    headers = {name.lower(): value.strip() for name, _, value in (line.partition(":") for line in lines)}
    return int(first.split()[1]), headers, await reader.readexactly(int(headers["content-length"]))


def good(asked: Asked, status: int, headers: dict[str, str], body: bytes) -> bool:
    """Whether it is the right answer to this request and not to another."""
    if status != asked.status or headers["x-content-type-options"] != "nosniff":
        return False
    if asked.path != "/api/plan" or status != 200:
        return True
    start, told = json.loads(asked.body)["pose"], json.loads(body)
    first = told["segments"][0]["start"] if told["segments"] else told["join"]
    return (first["east_m"], first["north_m"]) == (start["east_m"], start["north_m"])


async def client(port: int, requests: list[Asked]) -> list[Answer]:
    """Ask one after the other over one connection."""
    reader, writer = await asyncio.open_connection("127.0.0.1", port)
    answers = []
    for asked in requests:
        began = time.perf_counter()
        try:
            right = good(asked, *await exchange(reader, writer, asked))
        except (OSError, EOFError) as error:
            print(f"{asked.kind}: {error!r}", file=sys.stderr)
            right = False
            reader, writer = await asyncio.open_connection("127.0.0.1", port)
        answers.append(Answer(asked.kind, time.perf_counter() - began, right))
    writer.close()
    return answers


async def load(port: int, clients: int, requests: int, seed: int) -> list[Answer]:
    rng = random.Random(seed)
    asked = [drawn(rng) for _ in range(requests)]
    found = await asyncio.gather(*(client(port, asked[i::clients]) for i in range(clients)))
    return [answer for answers in found for answer in answers]


def memory(pid: int) -> tuple[int, int]:
    """Resident memory of a process now and at most, kB (Linux)."""
    fields = dict(line.split(":", 1) for line in Path(f"/proc/{pid}/status").read_text().splitlines())
    return int(fields["VmRSS"].split()[0]), int(fields["VmHWM"].split()[0])


def percentile(seconds: list[float], share: float) -> float:
    return sorted(seconds)[min(len(seconds) - 1, int(share * len(seconds)))] * 1e3


def main() -> int:
    parser = argparse.ArgumentParser(prog="python -m benchmarks.service", description=__doc__)
    parser.add_argument("--requests", type=int, default=10_000)
    parser.add_argument("--clients", type=int, default=50)
    options = parser.parse_args()
    command = [sys.executable, "-c", "import sys; from loiter.cli.app import main; sys.exit(main())"]
    with subprocess.Popen([*command, "serve", "--port", "0"], stdout=subprocess.PIPE, text=True) as server:
        assert server.stdout is not None
        port = int(server.stdout.readline().rstrip("/\n").rpartition(":")[2])
        # Once through the mix, so that what is loaded or kept is.
        asyncio.run(load(port, options.clients, max(200, options.requests // 10), 0))
        before = memory(server.pid)
        began = time.perf_counter()
        answers = asyncio.run(load(port, options.clients, options.requests, 1))
        seconds, after = time.perf_counter() - began, memory(server.pid)
        server.terminate()
    lost = Counter(answer.kind for answer in answers if not answer.good)
    print(f"{len(answers)} answers in {seconds:.1f} s, {len(answers) / seconds:.0f}/s; lost or wrong: {lost.total()}")
    for kind, count in sorted(Counter(answer.kind for answer in answers).items()):
        took = [answer.seconds for answer in answers if answer.kind == kind]
        shares = ", ".join(f"{name} {percentile(took, share):.0f}" for name, share in (("p50", 0.5), ("p99", 0.99)))
        print(f"  {kind:<13} {count:6}   {shares}, most {max(took) * 1e3:.0f} ms")
    took = [answer.seconds for answer in answers]
    print(f"  all           {len(took):6}   p50 {percentile(took, 0.5):.0f}, p99 {percentile(took, 0.99):.0f} ms")
    print(f"memory: {before[0]} kB before, {after[0]} kB after; at most {before[1]} and {after[1]} kB")
    print(f"exit status of the server: {server.returncode}")
    return int(bool(lost) or server.returncode != 0 or len(answers) != options.requests)


if __name__ == "__main__":
    sys.exit(main())
