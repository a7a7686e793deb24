"""The kernel in JavaScript, run by the browser: the bits of the Python that it comes from."""

from pathlib import Path

from compiled.windy import BAD, drawn
from native.javascript import Portable
from native.states import SPECIAL
from native.states import drawn as drawn_in_still_air
from native.test_javascript import beside
from page.browsing import SOURCE

ANSWERS = Path(__file__).parents[1] / "native" / "answers.js"

RUN = """async ([kernelText, asked]) => {
  %s
  const functions = { inStillAir, rankedInStillAir, around, inWind, rankedInWind };
  const kernel = await import(URL.createObjectURL(new Blob([kernelText], { type: "text/javascript" })));
  return asked.map(([name, rows]) => rows.map((row) => functions[name](kernel, row)));
}"""


def test_the_browser_gives_the_bits_of_python(browser):
    portable = Portable()
    asked = {
        "inStillAir": ([*drawn_in_still_air(2_000, 8), *SPECIAL[::50]], portable.in_still_air),
        "rankedInStillAir": (drawn_in_still_air(100, 9), portable.ranked_in_still_air),
        "around": (beside(90), portable.around),
        "inWind": ([*drawn(40, 7), *BAD], lambda *problem: portable.in_wind(*problem)[:8]),
        "rankedInWind": (drawn(4, 8), portable.ranked_in_wind),
    }
    functions = ANSWERS.read_text("utf-8").replace("export ", "")
    kernel = (SOURCE / "kernel" / "kernel.js").read_text("utf-8")
    page = browser.new_page()
    found = page.evaluate(RUN % functions, [kernel, [[name, rows] for name, (rows, _) in asked.items()]])
    page.close()
    for (name, (rows, function)), answers in zip(asked.items(), found, strict=True):
        for row, answer in zip(rows, answers, strict=True):
            assert repr([float(number) for number in answer]) == repr(list(map(float, function(*row)))), (name, row)
