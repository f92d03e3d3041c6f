"""Correlation surfaces by cv2.matchTemplate(TM_CCOEFF_NORMED), and its time with one thread.

Question: {"cases": [{"width", "height", "search": [...], "template_width", "template_height",
"template": [...]}], "repeat": n}. Answer: [{"surface": [...], "microseconds": best of n}, ...].
"""

import json
import sys
import time

import cv2
import numpy as np

cv2.setNumThreads(1)


def answer(case, repeat):
    search = np.array(case["search"], dtype=np.float32)
    search = search.reshape(case["height"], case["width"])
    template = np.array(case["template"], dtype=np.float32)
    template = template.reshape(case["template_height"], case["template_width"])
    best = float("inf")
    for _ in range(max(repeat, 1)):
        start = time.perf_counter()
        surface = cv2.matchTemplate(search, template, cv2.TM_CCOEFF_NORMED)
        best = min(best, time.perf_counter() - start)
    return {"surface": surface.astype(float).ravel().tolist(), "microseconds": best * 1e6}


question = json.load(sys.stdin)
json.dump([answer(case, question["repeat"]) for case in question["cases"]], sys.stdout)
