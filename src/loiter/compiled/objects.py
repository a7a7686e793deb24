"""Compiled code on disk: one object file for each version of the sources, written atomically, loaded without Numba.

Numba's own cache does not notice changed callees, and processes that fill it at the same time can leave an index and a
data file that do not match, which causes a segmentation fault (numba issues 4807 and 10128). Here the name of the file
is a digest of everything that the code depends on, and the file appears by a single rename.
"""

import hashlib
import os
import platform
import sys
from collections.abc import Callable, Iterable, Sequence
from contextlib import suppress
from importlib.metadata import version
from pathlib import Path
from typing import Any

import llvmlite.binding as llvm

from loiter.compiled import announce

# Functions of the C library that compiled code may call.
C_LIBRARY = {"acos", "atan2", "cos", "feclearexcept", "sin", "sqrt"}

DIGEST = hashlib.sha256().digest_size


def addresses(
    names: Sequence[str], sources: Iterable[Path], build: Callable[[], Any], what: str = "functions"
) -> list[int]:
    """The addresses of the functions `names` in memory, loaded from the object file for `sources`.

    If there is no such file, or it is damaged, it is made from `build()`, an LLVM module that contains all functions;
    if its folder cannot be written, every process compiles for itself. The code stays loaded until the process ends.
    Before a compilation `compiled.announce` says `what` is compiled.
    """
    _start()
    path = _path(names, sources)
    code = _read(path)
    if code is None:
        announce(f"compiling the {what} for this machine, once; this takes ten to thirty seconds")
        code = _emit(build(), names)
        _MADE.append(path)
        _publish(path, code)
    return _load(code, names)


def cached_addresses(names: Sequence[str], sources: Iterable[Path]) -> list[int] | None:
    """`addresses` where the object file is there and whole; None, at once, where it would have to be made."""
    _start()
    code = _read(_path(names, sources))
    return None if code is None else _load(code, names)


def is_cached(names: Sequence[str], sources: Iterable[Path]) -> bool:
    """Whether the object file is there and whole, so that `addresses` compiles nothing."""
    _start()
    return _read(_path(names, sources)) is not None


def compilations() -> int:
    """How many object files this process has made."""
    return len(_MADE)


def _load(code: bytes, names: Sequence[str]) -> list[int]:
    engine = llvm.create_mcjit_compiler(llvm.parse_assembly(""), _machine())
    engine.add_object_file(llvm.ObjectFileRef.from_data(code))
    engine.finalize_object()
    _ENGINES.append(engine)
    return [engine.get_function_address(name) for name in names]


def kernel_sources() -> list[Path]:
    """The files that the machine code depends on: the formulas, and the code that compiles them."""
    compiled = Path(__file__).parent
    return sorted([*compiled.glob("*.py"), *compiled.with_name("kernel").rglob("*.py")])


def folder() -> Path:
    """The folder of object files: `loiter` in the user's cache folder, $XDG_CACHE_HOME or ~/.cache."""
    return Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache") / "loiter"


def _path(names: Sequence[str], sources: Iterable[Path]) -> Path:
    return folder() / f"{_digest(names, sources)}.o"


def _digest(names: Sequence[str], sources: Iterable[Path]) -> str:
    """A digest of what the machine code depends on: its functions, the sources, the compilers and the processor."""
    compilers = [f"{name} {version(name)}" for name in ("numba", "llvmlite")]
    machine = [platform.platform(), llvm.get_host_cpu_name(), llvm.get_host_cpu_features().flatten()]
    digest = hashlib.sha256("\n".join([*names, sys.version, *compilers, *machine]).encode())
    for source in sources:
        digest.update(source.read_bytes())
    return digest.hexdigest()


def _read(path: Path) -> bytes | None:
    with suppress(OSError):
        data = path.read_bytes()
        if hashlib.sha256(data[DIGEST:]).digest() == data[:DIGEST]:
            return data[DIGEST:]
    return None


def _publish(path: Path, code: bytes) -> None:
    part = path.with_suffix(f".{os.getpid()}.part")
    with suppress(OSError):
        path.parent.mkdir(parents=True, exist_ok=True)
        try:
            part.write_bytes(hashlib.sha256(code).digest() + code)
            part.replace(path)
        finally:
            part.unlink(missing_ok=True)


def _start() -> None:
    llvm.initialize_native_target()
    llvm.initialize_native_asmprinter()


def _machine() -> Any:
    target = llvm.Target.from_default_triple()
    features = llvm.get_host_cpu_features().flatten()
    return target.create_target_machine(cpu=llvm.get_host_cpu_name(), features=features, opt=3, jit=True)


def _emit(module: Any, names: Sequence[str]) -> bytes:
    """Machine code of the functions `names`, with everything that they call inlined.

    Numba's code for reporting Python exceptions, which these functions cannot raise, is thereby removed: it would need
    Numba at run time.
    """
    for function in module.functions:
        if not function.is_declaration and function.name not in names:
            function.linkage = "internal"
    machine = _machine()
    builder = llvm.create_pass_builder(machine, llvm.create_pipeline_tuning_options(speed_level=2))
    builder.getModulePassManager().run(module, builder)
    needs = {f.name for f in module.functions if f.is_declaration and not f.name.startswith("llvm.")}
    assert needs <= C_LIBRARY, f"compiled code needs {needs - C_LIBRARY}"
    code: bytes = machine.emit_object(module)
    return code


# The engines own the loaded code.
_ENGINES: list[Any] = []

# The object files that this process has made.
_MADE: list[Path] = []
