"""Writes a PMTiles archive by Protomaps' own library and says what is in it.

Question: {"path": where to write}. Answer: {"zooms": [least, most], "tiles": [[z, x, y, id, bytes as
hex or null], ...]}: a sample of the tiles, some of which the archive leaves out.
"""

import io
import json
import random
import sys

from PIL import Image
from pmtiles.tile import Compression, TileType, zxy_to_tileid
from pmtiles.writer import write


def png(z, x, y):
    # A third of the tiles are equal to others: the archive stores those once.
    colour = (z * 9, x % 256 if x % 3 else 0, y % 256 if x % 3 else 0)
    buffer = io.BytesIO()
    Image.new("RGB", (8, 8), colour).save(buffer, "PNG")
    return buffer.getvalue()


def main():
    question = json.load(sys.stdin)
    chance = random.Random(3)
    stored = {}
    for z in range(9):
        for x in range(2**z):
            for y in range(2**z):
                if z < 4 or chance.random() < 0.3:
                    stored[zxy_to_tileid(z, x, y)] = (z, x, y)
    with write(question["path"]) as archive:
        for number in sorted(stored):
            archive.write_tile(number, png(*stored[number]))
        archive.finalize(
            {
                "tile_type": TileType.PNG,
                "tile_compression": Compression.NONE,
                "min_lon_e7": -1800000000,
                "min_lat_e7": -850000000,
                "max_lon_e7": 1800000000,
                "max_lat_e7": 850000000,
                "center_zoom": 0,
                "center_lon_e7": 0,
                "center_lat_e7": 0,
            },
            {},
        )
    tiles = []
    for _ in range(3000):
        z = chance.randint(0, 9)
        x, y = chance.randrange(2**z), chance.randrange(2**z)
        number = zxy_to_tileid(z, x, y)
        found = png(z, x, y).hex() if number in stored else None
        tiles.append([z, x, y, number, found])
    for z in range(10, 27):
        x, y = chance.randrange(2**z), chance.randrange(2**z)
        tiles.append([z, x, y, zxy_to_tileid(z, x, y), None])
    json.dump({"zooms": [0, 8], "tiles": tiles}, sys.stdout)


main()
