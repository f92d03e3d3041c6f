"""Answers with SciPy's points of Sobol: for [dimensions, count] their coordinates in units of 2^-32."""

import json
import sys

from scipy.stats import qmc

dimensions, count = json.load(sys.stdin)
points = qmc.Sobol(dimensions, scramble=False, bits=32).random(count) * 2.0**32
json.dump([[int(coordinate) for coordinate in point] for point in points], sys.stdout)
