//! `pilotage register` as a user calls it.
#![expect(
    clippy::unwrap_used,
    reason = "a test stops where something is missing"
)]

use std::process::{Command, Output};

use pilotage_tests::data::shared;
use serde_json::Value;

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
    assert!(out.join("DJI_001.png").metadata().unwrap().len() > 100_000);
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
