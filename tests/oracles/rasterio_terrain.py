"""Writes elevation models with rasterio and says the height at places.

Question: {"directory": where to write, "raw": path of 344 rows of 403 little-endian 16-bit heights
from the north, or null}. Answer: a list with one member a file: "name", "path", "datum": the name that
PROJ has for what heights count from ("" where the file does not say it), "posts": so many posts were read
by the driver for such files, and "heights": [latitude, longitude, height in metres or null] at 1,000 random
places between posts and, in .hgt files, 1,000 random posts; null beside missing posts.
"""

import json
import os
import sys

import numpy as np
import rasterio
import rasterio.shutil
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
    lerc = dict(tiled=True, blockxsize=64, blockysize=48, compress="lerc_zstd", max_z_error=0)
    yield "lerc-not-a-number", unknown, 32616, utm, lerc
    web = from_origin(-9400000.0, 4350000.0, 40.0, 40.0)
    yield "web-whole", hills(90, 200).astype(np.int16), 3857, web, {}
    # What heights count from: above ellipsoid and geoids, in metres and feet.
    yield "egm96", real, "32616+5773", utm, dict(tiles)
    yield "egm2008-degrees", real, "4326+3855", from_origin(10.0, 47.0, 4e-4, 3e-4), dict(tiles)
    yield "navd88", real, "32616+5703", utm, dict(tiles)
    yield "navd88-survey-feet", real, "32616+6360", utm, dict(tiles)
    yield "navd88-feet", real, "32616+8228", utm, dict(tiles)
    yield "ngvd29-feet", real, "32616+5702", utm, dict(tiles)
    yield "dhhn2016", real, "32632+7837", utm, dict(tiles)
    yield "ellipsoid-degrees", real, "4979", from_origin(10.0, 47.0, 4e-4, 3e-4), dict(tiles)
    if raw:
        heights = np.fromfile(raw, "<i2").reshape(344, 403)
        # Posts in the middle of pixels, as the data set has them.
        box = from_bounds(-84.41375, 36.44625, -84.07792, 36.73292, 403, 344)
        yield "jacksboro", heights, 4326, box, dict(compress="lzw", predictor=2, nodata=-32768)


def hgt_models(directory):
    """.hgt files as GDAL's driver for them writes and reads them: name, path, heights, place."""
    for name, side, latitude, longitude in [
        ("N46W092.hgt", 1201, 46, -92),
        ("S34E151.hgt", 3601, -34, 151),
        ("N00E006.hgt", 1201, 0, 6),
        ("S01W001.hgt", 1201, -1, -1),
    ]:
        random = np.random.default_rng(side + latitude)
        known = hills(side, side) + random.normal(0, 30, (side, side))
        posts = np.clip(known - 250, -430, 8850).astype(np.int16)
        for _ in range(40):
            row, column = random.integers(0, side, 2)
            posts[row : row + side // 30, column : column + side // 40] = -32768
        step = 1 / (side - 1)
        # Posts on whole degrees, in the middle of GDAL's pixels.
        place = from_origin(longitude - step / 2, latitude + 1 + step / 2, step, step)
        path = os.path.join(directory, name)
        plain = path + ".tif"
        with rasterio.open(
            plain, "w", driver="GTiff", width=side, height=side, count=1, dtype="int16",
            crs="EPSG:4326", transform=place, nodata=-32768,
        ) as file:
            file.write(posts, 1)
        rasterio.shutil.copy(plain, path, driver="SRTMHGT")
        os.remove(plain)
        with rasterio.Env(REPORT_COMPD_CS=True), rasterio.open(path) as file:
            assert file.driver == "SRTMHGT", file.driver
            yield name, path, file.read(1), file.transform, file.crs, file.nodata


def datum_of(crs):
    """Name of what heights count from, "" for a flat system."""
    crs = CRS.from_wkt(crs.to_wkt())
    if crs.is_compound:
        return crs.sub_crs_list[1].name
    return crs.ellipsoid.name if len(crs.axis_info) == 3 else ""


def at_posts(data, transform, nodata):
    random = np.random.default_rng(5)
    rows, columns = (random.integers(0, size, 996) for size in data.shape)
    # The corners are where a driver that is off by half a post shows it.
    rows = np.append(rows, [0, 0, data.shape[0] - 1, data.shape[0] - 1])
    columns = np.append(columns, [0, data.shape[1] - 1, 0, data.shape[1] - 1])
    x, y = transform * (columns + 0.5, rows + 0.5)
    found = data[rows, columns]
    return [
        [float(b), float(a), None if h == nodata else float(h)] for a, b, h in zip(x, y, found)
    ]


def heights(data, crs, transform, nodata):
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
    to_degrees = Transformer.from_crs(crs, CRS.from_epsg(4326), always_xy=True)
    longitude, latitude = to_degrees.transform(*(transform * (x, y)))
    return [
        [float(a), float(b), None if np.isnan(h) else float(h)]
        for a, b, h in zip(latitude, longitude, found)
    ]


def main():
    question = json.load(sys.stdin)
    os.makedirs(question["directory"], exist_ok=True)
    answers = []
    for name, data, system, transform, options in models(question["raw"]):
        system = str(system)
        flat = CRS.from_epsg(int(system.split("+")[0])).to_2d()
        whole = CRS.from_user_input("EPSG:" + system)
        path = os.path.join(question["directory"], f"{name}.tif")
        with rasterio.open(
            path, "w", driver="GTiff", width=data.shape[1], height=data.shape[0], count=1,
            dtype=data.dtype, crs=whole.to_wkt(), transform=transform, **options,
        ) as file:
            file.write(data, 1)
        unit = whole.sub_crs_list[1].axis_info[0].unit_conversion_factor if whole.is_compound else 1
        metres = data if unit == 1 else data.astype(np.float64) * unit
        with rasterio.open(path) as file:
            datum = datum_of(file.crs)
        answers.append(
            {
                "name": name,
                "path": path,
                "datum": datum,
                "posts": 0,
                "heights": heights(metres, flat, transform, options.get("nodata")),
            }
        )
    for name, path, data, transform, crs, nodata in hgt_models(question["directory"]):
        posts = at_posts(data, transform, nodata)
        between = heights(data, CRS.from_epsg(4326), transform, nodata)
        answers.append(
            {
                "name": name,
                "path": path,
                "datum": datum_of(crs),
                "posts": data.size,
                "heights": between + posts,
            }
        )
    json.dump(answers, sys.stdout)


if __name__ == "__main__":
    main()
