//! Towns of an invented globe, and the file of the page.

use super::*;

/// The file with towns of two regions: names, latitudes and longitudes in degrees, and sizes.
fn file() -> Vec<u8> {
    let towns = [
        ("Zürich", 47.37, 8.55, 18),
        ("L’Aquila", 42.35, 13.4, 8),
        ("Duluth", 34.0, -84.14, 4),
        ("Duluth", 46.78, -92.11, 10),
        ("New Zagra", -17.0, 179.99, 30),
    ];
    let regions = "2\tAlps\n3\tGeorgia, Far West\n";
    let names = towns.map(|town| town.0).join("\n") + "\n";
    let mut bytes = MARK.to_vec();
    for length in [towns.len(), regions.len(), names.len()] {
        bytes.extend((length as u32).to_le_bytes());
    }
    bytes.extend(regions.bytes().chain(names.bytes()));
    for column in [towns.map(|town| town.1), towns.map(|town| town.2)] {
        let mut last = 0;
        let steps = column.map(|degrees: f64| {
            let value = (100.0 * degrees).round() as i16;
            value
                .wrapping_sub(std::mem::replace(&mut last, value))
                .to_le_bytes()
        });
        bytes.extend(steps.map(|step| step[0]));
        bytes.extend(steps.map(|step| step[1]));
    }
    bytes.extend(towns.map(|town| town.3));
    bytes
}

fn names(gazetteer: &Gazetteer, text: &str) -> Vec<String> {
    let found = gazetteer.find(text, 8, &|_| None).into_iter();
    found
        .map(|it| format!("{}, {}", it.name, it.region))
        .collect()
}

#[test]
fn towns_are_found_by_the_beginnings_of_their_words_the_larger_ones_first() {
    let gazetteer = Gazetteer::from_bytes(&file()).expect("a sound file");
    for text in ["zur", "Zür", "ZÜRICH", " zu\u{308}rich ", "zürich alps"] {
        assert_eq!(names(&gazetteer, text), ["Zürich, Alps"], "{text}");
    }
    for text in ["aquila", "l'aquila", "laquila", "L’Aq"] {
        assert_eq!(names(&gazetteer, text), ["L’Aquila, Alps"], "{text}");
    }
    let of_z = ["New Zagra, Georgia, Far West", "Zürich, Alps"];
    assert_eq!(names(&gazetteer, "z"), of_z);
    for text in ["", " ", "urich", "alps", "zürich georgia", "-"] {
        assert!(names(&gazetteer, text).is_empty(), "{text}");
    }
    let found = gazetteer.find("duluth", 8, &|_| None);
    let [latitude, longitude] = [found[0].place.latitude, found[0].place.longitude];
    assert!((latitude.to_degrees() - 46.78).abs() < 1e-9);
    assert!((longitude.to_degrees() + 92.11).abs() < 1e-9);
    let far = gazetteer.find("new", 8, &|_| None);
    assert!((far[0].place.longitude.to_degrees() - 179.99).abs() < 1e-9);
}

#[test]
fn towns_nearby_come_before_larger_ones() {
    let gazetteer = Gazetteer::from_bytes(&file()).expect("a sound file");
    let south = |place: &Geodetic| (place.latitude < 0.7).then_some(5.0);
    let found = gazetteer.find("du", 8, &south);
    assert_eq!(found.len(), 2);
    assert!(found[0].place.latitude < found[1].place.latitude);
    assert_eq!(gazetteer.find("du", 1, &south), found[..1]);
}

#[test]
fn damaged_files_are_refused() {
    let whole = file();
    for length in 0..whole.len() {
        assert!(
            Gazetteer::from_bytes(&whole[..length]).is_none(),
            "{length}"
        );
    }
    assert!(Gazetteer::from_bytes(&[&whole[..], b"x"].concat()).is_none());
    // Every byte in turn becomes another: nothing panics, here or in a search.
    for place in 0..whole.len() {
        for other in [0, 9, 10, 0x7f, 0xff] {
            let mut damaged = whole.clone();
            damaged[place] = other;
            if let Some(gazetteer) = Gazetteer::from_bytes(&damaged) {
                gazetteer.find("duluth", 8, &|_| None);
            }
        }
    }
    // Four billion places.
    let mut damaged = whole;
    damaged[8..12].fill(0xff);
    assert!(Gazetteer::from_bytes(&damaged).is_none());
}

/// Places by Wikipedia.
#[test]
fn the_file_of_the_page_has_towns_of_the_globe_whose_letters_all_have_a_plain_form() {
    let file = concat!(env!("CARGO_MANIFEST_DIR"), "/../../../www/places.bin");
    let bytes = std::fs::read(file).expect("a file of the page");
    let gazetteer = Gazetteer::from_bytes(&bytes).expect("a sound file");
    for (text, name, latitude, longitude) in [
        ("zurich", "Zürich", 47.374, 8.541),
        ("duluth minn", "Duluth", 46.787, -92.098),
        ("lodz", "Łódź", 51.777, 19.455),
        ("suva", "Suva", -18.142, 178.442),
    ] {
        let found = gazetteer.find(text, 1, &|_| None);
        let FoundTown {
            name: own, place, ..
        } = &found[0];
        let off = (place.latitude.to_degrees() - latitude).abs()
            + (place.longitude.to_degrees() - longitude).abs();
        assert!(own == name && off < 0.1, "{text}: {own} {place:?}");
    }
    let strange = gazetteer.folded.lines().find(|line| !line.is_ascii());
    assert_eq!(strange, None);
}
