"""Writes GeoTIFF files of many kinds with rasterio and says what is in them.

Question: {"directory": where to write, "files": [paths of files that exist already]}. Answer:
a list with one member a file: "name", "path", "lossy", "dtype", "shape" (height, width, bands),
"samples" (all samples as hex, little-endian, those of a pixel together, masked ones included),
"valid" (255 or 0 a pixel, as hex), "overviews" (widths), "epsg", "transform" (x = a column + b row +
c, y = d column + e row + f, as [a, b, c, d, e, f]), and "points": the corners of the picture and 1,000
random places as [column, row, x, y, latitude, longitude, north, east], the last two on the plane
through the middle of the picture at height zero. Files that lie where an earlier one does have no
points.
"""

import itertools
import json
import os
import sys
import warnings

import numpy as np
import rasterio
from pyproj import CRS, Transformer
from rasterio.enums import ColorInterp, Resampling
from rasterio.transform import Affine, from_origin

from pyproj_points import on_plane

warnings.filterwarnings("ignore")
WIDTH, HEIGHT = 70, 93

UTM = (32617, from_origin(404211.9, 3285102.9, 0.1, 0.1))
PLACES = {
    "utm": UTM,
    "utm-south": (32733, Affine(3.0, 0.4, 261000.0, 0.3, -2.9, 6243000.0)),
    "web": (3857, from_origin(-10240000.0, 5910000.0, 1.2, 1.2)),
    "degrees": (4326, from_origin(10.1, 45.2, 2.7e-6, 1.9e-6)),
    "far": (32631, from_origin(-200000.0, 8800000.0, 900.0, 1100.0)),
}


def picture(random, dtype, bands, smooth):
    if smooth:
        y, x = np.mgrid[0:HEIGHT, 0:WIDTH]
        waves = [127 + 90 * np.sin(x / (7 + 3 * b) + y / (11 - b)) for b in range(bands)]
        return np.stack(waves).astype(dtype)
    if np.issubdtype(dtype, np.floating):
        return random.normal(300, 80, (bands, HEIGHT, WIDTH)).astype(dtype)
    info = np.iinfo(dtype)
    return random.integers(info.min, info.max, (bands, HEIGHT, WIDTH), dtype, endpoint=True)


def kinds():
    """Every combination that there is, as (name, dtype, bands, creation options)."""
    layouts = {
        "strips": {},
        "one-strip": {"blockysize": HEIGHT},
        "tiles": {"tiled": True, "blockxsize": 32, "blockysize": 16},
    }
    packings = ["none", "deflate", "lzw", "packbits"]
    dtypes = ["uint8", "uint16", "int16", "float32"]
    for (layout, cut), packing, dtype, bands, interleave in itertools.product(
        layouts.items(), packings, dtypes, [1, 2, 3, 4], ["pixel", "band"]
    ):
        if bands == 1 and interleave == "band":
            continue
        predictors = [1]
        if packing in ("deflate", "lzw"):
            predictors = [1, 2, 3] if dtype == "float32" else [1, 2]
        for predictor in predictors:
            options = dict(cut, compress=packing, interleave=interleave)
            if predictor > 1:
                options["predictor"] = predictor
            if bands >= 3 and dtype.startswith("uint"):
                options["photometric"] = "RGB"
            if bands in (2, 4):
                options["alpha"] = "unassociated"
            name = f"{layout}-{packing}-{dtype}-{bands}-{interleave}-{predictor}"
            yield name, dtype, bands, options
    for (layout, cut), bands in itertools.product(layouts.items(), [1, 3]):
        options = dict(cut, compress="jpeg", jpeg_quality=95)
        yield f"{layout}-jpeg-{bands}", "uint8", bands, options
        if bands == 3:
            yield f"{layout}-jpeg-ycbcr", "uint8", 3, dict(options, photometric="YCBCR")
            yield f"{layout}-jpeg-planes", "uint8", 3, dict(options, interleave="band")
    tiles = dict(layouts["tiles"], compress="deflate")
    yield "big-endian", "uint16", 3, dict(tiles, ENDIANNESS="BIG", predictor=2)
    yield "big-endian-real", "float32", 1, dict(tiles, ENDIANNESS="BIG", predictor=3)
    yield "bigtiff", "uint8", 3, dict(tiles, BIGTIFF="YES")
    yield "bigtiff-big-endian", "int16", 1, dict(tiles, BIGTIFF="YES", ENDIANNESS="BIG")
    yield "white-is-zero", "uint8", 1, dict(tiles, photometric="MINISWHITE")
    yield "sparse", "uint8", 3, dict(tiles, SPARSE_OK="TRUE")
    yield "no-data", "int16", 1, dict(tiles, nodata=-32768)
    yield "mask", "uint8", 3, dict(tiles, photometric="RGB")
    yield "overviews", "uint8", 3, dict(tiles, photometric="RGB")
    yield "overviews-mask", "uint8", 3, dict(tiles, photometric="RGB")
    for real in ("float64", "uint32", "int32", "int8"):
        yield f"samples-{real}", real, 1, tiles
    for place in PLACES:
        yield f"place-{place}", "uint8", 1, tiles
    yield "place-point", "uint8", 1, tiles


def write(directory, name, dtype, bands, options):
    random = np.random.default_rng(abs(hash_of(name)))
    place = name.removeprefix("place-") if name.startswith("place-") else "utm"
    epsg, transform = PLACES.get(place, UTM)
    data = picture(random, np.dtype(dtype), bands, "jpeg" in name)
    if name == "sparse":
        data[:, 16:48, 0:32] = 0
    if name == "no-data":
        data[:, 10:30, 20:50] = -32768
    path = os.path.join(directory, f"{name}.tif")
    environment = {"GDAL_TIFF_INTERNAL_MASK": True}
    with rasterio.Env(**environment), rasterio.open(
        path, "w", driver="GTiff", width=WIDTH, height=HEIGHT, count=bands, dtype=dtype,
        crs=f"EPSG:{epsg}", transform=transform, **options,
    ) as file:
        file.write(data)
        if name == "place-point":
            file.update_tags(AREA_OR_POINT="Point")
        if "mask" in name:
            mask = np.full((HEIGHT, WIDTH), 255, np.uint8)
            mask[5:40, 30:61] = 0
            file.write_mask(mask)
    if name.startswith("overviews"):
        with rasterio.Env(**environment), rasterio.open(path, "r+") as file:
            file.build_overviews([2, 4], Resampling.average)
    return path


def hash_of(name):
    return sum((i + 1) * ord(letter) for i, letter in enumerate(name))


def points(file, epsg):
    random = np.random.default_rng(7)
    columns = np.concatenate([[0, file.width, 0, file.width], random.uniform(0, file.width, 1000)])
    rows = np.concatenate([[0, 0, file.height, file.height], random.uniform(0, file.height, 1000)])
    x, y = file.transform * (columns, rows)
    to_degrees = Transformer.from_crs(CRS.from_epsg(epsg), CRS.from_epsg(4326), always_xy=True)
    longitude, latitude = to_degrees.transform(x, y)
    middle = file.transform * (file.width / 2, file.height / 2)
    origin = to_degrees.transform(*middle)
    north, east = on_plane(latitude, longitude, [origin[1], origin[0], 0.0])
    return np.stack([columns, rows, x, y, latitude, longitude, north, east], axis=1).tolist()


def answer(name, path, lossy, answered):
    with rasterio.open(path) as file:
        samples = np.ascontiguousarray(np.moveaxis(file.read(masked=False), 0, -1))
        valid = file.dataset_mask()
        epsg = file.crs.to_epsg()
        transform = [float(v) for v in tuple(file.transform)[:6]]
        place = (epsg, *transform)
        is_new = place not in answered
        answered.add(place)
        return {
            "name": name,
            "path": path,
            "lossy": lossy,
            "dtype": samples.dtype.name,
            "shape": samples.shape,
            "samples": samples.astype(samples.dtype.newbyteorder("<")).tobytes().hex(),
            "valid": valid.tobytes().hex(),
            "overviews": [-(-file.width // f) for f in file.overviews(1)],
            "epsg": epsg,
            "transform": transform,
            "points": points(file, epsg) if is_new else [],
        }


def main():
    question = json.load(sys.stdin)
    os.makedirs(question["directory"], exist_ok=True)
    answers = []
    answered = set()
    for name, dtype, bands, options in kinds():
        path = write(question["directory"], name, dtype, bands, options)
        answers.append(answer(name, path, "jpeg" in name, answered))
    for path in question["files"]:
        answers.append(answer(os.path.basename(path), path, False, answered))
    json.dump(answers, sys.stdout)


if __name__ == "__main__":
    main()
