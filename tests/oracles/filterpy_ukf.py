"""Answers with FilterPy's estimates on a flight in wind past landmarks, and with those of Table 3
of DeAngelo 2016 in 60 decimal digits.

Question: a list; each has alpha, beta, carried_through, step (s), height (m), focal_length, principal_point (px),
mean, covariance, process_noise, measurement_noise, exact (whether to compute the second answer),
steps of {air_velocity, camera_from_world, landmark, pixel}.
Answer: a list; each has filterpy and exact (or null), each a list per step of {mean, covariance, nis}.
"""

import json
import sys
from decimal import Decimal, getcontext

import numpy as np
from filterpy.kalman import MerweScaledSigmaPoints, UnscentedKalmanFilter
from filterpy.kalman.unscented_transform import unscented_transform

getcontext().prec = 60


def process(x, dt, step):
    """Airplane in wind: north, east, wind north, wind east."""
    north, east = step["air_velocity"]
    return [x[0] + (north + x[2]) * dt, x[1] + (east + x[3]) * dt, x[2], x[3]]


def pixel(x, step, question):
    """Pinhole picture of the landmark from the state's position at the known height."""
    line = [
        step["landmark"][0] - x[0],
        step["landmark"][1] - x[1],
        step["landmark"][2] + question["height"],
    ]
    right, down, out = (
        row[0] * line[0] + row[1] * line[1] + row[2] * line[2]
        for row in step["camera_from_world"]
    )
    scale = question["focal_length"] / out
    return [
        question["principal_point"][0] + scale * right,
        question["principal_point"][1] + scale * down,
    ]


class CarriedThrough(UnscentedKalmanFilter):
    """FilterPy's filter without its redrawing of the points after the process noise."""

    def predict(self, dt=None, UT=None, fx=None, **fx_args):
        self.compute_process_sigmas(self._dt, None, **fx_args)
        self.x, self.P = unscented_transform(self.sigmas_f, self.Wm, self.Wc, self.Q)


def filterpy(question):
    """Estimates of FilterPy."""
    points = MerweScaledSigmaPoints(4, question["alpha"], question["beta"], 0.0)
    kind = CarriedThrough if question["carried_through"] else UnscentedKalmanFilter
    ukf = kind(
        4,
        2,
        question["step"],
        hx=lambda x, step: np.array(pixel(x, step, question)),
        fx=lambda x, dt, step: np.array(process(x, dt, step)),
        points=points,
    )
    ukf.x = np.array(question["mean"])
    ukf.P = np.array(question["covariance"])
    ukf.Q = np.array(question["process_noise"])
    ukf.R = np.array(question["measurement_noise"])
    for step in question["steps"]:
        ukf.predict(step=step)
        ukf.update(np.array(step["pixel"]), step=step)
        nis = float(ukf.y @ ukf.SI @ ukf.y)
        yield {"mean": ukf.x.tolist(), "covariance": ukf.P.tolist(), "nis": nis}


def decimals(value):
    """The question's numbers as exact decimals."""
    if isinstance(value, float):
        return Decimal(value)
    if isinstance(value, list):
        return [decimals(v) for v in value]
    if isinstance(value, dict):
        return {k: decimals(v) for k, v in value.items()}
    return value


def cholesky(a):
    """Lower triangular root."""
    n = len(a)
    root = [[Decimal(0)] * n for _ in range(n)]
    for i in range(n):
        for j in range(i + 1):
            rest = a[i][j] - sum(root[i][k] * root[j][k] for k in range(j))
            root[i][j] = rest.sqrt() if i == j else rest / root[j][j]
    return root


def spread(weights, a, b):
    """Weighted sum of outer products."""
    return [
        [sum(w * p[i] * q[j] for w, p, q in zip(weights, a, b)) for j in range(len(b[0]))]
        for i in range(len(a[0]))
    ]


def table_3(question):
    """DeAngelo 2016, eqs 9-22, in decimal arithmetic."""
    carried_through = question["carried_through"]
    question = decimals(question)
    alpha, beta, n = question["alpha"], question["beta"], 4
    eta = alpha * Decimal(n).sqrt()
    outer = 1 / (2 * n * alpha * alpha)
    mean_weights = [(alpha * alpha - 1) / (alpha * alpha)] + [outer] * (2 * n)
    weights = [mean_weights[0] + 1 - alpha * alpha + beta] + [outer] * (2 * n)
    x, p = question["mean"], question["covariance"]
    q, r = question["process_noise"], question["measurement_noise"]

    def draw():
        root = cholesky(p)
        columns = [[root[i][j] for i in range(n)] for j in range(n)]
        return [x] + [
            [v + sign * eta * d for v, d in zip(x, column)] for sign in (1, -1) for column in columns
        ]

    def average(points):
        return [sum(w * v for w, v in zip(mean_weights, values)) for values in zip(*points)]

    def minus(points, centre):
        return [[v - c for v, c in zip(point, centre)] for point in points]

    for step in question["steps"]:
        points = [process(point, question["step"], step) for point in draw()]
        x = average(points)
        p = spread(weights, minus(points, x), minus(points, x))
        p = [[a + b for a, b in zip(*rows)] for rows in zip(p, q)]
        if not carried_through:
            points = draw()
        seen = [pixel(point, step, question) for point in points]
        z = average(seen)
        s = spread(weights, minus(seen, z), minus(seen, z))
        s = [[a + b for a, b in zip(*rows)] for rows in zip(s, r)]
        cross = spread(weights, minus(points, x), minus(seen, z))
        det = s[0][0] * s[1][1] - s[0][1] * s[1][0]
        inverse = [[s[1][1] / det, -s[0][1] / det], [-s[1][0] / det, s[0][0] / det]]
        gain = [[sum(row[k] * inverse[k][j] for k in (0, 1)) for j in (0, 1)] for row in cross]
        y = [a - b for a, b in zip(step["pixel"], z)]
        x = [v + g[0] * y[0] + g[1] * y[1] for v, g in zip(x, gain)]
        p = [
            [p[i][j] - sum(gain[i][k] * cross[j][k] for k in (0, 1)) for j in range(n)]
            for i in range(n)
        ]
        yield {
            "mean": [float(v) for v in x],
            "covariance": [[float(v) for v in row] for row in p],
            "nis": float(sum(y[i] * inverse[i][j] * y[j] for i in (0, 1) for j in (0, 1))),
        }


if __name__ == "__main__":
    answers = [
        {
            "filterpy": list(filterpy(asked)),
            "exact": list(table_3(asked)) if asked["exact"] else None,
        }
        for asked in json.load(sys.stdin)
    ]
    json.dump(answers, sys.stdout)
