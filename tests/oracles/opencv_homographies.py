"""Where the middles of pictures lie on a map, by cv2.findHomography through SIFT features of both.

Question: {"map": path, "pictures": [path, ...]}. Answer: [[x, y, inliers] or null, ...]: pixels of the map
from its outer corner.
"""

import json
import sys

import cv2
import numpy as np

LONGEST = 800  # Side to which pictures are reduced, pixels: about twice as fine as the map.
RATIO = 0.8  # Lowe's ratio of the nearest to the second nearest descriptor.
TOLERANCE = 4.0  # Of RANSAC, pixels of the map.
FEWEST = 15  # Inliers of a homography that is believed.

cv2.setRNGSeed(1)
clahe = cv2.createCLAHE(2.0, (8, 8))
sift = cv2.SIFT_create(8000)
matcher = cv2.BFMatcher()


def features(gray, size, mask=None):
    """Places, pixels of the picture as it was from its outer corner, and descriptors."""
    scale = np.array([size[0] / gray.shape[1], size[1] / gray.shape[0]])
    points, descriptors = sift.detectAndCompute(clahe.apply(gray), mask)
    return (np.array([p.pt for p in points]) + 0.5) * scale, descriptors


def middle(path, ground, of_ground):
    gray = cv2.imread(path, cv2.IMREAD_GRAYSCALE)
    height, width = gray.shape
    factor = LONGEST / max(height, width)
    small = cv2.resize(gray, None, fx=factor, fy=factor, interpolation=cv2.INTER_AREA)
    places, descriptors = features(small, (width, height))
    pairs = matcher.knnMatch(descriptors, of_ground, k=2)
    kept = [a for a, b in pairs if a.distance < RATIO * b.distance]
    if len(kept) < FEWEST:
        return None
    seen = places[[m.queryIdx for m in kept]]
    there = ground[[m.trainIdx for m in kept]]
    found, inliers = cv2.findHomography(seen, there, cv2.RANSAC, TOLERANCE)
    if found is None or inliers.sum() < FEWEST:
        return None
    x, y, w = found @ [0.5 * width, 0.5 * height, 1.0]
    return [x / w, y / w, int(inliers.sum())]


question = json.load(sys.stdin)
image = cv2.imread(question["map"], cv2.IMREAD_UNCHANGED)
size = (image.shape[1], image.shape[0])
gray = cv2.cvtColor(image[:, :, :3], cv2.COLOR_BGR2GRAY)
covered = (image[:, :, 3] > 0).astype(np.uint8) * 255
twice = cv2.resize(clahe.apply(gray), None, fx=2, fy=2, interpolation=cv2.INTER_CUBIC)
cover = cv2.resize(covered, None, fx=2, fy=2, interpolation=cv2.INTER_NEAREST)
ground, of_ground = features(twice, size, cover)
json.dump([middle(path, ground, of_ground) for path in question["pictures"]], sys.stdout)
