"""Answers with FilterPy's extended Kalman filter and its smoothers.

Question: {"extended": question as that of filterpy_ukf.py, "smoothing": list of {process, alpha, beta,
process_noise, steps, means, covariances}}. Its process is "airplane" (steps of {air_velocity}, step of
half a second), "turning" (steps of {speed, turn_rate, step}: north, east, heading) or "linear" (transition
in place of steps). Means and covariances are those of a filter: one more than there are steps.
Answer: {"extended": estimates per step of {mean, covariance, nis}, "smoothing": list of lists of {mean,
covariance}}.
"""

import json
import math
import sys

import numpy as np
from filterpy.kalman import (
    ExtendedKalmanFilter,
    KalmanFilter,
    MerweScaledSigmaPoints,
    UnscentedKalmanFilter,
)

from filterpy_ukf import pixel, process


def slope_of_pixel(x, step, question):
    """Jacobian of the pixel with north, east and the wind."""
    line = np.array(step["landmark"]) - np.array([x[0], x[1], -question["height"]])
    rotation = np.array(step["camera_from_world"])
    right, down, out = rotation @ line
    focal = question["focal_length"]
    by_camera = focal * np.array([[1 / out, 0, -right / out**2], [0, 1 / out, -down / out**2]])
    by_position = -(by_camera @ rotation)[:, :2]
    return np.hstack([by_position, np.zeros((2, 2))])


def extended(question):
    """Estimates of FilterPy's extended filter over the flight."""
    dt = question["step"]
    ekf = ExtendedKalmanFilter(4, 2)
    ekf.x = np.array(question["mean"])
    ekf.P = np.array(question["covariance"])
    ekf.Q = np.array(question["process_noise"])
    ekf.R = np.array(question["measurement_noise"])
    ekf.F = np.eye(4)
    ekf.F[0, 2] = ekf.F[1, 3] = dt
    for step in question["steps"]:
        ekf.predict_x = lambda u=0, step=step: setattr(ekf, "x", np.array(process(ekf.x, dt, step)))
        ekf.predict()
        ekf.update(
            np.array(step["pixel"]),
            lambda x, step=step: slope_of_pixel(x, step, question),
            lambda x, step=step: np.array(pixel(x, step, question)),
        )
        nis = float(ekf.y @ ekf.SI @ ekf.y)
        yield {"mean": ekf.x.tolist(), "covariance": ekf.P.tolist(), "nis": nis}


def turning(x, step):
    """Vehicle of known speed and turn rate: north, east, heading."""
    dt, speed = step["step"], step["speed"]
    return np.array(
        [
            x[0] + speed * math.cos(x[2]) * dt,
            x[1] + speed * math.sin(x[2]) * dt,
            x[2] + step["turn_rate"] * dt,
        ]
    )


def smoothed(question):
    """What FilterPy's smoothers make of filtered beliefs."""
    means, covariances = np.array(question["means"]), np.array(question["covariances"])
    size, noise = means.shape[1], np.array(question["process_noise"])
    if question["process"] == "linear":
        kalman = KalmanFilter(size, 1)
        transitions = [np.array(question["transition"])] * len(means)
        means, covariances, _, _ = kalman.rts_smoother(
            means[:, :, None], covariances, transitions, [noise] * len(means)
        )
        means = means[:, :, 0]
    else:
        if question["process"] == "airplane":
            moved = lambda x, step: np.array(process(x, 0.5, step))
        else:
            moved = turning
        points = MerweScaledSigmaPoints(size, question["alpha"], question["beta"], 0.0)
        ukf = UnscentedKalmanFilter(size, 1, 1.0, hx=None, fx=moved, points=points)
        ukf.Q = noise
        # The step after each belief; after the last there is none, and none is asked for.
        steps = question["steps"] + [None]
        means, covariances, _ = ukf.rts_smoother(means, covariances, dts=steps)
    return [
        {"mean": mean.tolist(), "covariance": covariance.tolist()}
        for mean, covariance in zip(means, covariances)
    ]


if __name__ == "__main__":
    asked = json.load(sys.stdin)
    answer = {
        "extended": list(extended(asked["extended"])),
        "smoothing": [smoothed(question) for question in asked["smoothing"]],
    }
    json.dump(answer, sys.stdout)
