//! Places of photos in tables beside them, whoever wrote those.

use std::collections::BTreeMap;
use std::sync::Arc;

use pilotage_core::exchange::{TabledPicture, placed_pictures};
use pilotage_core::flight::FlightFolder;
use pilotage_core::flight::files::{FileSet, file_of, folder_of, has_ending, names_ending_in};
use pilotage_core::flight::photo::{PhotoPlace, PhotoRow, PhotoRows, read_tabled_photos};
use pilotage_core::mission::places_in_degrees;

/// Endings of the names of tables.
const TABLES: [&str; 4] = ["csv", "tsv", "txt", "mrk"];
/// Endings of the names of pictures, also in tables.
const PICTURES: [&str; 9] = [
    "jpg", "jpeg", "png", "tif", "tiff", "dng", "arw", "cr2", "nef",
];
/// A longer table is a log and none of photos, bytes.
const LONGEST: u64 = 1 << 25;
/// Middle pitch below which the angles are those of a gimbal that counts from the horizon, radians.
const LOOKS_DOWN: f64 = -std::f64::consts::FRAC_PI_4;
/// Word before the number of a photo among the marks of DJI.
const MARK: &str = "mark ";

/// Places of photos, as tables beside them tell them.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PlacesBesidePhotos {
    /// Rows by the names of the photos.
    pub rows: PhotoRows,
    /// Names of the tables that have them.
    pub tables: Vec<String>,
    /// Sentences on what was assumed of these, and on tables that were passed over.
    pub notes: Vec<String>,
}

/// Places of the photos among files, as tables beside them tell them.
///
/// A table names the file of each photo, perhaps behind other folders, in other letters or without its ending; the marks of
/// DJI (`.MRK`) have the numbers in the names of the photos in their folder.
pub fn places_of_photos(files: &dyn FileSet) -> PlacesBesidePhotos {
    let photos = names_ending_in(files, &PICTURES);
    let mut beside = PlacesBesidePhotos::default();
    if photos.is_empty() {
        return beside;
    }
    for table in names_ending_in(files, &TABLES) {
        let is_short = files
            .source(&table)
            .is_some_and(|source| source.length() <= LONGEST);
        if !is_short {
            continue;
        }
        let Some(bytes) = files.read(&table) else {
            continue;
        };
        let in_degrees = std::str::from_utf8(&bytes).ok().and_then(places_in_degrees);
        let (bytes, system) = in_degrees.map_or((bytes, Vec::new()), |(text, told)| {
            (text.into_bytes(), told)
        });
        let names = NamesOfPhotos::of(&photos, &table);
        let Ok(found) = placed_pictures(&table, &bytes, &|cell| names.find(cell).is_some()) else {
            continue;
        };
        if found.pictures.is_empty() {
            continue;
        }
        let of_name = |note: &String| format!("{table}: {note}");
        let is_gimbal = counts_from_horizon(&found.pictures);
        let mut places: BTreeMap<&str, Vec<PhotoRow>> = BTreeMap::new();
        for picture in &found.pictures {
            if let Some(photo) = names.find(&picture.name) {
                let rows = places.entry(photo).or_default();
                rows.push(row(picture, is_gimbal));
            }
        }
        // Where a photo has several places these are of what it shows: control points.
        let is_one = |rows: &Vec<PhotoRow>| rows.iter().all(|row| row.place == rows[0].place);
        if !places.values().all(is_one) {
            let told =
                "several places stand beside one photo: it does not tell where photos were taken";
            beside.notes.push(of_name(&told.to_owned()));
            continue;
        }
        let told = system.iter().chain(&found.notes).map(of_name);
        beside.notes.extend(told);
        for (photo, told) in places {
            let rows = &mut beside.rows.0;
            rows.entry(photo.to_owned()).or_insert(told[0]);
        }
        beside.tables.push(table);
    }
    beside
}

/// The flight of photos that tables place; `None` where they place less than two.
pub(super) fn flight_of_tabled_photos(files: &Arc<dyn FileSet>) -> Option<FlightFolder> {
    let beside = places_of_photos(files.as_ref());
    if beside.rows.0.len() < 2 {
        return None;
    }
    let mut flown = read_tabled_photos(files, &beside.rows)?;
    flown.notes.extend(beside.notes);
    Some(flown)
}

fn row(picture: &TabledPicture, is_gimbal: bool) -> PhotoRow {
    let (longitude, latitude) = picture.place;
    let [heading, pitch, roll] = picture.angles;
    let tilt =
        (pitch.is_some() || roll.is_some()).then_some((roll.unwrap_or(0.0), pitch.unwrap_or(0.0)));
    PhotoRow {
        place: PhotoPlace {
            latitude: latitude.to_radians(),
            longitude: longitude.to_radians(),
            altitude: picture.altitude,
        },
        height_above_take_off: picture.height_above_take_off,
        heading,
        tilt,
        is_gimbal,
    }
}

fn counts_from_horizon(pictures: &[TabledPicture]) -> bool {
    let mut pitches: Vec<f64> = pictures.iter().filter_map(|p| p.angles[1]).collect();
    pitches.sort_by(f64::total_cmp);
    let middle = pitches.get(pitches.len() / 2);
    middle.is_some_and(|pitch| *pitch < LOOKS_DOWN)
}

/// Photos by the names that a table may call them by.
struct NamesOfPhotos<'a> {
    /// By the name without its ending, in small letters.
    by_stem: BTreeMap<String, Vec<&'a str>>,
    /// By the number in the name, of those in the folder of the table.
    by_number: BTreeMap<u32, Vec<&'a str>>,
}

impl<'a> NamesOfPhotos<'a> {
    fn of(photos: &'a [String], table: &str) -> Self {
        let mut names = Self {
            by_stem: BTreeMap::new(),
            by_number: BTreeMap::new(),
        };
        let are_marks = has_ending(table, &["mrk"]);
        for photo in photos {
            let stem = stem(file_of(photo));
            names.by_stem.entry(stem.clone()).or_default().push(photo);
            if let Some(number) = number(&stem)
                && are_marks
                && folder_of(photo) == folder_of(table)
            {
                names.by_number.entry(number).or_default().push(photo);
            }
        }
        names
    }

    /// The photo that a cell names, if there is one and no other.
    fn find(&self, cell: &str) -> Option<&'a str> {
        if let Some(number) = cell.strip_prefix(MARK) {
            let found = self.by_number.get(&number.parse().ok()?)?;
            return only(found);
        }
        let path = cell.replace('\\', "/");
        let found = self.by_stem.get(&stem(file_of(&path)))?;
        only(found).or_else(|| {
            let path = path.to_lowercase();
            let is_it = |photo: &&&str| {
                let photo = photo.to_lowercase();
                photo.ends_with(&path) || path.ends_with(&photo)
            };
            only(&found.iter().filter(is_it).copied().collect::<Vec<_>>())
        })
    }
}

fn only<'a>(found: &[&'a str]) -> Option<&'a str> {
    match found {
        [one] => Some(one),
        _ => None,
    }
}

/// A file's name in small letters, without the ending of a picture.
fn stem(file: &str) -> String {
    let file = file.trim().to_lowercase();
    match file.rsplit_once('.') {
        Some((stem, ending)) if PICTURES.contains(&ending) => stem.to_owned(),
        _ => file,
    }
}

/// The number of a photo in a name such as `dji_20240501100000_0007_v`: its last part of digits.
fn number(stem: &str) -> Option<u32> {
    let is_number = |part: &&str| {
        (3..=5).contains(&part.len()) && part.bytes().all(|byte| byte.is_ascii_digit())
    };
    stem.rsplit('_').find(is_number)?.parse().ok()
}

#[cfg(test)]
mod tests {
    use pilotage_core::flight::ChannelName;
    use pilotage_core::flight::files::MemoryFiles;
    use pilotage_core::frames::GroundPoint;
    use pilotage_core::raster::{Picture, encode_png};

    use super::super::flight_among;
    use super::*;

    /// Latitude, longitude and altitude of a photo by its number, degrees and metres.
    fn place(number: u32) -> [f64; 3] {
        let n = f64::from(number);
        [47.1 + 1e-4 * n, 8.5 - 2e-4 * n, 520.0 + n]
    }

    /// Four photos that tell nothing, in a folder, with a table beside them.
    fn files(prefix: &str, table: &str, text: &str) -> Arc<dyn FileSet> {
        let picture = encode_png(&Picture::filled(8, 6, [7; 3])).expect("a small picture");
        let photo = |number| (format!("flight/{prefix}{number:04}.png"), picture.clone());
        let mut files = MemoryFiles((1..=4).map(photo).collect());
        files
            .0
            .insert(format!("flight/{table}"), text.as_bytes().to_vec());
        Arc::new(files)
    }

    fn rows(row: impl Fn(u32, [f64; 3]) -> String) -> String {
        (1..=4)
            .map(|number| row(number, place(number)) + "\n")
            .collect()
    }

    /// The tables of all makers, with the beginnings of the photos' names.
    fn tables() -> Vec<(&'static str, &'static str, String)> {
        vec![
            (
                "IMG_",
                "pix4d.csv",
                rows(|n, [a, o, h]| format!("IMG_{n:04}.png,{a},{o},{h}")),
            ),
            (
                "IMG_",
                "geo.txt",
                format!(
                    "EPSG:4326\n{}",
                    rows(|n, [a, o, h]| format!("IMG_{n:04}.png {o} {a} {h} 30 1 2"))
                ),
            ),
            (
                "my, ",
                "ref.txt",
                format!(
                    "#Label\tX/Longitude\tY/Latitude\tZ/Altitude\tYaw\tPitch\tRoll\n{}",
                    rows(
                        |n, [a, o, h]| format!("\"my, {n:04}\"\t{o}\t{a}\t{h}\t30\t1\t2")
                            .replace('.', ",")
                    )
                ),
            ),
            (
                "IMG_",
                "sensefly.csv",
                format!(
                    "# image,latitude,longitude,altitude,roll,pitch,yaw\n{}",
                    rows(|n, [a, o, h]| format!("img_{n:04}.JPG,{a},{o},{h},2,1,30"))
                ),
            ),
            (
                "DJI_",
                "gimbal.csv",
                format!(
                    "File;Lat;Lon;Alt;GimbalYawDegree;GimbalPitchDegree;GimbalRollDegree\n{}",
                    rows(|n, [a, o, h]| format!("D:\\fly\\DJI_{n:04}.png;{a};{o};{h};30;-89;0"))
                ),
            ),
            (
                "100_0001_",
                "100_0001_Timestamp.MRK",
                rows(|n, [a, o, h]| {
                    format!(
                        "{n}\t295218.5\t[2312]\t  10,N\t  20,E\t 190,V\t{a:.8},Lat\t{o:.8},Lon\t{h:.3},Ellh\t0.01, 0.01, 0.02\t50,Q"
                    )
                }),
            ),
        ]
    }

    #[test]
    fn photos_without_places_are_a_flight_by_the_table_beside_them() {
        for (prefix, table, text) in tables() {
            let folder = flight_among(&files(prefix, table, &text), None);
            let flight = folder.expect(table).expect(table).flight;
            assert_eq!(flight.frames.len(), 4, "{table}");
            let frame = flight.frame_on_globe.as_ref().expect(table);
            let states = &flight.truth.as_ref().expect(table).states;
            for (state, number) in states.iter().zip(1..) {
                let [latitude, longitude, altitude] = place(number);
                let at = GroundPoint::new(state.position.x, state.position.y);
                let found = frame.geodetic_from_ground(&at);
                assert!(
                    (found.latitude.to_degrees() - latitude).abs() < 1e-7,
                    "{table}"
                );
                assert!(
                    (found.longitude.to_degrees() - longitude).abs() < 1e-7,
                    "{table}"
                );
                let height = altitude - place(1)[2];
                assert!((state.position.z + height).abs() < 1e-6, "{table}");
            }
            let last = |name| {
                let channel = flight.channel(name)?;
                channel.values.last().map(|value| value.to_degrees())
            };
            let (heading, pitch) = (last(ChannelName::Heading), last(ChannelName::Pitch));
            if !table.starts_with("pix4d") && !table.contains("MRK") {
                assert!((heading.expect(table) - 30.0).abs() < 1e-6, "{table}");
                assert!((pitch.expect(table) - 1.0).abs() < 1e-6, "{table}");
            }
        }
    }

    #[test]
    fn control_points_with_the_photos_that_show_them_place_no_photo() {
        let points = "photo,lat,lon,alt,px,py\n\
            IMG_0001.png,47.1,8.5,500,1,2\n\
            IMG_0002.png,47.1,8.5,500,3,4\n\
            IMG_0002.png,47.2,8.6,510,5,1\n";
        let files = files("IMG_", "points.csv", points);
        let beside = places_of_photos(files.as_ref());
        assert!(beside.rows.0.is_empty() && beside.tables.is_empty());
        let is_told = |note: &String| note.contains("several places");
        assert!(beside.notes.iter().any(is_told), "{beside:?}");
        assert!(flight_among(&files, None).is_ok_and(|flight| flight.is_none()));
        let of_open_drone_map =
            "EPSG:4326\n8.5 47.1 500 1 2 IMG_0001.png gcp1\n8.5 47.1 500 3 4 IMG_0002.png gcp1\n";
        let files = self::files("IMG_", "gcp_list.txt", of_open_drone_map);
        let beside = places_of_photos(files.as_ref());
        assert!(beside.rows.0.is_empty(), "{beside:?}");
    }

    #[test]
    fn photos_of_one_name_in_two_folders_are_told_apart_by_their_paths() {
        let photos = ["a/IMG_1.JPG", "b/IMG_1.JPG", "b/IMG_2.JPG"].map(str::to_owned);
        let names = NamesOfPhotos::of(&photos, "t.csv");
        assert_eq!(names.find("IMG_2"), Some("b/IMG_2.JPG"));
        assert_eq!(names.find("IMG_1.JPG"), None);
        assert_eq!(names.find(r"D:\all\b\img_1.jpg"), Some("b/IMG_1.JPG"));
        assert_eq!(names.find("IMG_3.JPG"), None);
    }
}
