"""The C for autopilots with libFuzzer and sanitizers: `python -m native.fuzz entry 3600`.

What is called is `entry`, `search` or `law`; the number is that of seconds. `--float` is single precision, and
`--corpus FOLDER` keeps the inputs that reach new code, and begins with those. Needs clang. An input that makes a
sanitizer or a check complain is left in the present folder, and given again by its name instead of the seconds.
"""

import argparse
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

from codegen.onboard import FOLDER

HERE = Path(__file__).parent
CLANG = shutil.which("clang")
CALLED = ("entry", "search", "law")

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


def fuzz(program, corpus, seconds):
    """What libFuzzer says at the end, and its exit status."""
    limits = [f"-max_total_time={seconds}", f"-timeout={LONGEST_S}", f"-max_len={MOST_BYTES}", "-print_final_stats=1"]
    done = subprocess.run([program, corpus, *limits], stderr=subprocess.PIPE, text=True, check=False)
    return done.stderr, done.returncode


def figures(said):
    """The calls made, and the places in the code that they reached."""
    (executed,) = re.findall(r"stat::number_of_executed_units: (\d+)", said)
    return int(executed), int(re.findall(r" cov: (\d+)", said)[-1])


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
    with tempfile.TemporaryDirectory() as temporary:
        program = build(Path(temporary), options.called, options.single)
        if not options.seconds.isdigit():
            return subprocess.run([program, options.seconds], check=False).returncode
        corpus = options.corpus or Path(temporary) / "corpus"
        corpus.mkdir(exist_ok=True)
        said, status = fuzz(program, corpus, int(options.seconds))
    if status != 0:
        print(said, file=sys.stderr)
        return status
    executed, reached = figures(said)
    print(f"{options.called}: {executed} inputs, {reached} places reached, nothing found")
    return 0


if __name__ == "__main__":
    sys.exit(main())
