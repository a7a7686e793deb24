"""The page's formulas of the turn radius are the library's."""

import json
import subprocess
import sys
from pathlib import Path

import pytest

from loiter import Aircraft
from page.browsing import SOURCE

NODE = Path(sys.prefix) / "bin" / "node"
LIMITS = [("max_bank_deg", 35.0), ("max_bank_deg", 1.0), ("max_turn_rate_deg_s", 12.0), ("min_turn_radius_m", 40.0)]

SCRIPT = """
import {{ limitFor, turnRadiusOf }} from {module};
const found = {aircraft}.map((uav) => [turnRadiusOf(uav), {names}.map((n) => limitFor(n, 18, turnRadiusOf(uav)))]);
console.log(JSON.stringify(found));
"""


@pytest.mark.skipif(not NODE.exists(), reason="needs Node")
def test_the_turn_radius_of_the_page_is_that_of_the_library():
    given = [{"airspeed_m_s": 18.0, name: value} for name, value in LIMITS]
    module, names = (SOURCE / "shared" / "turning.js").as_uri(), [name for name, _ in LIMITS]
    script = SCRIPT.format(module=json.dumps(module), aircraft=json.dumps(given), names=json.dumps(names))
    command = [NODE, "--no-warnings", "--input-type=module", "-e", script]
    done = subprocess.run(command, stdout=subprocess.PIPE, text=True, check=True)
    for values, (radius_m, limits) in zip(given, json.loads(done.stdout), strict=True):
        assert radius_m == pytest.approx(Aircraft(**values).turn_radius_m, rel=1e-14)
        for name, limit in zip(names, limits, strict=True):
            assert Aircraft(18.0, **{name: limit}).turn_radius_m == pytest.approx(radius_m, rel=1e-13)
