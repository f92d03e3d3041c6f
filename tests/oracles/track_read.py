"""Flown tracks that `pilotage export --track` wrote, as other readers have them, beside the log itself.

Question: {"log": path of a ULog, "topic", "fix": name of the field of the kind of fix or null, "channel": [topic, field],
"files": {"kml", "gpx", "geojson", "csv": path}}. Answer: {"places": compared in each file, "colours": styles that lines of
the KML have, "differences": the first in words}. KML is read by the XML library of Python, GPX by gpxpy.
"""

import csv
import json
import math
import sys
import xml.etree.ElementTree as tree
from datetime import datetime

import gpxpy
from pyulog import ULog

KML = "{http://www.opengis.net/kml/2.2}"
GX = "{http://www.google.com/kml/ext/2.2}"


def seconds(text):
    return datetime.fromisoformat(text.replace("Z", "+00:00")).timestamp()


def number(text):
    return float(text) if text not in (None, "") else None


def kml(path):
    root = tree.parse(path).getroot()
    track = root.find(f".//{GX}Track")
    when = [seconds(w.text) for w in track.findall(f"{KML}when")]
    places = [tuple(map(float, c.text.split())) for c in track.findall(f"{GX}coord")]
    values = [number(v.text) for v in track.iter(f"{GX}value")]
    lines = [
        [tuple(map(float, c.split(","))) for c in line.text.split()]
        for line in root.findall(f".//{KML}LineString/{KML}coordinates")
    ]
    # The coloured pieces are the same way.
    joined = lines[0] + [place for line in lines[1:] for place in line[1:]]
    if joined != places:
        differences.append("the coloured line of the KML is another way")
    return [(t, lat, lon, h, v) for t, (lon, lat, h), v in zip(when, places, values, strict=True)]


def gpx(path):
    with open(path, encoding="utf-8") as file:
        points = gpxpy.parse(file).tracks[0].segments[0].points
    return [
        (p.time.timestamp(), p.latitude, p.longitude, p.elevation, number(p.extensions[0].text if p.extensions else None))
        for p in points
    ]


def geojson(path):
    with open(path, encoding="utf-8") as file:
        line = json.load(file)["features"][0]
    beside = line["properties"]["coordinateProperties"]
    (name,) = beside.keys() - {"times"}
    places = line["geometry"]["coordinates"]
    return [
        (seconds(t), lat, lon, h, v) for t, (lon, lat, h), v in zip(beside["times"], places, beside[name], strict=True)
    ]


def table(path):
    with open(path, newline="", encoding="utf-8") as file:
        _, *rows = csv.reader(file)
    return [(seconds(utc), float(lat), float(lon), float(h), number(v)) for _, utc, lat, lon, h, v in rows]


question = json.load(sys.stdin)
differences = []
log = ULog(question["log"])
data = log.get_dataset(question["topic"]).data
scale = {"lat": 1, "lon": 1, "alt": 1} if data["lat"].dtype.kind == "f" else {"lat": 1e7, "lon": 1e7, "alt": 1e3}
topic, field = question["channel"]
channel = log.get_dataset(topic).data
expected = []
for row, time in enumerate(data["timestamp"]):
    if question["fix"] and data[question["fix"]][row] < 2:
        continue
    before = [i for i, t in enumerate(channel["timestamp"]) if t <= time]
    value = float(channel[field][before[-1]]) if before else None
    place = [float(data[name][row]) / scale[name] for name in ("lat", "lon", "alt")]
    expected.append((int(time), *place, value))
readers = {"kml": kml, "gpx": gpx, "geojson": geojson, "csv": table}
for name, path in question["files"].items():
    found = readers[name](path)
    if len(found) != len(expected):
        differences.append(f"{name}: {len(found)} places, not {len(expected)}")
        continue
    start = found[0][0] - expected[0][0] / 1e6
    for ours, theirs in zip(found, expected):
        far = [abs(a - b) for a, b in zip(ours[1:4], theirs[1:4])]
        is_late = abs(ours[0] - start - theirs[0] / 1e6) > 2e-6
        is_other = ours[4] != theirs[4] and not (theirs[4] is not None and math.isnan(theirs[4]) and ours[4] is None)
        if max(far[:2]) > 1e-10 or far[2] > 1e-6 or is_late or is_other:
            differences.append(f"{name}: {ours}, not {theirs}")
            break
if question["fix"]:
    # The receiver's own date, which is late by what the receiver takes.
    utc = data["time_utc_usec"][-1] / 1e6
    if abs(utc - (start + expected[-1][0] / 1e6)) > 1:
        differences.append(f"the last place is at {start + expected[-1][0] / 1e6}, not {utc}")
with open(question["files"]["kml"], encoding="utf-8") as file:
    colours = {line.split("<")[0] for line in file.read().split("<styleUrl>#step")[1:]}
json.dump({"places": len(expected), "colours": len(colours), "differences": differences}, sys.stdout)
