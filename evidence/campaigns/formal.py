"""Reads, evaluates, builds and breaks the Coq development in evidence/coq/.

`python -m evidence.campaigns.formal` changes one formula or one condition at a time and shows that the proof of each
false statement fails.
"""

import math
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

FOLDER = Path(__file__).parents[1] / "coq"
TOKEN = re.compile(r"\s*(:=|<=|/\\|[A-Za-z_]\w*|\d+|[-+*/()<])")

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
    ("Synthesis.v", "  (X = - (rho * sin th) /\\ Y = rho * cos th) \\/", "  (X * X + Y * Y = rho * rho) \\/"),
    (
        "Neighbour.v",
        "flight X Y th u T -> on_circle 1 Xc Yc (th T) -> distance_sq (X T) (Y T) Xc Yc <= delta * delta ->",
        "flight X Y th u T -> on_circle 1 Xc Yc (th T) -> distance_sq (X T) (Y T) Xc Yc <= delta ->",
    ),
    ("Below.v", "R := 3 * PI / 2 - lower_angle x y + 3", "R := 3 * PI / 2 - lower_angle x y + 2"),
    ("Below.v", "R := 5 * PI / 2 - lower_angle", "R := 2 * PI - lower_angle"),
    ("BelowBound.v", "Rmin right_first (time_lrl x y) else", "right_first else"),
    ("Clockwise.v", "else if Rle_dec 4 (outer_sq x y)", "else if Rle_dec 3 (outer_sq x y)"),
    ("Clockwise.v", ": Prop := X = - (rho * sin th) /\\ Y = rho * cos th.", ": Prop := X * X + Y * Y = rho * rho."),
    ("Wider.v", "then 2 * PI - acos (d / r) else", "then acos (d / r) else"),
    ("Wider.v", "left_turn x y (- c) 0 + (c - X) + left_turn", "left_turn x y (- c) 0 + c + left_turn"),
    ("Wider.v", "let y1 := rho - q / 4 in\n  right_turn", "let y1 := rho - q / 3 in\n  right_turn"),
    ("Wider.v", "  1 < rho /\\ (rho - 3) * (rho - 3) <= outer_sq x y", "  1 < rho /\\ 0 <= outer_sq x y"),
    ("Wider.v", "rho <= 3 /\\ outer_sq x y <= (3 - rho)", "rho <= 3 /\\ outer_sq x y <= (4 - rho)"),
    ("Wider.v", "list word := [LSL; RSL; LSR; RSR;", "list word := [LSL; LSR; RSR;"),
    ("WiderMargin.v", "| LSL | RSL => y <> 0 \\/ 0 < x", "| LSL | RSL => True"),
    (
        "WiderStraight.v",
        "faster_below_the_axis rho x y : 1 <= rho -> y <= 0 ->",
        "faster_below_the_axis rho x y : 1 <= rho -> y <= 1 ->",
    ),
    ("WiderStraight.v", "-> time_of RSR rho x y <= time_of LSR", "-> time_of RSR rho x y < time_of LSR"),
    ("WiderStraight.v", "T x0 y0 + t - eps * (s - t) <= T (x s) (y s) + s)", "T x0 y0 + t <= T (x s) (y s) + s / 2)"),
    ("WiderStraight.v", "with LSL | RSL | LSR | RSR => True", "with RL_left | LSL | RSL | LSR | RSR => True"),
    ("WiderCrossing.v", "R := (k * k - q) / 4.", "R := (k * k - q) / 3."),
    ("WiderCrossing.v", "q + y - 1 - x * (q + crossing_y k q - 1)", "q + y - 1 - x * (q + crossing_y k q)"),
    ("WiderCrossing.v", "-> 0 <= margin_of w rho x y ->", "-> -1 <= margin_of w rho x y ->"),
    ("WiderCrossing.v", "rho + 3) /\\ (outer_sq x y <> (rho + 1) * (rho + 1) \\/ x < 0)", "rho + 3)"),
    ("WiderLRL.v", "(2 * lrl_a rho x y / lrl_s rho x y + 1) / lrl_m", "(lrl_a rho x y / lrl_s rho x y + 1) / lrl_m"),
    ("WiderLRL.v", "-> 0 <= three_arcs_margin rho x y ->", "-> -1 <= three_arcs_margin rho x y ->"),
    ("WiderLRL.v", "let s' := p * (2 * s + d) / (4 * g)", "let s' := p * (s + d) / (4 * g)"),
    ("WiderLRL.v", "  0 < lrl_under_root rho x y /\\ lrl_s", "  0 <= lrl_under_root rho x y /\\ lrl_s"),
    ("WiderEdge.v", "(rho - 1) * (rho - 1) /\\ 0 <= range_sq x y + y - 1\n", "(rho - 1) * (rho - 1) /\\ True\n"),
    (
        "WiderEdge.v",
        "LR_right => outer_sq x y = (rho + 1) * (rho + 1)",
        "LR_right => outer_sq x y = (rho - 3) * (rho - 3)",
    ),
    ("Motion.v", "right_derive x t (1 + u t * y t);", "right_derive x t (2 + u t * y t);"),
]


def definitions():
    """The definitions of coq/ by name that are numbers or conditions: their parameters, their bodies as text."""
    found = {}
    for path in FOLDER.glob("*.v"):
        pattern = r"Definition (\w+) \(([\w ]+) : R\) : (?:R|Prop) :=\s*(.*?)\.\s"
        for name, parameters, body in re.findall(pattern, path.read_text(), flags=re.S):
            found[name] = parameters.split(), body
    return found


def evaluate(known, name, *values):
    """The value of a definition of evidence/coq/ at real numbers."""
    parameters, body = known[name]
    tokens = TOKEN.findall(body)
    value, rest = _expression(tokens, dict(zip(parameters, values, strict=True)), known)
    assert rest == [], (name, rest)
    return value


def holds(known, name, *values):
    """Whether a condition of evidence/coq/, a conjunction of inequalities, holds at real numbers."""
    parameters, body = known[name]
    values, rest, truth = dict(zip(parameters, values, strict=True)), ["/\\", *TOKEN.findall(body)], True
    while rest:
        assert rest[0] == "/\\", (name, rest)
        left, (sign, *rest) = _sum(rest[1:], values, known)
        right, rest = _sum(rest, values, known)
        truth &= {"<=": left <= right, "<": left < right}[sign]
    return truth


def words():
    """The words of Wider.v: the names of the condition and the time of each, and the arguments before rho, x, y."""
    conditions, times = _cases("exists_at"), _cases("time_of")
    return {
        word: (condition, time, [float(value.strip("()")) for value in side])
        for word, (condition,) in conditions.items()
        for time, *side in [times[word]]
    }


def _cases(name):
    """The cases of a definition of Wider.v by word: what stands behind the arrow."""
    text = (FOLDER / "Wider.v").read_text()
    body = re.search(rf"Definition {name} .*?\bwith\b(.*?)\bend\b", text, flags=re.S)[1]
    arrows = re.findall(r"((?:\| \w+ )+)=> ([^|]+)", body)
    return {word: target.split() for left, target in arrows for word in re.findall(r"\w+", left)}


def least_of_words(known, choices, rho, x, y):
    """The word and the least time among those that exist onto the clockwise circle of radius rho: `least_of_words`."""
    times = [
        (evaluate(known, time, *side, rho, x, y), word)
        for word, (condition, time, side) in choices.items()
        if holds(known, condition, rho, x, y)
    ]
    return min(times)


def margin(known, word, rho, x, y):
    """The margin that the theorems of WiderMargin.v, WiderCrossing.v and WiderLRL.v ask to be no less than 0."""
    side = {"left": -1.0, "right": 1.0}.get(word.partition("_")[2])
    if word == "LRL":
        return evaluate(known, "three_arcs_margin", rho, x, y)
    if side is None:
        end = {"L": -1.0, "R": 1.0}[word[2]]
        return evaluate(known, "axis_margin", end, x, y if word[0] == "L" else -y)
    if word.startswith("RL"):
        return evaluate(known, "crossing_margin", side, rho + 1.0, x, y)
    return evaluate(known, "crossing_margin", side, rho - 1.0, x, -y)


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


FUNCTIONS = {
    "sqrt": lambda v: math.sqrt(max(v, 0.0)),
    "atan": math.atan,
    "asin": math.asin,
    "acos": lambda v: math.acos(min(max(v, -1.0), 1.0)),
}


def _expression(tokens, values, known):
    """A sum, after any `let name := sum in` and `if Rle_dec atom atom then sum else`; and the tokens after it."""
    if tokens[0] == "let":
        value, rest = _sum(tokens[3:], values, known)
        assert rest[0] == "in"
        return _expression(rest[1:], values | {tokens[1]: value}, known)
    if tokens[0] == "if":
        left, rest = _atom(tokens[2:], values, known)
        right, rest = _atom(rest, values, known)
        first, rest = _expression(rest[1:], values, known)
        second, rest = _expression(rest[1:], values, known)
        return (first if {"Rle_dec": left <= right, "Rlt_dec": left < right}[tokens[1]] else second), rest
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
