"""Rectangles that cv2.CascadeClassifier finds, ungrouped, with one thread, and in what time.

Question: {"cases": [{"image": path, "xml": text or path, "scale_step"}], "repeat": n}.
Answer: [{"rectangles": [[x, y, width, height], ...] sorted, "seconds": best of n}, ...].
"""

import json
import os
import sys
import tempfile
import time

import cv2

cv2.setNumThreads(1)


def classifier(xml):
    if not xml.lstrip().startswith("<"):
        return cv2.CascadeClassifier(xml)
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "cascade.xml")
        with open(path, "w", encoding="utf-8") as file:
            file.write(xml)
        return cv2.CascadeClassifier(path)


def answer(case, repeat):
    image = cv2.imread(case["image"], cv2.IMREAD_GRAYSCALE)
    cascade = classifier(case["xml"])
    best = float("inf")
    for _ in range(max(repeat, 1)):
        start = time.perf_counter()
        found = cascade.detectMultiScale(image, case["scale_step"], 0)
        best = min(best, time.perf_counter() - start)
    return {"rectangles": sorted([int(v) for v in r] for r in found), "seconds": best}


question = json.load(sys.stdin)
json.dump([answer(case, question["repeat"]) for case in question["cases"]], sys.stdout)
