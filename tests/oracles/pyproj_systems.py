"""Reference systems by pyproj.

Question: {"codes": [EPSG code, ...]}. Answer, a member each: {"name": ..., "texts": [well-known text as GDAL,
ESRI and ISO 19162 have it], "on_datum": [[x, y, latitude, longitude], ...], "on_wgs84": the same}: places of
the area of use, in degrees of the system's own datum without its prime meridian's offset, and of WGS 84 by the
best transformation without a grid. `on_wgs84` is empty of projected systems.
"""

import json
import math
import sys
import warnings

from pyproj import CRS, Transformer
from pyproj.exceptions import ProjError

warnings.filterwarnings("ignore")
STEPS = (0.13, 0.4, 0.62, 0.88)


def places(crs):
    area = crs.area_of_use
    west, south, east, north = area.bounds
    if east < west:
        east += 360.0
    for u in STEPS:
        for v in STEPS:
            longitude = west + u * (east - west)
            yield (longitude + 180.0) % 360.0 - 180.0, south + v * (north - south)


def by_way_of(crs, other):
    try:
        transform = Transformer.from_crs(other, crs, always_xy=True, allow_ballpark=False)
        back = Transformer.from_crs(crs, other, always_xy=True, allow_ballpark=False)
    except ProjError:
        # There is no better way than to take one for the other.
        return []
    found = []
    for longitude, latitude in places(crs):
        x, y = transform.transform(longitude, latitude)
        if not (math.isfinite(x) and math.isfinite(y)):
            continue
        # The way back of PROJ's equal-area projections is good to a millimetre only.
        if not crs.is_projected or not other.equals(crs.geodetic_crs):
            longitude, latitude = back.transform(x, y)
        if math.isfinite(longitude) and math.isfinite(latitude):
            found.append([x, y, latitude, longitude])
    return found


def text(crs, version):
    try:
        return crs.to_wkt(version)
    except Exception:
        return None


def answer(code):
    crs = CRS.from_epsg(code)
    base = crs.geodetic_crs
    texts = [text(crs, version) for version in ("WKT1_GDAL", "WKT1_ESRI", "WKT2_2019")]
    geographic = crs.is_geographic
    greenwich = base.prime_meridian.longitude == 0
    return {
        "name": crs.name,
        "texts": [text for text in texts if text],
        "on_datum": by_way_of(crs, base) if greenwich and not geographic else [],
        "on_wgs84": by_way_of(crs, CRS.from_epsg(4326)) if geographic or not greenwich else [],
    }


if __name__ == "__main__":
    json.dump([answer(code) for code in json.load(sys.stdin)["codes"]], sys.stdout)
