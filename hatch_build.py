"""Builds the extension modules of `loiter.compiled` from the C of src/loiter/native.

Hatchling calls it for every wheel and for editable installations; `python hatch_build.py` builds the modules beside the
sources. With LOITER_PURE=1 the wheel has no modules: the same functions run in plain Python.
"""

from __future__ import annotations

import hashlib
import os
import platform
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any, NamedTuple

from hatchling.builders.hooks.plugin.interface import BuildHookInterface

NO_COMPILER = (
    "loiter is built with a C compiler, and compiling failed ({error}): install one (on Debian: apt-get install gcc "
    "libc6-dev python3-dev), or set LOITER_PURE=1 for a package in plain Python, which is some hundred times slower"
)

# Kinds of x86 processors for which the loops are compiled, besides any processor.
LEVELS = ("v2", "v3", "v4")
LEVELLED = {"loops.c", "tight_loop.c"}

GNU = ["-std=c11", "-O3", "-ffp-contract=off", "-fno-math-errno", "-fno-trapping-math", "-fvisibility=hidden", "-g0"]
MICROSOFT = ["/std:c11", "/O2", "/fp:precise"]


class Job(NamedTuple):
    """A file to compile, the folder of its object, and its macros."""

    file: str
    folder: str
    macros: list[Any]


def sources(root: Path) -> list[Path]:
    """The files of C from which the modules are built."""
    return sorted((root / "src" / "loiter" / "native").glob("*.[ch]"))


def digest(root: Path) -> str:
    """A digest of the C, which the modules contain."""
    return hashlib.sha256(b"".join(path.read_bytes() for path in sources(root))).hexdigest()


def build(root: Path) -> list[Path]:
    """Build the modules in place; their files."""
    import numpy
    from setuptools import Distribution, Extension, errors
    from setuptools.command.build_ext import build_ext

    folder = root / "src" / "loiter" / "native"
    is_x86 = platform.machine().lower() in ("x86_64", "amd64") and "arm64" not in os.environ.get("ARCHFLAGS", "")

    class Build(build_ext):
        """Compiles the loops once for each kind of processors."""

        def build_extension(self, ext: Extension) -> None:
            """Compile and link one module."""
            is_gnu = self.compiler.compiler_type != "msvc"
            flags = GNU if is_gnu else MICROSOFT
            levels = LEVELS if is_x86 and is_gnu else ()
            macros = [("LOITER_SOURCES", digest(root)), *([("LOITER_X86_LEVELS", "1")] if levels else [])]
            jobs = [Job(name, ext.name, macros) for name in ext.sources if name not in LEVELLED]
            for name in LEVELLED & set(ext.sources):
                jobs += [Job(name, level, [("LOITER_LEVEL", level)]) for level in ("any", *levels)]

            def compiled(job: Job) -> list[str]:
                return self.compiler.compile(
                    [str(folder / job.file)],
                    output_dir=str(Path(self.build_temp) / job.folder),
                    macros=job.macros,
                    include_dirs=[str(folder), numpy.get_include(), *self.compiler.include_dirs],
                    extra_postargs=[*flags, *([f"-march=x86-64-{job.folder}"] if job.folder in levels else [])],
                )

            with ThreadPoolExecutor(os.cpu_count()) as pool:
                objects = [path for paths in pool.map(compiled, jobs) for path in paths]
            self.compiler.link_shared_object(
                objects, self.get_ext_fullpath(ext.name), libraries=[] if os.name == "nt" else ["m"]
            )

    modules = [
        Extension("loiter.compiled.single", ["single.c", "loiter.c"]),
        Extension("loiter.compiled.loops", ["ufuncs.c", "wind_loops.c", "loiter.c", "loops.c", "tight_loop.c"]),
    ]
    distribution = Distribution({"name": "loiter", "ext_modules": modules, "package_dir": {"": str(root / "src")}})
    command = Build(distribution)
    command.inplace = True
    command.build_temp = str(root / "build" / "native")
    command.ensure_finalized()
    try:
        command.run()
    except (errors.BaseError, errors.CompileError, errors.LinkError, OSError) as error:
        raise SystemExit(NO_COMPILER.format(error=error)) from None
    return [Path(command.get_ext_fullpath(module.name)) for module in modules]


class NativeBuildHook(BuildHookInterface):
    """Adds the modules to a wheel."""

    def initialize(self, version: str, build_data: dict[str, Any]) -> None:
        """Build the modules before the wheel is made."""
        if os.environ.get("LOITER_PURE"):
            return
        root = Path(self.root)
        files = build(root)
        build_data["pure_python"], build_data["infer_tag"] = False, True
        build_data["artifacts"] += [str(path.resolve().relative_to(root.resolve()).as_posix()) for path in files]


if __name__ == "__main__":
    for path in build(Path(__file__).parent):
        sys.stdout.write(f"{path}\n")
