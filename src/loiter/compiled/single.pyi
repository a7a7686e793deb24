sources: str

_WindEntry = tuple[int, int, int, float, float, float, float, float]

def optimum(
    x: float, y: float, R: float, side: int, tolerance: float, /
) -> tuple[int, int, float, float, float] | None: ...
def fastest_in_wind(
    x: float, y: float, c: float, s: float, R: float, side: int, wx: float, wy: float, tolerance: float, /
) -> _WindEntry: ...
def local_minima_in_wind(
    x: float, y: float, c: float, s: float, R: float, side: int, wx: float, wy: float, tolerance: float, /
) -> list[_WindEntry]: ...
def first_in_slot(
    x: float, y: float, c: float, s: float, R: float, side: int, wx: float, wy: float, tolerance: float, phase: float, /
) -> _WindEntry: ...
