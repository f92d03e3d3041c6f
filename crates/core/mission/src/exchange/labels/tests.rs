//! Labels written and read again, other people's files, broken ones.

use super::*;
use crate::mission::LabelBox;
use pilotage_base::files::{FileSet as _, ZipFiles};
use pilotage_base::frames::{GroundPoint, GroundRect};

const SIZE: (u32, u32) = (1000, 750);

fn landmarks() -> Vec<Landmark> {
    let bounds = GroundRect::centered(GroundPoint::new(0.0, 0.0), 20.0, 20.0);
    [(3, "Church & <yard>"), (7, "Pool")]
        .map(|(id, name)| Landmark::new(id, name, bounds))
        .to_vec()
}

fn labels() -> Vec<FrameLabels> {
    let label = |id, name: &str, a: [f64; 2], b: [f64; 2]| {
        LabelBox::new(id, name, [a, b], SIZE).expect("a box")
    };
    let mut hard = label(7, "Pool", [0.0, 700.5], [33.125, 760.0]);
    hard.difficult = true;
    vec![
        FrameLabels {
            flight: "River & back from 1.0 m, -2.5 m".to_owned(),
            frame: "00001.jpg".to_owned(),
            size: SIZE,
            boxes: vec![
                label(3, "Church & <yard>", [10.25, 20.5], [110.75, 99.0]),
                hard,
            ],
            ..FrameLabels::default()
        },
        FrameLabels {
            frame: "00002.jpg".to_owned(),
            size: SIZE,
            absent: vec![7],
            ..FrameLabels::default()
        },
    ]
}

fn read_back(format: LabelFormat, bytes: &[u8]) -> FoundLabels {
    if format == LabelFormat::Coco {
        return read_labels("labels.json", bytes).unwrap();
    }
    let zip = ZipFiles::open(bytes).unwrap();
    let mut all = FoundLabels::default();
    let mut names = zip.names();
    names.sort();
    for name in names {
        let one = read_labels(&name, &zip.read(&name).unwrap()).unwrap();
        all.add(one);
    }
    all
}

#[test]
fn labels_come_back_from_both_formats_as_they_were() {
    for format in [LabelFormat::Voc, LabelFormat::Coco] {
        let written = write_labels(format, &labels(), &landmarks()).unwrap();
        let (frames, notes) = read_back(format, &written.bytes).placed(&landmarks());
        assert_eq!(frames, labels(), "{format:?}");
        assert!(notes.is_empty(), "{notes:?}");
    }
}

#[test]
fn a_label_that_is_given_to_a_landmark_by_its_number_alone_is_told() {
    let written = write_labels(LabelFormat::Coco, &labels(), &landmarks()).unwrap();
    let mut renamed = landmarks();
    renamed[1].name = "Bridge".to_owned();
    let (frames, notes) = read_back(LabelFormat::Coco, &written.bytes).placed(&renamed);
    assert_eq!(frames[0].boxes.len(), 2);
    assert_eq!(
        notes,
        ["1 × “Pool” is taken for “Bridge”, which has its number"]
    );
}

#[test]
fn what_other_programs_write_beside_boxes_is_written_again() {
    let voc = "<annotation><folder>a &amp; b</folder><filename>x.png</filename>\
        <size><width>64</width><height>48</height><depth>3</depth></size><segmented>0</segmented>\
        <object><name>pool</name><pose>Left</pose><bndbox><xmax>20</xmax><xmin>11</xmin>\
        <ymin>1</ymin><ymax>9.5</ymax></bndbox></object></annotation>";
    let (frames, _) = read_labels("x.xml", voc.as_bytes())
        .unwrap()
        .placed(&landmarks());
    assert_eq!(frames[0].boxes[0].min, [10.0, 0.0], "pixel 11 begins at 10");
    assert_eq!(frames[0].boxes[0].max, [20.0, 9.5]);
    let bytes = write_labels(LabelFormat::Voc, &frames, &landmarks())
        .unwrap()
        .bytes;
    let zip = ZipFiles::open(&bytes).unwrap();
    let text = String::from_utf8(zip.read("Annotations/x.xml").unwrap()).unwrap();
    let other = write_labels(LabelFormat::Coco, &frames, &landmarks()).unwrap();
    assert_eq!(
        other.notes[1],
        "1 × `folder`, 1 × `pose`, 1 × `segmented` of another format are left out: COCO has no place for them"
    );
    for kept in [
        "<folder>a &amp; b</folder>",
        "<segmented>0</segmented>",
        "<pose>Left</pose>",
    ] {
        assert!(text.contains(kept), "{kept} in {text}");
    }

    let coco = r#"{ "info": { "year": 2020 }, "licenses": [],
        "images": [{ "id": 5, "file_name": "x.png", "width": 64, "height": 48, "license": 2 }],
        "categories": [{ "id": 9, "name": "Pool" }, { "id": 1, "name": "car" }],
        "annotations": [
          { "id": 1, "image_id": 5, "category_id": 9, "bbox": [10, 0, 10, 9.5], "score": 0.5 },
          { "id": 2, "image_id": 5, "category_id": 1, "bbox": [1, 1, 10, 10] }] }"#;
    let (frames, notes) = read_labels("c.json", coco.as_bytes())
        .unwrap()
        .placed(&landmarks());
    assert_eq!(frames[0].boxes.len(), 1);
    assert_eq!(frames[0].boxes[0].landmark, 7);
    assert!(notes.iter().any(|n| n.contains("`info`")), "{notes:?}");
    assert!(notes.iter().any(|n| n.contains("“car”")), "{notes:?}");
    let bytes = write_labels(LabelFormat::Coco, &frames, &landmarks())
        .unwrap()
        .bytes;
    let again: serde_json::Value = serde_json::from_slice(&bytes).unwrap();
    assert_eq!(again["images"][0]["license"], 2);
    assert_eq!(again["annotations"][0]["score"], 0.5);
}

#[test]
fn labels_without_an_area_are_left_out_and_told_and_an_outline_stands_in_for_a_box() {
    let voc = "<annotation><filename>x.png</filename><size><width>64</width><height>48</height></size>\
        <object><name>pool</name><bndbox><xmin>11</xmin><ymin>1</ymin><xmax>10</xmax><ymax>9</ymax></bndbox></object>\
        <object><name>pool</name><bndbox><xmin>91</xmin><ymin>1</ymin><xmax>99</xmax><ymax>9</ymax></bndbox></object>\
        <object><name>pool</name><bndbox><xmin>11</xmin><ymin>1</ymin><xmax>20</xmax><ymax>9</ymax></bndbox></object>\
        </annotation>";
    let found = read_labels("x.xml", voc.as_bytes()).unwrap();
    assert_eq!(found.frames[0].boxes.len(), 1);
    let told = [
        "x.xml: 1 × box outside of its picture is left out",
        "x.xml: 1 × box without an area is left out",
    ];
    assert_eq!(found.notes, told);
    let coco = r#"{ "images": [{ "id": 5, "file_name": "x.png", "width": 64, "height": 48 }],
        "categories": [{ "id": 9, "name": "Pool" }],
        "annotations": [
          { "image_id": 5, "category_id": 9, "bbox": [10, 10, 0, 9.5] },
          { "image_id": 5, "category_id": 9, "bbox": [10, 10, 4, 0] },
          { "image_id": 5, "category_id": 9, "segmentation": { "counts": "abc", "size": [48, 64] } },
          { "image_id": 5, "category_id": 9, "segmentation": [[10, 20, 30, 12.5, 25, 40], [8, 30, 9, 31, 9, 30]] },
          { "image_id": 5, "category_id": 9, "bbox": [], "segmentation": [[1, 2, 3, 2, 3, 4]] },
          { "image_id": 5, "category_id": 9, "bbox": [10, 0, 10, 9.5] }] }"#;
    let found = read_labels("c.json", coco.as_bytes()).unwrap();
    let boxes: Vec<_> = found.frames[0]
        .boxes
        .iter()
        .map(|b| (b.min, b.max))
        .collect();
    let right = [
        ([8.0, 12.5], [30.0, 40.0]),
        ([1.0, 2.0], [3.0, 4.0]),
        ([10.0, 0.0], [20.0, 9.5]),
    ];
    assert_eq!(boxes, right);
    let told = [
        "2 × box without an area is left out",
        "1 × label without a box or an outline is left out",
    ];
    assert_eq!(found.notes, told);
}

#[test]
fn a_box_that_reaches_out_of_its_picture_is_cut_and_says_so() {
    let coco = r#"{ "images": [{ "id": 5, "file_name": "x.png", "width": 640, "height": 480 }],
        "categories": [{ "id": 9, "name": "Pool" }, { "id": 3, "name": "Church & <yard>" }],
        "annotations": [
          { "image_id": 5, "category_id": 9, "bbox": [-60, 100, 120, 80], "truncated": 0 },
          { "image_id": 5, "category_id": 3, "bbox": [0, 400, 120, 80] }] }"#;
    let found = read_labels("c.json", coco.as_bytes()).unwrap();
    let [cut, at_the_edge] = &found.frames[0].boxes[..] else {
        panic!("{found:?}");
    };
    // Its middle is at 0, that of what is left at 30.
    assert_eq!((cut.min[0], cut.max[0], cut.truncated), (0.0, 60.0, true));
    assert!(!at_the_edge.truncated, "the file does not say so");
    let voc = "<annotation><filename>x.png</filename><size><width>64</width><height>48</height></size>\
        <object><name>pool</name><truncated>0</truncated><bndbox><xmin>11</xmin><ymin>1</ymin>\
        <xmax>20</xmax><ymax>52</ymax></bndbox></object></annotation>";
    let found = read_labels("x.xml", voc.as_bytes()).unwrap();
    assert!(found.frames[0].boxes[0].truncated);
}

#[test]
fn pictures_of_one_name_in_other_folders_have_annotations_of_their_own() {
    let [church, _] = &labels()[..] else {
        panic!("two pictures");
    };
    let of = |frame: &str, flight: &str| FrameLabels {
        frame: frame.to_owned(),
        flight: flight.to_owned(),
        ..church.clone()
    };
    let frames = [
        of("100MEDIA/DJI_0001.JPG", ""),
        of("101MEDIA/DJI_0001.JPG", ""),
        of("101MEDIA/DJI_0001.JPG", "another flight"),
        of("dji_0001.png", ""),
    ];
    let written = write_labels(LabelFormat::Voc, &frames, &landmarks()).unwrap();
    let mut names = ZipFiles::open(&written.bytes).unwrap().names();
    names.sort();
    let right = ["DJI_0001-2", "DJI_0001-3", "DJI_0001", "dji_0001-4"];
    assert_eq!(names, right.map(|name| format!("Annotations/{name}.xml")));
    assert!(written.notes[1].starts_with("3 annotations have a number"));
    let (mut read, _) = read_back(LabelFormat::Voc, &written.bytes).placed(&landmarks());
    read.sort_by(|a, b| (&a.frame, &a.flight).cmp(&(&b.frame, &b.flight)));
    assert_eq!(read, frames);
}

#[test]
fn flags_of_coco_are_numbers_or_true_and_false() {
    let coco = r#"{ "images": [{ "id": 5, "file_name": "x.png", "width": 640, "height": 480 }],
        "categories": [{ "id": 9, "name": "Pool" }],
        "annotations": [
          { "image_id": 5, "category_id": 9, "bbox": [1, 1, 12, 8], "iscrowd": false, "difficult": true },
          { "image_id": 5, "category_id": 9, "bbox": [1, 1, 12, 8], "iscrowd": true },
          { "image_id": 5, "category_id": 9, "bbox": [1, 1, 12, 8], "iscrowd": 1 }] }"#;
    let found = read_labels("c.json", coco.as_bytes()).unwrap();
    assert_eq!(found.frames[0].boxes.len(), 1);
    assert!(found.frames[0].boxes[0].difficult);
    assert_eq!(found.notes, ["2 crowds are left out"]);
}

#[test]
fn broken_files_are_named_with_the_place_and_never_panic() {
    let cause =
        |name: &str, text: &str| read_labels(name, text.as_bytes()).unwrap_err().to_string();
    let voc = "<annotation>\n<filename>x</filename>\n<size><width>64</width>\
        <height>48</height></size>\n<object><name>a</name>\n<bndbox><xmin>q</xmin></bndbox></object></annotation>";
    let told = cause("x.xml", voc);
    assert!(
        told.starts_with("x.xml, line 5") && told.contains("xmin"),
        "{told}"
    );
    let coco = "{ \"images\": [],\n \"categories\": [],\n \"annotations\": [\n{ \"image_id\": 1, \"category_id\": 2, \"bbox\": [0,0,1,1] }] }";
    let told = cause("c.json", coco);
    assert!(
        told.starts_with("c.json, line 4") && told.contains("no image 1"),
        "{told}"
    );
    assert!(cause("n.txt", "dear").contains("neither"));
    for format in [LabelFormat::Voc, LabelFormat::Coco] {
        let written = write_labels(format, &labels(), &landmarks()).unwrap().bytes;
        let text = match format {
            LabelFormat::Coco => written,
            LabelFormat::Voc => {
                let zip = ZipFiles::open(&written).unwrap();
                zip.read("Annotations/00001.xml").unwrap()
            }
        };
        for place in 0..text.len() {
            let _ = read_labels("cut", &text[..place]);
            let mut flipped = text.clone();
            flipped[place] ^= 0x15;
            let _ = read_labels("flipped", &flipped);
        }
    }
}
