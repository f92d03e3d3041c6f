"""Squares of 100 km2 of real road maps, as GeoJSON, for measuring `pilotage roads lost`.

    pip download --no-deps --no-binary :all: neatnet==0.1.6
    pip install pyarrow==26.0.1 pyproj==3.7.2 numpy==2.4.6
    python road_maps.py neatnet-0.1.6.tar.gz FOLDER

The source distribution of neatnet (BSD-3) has the streets of seven urban areas out of OpenStreetMap (ODbL, (c)
OpenStreetMap contributors), drivable ways only. Of each the square of 10 km by 10 km that has most road is written.
"""

import io
import json
import sys
import tarfile
from pathlib import Path

import numpy as np
import pyarrow.parquet as parquet
from pyproj import CRS, Transformer

SIDE = 10_000.0
STEP = 1_000.0


def line(wkb: bytes) -> np.ndarray:
    """Points of a LineString as well-known binary, little-endian."""
    if wkb[0] != 1 or int.from_bytes(wkb[1:5], "little") != 2:
        raise ValueError("no line string")
    count = int.from_bytes(wkb[5:9], "little")
    return np.frombuffer(wkb, "<f8", 2 * count, 9).reshape(count, 2)


def densest(lines: list[np.ndarray]) -> tuple[float, float]:
    """South-west corner of the square with the greatest length of road."""
    middles = np.concatenate([0.5 * (p[1:] + p[:-1]) for p in lines])
    lengths = np.concatenate([np.hypot(*np.diff(p, axis=0).T) for p in lines])
    low = middles.min(axis=0)
    cells = ((middles - low) / STEP).astype(int)
    grid = np.zeros(cells.max(axis=0) + 1)
    np.add.at(grid, (cells[:, 0], cells[:, 1]), lengths)
    side = int(SIDE / STEP)
    sums = np.array([[grid[i:i + side, j:j + side].sum()
                      for j in range(max(1, grid.shape[1] - side + 1))]
                     for i in range(max(1, grid.shape[0] - side + 1))])
    i, j = np.unravel_index(sums.argmax(), sums.shape)
    return low[0] + i * STEP, low[1] + j * STEP


def chains(pieces: list[tuple[np.ndarray, str]]) -> list[tuple[np.ndarray, str]]:
    """Pieces of one kind joined where no other piece meets them."""
    at: dict[bytes, list[int]] = {}
    for index, (points, _) in enumerate(pieces):
        for end in (points[0], points[-1]):
            at.setdefault(end.tobytes(), []).append(index)

    def onward(index: int, end: np.ndarray) -> int | None:
        here = at[end.tobytes()]
        if len(here) != 2 or here[0] == here[1]:
            return None
        other = here[0] if here[1] == index else here[1]
        return other if pieces[other][1] == pieces[index][1] else None

    used = [False] * len(pieces)
    joined = []
    for start in range(len(pieces)):
        if used[start]:
            continue
        used[start] = True
        points, kind = pieces[start]
        for _ in range(2):
            index = start
            while (other := onward(index, points[-1])) is not None and not used[other]:
                used[other] = True
                more = pieces[other][0]
                more = more if (more[0] == points[-1]).all() else more[::-1]
                points = np.concatenate([points, more[1:]])
                index = other
            points = points[::-1]
        joined.append((points, kind))
    return joined


def convert(name: str, data: bytes, folder: Path) -> None:
    table = parquet.read_table(io.BytesIO(data))
    geo = json.loads(table.schema.metadata[b"geo"])
    system = CRS.from_json_dict(geo["columns"][geo["primary_column"]]["crs"])
    to_globe = Transformer.from_crs(system, CRS.from_epsg(4326), always_xy=True)
    lines = [line(wkb) for wkb in table.column("geometry").to_pylist()]
    highways = table.column("highway").to_pylist()
    west, south = densest(lines)
    length, seen, pieces = 0.0, set(), []
    for points, highway in zip(lines, highways):
        middle = points.mean(axis=0)
        if not (west <= middle[0] < west + SIDE and south <= middle[1] < south + SIDE):
            continue
        # Both senses of a street that is driven in both are one street.
        ends = min(points.tobytes(), points[::-1].tobytes())
        if ends in seen:
            continue
        seen.add(ends)
        length += np.hypot(*np.diff(points, axis=0).T).sum()
        kind = highway if isinstance(highway, str) else highway[0]
        pieces.append((points, kind.strip("[]'\" ").split("'")[0].split(",")[0]))
    features = []
    for points, kind in chains(pieces):
        lon, lat = to_globe.transform(points[:, 0], points[:, 1])
        places = [[round(x, 8), round(y, 8)] for x, y in zip(lon, lat)]
        features.append({
            "type": "Feature",
            "properties": {"highway": kind},
            "geometry": {"type": "LineString", "coordinates": places},
        })
    text = json.dumps({"type": "FeatureCollection", "features": features})
    (folder / f"{name}.geojson").write_text(text)
    print(f"{name}: {len(features)} lines, {length / 1000:.0f} km")


def main() -> None:
    folder = Path(sys.argv[2])
    folder.mkdir(parents=True, exist_ok=True)
    with tarfile.open(sys.argv[1]) as archive:
        for member in archive:
            parts = member.name.split("/")
            if parts[-1] == "original.parquet":
                convert(parts[-2].split("_")[0], archive.extractfile(member).read(), folder)


main()
