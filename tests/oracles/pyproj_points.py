"""Places by pyproj.

Question: {"cases": [{"epsg": code, "coordinates": [[x, y], ...], "origin": [latitude, longitude,
height]}]}. Answer: a case each, [[latitude, longitude, north, east], ...]: degrees, and metres on
the horizontal plane through the origin, straight above or below the place.
"""

import json
import sys

import numpy as np
from pyproj import CRS, Transformer


def on_plane(latitude, longitude, origin):
    to_plane = Transformer.from_pipeline(
        "+proj=pipeline +step +proj=unitconvert +xy_in=deg +xy_out=rad "
        "+step +proj=cart +ellps=WGS84 "
        f"+step +proj=topocentric +ellps=WGS84 +lat_0={origin[0]!r} +lon_0={origin[1]!r} "
        f"+h_0={origin[2]!r}"
    )
    height = np.full_like(latitude, origin[2])
    for _ in range(40):
        east, north, up = to_plane.transform(longitude, latitude, height)
        height = height - up
    return north, east


def places(case):
    x, y = np.array(case["coordinates"], dtype=np.float64).T
    to_degrees = Transformer.from_crs(CRS.from_epsg(case["epsg"]), CRS.from_epsg(4326), always_xy=True)
    longitude, latitude = to_degrees.transform(x, y)
    north, east = on_plane(latitude, longitude, case["origin"])
    return np.stack([latitude, longitude, north, east], axis=1).tolist()


if __name__ == "__main__":
    json.dump([places(case) for case in json.load(sys.stdin)["cases"]], sys.stdout)
