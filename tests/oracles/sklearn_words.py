"""Words by scikit-learn's k-means, and a linear support vector machine by its LinearSVC.

Question: {"descriptors": [[64 numbers]], "start": [[64 numbers]], "rounds": n, "inputs": [[x]], "signs": [bool],
"price": C, "asked": [[x]]}. Answer: {"words": [[64 numbers]] after so many rounds of Lloyd from "start",
"margins": of "asked", "objective": 1/2 |w|^2 + C sum of hinge losses}.
"""

import json
import sys

import numpy as np
from sklearn.cluster import KMeans
from sklearn.svm import LinearSVC

q = json.load(sys.stdin)
descriptors, start = np.array(q["descriptors"]), np.array(q["start"])
means = KMeans(
    len(start), init=start, n_init=1, max_iter=q["rounds"], tol=0, algorithm="lloyd"
).fit(descriptors)

inputs, signs = np.array(q["inputs"]), np.where(q["signs"], 1, -1)
# The constant input is punished like the others, as in ours.
machine = LinearSVC(
    loss="hinge", C=q["price"], dual=True, intercept_scaling=1, tol=1e-10, max_iter=1_000_000, random_state=1
).fit(inputs, signs)
weights = np.r_[machine.coef_[0], machine.intercept_]
losses = np.maximum(0, 1 - signs * machine.decision_function(inputs))

json.dump(
    {
        "words": means.cluster_centers_.tolist(),
        "margins": machine.decision_function(np.array(q["asked"])).tolist(),
        "objective": float(0.5 * weights @ weights + q["price"] * losses.sum()),
    },
    sys.stdout,
)
