"""Lists the names that users depend on: functions, parameters, options, JSON keys, columns, statuses.

`python tests/golden/build_public.py > tests/golden/public.json` writes the list anew where a name is added on purpose.
A name that goes, or that changes its meaning, breaks somebody's program.
"""

import importlib
import inspect
import json
from enum import Enum

from cyclopts import App

import loiter

PACKAGES = [
    "loiter",
    "loiter.tables",
    "loiter.fences",
    "loiter.geo",
    "loiter.guidance",
    "loiter.files",
    "loiter.fleets",
    "loiter.flight",
    "loiter.plot",
    "loiter.tables",
    "loiter.certificate",
]

# Import paths that the documentation has given, with the names found there.
DOCUMENTED = {
    "loiter.guidance.entry.loiter_entry": ["LoiterEntry"],
    "loiter.lab.simulators.airframes": ["AEROSONDE", "J3CUB"],
    "loiter.lab.simulators.jsbsim_aircraft": ["JsbsimAircraft"],
    "loiter.lab.simulators.kinematic": ["Kinematic"],
    "loiter.lab.simulators.point_mass": ["PointMass"],
    "loiter.lab.trials.campaign": ["LAWS", "campaign", "kinematic", "outcome", "point_mass", "trials"],
    "loiter.lab.trials.flight": ["fly"],
    "loiter.lab.trials.summary": ["summary"],
    "loiter.planning.model": ["Aircraft", "Orbit", "Pose", "Segment", "Turn", "Wind"],
    "loiter.certificate.entry_certificate": ["Certificate", "certify"],
}


def exports():
    """The names that modules export, and those of the public exceptions."""
    found = {package: sorted(importlib.import_module(package).__all__) for package in PACKAGES} | DOCUMENTED
    errors = vars(importlib.import_module("loiter.errors"))
    exceptions = [name for name, value in errors.items() if inspect.isclass(value) and issubclass(value, Exception)]
    return found | {"loiter.errors": sorted(exceptions)}


def parameters():
    """The parameters of functions, or the members of classes."""
    found = {}
    for package, names in exports().items():
        for name in names:
            thing = getattr(importlib.import_module(package), name)
            if inspect.isfunction(thing):
                found[f"{package}.{name}"] = list(inspect.signature(thing).parameters)
            elif inspect.isclass(thing) and not issubclass(thing, (Enum, Exception)):
                found[f"{package}.{name}"] = sorted(member for member in dir(thing) if not member.startswith("_"))
    return found


def options():
    from loiter.cli.app import app

    found = {}
    for name in sorted(command for command in app if not command.startswith("-")):
        command: App = app[name]
        found[name] = sorted(
            option
            for argument in command.assemble_argument_collection()
            for option in argument.names
            if option != "*" and not option.startswith("--empty-")
        )
    return found


def keys(value):
    """The keys of a JSON document."""
    if isinstance(value, dict):
        return {*value, *(key for inner in value.values() for key in keys(inner))}
    return {key for inner in value for key in keys(inner)} if isinstance(value, (list, tuple)) else set()


def documents():
    from loiter.certificate.entry_certificate import certify
    from loiter.files.document import answer

    uav = loiter.Aircraft(18.0, max_bank_deg=35.0)
    scene = loiter.Pose(-400.0, 120.0, 90.0), loiter.Orbit(0.0, 0.0, 120.0), uav
    best, known = loiter.plan_all(*scene), loiter.candidates(*scene)
    frame = loiter.geo.LocalFrame(47.0, 8.0)
    return {
        "plan": sorted(keys(answer(best, known[1:], frame))),
        "certificate": sorted(keys(certify(best[0]).to_dict())),
    }


def tables():
    columns = importlib.import_module("loiter.tables.columns")
    files, jobs = (importlib.import_module(f"loiter.tables.{name}") for name in ("files", "jobs"))
    return {
        "dataset": [files.SUCCESS, files.TEMPORARY, jobs.part_name(0, 10, "0123456789")],
        "added": columns.added_schema(is_placed=False).names,
        "added on Earth": columns.added_schema(is_placed=True).names,
        "statuses": list(columns.STATUSES),
    }


def public():
    """The names of each kind, in a line for each place where they are."""
    found = {
        "names": exports(),
        "parameters and members": parameters(),
        "options": options(),
        "documents": documents(),
        "tables": tables(),
    }
    return {kind: {place: ", ".join(names) for place, names in places.items()} for kind, places in found.items()}


if __name__ == "__main__":
    print(json.dumps(public(), indent=1, sort_keys=True))
