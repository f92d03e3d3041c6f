"""Curves, calibration and covariance by scikit-learn, Wilson's interval by SciPy.

Question: {"roc", "froc": {"right": [score], "wrong": [score], "looks": n, "present": n},
"marks": {"scores": [...], "right": [bool]}, "found": n, "present": n, "wilson": [[happened, of]],
"isotonic": {"samples": [[x, y, weight]], "at": [x]}, "logistic_at": [score], "points": [[x, y]],
"stated": [p], "came_true": [bool]}. Scores of "right" are those of looks that were found, of "wrong" in
"roc" the best wrong one of each look. Answer: {"roc", "froc": [[x, y, threshold]], "precision_recall":
[[recall, precision, threshold]], "average_precision", "wilson": [[low, high]], "isotonic": [y],
"logistic": [p], "covariance": {"location", "covariance", "determinant"}, "brier", "log_loss"}.
"""

import json
import sys

import numpy as np
from scipy.stats import binomtest
from sklearn.covariance import MinCovDet
from sklearn.isotonic import IsotonicRegression
from sklearn.linear_model import LogisticRegression
from sklearn.metrics import (
    average_precision_score,
    brier_score_loss,
    log_loss,
    precision_recall_curve,
    roc_curve,
)

q = json.load(sys.stdin)


def operating(case):
    # Rates of the marks, scaled to rates of looks; the first row is no threshold at all.
    right, wrong = case["right"], case["wrong"]
    truth = np.r_[np.ones(len(right)), np.zeros(len(wrong))]
    x, y, threshold = roc_curve(truth, np.r_[right, wrong], drop_intermediate=False)
    x, y = x * len(wrong) / case["looks"], y * len(right) / case["present"]
    return np.column_stack([x, y, threshold])[1:].tolist()


truth, scores = np.array(q["marks"]["right"], dtype=int), np.array(q["marks"]["scores"])
share = q["found"] / q["present"]
precision, recall, threshold = precision_recall_curve(truth, scores)
# Rising thresholds, and a last point without one.
curve = np.column_stack([recall[:-1] * share, precision[:-1], threshold])[::-1]

x, y, weight = np.array(q["isotonic"]["samples"]).T
isotonic = IsotonicRegression(out_of_bounds="clip").fit(x, y, sample_weight=weight)

# Platt's targets: each mark is as much right and as much wrong as they say.
n_right, n_wrong = truth.sum(), (1 - truth).sum()
target = np.where(truth == 1, (n_right + 1) / (n_right + 2), 1 / (n_wrong + 2))
logistic = LogisticRegression(C=np.inf, tol=1e-12, max_iter=10000).fit(
    np.r_[scores, scores][:, None],
    np.r_[np.ones(len(scores)), np.zeros(len(scores))],
    sample_weight=np.r_[target, 1 - target],
)

fit = MinCovDet(random_state=1).fit(np.array(q["points"]))


def wilson(happened, of):
    interval = binomtest(happened, of).proportion_ci(0.95, method="wilson")
    return [interval.low, interval.high]


json.dump(
    {
        "roc": operating(q["roc"]),
        "froc": operating(q["froc"]),
        "precision_recall": curve.tolist(),
        "average_precision": average_precision_score(truth, scores) * share,
        "wilson": [wilson(*pair) for pair in q["wilson"]],
        "isotonic": isotonic.predict(q["isotonic"]["at"]).tolist(),
        "logistic": logistic.predict_proba(np.array(q["logistic_at"])[:, None])[:, 1].tolist(),
        "covariance": {"location": fit.location_.tolist(), "covariance": fit.covariance_.tolist()},
        "brier": brier_score_loss(q["came_true"], q["stated"]),
        "log_loss": log_loss(q["came_true"], q["stated"]),
    },
    sys.stdout,
)
