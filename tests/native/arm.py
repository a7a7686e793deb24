"""The C for autopilots on ARM Cortex-M: how large it is, how deep its stack, and how it runs in QEMU."""

import re
import shutil
import subprocess
from pathlib import Path

import pytest

from codegen.onboard import FOLDER

HERE = Path(__file__).parent
COMPILER = shutil.which("arm-none-eabi-gcc")
HOST = shutil.which("cc")
EMULATOR = shutil.which("qemu-system-arm")
needs_arm = pytest.mark.skipif(COMPILER is None, reason="there is no arm-none-eabi-gcc")
needs_emulator = pytest.mark.skipif(COMPILER is None or EMULATOR is None, reason="there is no qemu-system-arm")

# The processor, and the machine of QEMU that has one.
PROCESSORS = {
    "m4": (["-mcpu=cortex-m4", "-mfpu=fpv4-sp-d16"], "mps2-an386"),
    "m7": (["-mcpu=cortex-m7", "-mfpu=fpv5-sp-d16"], "mps2-an500"),
}

FLAGS = ["-mthumb", "-mfloat-abi=hard", "-std=c99", "-Os", "-ffp-contract=off", "-fno-math-errno", "-DLOITER_FLOAT"]


def compiled(folder, processor, name="loiter"):
    """The object file of loiter.c, or of another file, and the call graph beside it."""
    target, (flags, _) = folder / f"{name}.o", PROCESSORS[processor]
    more = ["-fstack-usage", "-fcallgraph-info=su", "-c", str(FOLDER / f"{name}.c"), "-o", str(target)]
    subprocess.run([COMPILER, *FLAGS, *flags, *more], check=True)
    return target


def sizes(path):
    """The bytes of code and constants, of initialised and of other variables."""
    tool = COMPILER.replace("gcc", "size")
    found = subprocess.run([tool, str(path)], check=True, capture_output=True, text=True).stdout
    return tuple(int(each) for each in found.splitlines()[1].split()[:3])


def call_graph(path):
    """The bytes of stack of each function, and the functions that it calls."""
    text = path.with_suffix(".ci").read_text("utf-8")
    nodes = re.findall(r'node: \{ title: "([^"]*)" label: "([^"]*)"', text)
    own = {title: int(size.group(1)) for title, label in nodes if (size := re.search(r"(\d+) bytes", label))}
    assert not re.search("dynamic", text)
    called = {}
    for source, target in re.findall(r'edge: \{ sourcename: "([^"]*)" targetname: "([^"]*)"', text):
        called.setdefault(source, set()).add(target)
    return own, called


def deepest(own, called, root, above=()):
    """The bytes of stack of a function and all that it calls, and the calls on the way; library functions count as 0.

    A function that calls itself is an error.
    """
    assert root not in above, f"{root} calls itself"
    below = [deepest(own, called, each, (*above, root)) for each in called.get(root, ())]
    size, path = max(below, default=(0, ()))
    return own.get(root, 0) + size, (f"{root.rpartition(':')[2]} {own.get(root, 0)}", *path)


def output(folder, processor, sizes):
    """What arm_main.c prints in QEMU, or on the host where the processor is None."""
    macros = [f"-D{name}={value}" for name, value in sizes.items()]
    sources = [str(FOLDER / "loiter.c"), str(FOLDER / "loiter_identification.c"), str(HERE / "arm_main.c")]
    program = folder / f"program-{processor}"
    if processor is None:
        flags = ["-std=c99", "-O2", "-ffp-contract=off", "-DLOITER_FLOAT"]
        subprocess.run([HOST, *flags, *macros, f"-I{FOLDER}", *sources, "-o", str(program), "-lm"], check=True)
        command = [str(program)]
    else:
        flags, machine = PROCESSORS[processor]
        link = ["--specs=rdimon.specs", f"-T{HERE / 'arm.ld'}", str(HERE / "arm_start.c"), "-lm"]
        made = [COMPILER, *FLAGS, *flags, *macros, f"-I{FOLDER}", *sources, *link, "-o", str(program)]
        subprocess.run(made, check=True)
        emulated = ["-nographic", "-monitor", "none", "-serial", "none", "-icount", "shift=0"]
        semihosted = ["-semihosting-config", "enable=on,target=native", "-kernel", str(program)]
        command = [EMULATOR, "-M", machine, *emulated, *semihosted]
    return subprocess.run(command, check=True, capture_output=True, text=True, timeout=600).stdout.splitlines()
