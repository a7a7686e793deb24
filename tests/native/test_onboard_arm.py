"""The C for autopilots on Cortex-M4F and M7: code, stack, and the same flights in QEMU as on the host."""

import struct

import pytest

from native.arm import PROCESSORS, call_graph, compiled, deepest, needs_arm, needs_emulator, output, sizes

# Bytes: of code and constants, and of stack.
FLASH, STACK = 64 * 1024, 4096

# How far numbers may differ from those of the host, whose sines are others. The fits of the identification amplify the
# last digits: where wind is identified, to some hundredths of a degree of bank.
DIFFERENCE, IDENTIFIED_DIFFERENCE = 5e-3, 0.1

SIZES = {"FLIGHT_STEPS": 500, "STILL_ENTRIES": 100, "WINDY_ENTRIES": 20}


@needs_arm
@pytest.mark.parametrize("processor", PROCESSORS)
def test_code_and_stack_are_as_small_as_documented(processor, tmp_path):
    built = compiled(tmp_path, processor)
    code, initialised, others = sizes(built)
    assert code <= FLASH
    assert initialised == others == 0
    graph = call_graph(built)
    for name in ("loiter_fastest", "loiter_search_begin", "loiter_search_step", "loiter_law_begin", "loiter_law_step"):
        assert 0 < deepest(*graph, f"{name}_float")[0] <= STACK
    known = compiled(tmp_path, processor, "loiter_identification")
    assert code + sizes(known)[0] <= FLASH
    own, called = (a | b for a, b in zip(graph, call_graph(known), strict=True))
    assert 0 < deepest(own, called, "loiter_law_step_identified_float")[0] <= STACK


def numbers(word):
    """A printed integer, or the single-precision number with these bits."""
    return struct.unpack(">f", bytes.fromhex(word))[0] if len(word) == 8 else int(word)


def parts(lines):
    """The numbers that each part of the program printed, and the largest count of its instructions."""
    found, rows = {}, []
    for words in map(str.split, lines):
        if words[0] == "instructions":
            found[" ".join(words[1:-2])] = rows, int(words[-1])
            rows = []
        else:
            rows.append([numbers(each) for each in words])
    return found


@needs_emulator
@pytest.mark.parametrize("processor", PROCESSORS)
def test_the_answers_in_qemu_are_those_of_the_host(processor, tmp_path):
    on_host, emulated = (parts(output(tmp_path, each, SIZES)) for each in (None, processor))
    assert on_host.keys() == emulated.keys()
    for name, (rows, _) in on_host.items():
        difference = IDENTIFIED_DIFFERENCE if name == "identified law in wind by parts" else DIFFERENCE
        for row, found in zip(rows, emulated[name][0], strict=True):
            assert found == pytest.approx(row, abs=difference, nan_ok=True)
    counts = {name: count for name, (_, count) in emulated.items()}
    assert counts["law"] < 50_000
    assert counts["law in wind by parts"] < 150_000
    assert counts["identified law"] < 200_000
    assert counts["still"] < 20_000
