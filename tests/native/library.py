"""The C of src/loiter/native as a library: compiled by the system's compiler, called through ctypes."""

import re
import shutil
import subprocess
from ctypes import CDLL, POINTER, Structure, byref, c_double, c_int, c_longlong
from pathlib import Path

import pytest

from codegen.files import FOLDER
from loiter.kernel.entry import Entry
from loiter.kernel.wind.wind_search import WindEntry

COMPILER = shutil.which("cc") or shutil.which("gcc") or shutil.which("clang")
needs_compiler = pytest.mark.skipif(COMPILER is None, reason="there is no C compiler")

FLAGS = ["-std=c99", "-O2", "-ffp-contract=off", "-fPIC", "-shared", "-Wall", "-Wextra", "-Werror"]

# Functions of the search in wind whose calls are counted.
COUNTED = ("words_inside", "words_beside", "first_path_of", "join_point", "lsr_rsl_root", "middle_arc", "fit_two_arcs")


class CEntry(Structure):
    """`loiter_entry`."""

    _fields_ = [("side", c_int), ("word", c_int), *((name, c_double) for name in ("t1", "t2", "t3"))]


class CProblem(Structure):
    """`loiter_wind_problem`."""

    _fields_ = [
        *((name, c_double) for name in ("x", "y", "c", "s", "R")),
        ("side", c_int),
        *((name, c_double) for name in ("wx", "wy", "tolerance")),
    ]


class CWindEntry(Structure):
    """`loiter_wind_entry`."""

    _fields_ = [
        *((name, c_int) for name in ("status", "side", "word")),
        *((name, c_double) for name in ("t1", "t2", "t3", "azimuth", "miss")),
    ]


def counting(source):
    """The C of the kernel, with a counter in each function of `COUNTED`."""
    for i, name in enumerate(COUNTED):
        source, found = re.subn(rf"^(static inline \w+ {name}\([^{{]*{{)$", rf"\1 calls[{i}]++;", source, flags=re.M)
        assert found == 1, name
    return source.replace("typedef double real;", f"typedef double real;\nlong long calls[{len(COUNTED)}];")


def build(folder, change=lambda source: source, flags=()):
    """The library, compiled in a folder from a copy of the C whose kernel.h is changed."""
    for name in ("loiter.h", "loiter.c", "kernel.h"):
        text = Path(FOLDER / name).read_text("utf-8")
        (folder / name).write_text(change(text) if name == "kernel.h" else text, encoding="utf-8")
    library = folder / "liboiter.so"
    subprocess.run([COMPILER, *FLAGS, *flags, str(folder / "loiter.c"), "-o", str(library), "-lm"], check=True)
    return Library(library)


class Library:
    """The functions of the library, with the arguments and results of those of the kernel."""

    def __init__(self, path):
        self.c = CDLL(str(path))
        self.c.loiter_optimum.argtypes = [c_double, c_double, c_double, c_int, c_double, POINTER(CEntry)]
        self.c.loiter_least_time.argtypes = [c_double, c_double, c_double, c_int, c_double]
        self.c.loiter_least_time.restype = c_double
        self.c.loiter_miss.argtypes = [c_double, c_double, c_double, POINTER(CEntry)]
        self.c.loiter_miss.restype = c_double
        self.c.loiter_fastest_in_wind.argtypes = [POINTER(CProblem)]
        self.c.loiter_fastest_in_wind.restype = CWindEntry
        self.c.loiter_first_in_slot.argtypes = [POINTER(CProblem), c_double]
        self.c.loiter_first_in_slot.restype = CWindEntry

    def optimum(self, x, y, R, side, tolerance):
        """Status, maneuver and miss; None for the last two where there is nothing to solve."""
        found = CEntry()
        status = self.c.loiter_optimum(x, y, R, side, tolerance, byref(found))
        if status != 0:
            return status, None, None
        entry = Entry(found.side, found.word, found.t1, found.t2, found.t3)
        return status, entry, self.c.loiter_miss(x, y, R, byref(found))

    def least_time(self, x, y, R, side, tolerance):
        """The least time; nan where there is nothing to solve."""
        return self.c.loiter_least_time(x, y, R, side, tolerance)

    def fastest(self, problem):
        """`wind_search.fastest`."""
        return _entry(self.c.loiter_fastest_in_wind(byref(CProblem(*problem))))

    def first_in_slot(self, problem, phase):
        """`slots.first_in_slot`."""
        return _entry(self.c.loiter_first_in_slot(byref(CProblem(*problem)), phase))

    def local_minima(self, problem):
        """`wind_search.local_minima`."""
        found = (CWindEntry * 128)()
        count = self.c.loiter_local_minima(byref(CProblem(*problem)), found)
        return [_entry(found[i]) for i in range(count)]

    def calls(self):
        """How often the functions of `COUNTED` were called so far."""
        return list((c_longlong * len(COUNTED)).in_dll(self.c, "calls"))


def _entry(found):
    return WindEntry(*(getattr(found, name) for name in WindEntry._fields))
