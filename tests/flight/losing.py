"""Uploads over a line that loses one packet of five each way, with the time-outs of real vehicles.

`python -m flight.losing 50`: to vehicles of ours, eight at a time;
`python -m flight.losing 50 mavsdk`: to that of mavsdk, one after the other.
"""

import json
import subprocess
import sys
import time
from collections import Counter
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager
from functools import partial
from pathlib import Path
from queue import Queue
from threading import Thread

from flight.vehicle import Plane, Vehicle, flying, free_port, kept, lossy, mission
from loiter.errors import LoiterError
from loiter.flight import upload


def fresh(seed):
    """A mission that no other seed has, held one way or the other."""
    return mission("cw" if seed % 2 else "ccw", waypoints=2 + seed % 5, radius_m=80.0 + seed)


def vehicle_of(seed):
    """Every kind holds missions in both directions."""
    return [Vehicle, Vehicle, Plane, Plane][seed % 4]()


def lost(vehicle, seed, loss=0.2):
    """An upload to a vehicle of ours; whether the vehicle has the mission."""
    with flying(vehicle), lossy(vehicle.port, loss=loss, seed=seed) as line:
        upload(fresh(seed), line.connection, system=1)
    new = kept(fresh(seed))
    return vehicle.mission[-len(new) :] == new


class Mavsdk:
    """mavsdk's vehicle, in a process of its own."""

    def __init__(self):
        self.port = free_port()
        command = [sys.executable, Path(__file__).with_name("server.py"), str(self.port)]
        self.process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        self.said = Queue()
        self.reader = Thread(target=lambda: [self.said.put(line) for line in self.process.stdout])
        self.reader.start()

    @property
    def connection(self):
        return f"udpout:127.0.0.1:{self.port}"

    def next(self, word):
        """What the next line of JSON has that begins with a word; raises `Empty` where none comes in half a minute."""
        while not (line := self.said.get(timeout=30.0)).startswith(f'["{word}"'):
            pass
        return json.loads(line)[1]

    def mission(self):
        """The next mission that it has whole, as our vehicles keep theirs."""
        return [(i[0], i[1], tuple(i[2:6]), *i[6:]) for i in self.next("SUCCESS")]

    def stop(self):
        self.process.kill()
        self.reader.join()
        self.process.stdout.close()
        self.process.wait()


@contextmanager
def mavsdk():
    """mavsdk's vehicle while it flies."""
    vehicle = Mavsdk()
    try:
        vehicle.next("READY")
        yield vehicle
    finally:
        vehicle.stop()


def lost_to_mavsdk(vehicle, seed, loss=0.2):
    """An upload to mavsdk's vehicle; whether it says that it has the mission."""
    with lossy(vehicle.port, loss=loss, seed=seed) as line:
        upload(fresh(seed), line.connection, system=1)
    while vehicle.mission() != kept(fresh(seed)):
        pass
    return True


def timed(upload, seed):
    begun = time.monotonic()
    try:
        said = "arrived" if upload(seed) else "LOST"
    except LoiterError as error:
        said = str(error)
    return said, time.monotonic() - begun


def main(uploads, peer="ours"):
    seeds = range(int(uploads))
    if peer == "mavsdk":
        with mavsdk() as vehicle:
            done = [timed(partial(lost_to_mavsdk, vehicle), seed) for seed in seeds]
    else:
        with ThreadPoolExecutor(8) as pool:
            done = list(pool.map(partial(timed, lambda seed: lost(vehicle_of(seed).take_time(), seed)), seeds))
    seconds = sorted(seconds for _, seconds in done)
    print(dict(Counter(said for said, _ in done)))
    print(f"seconds: median {seconds[len(seconds) // 2]:.1f}, longest {seconds[-1]:.1f}")


if __name__ == "__main__":
    main(*sys.argv[1:])
