"""Lists what users depend on: public names, signatures, options, JSON keys, columns, statuses, HTTP paths, link keys.

`python tests/golden/build_public.py > tests/golden/public.json` writes the list anew where a name is added on purpose.
A name that goes, or that changes its meaning, breaks somebody's program.
"""

import asyncio
import importlib
import inspect
import json
from dataclasses import fields, is_dataclass
from enum import Enum

from cyclopts import App

import loiter

PACKAGES = [
    "loiter",
    "loiter.batch",
    "loiter.geo",
    "loiter.guidance",
    "loiter.io",
    "loiter.mavlink",
    "loiter.plot",
    "loiter.verify",
]

# Import paths that the documentation has given, with the names found there.
DOCUMENTED = {
    "loiter.guidance.laws.loiter_entry": ["LoiterEntry"],
    "loiter.guidance.simulators.airframes": ["AEROSONDE", "J3CUB"],
    "loiter.guidance.simulators.jsbsim_aircraft": ["JsbsimAircraft"],
    "loiter.guidance.simulators.kinematic": ["Kinematic"],
    "loiter.guidance.simulators.point_mass": ["PointMass"],
    "loiter.guidance.trials.campaign": ["LAWS", "campaign", "kinematic", "outcome", "point_mass", "trials"],
    "loiter.guidance.trials.flight": ["fly"],
    "loiter.guidance.trials.summary": ["summary"],
    "loiter.planning.model": ["Aircraft", "Orbit", "Pose", "Segment", "Turn", "Wind"],
    "loiter.verify.certificate": ["Certificate", "certify"],
    "loiter.web": ["serve"],
}


def described(thing):
    """The parameters of a function, the members of a class."""
    if inspect.isclass(thing) and issubclass(thing, Enum):
        return {name: member.value for name, member in thing.__members__.items()}
    if inspect.isclass(thing):
        own = [f.name for f in fields(thing)] if is_dataclass(thing) else list(getattr(thing, "_fields", []))
        members = [name for name in dir(thing) if not name.startswith("_")]
        hidden = {"count", "index"} if issubclass(thing, tuple) else set()
        return {"fields": own, "members": sorted(set(members) - hidden - {"add_note", "args", "with_traceback"})}
    if callable(thing):
        return [str(p).partition(":")[0].partition("=")[0] for p in inspect.signature(thing).parameters.values()]
    return type(thing).__name__


def exports():
    named = {package: importlib.import_module(package).__all__ for package in PACKAGES}
    found = {}
    for package, names in (named | DOCUMENTED).items():
        module = importlib.import_module(package)
        found[package] = {
            name: described(thing)
            for name in sorted(names)
            for thing in [getattr(module, name)]
            if not inspect.ismodule(thing)
        }
    errors = importlib.import_module("loiter.errors")
    found["loiter.errors"] = {
        name: [base.__name__ for base in value.__mro__[1:3]]
        for name, value in sorted(vars(errors).items())
        if inspect.isclass(value) and issubclass(value, Exception)
    }
    return found


def options():
    from loiter.cli.app import app

    found = {}
    for name in sorted(command for command in app if not command.startswith("-")):
        command: App = app[name]
        found[name] = sorted(option for argument in command.assemble_argument_collection() for option in argument.names)
    return found


def keys(value, path=""):
    """The paths of the keys of a JSON document, elements of lists as []."""
    if isinstance(value, dict):
        for key, inner in value.items():
            yield f"{path}.{key}"
            yield from keys(inner, f"{path}.{key}")
    elif isinstance(value, (list, tuple)) and value:
        for inner in value:
            yield from keys(inner, f"{path}[]")


def documents():
    from loiter.io.document import answer
    from loiter.verify.certificate import certify

    uav = loiter.Aircraft(18.0, max_bank_deg=35.0)
    still = loiter.Pose(-400.0, 120.0, 90.0), loiter.Orbit(0.0, 0.0, 120.0), uav
    windy = (*still, loiter.Wind(8.0, 250.0))
    frame = loiter.geo.LocalFrame(47.0, 8.0)
    found = {}
    for name, scene in (("still air", still), ("wind", windy)):
        best, known = loiter.plan_all(*scene), loiter.candidates(*scene)
        certificate = certify(best[0]).to_dict()
        found[name] = {
            "plan": sorted(set(keys(answer(best, known[1:], None)))),
            "plan in degrees": sorted(set(keys(answer(best, known[1:], frame)))),
            "certificate": sorted(set(keys(certificate))),
            "conditions": [[r["name"], r["equation"]] for r in certificate["residuals"]],
        }
    return found


def tables():
    columns = importlib.import_module("loiter.batch.tables.columns")
    folder = importlib.import_module("loiter.batch.jobs.folder")
    return {
        "dataset": [folder.SUCCESS, folder.TEMPORARY, folder.part_name(0, 10, "0123456789", ".parquet")],
        "added": columns.added_schema(is_placed=False).names,
        "added on Earth": columns.added_schema(is_placed=True).names,
        "statuses": list(columns.STATUSES),
    }


def service():
    import httpx

    from loiter.web.app import create_app

    async def fetched():
        transport = httpx.ASGITransport(create_app(None))
        async with httpx.AsyncClient(transport=transport, base_url="http://127.0.0.1") as client:
            return (await client.get("/openapi.json")).json()

    schema = asyncio.run(fetched())
    paths = {path: sorted(operations) for path, operations in schema["paths"].items()}
    parts = {name: sorted(part.get("properties", {})) for name, part in schema["components"]["schemas"].items()}
    return {"paths": paths, "parts": parts}


def public():
    return {
        "names": exports(),
        "options": options(),
        "documents": documents(),
        "tables": tables(),
        "service": service(),
    }


if __name__ == "__main__":
    print(json.dumps(public(), indent=1, sort_keys=True, default=str))
