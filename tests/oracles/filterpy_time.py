"""Answers with the microseconds that FilterPy needs for a step: one prediction and one correction of
an airplane in wind (four components) that sees one landmark (two).

Takes no question; an argument gives the number of steps. The best of five rounds counts.
"""

import json
import sys
import time

from filterpy_ukf import filterpy

QUESTION = {
    "alpha": 1.0,
    "beta": 2.0,
    "carried_through": False,
    "step": 0.5,
    "height": 121.92,
    "focal_length": 554.0,
    "principal_point": [320.0, 240.0],
    "mean": [0.0, 0.0, 0.0, 0.0],
    "covariance": [[25.0, 0, 0, 0], [0, 25.0, 0, 0], [0, 0, 16.0, 0], [0, 0, 0, 16.0]],
    "process_noise": [[0.8, 0, 0, 0], [0, 0.8, 0, 0], [0, 0, 0.02, 0], [0, 0, 0, 0.02]],
    "measurement_noise": [[36.0, 0.0], [0.0, 36.0]],
}

steps = int(sys.argv[1]) if len(sys.argv) > 1 else 2000
QUESTION["steps"] = [
    {
        "air_velocity": [19.0, 0.0],
        "camera_from_world": [[0.0, 1.0, 0.0], [-1.0, 0.0, 0.0], [0.0, 0.0, 1.0]],
        "landmark": [9.5 * (k + 1), 20.0, 0.0],
        "pixel": [410.0, 240.0],
    }
    for k in range(steps)
]
best = float("inf")
for _ in range(5):
    start = time.perf_counter()
    for _ in filterpy(QUESTION):
        pass
    best = min(best, (time.perf_counter() - start) / steps)
json.dump({"microseconds_per_step": best * 1e6, "steps": steps}, sys.stdout)
