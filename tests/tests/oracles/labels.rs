//! Our labels in the readers of pycocotools and xmltodict.

use pilotage_core::exchange::labels::{LabelFormat, write_labels};
use pilotage_core::flight::files::{FileSet as _, ZipFiles};
use pilotage_core::mission::{FrameLabels, LabelBox};
use pilotage_tests::oracle::ask;
use serde::{Deserialize, Serialize};

const SIZE: (u32, u32) = (1000, 750);

#[derive(Serialize)]
struct Files {
    coco: String,
    voc: String,
}

/// Picture, name, left, top, right, bottom, whether it is hard to see, whether it is cut off.
type VocBox = (String, String, f64, f64, f64, f64, u8, u8);

#[derive(Deserialize)]
struct Read {
    coco: Vec<(String, String, f64, f64, f64, f64, f64)>,
    voc: Vec<VocBox>,
}

#[test]
fn other_readers_find_the_boxes_where_ours_are() {
    let label = |id, name: &str, corners| LabelBox::new(id, name, corners, SIZE).expect("a box");
    let mut pool = label(7, "Pool", [[0.0, 700.5], [33.25, 760.0]]);
    pool.difficult = true;
    let church = label(3, "Ärger & <Kirche>", [[10.25, 20.5], [110.75, 99.0]]);
    let frames = [FrameLabels {
        frame: "00001.jpg".to_owned(),
        size: SIZE,
        boxes: vec![church, pool],
        absent: vec![9],
        ..FrameLabels::default()
    }];
    let write = |format| write_labels(format, &frames, &[]).expect("written").bytes;
    let zip = ZipFiles::open(&write(LabelFormat::Voc)).expect("a zip");
    let voc = zip.read("Annotations/00001.xml").expect("an annotation");
    let text = |bytes| String::from_utf8(bytes).expect("text");
    let files = Files {
        coco: text(write(LabelFormat::Coco)),
        voc: text(voc),
    };
    let Some(read) = ask::<_, Read>("labels_read.py", &files) else {
        return;
    };
    let frame = || "00001.jpg".to_owned();
    let (church, pool) = ("Ärger & <Kirche>".to_owned(), "Pool".to_owned());
    let area = 100.5 * 78.5;
    assert_eq!(
        read.coco,
        [
            (frame(), church.clone(), 10.25, 20.5, 100.5, 78.5, area),
            (frame(), pool.clone(), 0.0, 700.5, 33.25, 49.5, 33.25 * 49.5),
        ]
    );
    // The first pixel is number one, and both ends belong to the box.
    assert_eq!(
        read.voc,
        [
            (frame(), church, 11.25, 21.5, 110.75, 99.0, 0, 0),
            (frame(), pool, 1.0, 701.5, 33.25, 750.0, 1, 1),
        ]
    );
}
