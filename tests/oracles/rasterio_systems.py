"""Writes GeoTIFF files in systems that their keys describe, and says where they lie.

Question: {"directory": where to write, "systems": [[definition after PROJ, latitude, longitude], ...],
"pixel": size of a pixel in metres}. Answer, a member each: {"path": ..., "corners": [[latitude, longitude],
...]} of WGS 84, clockwise from the first pixel's. The picture is 4 by 3 pixels and begins at that place.
"""

import json
import os
import sys
import warnings

import numpy as np
import rasterio
from pyproj import CRS, Transformer
from rasterio.transform import from_origin

warnings.filterwarnings("ignore")


def written(path, definition, latitude, longitude, pixel):
    crs = CRS.from_user_input(definition)
    size = pixel / (crs.axis_info[0].unit_conversion_factor if crs.is_projected else 111e3)
    x, y = Transformer.from_crs(4326, crs, always_xy=True).transform(longitude, latitude)
    with rasterio.open(
        path,
        "w",
        driver="GTiff",
        width=4,
        height=3,
        count=1,
        dtype="uint8",
        crs=rasterio.crs.CRS.from_wkt(crs.to_wkt()),
        transform=from_origin(x, y, size, size),
    ) as file:
        file.write(np.full((1, 3, 4), 7, dtype=np.uint8))
    back = Transformer.from_crs(crs, 4326, always_xy=True)
    corners = []
    for column, row in ((0, 0), (4, 0), (4, 3), (0, 3)):
        longitude, latitude = back.transform(x + column * size, y - row * size)
        corners.append([latitude, longitude])
    return {"path": path, "corners": corners}


if __name__ == "__main__":
    question = json.load(sys.stdin)
    answers = []
    for number, (definition, latitude, longitude) in enumerate(question["systems"]):
        path = os.path.join(question["directory"], f"{number}.tif")
        answers.append(written(path, definition, latitude, longitude, question["pixel"]))
    json.dump(answers, sys.stdout)
