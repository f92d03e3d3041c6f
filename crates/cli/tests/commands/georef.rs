//! A picture put on the ground from the command line.

use std::fmt::Write as _;
use std::process::Output;

use pilotage_core::raster::{Picture, encode_png};

use super::folder::Folder;

/// Six points of a picture with half-metre pixels in UTM zone 15 north, one of them 3 m off.
const POINTS: &str = "#CRS: EPSG:32615
mapX,mapY,sourceX,sourceY,enable,dX,dY,residual
570005,5189995,10,-10,1,0,0,0
570095,5189995,190,-10,1,0,0,0
570095,5189955,190,-90,1,0,0,0
570005,5189955,10,-90,1,0,0,0
570050,5189975,100,-50,1,0,0,0
570030,5189983,60,-40,0,0,0,0
";

fn georef(folder: &Folder, more: &[&str]) -> Output {
    let points = ["map", "georef", "area.png", "--points", "area.points"];
    folder.call(&[&points, more].concat())
}

#[test]
fn points_make_a_world_file_that_puts_the_picture_where_they_are() {
    let folder = Folder::new("georef");
    let picture = Picture::from_fn(200, 100, |x, y| [x as u8, y as u8, 90]);
    folder.write("area.png", encode_png(&picture).unwrap());
    folder.write("area.points", POINTS);

    let made = georef(&folder, &["--kind", "affine", "--out", "area.pgw"]);
    assert!(
        made.status.success(),
        "{}",
        String::from_utf8_lossy(&made.stderr)
    );
    let summary: serde_json::Value = serde_json::from_slice(&made.stdout).unwrap();
    assert_eq!(summary["epsg"], 32_615);
    assert!(summary["rms_m"].as_f64().unwrap() < 1e-6, "{summary}");
    assert!(summary["rms_left_out_m"].as_f64().unwrap() < 1e-6);
    // The point that is off: 30 m east and 20 m south of the corner by the fit.
    let off = &summary["points"][5];
    assert_eq!(off["enabled"], false);
    assert!(
        // Metres of the ground, of which those of the zone are 0.9997.
        (off["residual_north_m"].as_f64().unwrap() + 3.001).abs() < 5e-4,
        "{off}"
    );
    assert!((off["residual_px"].as_f64().unwrap() - 6.0).abs() < 1e-6);

    let world: Vec<f64> = std::fs::read_to_string(folder.0.join("area.pgw"))
        .unwrap()
        .lines()
        .map(|line| line.parse().unwrap())
        .collect();
    let wanted = [0.5, 0.0, 0.0, -0.5, 570_000.25, 5_189_999.75];
    for (found, wanted) in world.iter().zip(wanted) {
        assert!((found - wanted).abs() < 1e-6, "{world:?}");
    }
    let info = folder.call(&["map", "info", "area.png"]);
    let info: serde_json::Value = serde_json::from_slice(&info.stdout).unwrap();
    for corner in 0..4 {
        for axis in 0..2 {
            let of = |v: &serde_json::Value| v["corners_lat_lon"][corner][axis].as_f64().unwrap();
            assert!((of(&info) - of(&summary)).abs() < 1e-9, "{info} {summary}");
        }
    }

    let refused = georef(&folder, &["--kind", "projective", "--out", "b.pgw"]);
    let why = String::from_utf8_lossy(&refused.stderr).into_owned();
    assert!(!refused.status.success() && why.contains("affine"), "{why}");
}

/// Four corners, a pixel a unit, of which one lies 10 units off: 2.5 units of RMS, and 10 of each point left out.
#[test]
fn errors_are_told_in_metres_of_the_ground_whatever_the_unit_of_the_plane() {
    let folder = Folder::new("georef-units");
    let picture = Picture::filled(200, 100, [9, 9, 9]);
    folder.write("area.png", encode_png(&picture).unwrap());
    // A unit of Web Mercator at 60° north is half a metre, that of EPSG:2263 a foot of the survey.
    for (code, x, y, unit) in [
        (3857, 1_200_000.0, 8_399_737.0, 0.5008),
        (2263, 987_000.0, 200_000.0, 0.3048),
    ] {
        let mut text = format!("#CRS: EPSG:{code}\nmapX,mapY,sourceX,sourceY,enable\n");
        for (column, row, off) in [
            (10, 10, 0.0),
            (190, 10, 0.0),
            (190, 90, 10.0),
            (10, 90, 0.0),
        ] {
            let (x, y) = (x + f64::from(column) + off, y - f64::from(row));
            writeln!(text, "{x},{y},{column},-{row},1").unwrap();
        }
        folder.write("area.points", text);
        let made = georef(&folder, &[]);
        let said = String::from_utf8_lossy(&made.stderr);
        assert!(made.status.success(), "{said}");
        let summary: serde_json::Value = serde_json::from_slice(&made.stdout).unwrap();
        for (name, units) in [
            ("metres_per_unit", 1.0),
            ("rms_m", 2.5),
            ("rms_left_out_m", 10.0),
        ] {
            let share = summary[name].as_f64().unwrap() / (units * unit);
            assert!(
                (share - 1.0).abs() < 2e-3,
                "{code}, {name}: {share}, {summary}"
            );
        }
        let first = &summary["points"][0];
        assert_eq!(first["x"].as_f64(), Some(x + 10.0));
    }
}
