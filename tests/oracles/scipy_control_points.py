"""Transforms from control points by SciPy.

Question: {"cases": [{"kind": "similarity" | "affine" | "projective", "pixels": [[x, y], ...],
"places": [[x, y], ...], "probe": [x, y]}]}. Answer: a case each, {"rms": root mean square distance in
the plane, "left_out": the same for every point left out of its own fit, "place": of the probe}.
The squared distances in the plane are minimized, by general least squares from a rough start.
"""

import json
import sys

import numpy as np
from scipy.optimize import least_squares


def apply(kind, p, points):
    x, y = points.T
    if kind == "similarity":
        return np.stack([p[0] * x + p[1] * y + p[2], p[1] * x - p[0] * y + p[3]], axis=1)
    top = np.stack([p[0] * x + p[1] * y + p[2], p[3] * x + p[4] * y + p[5]], axis=1)
    if kind == "affine":
        return top
    return top / (p[6] * x + p[7] * y + 1)[:, None]


def solve(kind, pixels, places):
    # An affine fit by linear least squares is the start.
    rows = np.column_stack([pixels, np.ones(len(pixels))])
    start, *_ = np.linalg.lstsq(rows, places, rcond=None)
    p = start.T.flatten()
    if kind == "similarity":
        p = np.array([p[0], p[1], p[2], p[5]])
    elif kind == "projective":
        p = np.concatenate([p, [0, 0]])

    def residuals(p):
        return (apply(kind, p, pixels) - places).flatten()

    best = least_squares(residuals, p, method="lm", x_scale="jac", xtol=1e-15, ftol=1e-15, gtol=1e-15)
    return best.x


def rms(vectors):
    return float(np.sqrt(np.mean(np.sum(vectors**2, axis=1))))


def answer(case):
    kind = case["kind"]
    pixels, places = np.array(case["pixels"]), np.array(case["places"])
    # Around zero and of size one: the distances only change by the factor.
    middle, size = places.mean(axis=0), np.abs(places - places.mean(axis=0)).max()
    centre, extent = pixels.mean(axis=0), np.abs(pixels - pixels.mean(axis=0)).max()
    scaled, seen = (places - middle) / size, (pixels - centre) / extent
    p = solve(kind, seen, scaled)
    out = []
    for i in range(len(pixels)):
        keep = np.arange(len(pixels)) != i
        q = solve(kind, seen[keep], scaled[keep])
        out.append(apply(kind, q, seen[i : i + 1])[0] - scaled[i])
    probe = (np.array([case["probe"]]) - centre) / extent
    return {
        "rms": rms(apply(kind, p, seen) - scaled) * size,
        "left_out": rms(np.array(out)) * size,
        "place": (apply(kind, p, probe)[0] * size + middle).tolist(),
    }


json.dump([answer(case) for case in json.load(sys.stdin)["cases"]], sys.stdout)
