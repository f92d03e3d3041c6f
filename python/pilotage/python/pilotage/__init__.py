"""Navigation by what can be seen on the ground.

Flight logs as NumPy arrays, the navigator over flights, its filter and vehicle models by themselves, the corridor along a
planned route, patches matched with pictures. Everything is computed by the program's own library, which lets go of
Python's global lock while it works; SI units and radians throughout, in a world of north, east and down.

>>> import pilotage
>>> log = pilotage.read_log("flight.ulg")          # doctest: +SKIP
>>> log["vehicle_attitude"]["rollspeed"]           # doctest: +SKIP
array([...], dtype=float32)
"""

from ._native import (
    Controls,
    Correction,
    Field,
    FilterError,
    Flight,
    Log,
    Match,
    PilotageError,
    Prediction,
    Run,
    Topic,
    Ukf,
    Vehicle,
    __version__,
    correlate,
    match_patch,
    predict_route,
    read_flight,
    read_log,
    read_run,
    replay,
    replay_scenario,
    scenario_names,
    vehicle_models,
)

__all__ = [
    "Controls",
    "Correction",
    "Field",
    "FilterError",
    "Flight",
    "Log",
    "Match",
    "PilotageError",
    "Prediction",
    "Run",
    "Topic",
    "Ukf",
    "Vehicle",
    "__version__",
    "correlate",
    "match_patch",
    "predict_route",
    "read_flight",
    "read_log",
    "read_run",
    "replay",
    "replay_scenario",
    "scenario_names",
    "vehicle_models",
]
