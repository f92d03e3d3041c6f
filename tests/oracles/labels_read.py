"""Labels as other people's readers find them in our files.

Question: {"coco": text, "voc": text of one annotation}. Answer: "coco", as pycocotools indexes it:
[[file name, category, x, y, width, height, area], ...]; "voc", as xmltodict parses it, by the rules of
the VOC development kit: [[file name, object, xmin, ymin, xmax, ymax, difficult, truncated], ...].
"""

import contextlib
import json
import sys
import tempfile

import xmltodict
from pycocotools.coco import COCO


def coco(text):
    with tempfile.NamedTemporaryFile("w", suffix=".json") as file:
        file.write(text)
        file.flush()
        with contextlib.redirect_stdout(sys.stderr):
            data = COCO(file.name)
    rows = []
    for annotation in data.loadAnns(data.getAnnIds(iscrowd=False)):
        image = data.loadImgs(annotation["image_id"])[0]
        category = data.loadCats(annotation["category_id"])[0]
        row = [image["file_name"], category["name"], *annotation["bbox"], annotation["area"]]
        rows.append(row)
    return rows


def voc(text):
    annotation = xmltodict.parse(text, force_list=("object",))["annotation"]
    rows = []
    for one in annotation["object"]:
        box = [float(one["bndbox"][edge]) for edge in ("xmin", "ymin", "xmax", "ymax")]
        flags = [int(one["difficult"]), int(one["truncated"])]
        rows.append([annotation["filename"], one["name"], *box, *flags])
    return rows


question = json.load(sys.stdin)
json.dump({"coco": coco(question["coco"]), "voc": voc(question["voc"])}, sys.stdout)
