"""The committed C is that of the Python beside it, and what cannot be translated is refused in a sentence."""

import re
from importlib import import_module
from itertools import chain

import pytest

import hatch_build
from codegen.arithmetic import CONSTANTS, DOUBLE
from codegen.files import FOLDER, PAGE, files
from codegen.javascript import PORTABLE, Module
from codegen.kinds import NotTranslated
from codegen.unit import ROOT, Unit
from loiter.compiled.solver import single
from native import same_names, untranslatable


def test_make_generate_was_run_after_the_last_change_and_no_other_file_claims_to_be_generated():
    made = files()
    for path, text in made.items():
        assert path.read_text("utf-8") == text, f"{path.name}: run make generate"
    folders = FOLDER.glob("*.[ch]"), PAGE.parent.rglob("*.js")
    assert {path for path in chain(*folders) if "do not edit" in path.read_text("utf-8")} == set(made)


@pytest.mark.skipif(single is None, reason="this package has no machine code")
def test_the_machine_code_is_that_of_the_c_beside_it():
    assert single.sources == hatch_build.digest(ROOT), "run make demo, or python hatch_build.py"


@pytest.mark.parametrize(("module", "name"), CONSTANTS)
def test_the_constants_of_the_arithmetic_of_doubles_are_those_of_the_kernel(module, name):
    source = ROOT / "src"
    titles = [".".join(path.relative_to(source).with_suffix("").parts) for path in source.rglob(f"{module}.py")]
    (found,) = (getattr(import_module(title), name) for title in titles if hasattr(import_module(title), name))
    assert CONSTANTS[module, name](DOUBLE) == found


def test_an_arithmetic_of_fewer_digits_has_its_own_constants():
    short = DOUBLE._replace(real="float", suffix="f", digits=24, exponents=126)
    text = Unit("kernel.h", short, (untranslatable.rounds,)).text()
    assert "typedef float real;" in text
    assert "#define ROUNDING 7.62939453125e-06f" in text


REFUSED = {
    "lists": "[x for x in (1.0, 2.0)]' is not part of the kernel's subset of Python",
    "unannotated": "the parameter 'x' of unannotated has no annotation",
    "recursive": "recursive calls itself, which a kernel function must not",
    "two_kinds": "the variable 'found' with values of the kinds real and real_2",
    "text": "the constant 'text' is not part of",
    "raises": "the statement 'raise ValueError(x)' is not part of",
    "calls_method": "the call 'x.hex()' is not part of",
    "unknown_function": "the function 'gamma' of math is not part of",
    "loop_variable": "the variable 'i' of a loop, set elsewhere too,",
    "computed_middle": "with a computed value in its middle is not part of",
    "lazy_tuple": "a structure is taken apart where it may not be computed",
    "two_into_ring": "'(*ring[2:], pair, pair)' is not part of",
    "ring_by_number": "'ring[x]' is not part of",
    "makes_list": "makes_list has a list, Pair[], which only JavaScript has",
    "wrong_argument": "is called with '(real_2){x, x}', which is no real",
}


@pytest.mark.parametrize(("name", "sentence"), REFUSED.items())
def test_what_is_outside_the_subset_is_refused_in_one_sentence(name, sentence):
    with pytest.raises(NotTranslated, match=re.escape(sentence)) as refusal:
        Unit("kernel.h", DOUBLE, (getattr(untranslatable, name),))
    assert "\n" not in str(refusal.value)
    assert str(refusal.value).startswith("tests/native/untranslatable.py")


@pytest.mark.parametrize("name", ["two_structures", "two_constants"])
def test_two_things_of_one_name_are_refused(name):
    """C would take one for the other, or refuse both with a riddle."""
    with pytest.raises(NotTranslated, match="rename one of them"):
        Unit("law.h", DOUBLE, (getattr(same_names, name),))


REFUSED_IN_JAVASCRIPT = {
    "nested_list": "'[Pair(a, b) for a in (x, x) for b in (x, x)]' is not part of",
    "mixed_list": "the list '[Pair(x, x), x]' is not part of",
    "list_of_some": "'found: list[Pair] = [Pair(x, x)]' is not part of",
    "loop_over_number": "'x' as a list is not part of",
    "sorted_by_lambda": "as a function is not part of",
}


@pytest.mark.parametrize(("name", "sentence"), REFUSED_IN_JAVASCRIPT.items())
def test_what_javascript_does_not_have_either_is_refused_in_one_sentence(name, sentence):
    with pytest.raises(NotTranslated, match=re.escape(sentence)) as refusal:
        Module("kernel.js", PORTABLE, (getattr(untranslatable, name),))
    assert str(refusal.value).startswith("tests/native/untranslatable.py")


def test_every_function_of_the_refused_ones_is_tried():
    names = {
        name
        for name, value in vars(untranslatable).items()
        if getattr(value, "__module__", "") == untranslatable.__name__
    }
    assert names - {"Pair", "rounds", "halved", "taken"} == {*REFUSED, *REFUSED_IN_JAVASCRIPT}
