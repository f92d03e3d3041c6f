"""Places of files of routes and areas, anywhere on the globe, by pyproj.

Question: [{"asked": [[latitude, longitude], ...], "files": {format: bytes as hexadecimal digits}}], where a
file has the places as the way-points of one route; KML and GeoJSON also have areas of three places each,
one after the other. Formats: plan, waypoints, kml, kmz, geojson, gpx, csv, litchi, wpml. Answer: for each
case {format: [farthest distance of a way-point from its place, of a corner from its], ...}, metres on the
ellipsoid; -1 where there are no areas. Every file is read here by nothing of ours.
"""

import csv
import io
import json
import sys
import xml.etree.ElementTree as ElementTree
import zipfile

import numpy as np
from pyproj import Geod

GEOD = Geod(ellps="WGS84")
KML = "{http://www.opengis.net/kml/2.2}"


def pairs(text):
    """Places of KML's coordinates, as [latitude, longitude]."""
    return [[float(n) for n in part.split(",")[1::-1]] for part in text.split()]


def plan(data):
    items = json.loads(data)["mission"]["items"]
    return [i["params"][4:6] for i in items if i["command"] == 16], []


def waypoints(data):
    rows = [line.split("\t") for line in data.decode().splitlines()[2:]]
    return [[float(r[8]), float(r[9])] for r in rows if r[3] == "16"], []


def kml(data):
    root = ElementTree.fromstring(data)
    line = pairs(root.find(f".//{KML}LineString/{KML}coordinates").text)
    areas = root.iterfind(f".//{KML}outerBoundaryIs//{KML}coordinates")
    return line, [pairs(area.text)[:-1] for area in areas]


def kmz(data):
    return kml(zipfile.ZipFile(io.BytesIO(data)).read("doc.kml"))


def geojson(data):
    line, areas = None, []
    for feature in json.loads(data)["features"]:
        geometry = feature["geometry"]
        if geometry["type"] == "LineString":
            line = [c[1::-1] for c in geometry["coordinates"]]
        else:
            areas.append([c[1::-1] for c in geometry["coordinates"][0][:-1]])
    return line, areas


def gpx(data):
    points = ElementTree.fromstring(data).iter("{http://www.topografix.com/GPX/1/1}rtept")
    return [[float(p.get("lat")), float(p.get("lon"))] for p in points], []


def table(latitude, longitude):
    def read(data):
        rows = csv.DictReader(io.StringIO(data.decode()))
        return [[float(r[latitude]), float(r[longitude])] for r in rows], []

    return read


def wpml(data):
    archive = zipfile.ZipFile(io.BytesIO(data))
    found = []
    for name in ("wpmz/waylines.wpml", "wpmz/template.kml"):
        root = ElementTree.fromstring(archive.read(name))
        points = root.iterfind(f".//{KML}Point/{KML}coordinates")
        found.append([pairs(p.text)[0] for p in points])
    if found[0] != found[1]:
        raise ValueError("the two files of DJI differ")
    return found[0], []


READERS = {
    "plan": plan,
    "waypoints": waypoints,
    "kml": kml,
    "kmz": kmz,
    "geojson": geojson,
    "gpx": gpx,
    "csv": table("latitude_deg", "longitude_deg"),
    "litchi": table("latitude", "longitude"),
    "wpml": wpml,
}


def farthest(found, asked):
    found, asked = np.array(found, dtype=float), np.array(asked, dtype=float)
    if found.shape != asked.shape:
        raise ValueError(f"{found.shape} places for {asked.shape}")
    _, _, metres = GEOD.inv(found[:, 1], found[:, 0], asked[:, 1], asked[:, 0])
    return float(np.max(metres))


def distances(case):
    asked, answer = case["asked"], {}
    for name, digits in case["files"].items():
        line, areas = READERS[name](bytes.fromhex(digits))
        corners = [corner for area in areas for corner in area]
        of_corners = farthest(corners, asked[: len(corners)]) if corners else -1.0
        answer[name] = [farthest(line, asked), of_corners]
    return answer


if __name__ == "__main__":
    json.dump([distances(case) for case in json.load(sys.stdin)], sys.stdout)
