"""Pixels of points by cv2.projectPoints.

Question: {"cases": [{"camera_from_world": 3x3, "position": [3], "focal": f, "principal": [2],
"distortion": [k1, k2, p1, p2, k3], "point": [3]}]}. Answer: [[x, y], ...].
OpenCV's pixel centres lie at integers, Pilotage's at half integers: half a pixel is taken from the
principal point and given back to the answer.
"""

import json
import sys

import cv2
import numpy as np


def pixel(case):
    rotation = np.array(case["camera_from_world"], dtype=np.float64)
    position = np.array(case["position"], dtype=np.float64)
    x, y = case["principal"]
    matrix = np.array([[case["focal"], 0, x - 0.5], [0, case["focal"], y - 0.5], [0, 0, 1]])
    found, _ = cv2.projectPoints(
        np.array([case["point"]], dtype=np.float64),
        cv2.Rodrigues(rotation)[0],
        -rotation @ position,
        matrix,
        np.array(case["distortion"], dtype=np.float64),
    )
    return (found.reshape(2) + 0.5).tolist()


json.dump([pixel(case) for case in json.load(sys.stdin)["cases"]], sys.stdout)
