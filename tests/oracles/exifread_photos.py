"""What ExifRead and the standard library's XML reader see in photos, and photos written by Pillow.

Question: {"paths": [files], "folder": where photos are to be written}. Answer: {file: {"size": [width, height],
"taken": [seconds since 1970, fraction, whether in UTC], "place": [degrees north, degrees east, metres] or null,
"focal": millimetres or null, "focal_35", "orientation", "camera", "xmp": {property: text}}, ...}.
"""

import io
import json
import random
import sys
from datetime import datetime
from pathlib import Path
from xml.etree import ElementTree

import exifread
from PIL import ExifTags, Image, TiffImagePlugin

DJI = "http://www.dji.com/drone-dji/1.0/"
MARK = b"http://ns.adobe.com/xap/1.0/\x00"


def ratio(number, over):
    return TiffImagePlugin.IFDRational(number, over)


def write(folder, seed):
    """A photo with tags drawn by chance, some of them missing."""
    chance = random.Random(seed)
    exif = Image.Exif()
    base, gps, tags = ExifTags.Base, ExifTags.GPS, {}
    exif[base.Make], exif[base.Model] = "Maker", chance.choice(["Maker One", "Two"])
    exif[base.Orientation] = chance.randint(1, 8)
    exif[base.DateTime] = "2024:02:29 23:59:59"
    if chance.random() < 0.8:
        tags[base.DateTimeOriginal] = f"2024:0{chance.randint(1, 9)}:1{chance.randint(0, 9)} 12:34:5{chance.randint(0, 9)}"
        if chance.random() < 0.6:
            tags[base.SubsecTimeOriginal] = str(chance.randint(0, 999))
        if chance.random() < 0.6:
            tags[base.OffsetTimeOriginal] = chance.choice(["+02:00", "-07:30", "Z"])
    tags[base.FocalLength] = ratio(chance.randint(300, 900), 100)
    if chance.random() < 0.7:
        tags[base.FocalLengthIn35mmFilm] = chance.randint(18, 80)
    exif.get_ifd(ExifTags.IFD.Exif).update(tags)
    if chance.random() < 0.9:
        angle = lambda most: (ratio(chance.randint(0, most), 1), ratio(chance.randint(0, 59), 1), ratio(chance.randint(0, 599999), 10000))
        exif.get_ifd(ExifTags.IFD.GPSInfo).update(
            {
                gps.GPSLatitudeRef: chance.choice("NS"),
                gps.GPSLatitude: angle(89),
                gps.GPSLongitudeRef: chance.choice("EW"),
                gps.GPSLongitude: angle(179),
                gps.GPSAltitudeRef: chance.choice([b"\x00", b"\x01"]),
                gps.GPSAltitude: ratio(chance.randint(0, 90000), 100),
            }
        )
    out = io.BytesIO()
    size = (chance.randint(1, 90), chance.randint(1, 90))
    Image.new("RGB", size).save(out, "JPEG", exif=exif, progressive=chance.random() < 0.5)
    file = out.getvalue()
    names = ["GimbalRollDegree", "GimbalPitchDegree", "GimbalYawDegree", "RelativeAltitude", "FlightYawDegree"]
    words = "".join(f' drone-dji:{name}="{chance.uniform(-179, 179):+.2f}"' for name in names)
    xmp = (
        '<x:xmpmeta xmlns:x="adobe:ns:meta/"><rdf:RDF xmlns:rdf="http://www.w3.org/1999/02/22-rdf-syntax-ns#">'
        f'<rdf:Description rdf:about="" xmlns:drone-dji="{DJI}"{words}>'
        f"<drone-dji:FlightPitchDegree>{chance.uniform(-20, 20):.1f}</drone-dji:FlightPitchDegree>"
        "</rdf:Description></rdf:RDF></x:xmpmeta>"
    ).encode()
    if chance.random() < 0.8:
        segment = MARK + xmp
        file = file[:2] + b"\xff\xe1" + (len(segment) + 2).to_bytes(2, "big") + segment + file[2:]
    path = folder / f"{seed}.jpg"
    path.write_bytes(file)
    return path


def number(value):
    return value.num / value.den if value.den else None


def degrees(tags, name):
    values = tags.get(f"GPS GPS{name}")
    if values is None:
        return None
    whole, minutes, seconds = (number(v) for v in values.values)
    sign = -1 if str(tags.get(f"GPS GPS{name}Ref")) in ("S", "W") else 1
    return sign * (whole + minutes / 60 + seconds / 3600)


def properties(file):
    start = file.find(MARK)
    if start < 0:
        return {}
    start += len(MARK)
    end = file.index(b"</x:xmpmeta>", start) + len(b"</x:xmpmeta>")
    start = file.index(b"<x:xmpmeta", start)
    found = {}
    for element in ElementTree.fromstring(file[start:end]).iter():
        for name, text in [(element.tag, element.text or ""), *element.attrib.items()]:
            if name.startswith(f"{{{DJI}}}"):
                found[name.split("}")[1]] = text.strip()
    return found


def moment(text, fraction, offset):
    seconds = datetime.strptime(text + "+0000", "%Y:%m:%d %H:%M:%S%z").timestamp()
    if offset and offset != "Z":
        hours, minutes = offset[1:].split(":")
        seconds -= (int(hours) * 3600 + int(minutes) * 60) * (-1 if offset[0] == "-" else 1)
    return [int(seconds), float(f"0.{fraction}") if fraction else 0.0, bool(offset)]


def read(path):
    file = Path(path).read_bytes()
    tags = exifread.process_file(io.BytesIO(file), details=False)
    text = lambda name: str(tags[name]) if name in tags else None
    taken = [text(f"EXIF {name}TimeOriginal") for name in ("Date", "SubSec", "Offset")]
    if "EXIF DateTimeOriginal" not in tags:
        taken = [text("Image DateTime"), None, None]
    place = None
    if "GPS GPSLatitude" in tags:
        altitude = number(tags["GPS GPSAltitude"].values[0])
        below = tags["GPS GPSAltitudeRef"].values[0] in (1, b"\x01")
        place = [degrees(tags, "Latitude"), degrees(tags, "Longitude"), -altitude if below else altitude]
    first = lambda name: tags[name].values[0] if name in tags else None
    with Image.open(path) as picture:
        size = picture.size
    focal = first("EXIF FocalLength")
    return {
        "size": size,
        "taken": moment(*taken),
        "place": place,
        "focal": None if focal is None else number(focal),
        "focal_35": first("EXIF FocalLengthIn35mmFilm"),
        "orientation": first("Image Orientation"),
        "camera": [text("Image Make"), text("Image Model")],
        "xmp": properties(file),
    }


question = json.load(sys.stdin)
paths = question["paths"] + [str(write(Path(question["folder"]), seed)) for seed in range(60)]
json.dump({path: read(path) for path in paths}, sys.stdout)
