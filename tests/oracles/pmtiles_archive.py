"""Writes a PMTiles archive by Protomaps' own library and says what is in it.

Question: {"path": where to write, "format": "png" or "jpeg"}. Answer: {"zooms": [least, most], "leaves":
bytes of leaf directories, "corners": [south, west, north, east] in degrees, "attribution": as it stands in
the archive, "tiles": [[z, x, y, id, bytes as hex or null, pixels as hex or null], ...]}: a sample of the
tiles, some of which the archive leaves out, as Protomaps' own reader gives them and Pillow decodes them.
"""

import io
import json
import random
import sys

from PIL import Image
from pmtiles.reader import MmapSource, Reader, all_tiles
from pmtiles.tile import Compression, TileType, zxy_to_tileid
from pmtiles.writer import write


ATTRIBUTION = '<a href="https://example.org">&copy; Map makers</a> &amp; others'
SIDE = 8


def picture(kind, z, x, y):
    # A third of the tiles are equal to others: the archive stores those once.
    colour = (z * 9, x % 256 if x % 3 else 0, y % 256 if x % 3 else 0)
    buffer = io.BytesIO()
    image = Image.new("RGB", (SIDE, SIDE), colour)
    if kind == "png":
        # Not of one colour, so that a turned or mirrored tile would show.
        image.putpixel((1, 2), (255, 0, 128))
    image.save(buffer, kind.upper(), quality=95, subsampling=0)
    return buffer.getvalue()


def main():
    question = json.load(sys.stdin)
    kind = question["format"]
    chance = random.Random(3)
    stored = {}
    for z in range(9):
        for x in range(2**z):
            for y in range(2**z):
                if z < 4 or chance.random() < 0.3:
                    stored[zxy_to_tileid(z, x, y)] = (z, x, y)
    with write(question["path"]) as archive:
        for number in sorted(stored):
            archive.write_tile(number, picture(kind, *stored[number]))
        archive.finalize(
            {
                "tile_type": TileType.PNG if kind == "png" else TileType.JPEG,
                "tile_compression": Compression.NONE,
                "min_lon_e7": -1799000000,
                "min_lat_e7": -850000000,
                "max_lon_e7": 1798000000,
                "max_lat_e7": 841234567,
                "center_zoom": 0,
                "center_lon_e7": 0,
                "center_lat_e7": 0,
            },
            {"attribution": ATTRIBUTION, "name": "A map"},
        )
    file = open(question["path"], "rb")
    source = MmapSource(file)
    reader = Reader(source)
    header = reader.header()
    # All at once: its reader unpacks the directories anew for every tile.
    read = dict(all_tiles(source))

    def row(z, x, y):
        found = read.get((z, x, y))
        pixels = found and Image.open(io.BytesIO(found)).convert("RGB").tobytes().hex()
        return [z, x, y, zxy_to_tileid(z, x, y), found and found.hex(), pixels]

    tiles = []
    for _ in range(3000):
        z = chance.randint(0, 9)
        x, y = chance.randrange(2**z), chance.randrange(2**z)
        tiles.append(row(z, x, y))
    for z in range(10, 27):
        x, y = chance.randrange(2**z), chance.randrange(2**z)
        tiles.append([z, x, y, zxy_to_tileid(z, x, y), None, None])
    corners = ["min_lat_e7", "min_lon_e7", "max_lat_e7", "max_lon_e7"]
    answer = {
        "zooms": [header["min_zoom"], header["max_zoom"]],
        "leaves": header["leaf_directory_length"],
        "corners": [header[corner] / 1e7 for corner in corners],
        "attribution": reader.metadata()["attribution"],
        "tiles": tiles,
    }
    json.dump(answer, sys.stdout)


main()
