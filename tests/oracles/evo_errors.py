"""Answers with the absolute and relative errors that evo finds between two trajectories.

The question names positions of the estimate and of the reference at the same times, how the estimate
is laid over the reference, and how many samples apart places of relative errors are; the answer has the
errors of each sample and evo's statistics of both.
"""

import json
import sys

import numpy as np
from evo.core import metrics
from evo.core.trajectory import PoseTrajectory3D

question = json.load(sys.stdin)
times = np.array(question["times"])


def trajectory(name):
    upright = np.tile([1.0, 0.0, 0.0, 0.0], (len(times), 1))
    return PoseTrajectory3D(np.array(question[name]), upright, times)


reference, estimate = trajectory("reference"), trajectory("estimate")
if question["alignment"] == "Origin":
    estimate.align_origin(reference)
elif question["alignment"] in ("Rigid", "Similarity"):
    estimate.align(reference, correct_scale=question["alignment"] == "Similarity")

absolute = metrics.APE(metrics.PoseRelation.translation_part)
absolute.process_data((reference, estimate))

# Relative errors of ways are taken before anything is turned: without attitude, evo's own are those of
# displacements in the world.
relative = metrics.RPE(
    metrics.PoseRelation.translation_part,
    delta=question["samples"],
    delta_unit=metrics.Unit.frames,
    all_pairs=True,
)
relative.process_data((reference, trajectory("estimate")))


def answer(metric):
    return {"errors": list(metric.error), "statistics": metric.get_all_statistics()}


json.dump({"absolute": answer(absolute), "relative": answer(relative)}, sys.stdout)
