"""Times of checks against a fence of 100 edges, beside the plan itself: `python -m benchmarks.fences`."""

from math import cos, pi, sin

from benchmarks.timing import least_times
from loiter import Aircraft, Orbit, Pose, Wind, plan
from loiter.fences import CircleZone, Fence, PolygonZone, check

ROUNDS = 100

POSE, UAV = Pose(-400.0, 120.0, 90.0), Aircraft(18.0, max_bank_deg=35.0)
SCENES = {"still air": (Orbit(0.0, 0.0, 80.0), None), "wind": (Orbit(0.0, 0.0, 120.0), Wind(8.0, 250.0))}


def star(corners: int) -> PolygonZone:
    """An inclusion zone of 500 m around the scene, its corners alternately 10 % farther out."""
    angles = [2.0 * pi * i / corners for i in range(corners)]
    lengths = [500.0 * (1.0 + 0.1 * (i % 2)) for i in range(corners)]
    places = ((r * cos(angle), r * sin(angle)) for r, angle in zip(lengths, angles, strict=True))
    return PolygonZone("field", tuple(places), inclusion=True)


FENCES = {
    "clear": Fence((star(100),)),
    "entered": Fence((star(100), CircleZone("mast", -150.0, 90.0, 60.0))),
}


def main() -> None:
    for air, (orbit, wind) in SCENES.items():
        maneuver = plan(POSE, orbit, UAV, wind)
        contenders = {"plan": lambda orbit=orbit, wind=wind: plan(POSE, orbit, UAV, wind)}
        for name, fence in FENCES.items():
            contenders[name] = lambda fence=fence, maneuver=maneuver: check(fence, maneuver, 5.0)
        times = least_times(contenders, ROUNDS)
        for name in FENCES:
            ratio = times[name] / times["plan"]
            print(f"{air}, {name}: {times[name] * 1000.0:.2f} ms, {ratio:.1f} times the plan")


if __name__ == "__main__":
    main()
