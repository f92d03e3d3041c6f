"""Writes elevation models with rasterio and says the height at places.

Question: {"directory": where to write, "raw": path of 344 rows of 403 little-endian 16-bit heights
from the north, or null}. Answer: a list with one member a file: "name", "path", and "heights":
[latitude, longitude, height in metres or null] at 1,000 random places; null beside missing posts.
"""

import json
import os
import sys

import numpy as np
import rasterio
from pyproj import CRS, Transformer
from rasterio.transform import from_bounds, from_origin
from scipy.ndimage import map_coordinates


def hills(height, width):
    y, x = np.mgrid[0:height, 0:width]
    return 400 + 90 * np.sin(x / 23) + 60 * np.cos(y / 17) + 0.3 * x


def models(raw):
    real = hills(120, 150).astype(np.float32)
    holes = real.copy()
    holes[30:50, 60:90] = -9999
    tiles = dict(tiled=True, blockxsize=64, blockysize=48, compress="deflate", predictor=3)
    utm = from_origin(740000.0, 4040000.0, 30.0, 30.0)
    yield "utm-real", real, 32616, utm, dict(tiles)
    yield "holes", holes, 32616, utm, dict(tiles, nodata=-9999)
    unknown = real.copy()
    unknown[70:90, 20:40] = np.nan
    yield "not-a-number", unknown, 32616, utm, dict(tiles)
    web = from_origin(-9400000.0, 4350000.0, 40.0, 40.0)
    yield "web-whole", hills(90, 200).astype(np.int16), 3857, web, {}
    if raw:
        heights = np.fromfile(raw, "<i2").reshape(344, 403)
        # Posts in the middle of pixels, as the data set has them.
        box = from_bounds(-84.41375, 36.44625, -84.07792, 36.73292, 403, 344)
        yield "jacksboro", heights, 4326, box, dict(compress="lzw", predictor=2, nodata=-32768)


def heights(data, epsg, transform, nodata):
    random = np.random.default_rng(11)
    rows, columns = data.shape
    # Half a pixel off the edge, where interpolation has posts on both sides.
    x = random.uniform(0.5, columns - 0.5, 1000)
    y = random.uniform(0.5, rows - 0.5, 1000)
    known = data.astype(np.float64)
    if nodata is not None:
        known[data == nodata] = np.nan
    # A missing post spoils what is near it, as a not-a-number spoils a sum.
    found = map_coordinates(known, [y - 0.5, x - 0.5], order=1)
    to_degrees = Transformer.from_crs(CRS.from_epsg(epsg), CRS.from_epsg(4326), always_xy=True)
    longitude, latitude = to_degrees.transform(*(transform * (x, y)))
    return [
        [float(a), float(b), None if np.isnan(h) else float(h)]
        for a, b, h in zip(latitude, longitude, found)
    ]


def main():
    question = json.load(sys.stdin)
    os.makedirs(question["directory"], exist_ok=True)
    answers = []
    for name, data, epsg, transform, options in models(question["raw"]):
        path = os.path.join(question["directory"], f"{name}.tif")
        with rasterio.open(
            path, "w", driver="GTiff", width=data.shape[1], height=data.shape[0], count=1,
            dtype=data.dtype, crs=f"EPSG:{epsg}", transform=transform, **options,
        ) as file:
            file.write(data, 1)
        answers.append(
            {
                "name": name,
                "path": path,
                "heights": heights(data, epsg, transform, options.get("nodata")),
            }
        )
    json.dump(answers, sys.stdout)


if __name__ == "__main__":
    main()
