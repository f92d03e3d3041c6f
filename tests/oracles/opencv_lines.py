"""Steps of the rule for yellow lines by OpenCV: HSV mask, dilation, connected components, Hough's votes.

Question: {"width", "height", "pixels": "rrggbb...", "hue": [low, high], "saturation": [...],
"value": [...], "dilation": side, "votes": least votes}. Answer: {"yellow": [0 or 1, ...],
"dilated": [0 or 1, ...], "areas": [pixels of each component, ascending], "lines": [[distance,
degrees, votes], ...]}, the last three of the dilated mask.
"""

import json
import sys

import cv2
import numpy as np

question = json.load(sys.stdin)
shape = (question["height"], question["width"], 3)
picture = np.frombuffer(bytes.fromhex(question["pixels"]), dtype=np.uint8).reshape(shape)
hsv = cv2.cvtColor(picture.astype(np.float32) / 255, cv2.COLOR_RGB2HSV)
hsv[..., 0] /= 360
yellow = np.ones(shape[:2], dtype=bool)
for channel, name in enumerate(["hue", "saturation", "value"]):
    low, high = question[name]
    yellow &= (hsv[..., channel] >= low) & (hsv[..., channel] <= high)
side = question["dilation"]
dilated = cv2.dilate(yellow.astype(np.uint8), np.ones((side, side), np.uint8))
_, _, statistics, _ = cv2.connectedComponentsWithStats(dilated, connectivity=8)
lines = cv2.HoughLinesWithAccumulator(dilated, 1, np.pi / 180, question["votes"])
json.dump(
    {
        "yellow": yellow.astype(int).ravel().tolist(),
        "dilated": dilated.astype(int).ravel().tolist(),
        "areas": sorted(statistics[1:, cv2.CC_STAT_AREA].tolist()),
        "lines": [
            [float(rho), float(np.degrees(theta)), int(votes)]
            for [[rho, theta, votes]] in ([] if lines is None else lines)
        ],
    },
    sys.stdout,
)
