//! `pilotage register` as a user calls it.
#![expect(
    clippy::unwrap_used,
    reason = "a test stops where something is missing"
)]

use std::process::{Command, Output};

use pilotage_core::raster::{Picture, encode_png};
use pilotage_tests::data::shared;
use serde_json::Value;

use super::folder::Folder;

fn register(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_pilotage"))
        .arg("register")
        .args(arguments)
        .output()
        .unwrap()
}

/// A photo over the satellite map of another date, of which nothing but the focal length is told, is found on the
/// whole map with its place, and drawn over it; one that the map does not show is refused with a reason.
#[test]
fn a_photo_is_laid_anywhere_on_a_map_of_another_date_or_refused_with_a_reason() {
    let Some(folder) = shared("fengyuan") else {
        return;
    };
    let file = |name: &str| folder.join(name).to_string_lossy().into_owned();
    let out = std::env::temp_dir().join(format!("pilotage-register-{}", std::process::id()));
    let out_name = out.to_string_lossy().into_owned();
    let (map, photo) = (file("map.jpg"), file("frames/DJI_001.jpg"));
    let said = register(&[
        &map,
        &photo,
        "--focal",
        "728",
        "--height",
        "120",
        "--json",
        "--overlay",
        &out_name,
    ]);
    assert!(said.status.success(), "{said:?}");
    let answers: Value = serde_json::from_slice(&said.stdout).unwrap();
    let place = &answers[0]["centre_lat_lon"];
    // By its receiver, and by how far the camera looks ahead.
    let (latitude, longitude) = (place[0].as_f64().unwrap(), place[1].as_f64().unwrap());
    let north = (latitude - 24.261_970) * 110_760.0;
    let east = (longitude - 120.720_301) * 101_500.0;
    assert!(north.hypot(east) < 10.0, "{latitude} {longitude}");
    assert!(answers[0]["probability"].as_f64().unwrap() > 0.95);
    assert!(out.join("DJI_001.overlay.png").metadata().unwrap().len() > 100_000);
    std::fs::remove_dir_all(&out).unwrap();

    let Some(elsewhere) = shared("adm2014/frames/F1_001.jpg") else {
        return;
    };
    let elsewhere = elsewhere.to_string_lossy().into_owned();
    let said = register(&[&map, &elsewhere, "--focal", "500", "--height", "115"]);
    let text = String::from_utf8(said.stdout).unwrap();
    assert!(text.contains("not laid: "), "{text}");

    let said = register(&[&map, &photo, "--at", "somewhere"]);
    let text = String::from_utf8(said.stderr).unwrap();
    assert!(
        !said.status.success() && text.contains("--at: \"somewhere\""),
        "{text}"
    );
}

/// A photo that cannot be read keeps no other from being laid; one that is not there at all does.
#[test]
fn photos_that_cannot_be_read_are_told_in_their_order_and_lost_ones_before_the_work() {
    let folder = Folder::new("register-broken");
    let map = Picture::from_fn(200, 100, |x, y| [x as u8, y as u8, 90]);
    folder.write("map.png", encode_png(&map).unwrap());
    folder.write("map.pgw", "0.5\n0\n0\n-0.5\n0.25\n-0.25\n");
    folder.write("broken.jpg", b"no picture");
    let grey = Picture::filled(40, 30, [90; 3]);
    folder.write("grey.png", encode_png(&grey).unwrap());
    let of = |photos: &[&str]| {
        let known = ["--height", "20", "--heading", "0", "--focal", "40"];
        folder.run(&[&["register", "map.png"], photos, &known].concat())
    };
    let said = of(&["grey.png", "broken.jpg", "grey.png"]).unwrap();
    let names: Vec<&str> = (said.lines())
        .filter(|line| !line.starts_with(' '))
        .filter_map(|line| line.split_once(" (").map(|(name, _)| name))
        .collect();
    assert_eq!(names, ["grey.png", "broken.jpg", "grey.png"], "{said}");
    assert!(said.contains("not laid: broken.jpg: "), "{said}");
    assert!(said.contains("0 of 3 photos were laid"), "{said}");
    let lost = of(&["grey.png", "lost.jpg"]).unwrap_err();
    assert!(lost.contains("lost.jpg: "), "{lost}");
}

/// A picture of a photo takes no photo's place, and photos of one name have one each.
#[test]
fn no_photo_is_written_over_and_two_of_one_name_have_two_pictures() {
    let folder = Folder::new("register-overlay");
    // Grey blocks of six pixels, no two areas alike.
    let grey = |x: usize, y: usize| {
        let block = (x / 6 * 7919 + y / 6 * 104_729) as u64;
        let mixed = (block ^ (block >> 7)).wrapping_mul(0x9e37_79b9_7f4a_7c15);
        [(mixed >> 56) as u8; 3]
    };
    let map = Picture::from_fn(400, 300, grey);
    folder.write("map.png", encode_png(&map).unwrap());
    folder.write("map.pgw", "0.5\n0\n0\n-0.5\n0.25\n-0.25\n");
    let photo = |left: usize, top: usize| {
        encode_png(&Picture::from_fn(160, 120, |x, y| grey(left + x, top + y))).unwrap()
    };
    let (first, second) = (photo(60, 60), photo(200, 120));
    std::fs::create_dir_all(folder.0.join("other")).unwrap();
    folder.write("P.png", &first);
    folder.write("other/P.png", &second);
    let known = ["--focal", "300", "--height", "150", "--heading", "0"];
    let photos = ["register", "map.png", "P.png", "other/P.png"];
    let said = folder.run(&[&photos[..], &known, &["--overlay", "."]].concat());
    let said = said.unwrap();
    assert!(said.contains("2 of 2 photos were laid"), "{said}");
    assert!(said.contains("other/P.png ("), "{said}");
    let read = |name: &str| std::fs::read(folder.0.join(name)).unwrap();
    assert!(read("P.png") == first && read("other/P.png") == second);
    assert_ne!(read("P.overlay.png"), read("P.overlay-2.png"));
}
