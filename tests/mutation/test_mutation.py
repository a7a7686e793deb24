"""The mutation search: what it changes, what it leaves alone, what it says of a mutant, and how it goes on."""

import ast
import json

import pytest

from mutation import __main__ as command
from mutation import running
from mutation.mutants import changes_of, chosen, difference, mutated


def changed(source):
    """Every way in which a source may be changed, as the lines that come."""
    tree = ast.parse(source)
    plain = ast.unparse(tree)
    return {difference(plain, mutated(tree, change))[1] for change in changes_of(tree)}


@pytest.mark.parametrize(
    ("source", "others"),
    [
        ("a < b", {"pass", "a <= b", "a >= b"}),
        ("f = a is b", {"f = a is not b"}),
        ("f = a and b and c", {"f = a or b or c", "f = b and c", "f = a and c", "f = a and b"}),
        ("f = a - b", {"f = a + b"}),
        ("f += a[-1]", {"pass", "f += a[1]", "f += a[-2]", "f += a[-0]"}),
        ("f = not a", {"f = a"}),
        ("f = 0.0", {"f = 0.25", "f = -0.25"}),
        ("f = 1e-12", {"f = 1e-09", "f = 1e-15"}),
        ("f = True", {"f = False"}),
        ("f += a['key']", {"pass", "f += a['key_']"}),
        ("f = min(a, b)", {"f = max(a, b)"}),
        ("f = g(a, b, c)", {"f = g(b, a, c)"}),
        ("f = g(a, k=b)", {"f = g(a)"}),
        ("f = a if b else c", {"f = a", "f = c"}),
        ("f = [a for a in b if a]", {"f = [a for a in b]"}),
        ("f += a", {"pass"}),
        ("raise E", {"pass"}),
        ("if a:\n    b = c", {"if not a:", "if True:", "pass"}),
        ("def f():\n    return (a, b)", {"return (b, a)"}),
        ("def f():\n    return a", {"return None"}),
    ],
)
def test_changes(source, others):
    assert changed(source) == others


@pytest.mark.parametrize(
    "source",
    [
        '"""Says what it does."""',
        "from a import b",
        "if TYPE_CHECKING:\n    f = 1",
        "def f(a: tuple[1]) -> Literal[2]:\n    pass",
        "@cache(True)\ndef f():\n    pass",
        "Pair = tuple[float, 2]",
        "f = a('a label', b'x')",
        "f = f'some text {a:.2f}'",
        "__all__ = ['a']",
    ],
)
def test_left_alone(source):
    assert changed(source) <= {"f = a(b'x', 'a label')"}


def test_the_seed_decides_which_mutants():
    files = ["geo/frame.py", "kernel/motion.py"]
    one, again, other = (list(chosen(command.PACKAGE, files, seed)) for seed in (1, 1, 2))
    assert one == again
    assert one != other
    assert sorted(one) == sorted(other)
    for mutant in one:
        assert mutant.before != mutant.after
        compile(mutant.source, mutant.file, "exec")


def test_every_file_has_tests_that_exist():
    named = {test for file in command.files([""]) for stage in running.stages(file) for test in stage}
    paths = {test.removeprefix("--ignore=").removeprefix("--deselect=").partition("::")[0] for test in named}
    assert [path for path in sorted(paths) if not (running.ROOT / path).exists()] == []


def test_a_mutant_is_killed_by_a_test_that_passes_without_it_and_the_original_survives(tmp_path, monkeypatch):
    monkeypatch.setattr(running, "STAGES", {"planning/compass.py": ()})
    copy, place = running.Copy(tmp_path), command.PACKAGE / "planning" / "compass.py"
    source = place.read_text()
    assert copy.outcome("planning/compass.py", source) == ("survived", "")
    verdict, test = copy.outcome(
        "planning/compass.py", source.replace("heading = heading_deg % 360.0", "heading = 0.0")
    )
    assert verdict == "killed"
    assert test.startswith(("tests/planning/test_compass.py::", "src/loiter/planning/compass.py::"))
    assert place.read_text() == (copy.root / "src" / "loiter" / "planning" / "compass.py").read_text() == source


def test_a_mutant_of_the_kernel_is_translated_for_its_tests(tmp_path, monkeypatch):
    monkeypatch.setattr(running, "TRANSLATION", (["-m", "codegen"],))
    copy, source = running.Copy(tmp_path), (command.PACKAGE / "kernel" / "angles.py").read_text()
    header, seen = copy.root / "src" / "loiter" / "native" / "kernel.h", []
    original = header.read_text()
    monkeypatch.setattr(copy, "_run", lambda stage: seen.append(header.read_text()) or running.Outcome("killed"))
    assert copy.outcome("kernel/angles.py", source.replace("turned + TWO_PI", "turned - TWO_PI")).verdict == "killed"
    assert original.count("turned + TWO_PI") == seen[0].count("turned - TWO_PI") == 1
    assert header.read_text() == original
    assert copy.outcome("kernel/angles.py", source.replace("    return ", "    return eval")).verdict == "killed"
    assert len(seen) == 1


def test_it_goes_on_where_it_was_and_tries_again_what_survived(tmp_path, monkeypatch, capsys):
    calls, verdicts = [], iter(["killed", "survived", "timed out", "killed"])

    class Copied:
        def __init__(self, folder):
            pass

        def outcome(self, file, source):
            calls.append(source)
            return running.Outcome(next(verdicts), "a test")

    monkeypatch.setattr(command, "Copy", Copied)
    results = tmp_path / "results.jsonl"
    arguments = ["mutation", "--seed", "3", "--mutants", "3", "--results", str(results), "--files", "kernel/motion.py"]
    monkeypatch.setattr("sys.argv", arguments)
    assert command.main() == 1
    assert "survived: kernel/motion.py:" in capsys.readouterr().out
    assert command.main() == 0
    assert [json.loads(line)["verdict"] for line in results.read_text().splitlines()] == [
        "killed",
        "survived",
        "timed out",
        "killed",
    ]
    assert calls[3] == calls[1]


def test_an_equivalent_is_not_tried(tmp_path, monkeypatch):
    first = next(chosen(command.PACKAGE, ["kernel/motion.py"], 3))
    monkeypatch.setattr(command, "listed", lambda _: {command.key(first)})
    monkeypatch.setattr(command, "Copy", lambda _: None)
    arguments = ["mutation", "--seed", "3", "--mutants", "1", "--files", "kernel/motion.py"]
    monkeypatch.setattr("sys.argv", [*arguments, "--results", str(tmp_path / "results")])
    assert command.main() == 0
    assert (tmp_path / "results").read_text() == ""


def test_equivalents_say_why():
    tables = command.tomllib.loads(command.EQUIVALENTS.read_text("utf-8"))["equivalent"]
    assert all(set(one) == {"file", "before", "after", "why"} and one["why"].endswith(".") for one in tables)
    assert len(command.listed(command.EQUIVALENTS)) == len(tables)


def test_equivalents_are_of_lines_that_there_are():
    tables = command.tomllib.loads(command.EQUIVALENTS.read_text("utf-8"))["equivalent"]
    for one in tables:
        source = ast.unparse(ast.parse((command.PACKAGE / one["file"]).read_text("utf-8")))
        assert all(line.strip() in source for line in one["before"].splitlines())
