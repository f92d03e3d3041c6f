//! `pilotage reference-map` as a user calls it.

use pilotage_core::raster::{Picture, encode_png};
use pilotage_core::reference::ReferenceTable;

use super::folder::Folder;
use super::map::tiff;

#[test]
fn a_map_becomes_a_table_and_the_rows_of_the_thesis() {
    let folder = Folder::new("reference_map");
    // Rough green ground with smooth bright roofs of 12 by 16 m.
    let picture = Picture::from_fn(400, 400, |x, y| {
        let noise = ((x * 7919 + y * 104_729) % 37) as u8;
        let is_roof = (20..44).contains(&(x % 130)) && (30..62).contains(&(y % 130));
        if is_roof {
            [165, 110, 95]
        } else {
            [70 + noise, 92 + noise, 48 + noise]
        }
    });
    folder.write("map.png", encode_png(&picture).unwrap());
    folder.write("map.pgw", b"0.5\n0\n0\n-0.5\n100.25\n-50.25\n");
    let words = [
        "reference-map",
        "map.png",
        "-o",
        "map.table",
        "--pixel-rows",
        "rows.csv",
    ];
    let out = folder.run(&words).unwrap();
    let bytes = std::fs::read(folder.0.join("map.table")).unwrap();
    let table = ReferenceTable::from_bytes(&bytes).unwrap();
    let rows = std::fs::read_to_string(folder.0.join("rows.csv")).unwrap();
    assert_eq!(rows.lines().count(), table.landmarks().len());
    let said = format!("{} landmarks", table.landmarks().len());
    assert!(out.contains(&said), "{out}");
    assert!(
        folder
            .run(&["reference-map", "none.png", "-o", "none.table"])
            .is_err()
    );
}

#[test]
fn a_photo_is_placed_by_the_edges_of_a_table_without_the_map() {
    let folder = Folder::new("locate_photo");
    // Roofs of several sizes and places, none like another.
    let ground = Picture::from_fn(500, 500, |x, y| {
        let (column, row) = (x / 50, y / 50);
        let drawn = (column * 7919 + row * 104_729 + column * row * 31) % 97;
        let (left, top) = (5 + drawn % 11, 4 + drawn % 13);
        let (width, height) = (14 + drawn % 9, 12 + drawn % 17);
        let is_roof = (left..left + width).contains(&(x % 50))
            && (top..top + height).contains(&(y % 50))
            && drawn % 3 > 0;
        if is_roof {
            [180, 160, 150]
        } else {
            [70, 92, 48]
        }
    });
    folder.write("map.png", encode_png(&ground).unwrap());
    folder.write("map.pgw", b"0.5\n0\n0\n-0.5\n0.25\n249.75\n");
    let photo = ground.crop(140, 170, 240, 180).unwrap();
    folder.write("photo.png", encode_png(&photo).unwrap());
    let out = folder
        .run(&["reference-map", "map.png", "--edges", "-o", "map.table"])
        .unwrap();
    assert!(out.contains("straight edges"), "{out}");
    assert!(out.contains("--at-metres"), "{out}");
    // The middle of the photo, 130 m from the west and 120 m from the south; the focal length is that of 0.5 m a pixel.
    let words = |rest: &str| {
        let all = format!("reference-map locate map.table photo.png {rest}");
        folder.run(&all.split(' ').collect::<Vec<_>>()).unwrap()
    };
    let known = "--height 100 --heading 0 --focal 200";
    let found = words(&format!("{known} --at-metres 131,118"));
    println!("{found}");
    assert!(found.contains("middle of the picture"), "{found}");
    assert!(found.contains("place as you said, within 25 m"), "{found}");
    let number = |found: &str, word: &str| -> f64 {
        let before = found.split(word).next().unwrap();
        before.split_whitespace().last().unwrap().parse().unwrap()
    };
    let off = [
        number(&found, " m north") - 120.0,
        number(&found, " m east") - 130.0,
    ];
    assert!(off[0].hypot(off[1]) < 2.0, "{found}");
    let lost = folder.run(&[
        "reference-map",
        "locate",
        "map.table",
        "photo.png",
        "lost.png",
    ]);
    assert!(lost.unwrap_err().contains("lost.png"));
    let all_around = words("--height 100 --heading 0 --heading-within 180 --at-metres 131,118");
    assert!(
        all_around.contains("--heading-within has to be"),
        "{all_around}"
    );
    // Some 2,400 million poses would take 19 GB, and hours.
    let open = words(&format!(
        "{known} --at-metres 131,118 --within 1000 --heading-within 179"
    ));
    let is_refused = open.contains("million poses") && open.contains("smaller --within");
    assert!(is_refused, "{open}");
    // What nobody tells is asked for.
    for (given, missing) in [
        (known, "--at-metres"),
        ("--heading 0 --at-metres 131,118", "--height"),
        ("--height 100 --at-metres 131,118", "--heading"),
    ] {
        let refused = words(given);
        let asks = refused.contains("no place: ") && refused.contains(missing);
        assert!(asks, "{given}: {refused}");
    }
    assert!(folder.run(&["reference-map"]).is_err());
}

/// A photo over the table of a satellite map of another date, which tells where on the globe it lies.
#[test]
fn a_photo_is_placed_on_the_globe_by_the_edges_of_a_map_of_another_date() {
    let Some(data) = pilotage_tests::data::shared("fengyuan") else {
        return;
    };
    let folder = Folder::new("locate_on_globe");
    let file = |name: &str| data.join(name).to_string_lossy().into_owned();
    let map = file("map.jpg");
    let out = folder.run(&["reference-map", &map, "--edges", "-o", "map.table"]);
    assert!(!out.unwrap().contains("--at-metres"));
    let table = std::fs::read(folder.0.join("map.table")).unwrap();
    let table = ReferenceTable::from_bytes(&table).unwrap();
    assert!(table.origin().is_some() && table.gsd().is_some());
    // Its receiver's place, and what its author's table tells of it.
    let photo = file("frames/DJI_003.jpg");
    let all = "--at 24.26109875,120.72074764 --height 119.3 --heading 152 --ahead 9.5 --focal 728";
    let mut words = vec!["reference-map", "locate", "map.table", &photo];
    words.extend(all.split(' '));
    let found = folder.run(&words).unwrap();
    let line = found.lines().find(|line| line.contains("middle of"));
    let line = line.unwrap_or_else(|| panic!("{found}"));
    let degrees: Vec<f64> = line
        .split([' ', ',', ';'])
        .filter_map(|word| word.parse().ok())
        .collect();
    // The author's truth of the middle: ahead of the receiver by the height times the tangent of the tilt.
    let ahead = 119.3 * 9.5_f64.to_radians().tan();
    let heading = 152_f64.to_radians();
    let north = (degrees[0] - 24.261_098_75) * 110_760.0 - ahead * heading.cos();
    let east = (degrees[1] - 120.720_747_64) * 101_500.0 - ahead * heading.sin();
    assert!(north.hypot(east) < 10.0, "{north} {east}: {found}");
}

#[test]
fn parts_of_a_map_that_cannot_be_read_are_told_by_commands_that_use_it() {
    let folder = Folder::new("damaged_map");
    let mut map = tiff(true);
    folder.write("whole.tif", &map);
    // Its strip is said to lie beyond the end of the file.
    let strip = map.windows(4).position(|tag| tag == [17, 1, 4, 0]);
    let at = strip.expect("the place of its strip") + 8;
    map[at..at + 4].copy_from_slice(&500_000_u32.to_le_bytes());
    folder.write("damaged.tif", &map);
    let notes = |words: &str| {
        let said = folder.call(&words.split(' ').collect::<Vec<_>>());
        String::from_utf8_lossy(&said.stderr).into_owned()
    };
    for options in ["-o", "--edges -o"] {
        let told = notes(&format!("reference-map damaged.tif {options} map.table"));
        assert!(told.contains("note: damaged.tif"), "{options}: {told}");
        let told = notes(&format!("reference-map whole.tif {options} map.table"));
        assert!(!told.contains("note: whole.tif"), "{options}: {told}");
    }
}
