from typing import Any

processor: str
min_time: Any
control: Any
reduce: Any
solve: Any
min_time_in_wind: Any
solve_in_wind: Any
gradient: Any
path_to_pose: Any
