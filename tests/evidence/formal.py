"""Reads, evaluates, builds and breaks the Coq development in formal/.

`python -m evidence.formal` changes one formula or one condition at a time and shows that the proof of each
false statement fails.
"""

import math
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

FOLDER = Path(__file__).parents[2] / "formal"
TOKEN = re.compile(r"\s*(:=|[A-Za-z_]\w*|\d+|[-+*/()])")

# A file, a text in it, and what stands there in the mutant: each makes a statement false.
MUTANTS = [
    ("RightFirst.v", "+ c - sqrt 3 + PI / 3", "+ c - sqrt 3 + PI / 4"),
    ("RightFirst.v", "+ 3 * asin (range x y / 4)", "+ 2 * asin (range x y / 4)"),
    ("LeftFirst.v", "(2 * PI - 2 * asin s)", "(2 * PI - asin s)"),
    ("LeftFirst.v", "R := m_of (s_of P) * c_of (s_of P).", "R := m_of (s_of P) * c_of (s_of P) + 1 / 100."),
    ("Value.v", "else if Rle_dec 4 (range_sq x y)", "else if Rle_dec 5 (range_sq x y)"),
    (
        "Synthesis.v",
        "turn_bounded : forall t, 0 <= t < T -> -1 <= u t",
        "turn_bounded : forall t, 0 <= t < T -> -2 <= u t",
    ),
    ("Synthesis.v", "  (X = - sin th /\\ Y = cos th) \\/", "  (X * X + Y * Y = 1) \\/"),
    (
        "Neighbour.v",
        "flight X Y th u T -> on_circle Xc Yc (th T) -> distance_sq (X T) (Y T) Xc Yc <= delta * delta ->",
        "flight X Y th u T -> on_circle Xc Yc (th T) -> distance_sq (X T) (Y T) Xc Yc <= delta ->",
    ),
    ("Below.v", "R := 3 * PI / 2 - lower_angle x y + 3", "R := 3 * PI / 2 - lower_angle x y + 2"),
    ("Below.v", "R := 5 * PI / 2 - lower_angle", "R := 2 * PI - lower_angle"),
    ("BelowBound.v", "Rmin right_first (time_lrl x y) else", "right_first else"),
    ("Clockwise.v", "else if Rle_dec 4 (outer_sq x y)", "else if Rle_dec 3 (outer_sq x y)"),
    ("Clockwise.v", ": Prop := X = - sin th /\\ Y = cos th.", ": Prop := X * X + Y * Y = 1."),
    ("Motion.v", "right_derive x t (1 + u t * y t);", "right_derive x t (2 + u t * y t);"),
]


def definitions():
    """The real-valued definitions of formal/ by name: their parameters, and their bodies as text."""
    found = {}
    for path in FOLDER.glob("*.v"):
        pattern = r"Definition (\w+) \(([\w ]+) : R\) : R :=\s*(.*?)\.\s"
        for name, parameters, body in re.findall(pattern, path.read_text(), flags=re.S):
            found[name] = parameters.split(), body
    return found


def evaluate(known, name, *values):
    """The value of a definition of formal/ at real numbers."""
    parameters, body = known[name]
    tokens = TOKEN.findall(body)
    value, rest = _expression(tokens, dict(zip(parameters, values, strict=True)), known)
    assert rest == [], (name, rest)
    return value


def least_time(known, x, y):
    """The name and the value of the formula for the least time, y >= 0, as `least_time_up` chooses it."""
    if evaluate(known, "range_sq", x, y) >= 4.0:
        name = "time_rsl"
    else:
        P = evaluate(known, "outer_sq", x, y)
        name = "time_lrl" if P < 4.0 and x <= evaluate(known, "curve_x", P) else "time_rl"
    return name, evaluate(known, name, x, y)


def least_time_clockwise(known, x, y):
    """The same for the clockwise circle and any state, as `least_time_clockwise` and `least_time_below` choose it."""
    P = evaluate(known, "outer_sq", x, y)
    if y >= 0.0 or P >= 4.0:
        return least_time(known, x, abs(y))
    names = ["time_rl_left", "time_rl_right"] + ["time_lrl"] * is_left_below(known, x, y, P)
    return min(((name, evaluate(known, name, x, y)) for name in names), key=lambda choice: choice[1])


def is_left_below(known, x, y, P):
    """Whether LRL is considered at a state below the axis: `left_below`."""
    if x >= 0.0 or evaluate(known, "discriminant", P) <= 0.0:
        return False
    s = evaluate(known, "s_of", P)
    return evaluate(known, "outer_angle", x, y) <= evaluate(known, "turn_to", evaluate(known, "m_of", s), s)


FUNCTIONS = {"sqrt": lambda v: math.sqrt(max(v, 0.0)), "atan": math.atan, "asin": math.asin}


def _expression(tokens, values, known):
    """A sum, or `let name := sum in expression`; returns its value and the tokens after it."""
    if tokens[0] == "let":
        value, rest = _sum(tokens[3:], values, known)
        assert rest[0] == "in"
        return _expression(rest[1:], values | {tokens[1]: value}, known)
    return _sum(tokens, values, known)


def _sum(tokens, values, known):
    value, rest = _product(tokens, values, known)
    while rest and rest[0] in "+-":
        term, after = _product(rest[1:], values, known)
        value, rest = (value + term if rest[0] == "+" else value - term), after
    return value, rest


def _product(tokens, values, known):
    value, rest = _factor(tokens, values, known)
    while rest and rest[0] in "*/":
        factor, after = _factor(rest[1:], values, known)
        value, rest = (value * factor if rest[0] == "*" else value / factor), after
    return value, rest


def _factor(tokens, values, known):
    """A sign or an inverse before a factor, a function with its arguments, or an atom."""
    head, rest = tokens[0], tokens[1:]
    if head in "-/":
        value, rest = _factor(rest, values, known)
        return (-value if head == "-" else 1.0 / value), rest
    if head in FUNCTIONS:
        value, rest = _atom(rest, values, known)
        return FUNCTIONS[head](value), rest
    if head in known and head not in values:
        arguments = []
        for _ in known[head][0]:
            value, rest = _atom(rest, values, known)
            arguments.append(value)
        return evaluate(known, head, *arguments), rest
    return _atom(tokens, values, known)


def _atom(tokens, values, known):
    head, rest = tokens[0], tokens[1:]
    if head == "(":
        value, rest = _sum(rest, values, known)
        assert rest[0] == ")"
        return value, rest[1:]
    if head.isdigit():
        return float(head), rest
    return (math.pi if head == "PI" else values[head]), rest


def build(source, target):
    """Build a copy of the development in a folder; returns the completed process, with what Coq printed."""
    for path in source.iterdir():
        if path.suffix == ".v" or path.name == "_CoqProject":
            shutil.copy(path, target)
    subprocess.run(["coq_makefile", "-f", "_CoqProject", "-o", "Makefile"], cwd=target, check=True, capture_output=True)
    return subprocess.run(["make"], cwd=target, capture_output=True, text=True)


def main():
    """Build each mutant; the exit code is 1 if one of them is proved."""
    proved = 0
    for name, text, replacement in MUTANTS:
        with tempfile.TemporaryDirectory() as folder:
            source, target = Path(folder, "source"), Path(folder, "build")
            shutil.copytree(FOLDER, source)
            target.mkdir()
            path = source / name
            assert path.read_text().count(text) == 1, text
            path.write_text(path.read_text().replace(text, replacement))
            result = build(source, target)
            proved += result.returncode == 0
            first = next(iter(re.findall(r'^File "\./(\w+\.v)", line (\d+)', result.stderr, flags=re.M)), ("", ""))
            print(
                f"{name}: {replacement[:70]!r}",
                "PROVED" if result.returncode == 0 else f"refused at {first[0]} {first[1]}",
            )
    return 1 if proved else 0


if __name__ == "__main__":
    sys.exit(main())
