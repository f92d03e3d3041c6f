//! Cascades that we wrote, in OpenCV's hands.

use std::fs;

use pilotage_core::landmark::cascade::Cascade;
use pilotage_tests::data::shared;
use pilotage_tests::oracle::ask;
use serde::{Deserialize, Serialize};

#[derive(Serialize)]
struct Scans {
    cases: Vec<Scan>,
    repeat: usize,
}

#[derive(Serialize)]
struct Scan {
    image: String,
    xml: String,
    scale_step: f64,
}

#[derive(Deserialize)]
struct Found {
    rectangles: Vec<[i32; 4]>,
}

#[test]
fn opencv_finds_with_what_we_wrote_what_it_finds_with_the_original() {
    let Some(folder) = shared("opencv_cascades") else {
        return;
    };
    let (mut titles, mut cases) = (Vec::new(), Vec::new());
    let image = folder.join("images/astronaut.png");
    for kind in ["haarcascades", "lbpcascades"] {
        for entry in fs::read_dir(folder.join(kind)).unwrap() {
            let path = entry.unwrap().path();
            let text = fs::read_to_string(&path).unwrap();
            let cascade = Cascade::read(kind, &text).unwrap();
            let former = cascade.to_former_xml().ok();
            let original = path.to_string_lossy().into_owned();
            let forms = [Some(original), Some(cascade.to_xml()), former];
            for (form, xml) in ["original", "present", "former"].iter().zip(forms) {
                titles.push(format!("{} {form}", path.display()));
                cases.push(Scan {
                    image: image.to_string_lossy().into_owned(),
                    xml: xml.unwrap_or_default(),
                    scale_step: 1.2,
                });
            }
        }
    }
    // Where there is no former layout, there is nothing to ask.
    let kept: Vec<bool> = cases.iter().map(|c| !c.xml.is_empty()).collect();
    let cases = cases.into_iter().filter(|c| !c.xml.is_empty()).collect();
    let Some(answer) = ask::<_, Vec<Found>>("opencv_cascades.py", &Scans { cases, repeat: 1 })
    else {
        return;
    };
    let mut answers = answer.into_iter();
    let (mut original, mut rectangles, mut compared) = (Vec::new(), 0, 0);
    for (title, kept) in titles.iter().zip(kept) {
        let Some(found) = kept.then(|| answers.next()).flatten() else {
            continue;
        };
        if title.ends_with("original") {
            rectangles += found.rectangles.len();
            original = found.rectangles;
        } else {
            assert_eq!(found.rectangles, original, "{title}");
            compared += 1;
        }
    }
    println!("{compared} files that we wrote find the same of {rectangles} rectangles");
    assert!(
        compared == 22 + 17 && rectangles > 500,
        "{compared} {rectangles}"
    );
}
