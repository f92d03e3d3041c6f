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

/// A photo that says nothing is looked for where a table in its folder says it was taken, in the forms of several makers, and
/// nowhere else; what people say goes before the table.
#[test]
fn a_photo_is_laid_where_the_table_in_its_folder_says_that_it_was_taken() {
    let folder = Folder::new("register-table");
    // Grey blocks of six pixels, no two areas alike.
    let grey = |x: usize, y: usize| {
        let block = (x / 6 * 7919 + y / 6 * 104_729) as u64;
        let mixed = (block ^ (block >> 7)).wrapping_mul(0x9e37_79b9_7f4a_7c15);
        [(mixed >> 56) as u8; 3]
    };
    // Half a metre a pixel where a degree has 111 170 metres north and 76 057 east.
    let metre = [1.0 / 111_170.0, 1.0 / 76_057.0];
    let world = format!(
        "{across:.12}\n0\n0\n-{down:.12}\n{west:.12}\n{north:.12}\n",
        down = 0.5 * metre[0],
        across = 0.5 * metre[1],
        north = 47.0 - 0.25 * metre[0],
        west = 8.0 + 0.25 * metre[1],
    );
    folder.write(
        "map.png",
        encode_png(&Picture::from_fn(400, 300, grey)).unwrap(),
    );
    folder.write("map.pgw", world);
    folder.write("map.prj", "EPSG:4326");
    let photo = |left: usize, top: usize| {
        encode_png(&Picture::from_fn(160, 120, |x, y| grey(left + x, top + y))).unwrap()
    };
    // Middles of the photos, metres south and east of the map's corner.
    let middles = [[60.0, 70.0], [90.0, 140.0]];
    let place = |[south, east]: [f64; 2]| [47.0 - south * metre[0], 8.0 + east * metre[1]];
    let [[a1, o1], [a2, o2]] = middles.map(place);
    let tables = [
        (
            "pix4d.csv",
            format!("IMG_0001.png,{a1:.8},{o1:.8},520\nIMG_0002.png,{a2:.8},{o2:.8},520\n"),
        ),
        (
            "geo.txt",
            format!("EPSG:4326\nIMG_0001.png {o1:.8} {a1:.8} 520\nIMG_0002.png {o2:.8} {a2:.8} 520\n"),
        ),
        (
            "flight_Timestamp.MRK",
            [(1, a1, o1), (2, a2, o2)]
                .map(|(n, a, o)| {
                    format!(
                        "{n}\t295218.5\t[2312]\t  10,N\t  20,E\t 190,V\t{a:.8},Lat\t{o:.8},Lon\t520.0,Ellh\t0.01, 0.01, 0.02\t50,Q\n"
                    )
                })
                .concat(),
        ),
    ];
    let known = [
        "--focal",
        "300",
        "--height",
        "150",
        "--heading",
        "0",
        "--within",
        "8",
    ];
    let lay = |photos: &[&str], more: &[&str]| {
        let said = folder.run(&[&["register", "map.png"], photos, &known, more].concat());
        said.unwrap()
    };
    for (name, text) in &tables {
        let inside = name.rsplit_once('.').unwrap().0;
        std::fs::create_dir_all(folder.0.join(inside)).unwrap();
        folder.write(&format!("{inside}/IMG_0001.png"), photo(60, 60));
        folder.write(&format!("{inside}/IMG_0002.png"), photo(200, 120));
        folder.write(&format!("{inside}/{name}"), text);
        let photos = [1, 2].map(|n| format!("{inside}/IMG_000{n}.png"));
        let photos = photos.each_ref().map(String::as_str);
        let said: Value = serde_json::from_str(&lay(&photos, &["--json"])).unwrap();
        for (number, middle) in middles.into_iter().enumerate() {
            let answer = &said[number];
            let assumed = answer["assumed"].to_string();
            assert!(
                assumed.contains("place as the table beside it says"),
                "{answer}"
            );
            let at = [0, 1].map(|i| answer["centre_lat_lon"][i].as_f64().unwrap());
            let right = place(middle);
            let off = ((at[0] - right[0]) / metre[0]).hypot((at[1] - right[1]) / metre[1]);
            assert!(off < 1.0, "{name}: {off} m: {answer}");
        }
        // By the place of the other photo none is found here.
        let elsewhere = format!("{a2:.8},{o2:.8}");
        let said = lay(&photos[..1], &["--at", &elsewhere]);
        assert!(
            said.contains("place as you said") && said.contains("not laid: "),
            "{said}"
        );
    }
}
