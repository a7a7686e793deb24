"""The C for autopilots on Cortex-M4F and M7: code, stack, and the same flights in QEMU as on the host."""

import struct

import pytest

from native.arm import PROCESSORS, call_graph, compiled, deepest, needs_arm, needs_emulator, output, sizes

# Bytes: of code and constants, and of stack.
FLASH, STACK = 64 * 1024, 4096

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
        assert deepest(*graph, name)[0] <= STACK
    known = compiled(tmp_path, processor, "loiter_identification")
    assert code + sizes(known)[0] <= FLASH
    own, called = (a | b for a, b in zip(graph, call_graph(known), strict=True))
    assert deepest(own, called, "loiter_law_step_identified")[0] <= STACK


def numbers(word):
    """A printed integer, or the single-precision number with these bits."""
    return struct.unpack(">f", bytes.fromhex(word))[0] if len(word) == 8 else int(word)


@needs_emulator
@pytest.mark.parametrize("processor", PROCESSORS)
def test_the_answers_in_qemu_are_those_of_the_host(processor, tmp_path):
    """But for the last digits, since the sine of the C library is another one."""
    on_host, emulated = (output(tmp_path, each, SIZES) for each in (None, processor))
    assert len(on_host) == len(emulated)
    for a, b in zip(on_host, emulated, strict=True):
        if not a.startswith("instructions"):
            assert [numbers(each) for each in b.split()] == pytest.approx(
                [numbers(each) for each in a.split()], abs=5e-3, nan_ok=True
            )
    counts = {" ".join(words[1:-2]): int(words[-1]) for words in map(str.split, emulated) if words[0] == "instructions"}
    assert counts["law"] < 50_000
    assert counts["law in wind by parts"] < 150_000
    assert counts["identified law"] < 200_000
    assert counts["still"] < 20_000
