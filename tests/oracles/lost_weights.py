"""Weights of crates/core/roads/src/lost/weights.rs, from tables of what was seen of known places.

    pip install numpy==2.4.6
    python lost_weights.py [--laws] TABLE...

A table has a line of JSON for every view: the map that was searched (`map`), that of which the view is (`of`), the index of
the right place or -1, and for each place the counts of points by class of distance. They are written by
`cargo test -p pilotage-roads --test lost tabled` and `cargo test -p pilotage-training --test roads_lost again` with
`PILOTAGE_LOST_TABLE`. The odds of a place against elsewhere are exp(base + counts · weights / sqrt(points)), fitted by
maximum likelihood over all places of a view and "elsewhere" (a multinomial logit) with a penalty of squared weights, and
of squared differences between the weights of neighbouring classes. With `--laws`: the mean logarithm of the probability
that was given to what is true, each map judged by the weights of the others, for three laws of what n points are worth.
"""

import json
import sys

import numpy as np

CLASSES = 8
PENALTY = 0.3
ROUGHNESS = 3.0
LAWS = {"n": 0.0, "n^3/4": 0.25, "sqrt(n)": 0.5}


def features(place: list[list[int]], power: float) -> np.ndarray:
    """1 and the counts of both sides, each over its number of points to a power."""
    sides = [np.array(side, float) for side in place]
    return np.concatenate([[1.0], *(side / max(side.sum(), 1.0) ** power for side in sides)])


def views(rows: list[dict], power: float) -> list[tuple[np.ndarray, int]]:
    """Features of the places of every view that has some, and the index of the right one."""
    return [(np.array([features(place, power) for place in row["places"]]), row["right"])
            for row in rows if row["places"]]


def probabilities(places: np.ndarray, weights: np.ndarray) -> tuple[np.ndarray, float]:
    """Of every place, and of elsewhere."""
    odds = places @ weights
    largest = max(0.0, odds.max())
    shares = np.exp(odds - largest)
    elsewhere = np.exp(-largest)
    total = shares.sum() + elsewhere
    return shares / total, elsewhere / total


def penalties(size: int) -> np.ndarray:
    """Matrix of the penalty of a vector of weights."""
    matrix = PENALTY * np.eye(size)
    matrix[0, 0] = 1e-4
    for side in range(2):
        for first in range(1 + side * CLASSES, side * CLASSES + CLASSES):
            pair = np.array([first, first + 1])
            matrix[np.ix_(pair, pair)] += ROUGHNESS * np.array([[1.0, -1.0], [-1.0, 1.0]])
    return matrix


def fit(data: list[tuple[np.ndarray, int]]) -> np.ndarray:
    """Weights by Newton's method, no step longer than 1."""
    size = data[0][0].shape[1]
    weights, penalty = np.zeros(size), penalties(size)
    for _ in range(80):
        gradient, curvature = -penalty @ weights, penalty
        for places, right in data:
            shares, _ = probabilities(places, weights)
            is_true = np.zeros(len(shares))
            if right >= 0:
                is_true[right] = 1.0
            mean = places.T @ shares
            gradient = gradient + places.T @ (is_true - shares)
            curvature = curvature + (places.T * shares) @ places - np.outer(mean, mean)
        step = np.linalg.solve(curvature, gradient)
        step /= max(1.0, np.abs(step).max())
        weights = weights + step
        if np.abs(step).max() < 1e-6:
            break
    return weights


def main() -> None:
    rows = []
    for name in (name for name in sys.argv[1:] if name != "--laws"):
        with open(name, encoding="utf-8") as table:
            rows += [json.loads(line) for line in table]
    for law, power in LAWS.items() if "--laws" in sys.argv else []:
        logs, believed, wrong = [], 0, 0
        for searched in sorted({row["map"] for row in rows}):
            weights = fit(views([r for r in rows if r["map"] != searched], power))
            for places, right in views([r for r in rows if r["map"] == searched], power):
                shares, elsewhere = probabilities(places, weights)
                logs.append(np.log(max(shares[right] if right >= 0 else elsewhere, 1e-12)))
                believed += shares.max() >= 0.99
                wrong += shares.max() >= 0.99 and shares.argmax() != right
        print(f"{law}: mean log {np.mean(logs):.4f} of {len(logs)} views, {believed} believed, {wrong} wrong")
    weights = fit(views(rows, 0.5))
    print(f"BASE {weights[0]:.2f}")
    for side, name in enumerate(["SEEN", "KNOWN"]):
        own = weights[1 + side * CLASSES:][:CLASSES]
        print(f"{name} [{', '.join(f'{weight:.2f}' for weight in own)}]")


main()
