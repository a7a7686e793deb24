"""The C for autopilots with libFuzzer and sanitizers: `python -m native.fuzz entry 3600`.

What is called is one of `CALLED`; the number is that of seconds of processor time. `--float` is single precision, and
`--corpus FOLDER` keeps the inputs that reach new code, and begins with those. Needs clang. An input that makes a
sanitizer or a check complain is left in the present folder, and given again by its name instead of the seconds.
"""

import argparse
import math
import re
import resource
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

from codegen.onboard import FOLDER

HERE = Path(__file__).parent
CLANG = shutil.which("clang")
CALLED = ("entry", "search", "law", "settings")

SANITIZERS = "address,undefined,float-cast-overflow"
FLAGS = ["-std=c99", "-O1", "-g", "-ffp-contract=off", "-fno-sanitize-recover=all"]

# An input may take so many seconds, and have so many bytes.
LONGEST_S, MOST_BYTES = 20, 1024


def build(folder, called, single):
    """The program that libFuzzer drives."""
    program, macros = folder / f"fuzz-{called}", [f"-DFUZZED={called}", *(["-DLOITER_FLOAT"] if single else [])]
    sources = [HERE / "fuzz_onboard.c", FOLDER / "loiter.c", FOLDER / "loiter_identification.c"]
    flags = [*FLAGS, f"-fsanitize=fuzzer,{SANITIZERS}", "-Wno-unused-function", f"-I{FOLDER}"]
    subprocess.run([CLANG, *flags, *macros, *sources, "-o", program, "-lm"], check=True)
    return program


def processor_s():
    """Processor time of the programs that have been run and have ended, s."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def fuzz(program, corpus, seconds):
    """What libFuzzer says at the end of each run, and the exit status of the last.

    libFuzzer stops by the clock; on a busy computer it is run again until the processor time is spent."""
    said, status, end = [], 0, processor_s() + seconds
    while status == 0 and (left := math.ceil(end - processor_s())) > 0:
        limits = [f"-max_total_time={left}", f"-timeout={LONGEST_S}", f"-max_len={MOST_BYTES}", "-print_final_stats=1"]
        done = subprocess.run([program, corpus, *limits], stderr=subprocess.PIPE, text=True, check=False)
        said.append(done.stderr)
        status = done.returncode
    return said, status


def figures(said):
    """The calls made in all runs, and the places in the code that they reached."""
    executed = sum(int(n) for run in said for n in re.findall(r"stat::number_of_executed_units: (\d+)", run))
    return executed, int(re.findall(r" cov: (\d+)", said[-1])[-1])


def main():
    parser = argparse.ArgumentParser(prog="python -m native.fuzz", description=__doc__.partition("\n")[0])
    parser.add_argument("called", choices=CALLED)
    parser.add_argument("seconds", help="or the name of an input")
    parser.add_argument("--float", action="store_true", dest="single")
    parser.add_argument("--corpus", type=Path)
    options = parser.parse_args()
    if CLANG is None:
        print("clang is needed", file=sys.stderr)
        return 2
    if not options.seconds.isdigit() and not Path(options.seconds).is_file():
        print(f"{options.seconds}: neither a number of seconds nor a file with an input", file=sys.stderr)
        return 2
    with tempfile.TemporaryDirectory() as temporary:
        program = build(Path(temporary), options.called, options.single)
        if not options.seconds.isdigit():
            return subprocess.run([program, options.seconds], check=False).returncode
        corpus = options.corpus or Path(temporary) / "corpus"
        corpus.mkdir(exist_ok=True)
        said, status = fuzz(program, corpus, int(options.seconds))
    if status != 0:
        print(said[-1], file=sys.stderr)
        return status
    executed, reached = figures(said)
    print(f"{options.called}: {executed} inputs, {reached} places reached, nothing found")
    return 0


if __name__ == "__main__":
    sys.exit(main())
