"""Answers with SciPy's chi-square quantiles: for each [probability, dof] of the question."""

import json
import sys

from scipy.stats import chi2

json.dump([float(chi2.ppf(p, dof)) for p, dof in json.load(sys.stdin)], sys.stdout)
