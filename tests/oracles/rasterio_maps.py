"""Writes GeoTIFF files of many kinds with rasterio and says what is in them.

Question: {"directory": where to write, "files": [paths of files that exist already]}. Answer:
a list with one member a file: "name", "path", "lossy", "dtype", "shape" (height, width, bands),
"samples" (all samples as hex, little-endian, those of a pixel together, masked ones included),
"valid" (255 or 0 a pixel, as hex), "overviews" (one member each, from the finest on: "shape", "samples"
and "valid" as those of the picture), "epsg", "transform" (x = a column + b row + c, y = d column + e
row + f, as [a, b, c, d, e, f]), and "points": the corners of the picture and 1,000 random places as
[column, row, x, y, latitude, longitude, north, east], the last two on the plane through the middle of
the picture at height zero. Files that lie where an earlier one does have no points.
"""

import itertools
import json
import os
import sys
import warnings

import numpy as np
import rasterio
import rasterio.shutil
from pyproj import CRS, Transformer
from rasterio.enums import ColorInterp, Resampling
from rasterio.transform import Affine, from_origin

from pyproj_points import on_plane

warnings.filterwarnings("ignore")
WIDTH, HEIGHT = 70, 93
# Of files with overviews: odd numbers all the way up, and several tiles in the first overview.
WIDE, HIGH = 189, 261

UTM = (32617, from_origin(404211.9, 3285102.9, 0.1, 0.1))
PLACES = {
    "utm": UTM,
    "utm-south": (32733, Affine(3.0, 0.4, 261000.0, 0.3, -2.9, 6243000.0)),
    "web": (3857, from_origin(-10240000.0, 5910000.0, 1.2, 1.2)),
    "degrees": (4326, from_origin(10.1, 45.2, 2.7e-6, 1.9e-6)),
    "far": (32631, from_origin(-200000.0, 8800000.0, 900.0, 1100.0)),
}


def picture(random, dtype, shape, smooth):
    """`smooth`: 0 for noise, or how many times longer waves are than the shortest."""
    bands, height, width = shape
    if smooth:
        y, x = np.mgrid[0:height, 0:width] / smooth
        waves = [127 + 90 * np.sin(x / (7 + 3 * b) + y / (11 - b)) for b in range(bands)]
        return np.stack(waves).astype(dtype)
    if np.issubdtype(dtype, np.floating):
        return random.normal(300, 80, shape).astype(dtype)
    info = np.iinfo(dtype)
    return random.integers(info.min, info.max, shape, dtype, endpoint=True)


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
    yield from kinds_with_overviews(layouts, tiles)
    yield from kinds_of_bits(layouts, tiles)
    for real in ("float64", "uint32", "int32", "int8"):
        yield f"samples-{real}", real, 1, tiles
    for place in PLACES:
        yield f"place-{place}", "uint8", 1, tiles
    yield "place-point", "uint8", 1, tiles


def kinds_of_bits(layouts, tiles):
    for dtype, bands, predictor in [
        ("uint8", 1, 1), ("uint8", 3, 2), ("uint16", 4, 2), ("int16", 1, 2), ("float32", 1, 3),
    ]:
        for layout, cut in layouts.items():
            options = dict(cut, compress="zstd", predictor=predictor)
            yield f"{layout}-zstd-{dtype}-{bands}", dtype, bands, options
    for bands in (3, 4):
        options = dict(layouts["tiles"], compress="webp", WEBP_LOSSLESS="YES", photometric="RGB")
        if bands == 4:
            options["alpha"] = "unassociated"
        yield f"tiles-webp-{bands}", "uint8", bands, options
    for dtype, bands, packing, (layout, cut) in itertools.product(
        ["uint8", "int8", "uint16", "int16", "uint32", "int32", "float32", "float64"],
        [1, 3, 4],
        ["lerc", "lerc_deflate", "lerc_zstd"],
        layouts.items(),
    ):
        options = dict(cut, compress=packing, max_z_error=0)
        if bands == 4:
            options["alpha"] = "unassociated"
        yield f"{layout}-{packing}-{dtype}-{bands}", dtype, bands, options
    for packing, interleave in itertools.product(["lerc", "lerc_zstd"], ["pixel", "band"]):
        options = dict(layouts["tiles"], compress=packing, max_z_error=0, interleave=interleave)
        yield f"tiles-{packing}-holes-{interleave}", "float32", 3, options
    # Reals are damaged by libtiff, which looks for what is no number before it swaps their bytes back.
    yield "lerc-big-endian", "int16", 3, dict(layouts["tiles"], compress="lerc", max_z_error=0, ENDIANNESS="BIG")
    for bits, bands, (layout, cut), packing in itertools.product(
        [1, 2, 3, 4, 6, 7, 9, 10, 12, 15], [1, 3], layouts.items(), ["none", "deflate"]
    ):
        dtype = "uint8" if bits < 8 else "uint16"
        options = dict(cut, compress=packing, NBITS=bits)
        yield f"bits-{bits}-{layout}-{packing}-{bands}", dtype, bands, options


def kinds_with_overviews(layouts, tiles):
    for (layout, cut), packing, dtype, bands in itertools.product(
        [("strips", layouts["strips"]), ("tiles", layouts["tiles"])],
        ["none", "deflate", "lzw", "jpeg"],
        ["uint8", "uint16"],
        [1, 3, 4],
    ):
        if packing == "jpeg" and (dtype == "uint16" or bands == 4):
            continue
        options = dict(cut, compress=packing)
        if packing in ("deflate", "lzw"):
            options["predictor"] = 2
        if bands >= 3:
            options["photometric"] = "RGB"
        if bands == 4:
            options["alpha"] = "unassociated"
        yield f"overviews-{layout}-{packing}-{dtype}-{bands}", dtype, bands, options
    colour = dict(tiles, photometric="RGB")
    jpeg = dict(layouts["tiles"], compress="jpeg", photometric="YCBCR")
    yield "overviews-jpeg-ycbcr", "uint8", 3, jpeg
    yield "overviews-planes", "uint8", 3, dict(colour, interleave="band")
    yield "overviews-bigtiff-big-endian", "uint16", 3, dict(colour, BIGTIFF="YES", ENDIANNESS="BIG")
    yield "overviews-mask", "uint8", 3, colour
    yield "overviews-mask-strips", "uint8", 3, dict(compress="lzw", photometric="RGB")
    yield "overviews-no-data", "uint8", 1, dict(tiles, nodata=0)
    # Files as GDAL's driver for cloud-optimized GeoTIFF lays them out: overviews before the picture.
    for packing, bands in itertools.product(["deflate", "lzw"], [1, 3]):
        yield f"overviews-cloud-{packing}-{bands}", "uint8", bands, {"cloud": packing}
    yield "overviews-cloud-jpeg-grey", "uint8", 1, {"cloud": "jpeg"}
    yield "overviews-cloud-jpeg-ycbcr", "uint8", 3, {"cloud": "jpeg"}
    yield "overviews-cloud-mask", "uint8", 3, {"cloud": "deflate"}


def write(directory, name, dtype, bands, options):
    random = np.random.default_rng(abs(hash_of(name)))
    place = name.removeprefix("place-") if name.startswith("place-") else "utm"
    epsg, transform = PLACES.get(place, UTM)
    width, height = (WIDE, HIGH) if name.startswith("overviews") else (WIDTH, HEIGHT)
    smooth = 1 if "jpeg" in name else 0
    if smooth and name.startswith("overviews") and "ycbcr" in name:
        # GDAL repeats halved colour where others interpolate: it has to be smooth in overviews, too.
        smooth = 8
    data = picture(random, np.dtype(dtype), (bands, height, width), smooth)
    if "NBITS" in options:
        data &= (1 << options["NBITS"]) - 1
    if name == "sparse":
        data[:, 16:48, 0:32] = 0
    if "lerc" in name and bands == 4 and dtype == "uint8":
        # LERC has what is transparent as a mask.
        data[3] = np.where(data[3] > 90, 255, 0)
    if "holes" in name:
        data[0, 10:30, 20:50] = np.nan
        data[:, 40:, 5:9] = np.nan
    if name == "no-data":
        data[:, 10:30, 20:50] = -32768
    path = os.path.join(directory, f"{name}.tif")
    options = dict(options)
    cloud = options.pop("cloud", None)
    environment = {"GDAL_TIFF_INTERNAL_MASK": True}
    with rasterio.Env(**environment), rasterio.open(
        path, "w", driver="GTiff", width=width, height=height, count=bands, dtype=dtype,
        crs=f"EPSG:{epsg}", transform=transform, **options,
    ) as file:
        file.write(data)
        if name == "place-point":
            file.update_tags(AREA_OR_POINT="Point")
        if "mask" in name:
            mask = np.full((height, width), 255, np.uint8)
            mask[5:40, 30:61] = 0
            file.write_mask(mask)
    if cloud:
        plain = path.replace("overviews-cloud", "plain-cloud")
        os.replace(path, plain)
        rasterio.shutil.copy(
            plain, path, driver="COG", COMPRESS=cloud, BLOCKSIZE=128, OVERVIEW_COUNT=2,
            OVERVIEWS="IGNORE_EXISTING", PREDICTOR="NO" if cloud == "jpeg" else "YES", QUALITY=95,
        )
    elif name.startswith("overviews"):
        # Tiles smaller than GDAL's usual ones, so that overviews have several.
        with rasterio.Env(GDAL_TIFF_OVR_BLOCKSIZE=64, JPEG_QUALITY_OVERVIEW=95, **environment):
            with rasterio.open(path, "r+") as file:
                file.build_overviews([2, 4, 8], Resampling.average)
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


def pixels(file):
    samples = np.ascontiguousarray(np.moveaxis(file.read(masked=False), 0, -1))
    return {
        "shape": samples.shape,
        "samples": samples.astype(samples.dtype.newbyteorder("<")).tobytes().hex(),
        "valid": file.dataset_mask().tobytes().hex(),
    }


def overview(path, level):
    with rasterio.open(path, overview_level=level) as file:
        return pixels(file)


def answer(name, path, lossy, answered):
    with rasterio.open(path) as file:
        epsg = file.crs.to_epsg()
        transform = [float(v) for v in tuple(file.transform)[:6]]
        place = (epsg, *transform)
        is_new = place not in answered
        answered.add(place)
        return {
            "name": name,
            "path": path,
            "lossy": lossy,
            "dtype": file.dtypes[0],
            **pixels(file),
            "overviews": [overview(path, level) for level in range(len(file.overviews(1)))],
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
