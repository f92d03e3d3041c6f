"""Routes and landmarks as other people's readers find them in our files.

Question: {"waypoints": text, "rally": text, "kml": text, "gpx": text}. Answer: "waypoints" and "rally", as
pymavlink's readers of missions and of rally points have them: [[sequence, current, frame, command, p1 ... p7,
autocontinue], ...]; "kml", the
placemarks of fastkml, once they pass the schema of KML 2.2: [{"name", "type", "coordinates"}, ...];
"gpx", as gpxpy has it: {"routes": [{"name", "points": [[latitude, longitude, elevation], ...]}],
"waypoints": [[name, latitude, longitude], ...]}.
"""

import json
import os
import sys
import tempfile

import fastkml
import gpxpy
import lxml.etree
from fastkml.utils import find_all
from fastkml.validator import validate

# Rally points have messages of their own since MAVLink 2.
os.environ["MAVLINK20"] = "1"
from pymavlink import mavwp  # noqa: E402


def waypoints(text, loader):
    with tempfile.NamedTemporaryFile("w", suffix=".waypoints") as file:
        file.write(text)
        file.flush()
        loader.load(file.name)
    items = [loader.wp(i) for i in range(loader.count())]
    return [
        [w.seq, w.current, w.frame, w.command]
        + [w.param1, w.param2, w.param3, w.param4, w.x, w.y, w.z]
        + [w.autocontinue]
        for w in items
    ]


def placemarks(text):
    data = text.encode()
    if not validate(element=lxml.etree.fromstring(data)):
        raise ValueError("the schema of KML 2.2 does not allow this")
    root = fastkml.KML.from_string(data, strict=True)
    found = []
    for placemark in find_all(root, of_type=fastkml.Placemark):
        geometry = placemark.geometry
        coordinates = getattr(geometry, "exterior", geometry).coords
        found.append(
            {
                "name": placemark.name,
                "type": geometry.geom_type,
                "coordinates": [list(c) for c in coordinates],
            }
        )
    return found


def gpx(text):
    parsed = gpxpy.parse(text)

    def place(point):
        return [point.latitude, point.longitude, point.elevation]

    return {
        "routes": [
            {"name": r.name, "points": [place(p) for p in r.points]} for r in parsed.routes
        ],
        "waypoints": [[w.name, w.latitude, w.longitude] for w in parsed.waypoints],
    }


question = json.load(sys.stdin)
json.dump(
    {
        "waypoints": waypoints(question["waypoints"], mavwp.MAVWPLoader()),
        "rally": waypoints(question["rally"], mavwp.MissionItemProtocol_Rally()),
        "kml": placemarks(question["kml"]),
        "gpx": gpx(question["gpx"]),
    },
    sys.stdout,
)
