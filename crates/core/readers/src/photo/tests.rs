//! Photos that are made here.

use pilotage_flight::FrameSource as _;
use std::sync::Arc;

use super::*;
use crate::interpret::{Role, log_of_flight};
use crate::overview::overview;
use pilotage_base::bytes::MemoryBytes;
use pilotage_base::files::{FileSet, MemoryFiles};
use pilotage_flight::ChannelName;

fn segment(kind: u8, contents: &[u8]) -> Vec<u8> {
    let length = u16::try_from(contents.len() + 2).unwrap();
    [&[0xff, kind][..], &length.to_be_bytes(), contents].concat()
}

/// A tag with its type, count and values.
type Tag = (u16, u16, u32, Vec<u8>);

fn ratio(numbers: &[(u32, u32)]) -> Vec<u8> {
    numbers
        .iter()
        .flat_map(|(a, b)| [a.to_le_bytes(), b.to_le_bytes()].concat())
        .collect()
}

/// A directory at `offset` with the values behind it.
fn directory(offset: usize, tags: &[Tag]) -> Vec<u8> {
    let mut table = (tags.len() as u16).to_le_bytes().to_vec();
    let mut values: Vec<u8> = Vec::new();
    let behind = offset + 2 + 12 * tags.len() + 4;
    for (tag, kind, count, bytes) in tags {
        table.extend(tag.to_le_bytes());
        table.extend(kind.to_le_bytes());
        table.extend(count.to_le_bytes());
        if bytes.len() <= 4 {
            let mut bytes = bytes.clone();
            bytes.resize(4, 0);
            table.extend(bytes);
        } else {
            table.extend(((behind + values.len()) as u32).to_le_bytes());
            values.extend(bytes);
        }
    }
    table.extend([0; 4]);
    [table, values].concat()
}

fn text(tag: u16, text: &str) -> Tag {
    let bytes = [text.as_bytes(), &[0]].concat();
    (tag, 2, bytes.len() as u32, bytes)
}

/// A photo of 400 by 300 pixels (which it does not have) at a second of a minute, so many seconds of arc north.
pub(super) fn photo(time: &str, fraction: &str, north: u32, xmp: &str) -> Vec<u8> {
    let photo_tags = [
        text(
            exif::DATE_TIME_ORIGINAL,
            &format!("2024:05:01 10:20:{time}"),
        ),
        text(exif::SUB_SECONDS_ORIGINAL, fraction),
        text(exif::OFFSET_TIME_ORIGINAL, "+02:00"),
        (exif::FOCAL_LENGTH_35, 3, 1, 24_u16.to_le_bytes().to_vec()),
    ];
    let gps_tags = [
        text(exif::LATITUDE_REF, "S"),
        (exif::LATITUDE, 5, 3, ratio(&[(30, 1), (0, 1), (north, 1)])),
        text(exif::LONGITUDE_REF, "W"),
        (exif::LONGITUDE, 5, 3, ratio(&[(60, 1), (30, 1), (0, 1)])),
        (exif::ALTITUDE, 5, 1, ratio(&[(1505, 10)])),
    ];
    let mut tiff = b"II*\0\x08\0\0\0".to_vec();
    let pointers = |photo: u32, gps: u32| {
        [
            text(exif::MODEL, "Test"),
            (0x8769, 4, 1, photo.to_le_bytes().to_vec()),
            (0x8825, 4, 1, gps.to_le_bytes().to_vec()),
        ]
    };
    let length = directory(8, &pointers(0, 0)).len();
    let at = 8 + length;
    let of_photo = directory(at, &photo_tags);
    let of_gps = directory(at + of_photo.len(), &gps_tags);
    tiff.extend(directory(
        8,
        &pointers(at as u32, (at + of_photo.len()) as u32),
    ));
    tiff.extend(of_photo);
    tiff.extend(of_gps);
    let xmp = format!("<x:xmpmeta><rdf:Description {xmp}/></x:xmpmeta>");
    [
        b"\xff\xd8".to_vec(),
        segment(0xe1, &[b"Exif\0\0", &*tiff].concat()),
        segment(
            0xe1,
            &[b"http://ns.adobe.com/xap/1.0/\0", xmp.as_bytes()].concat(),
        ),
        segment(0xc0, &[8, 1, 44, 1, 144, 3, 0, 0, 0]),
        segment(0xda, &[0]),
    ]
    .concat()
}

pub(super) fn gimbal(yaw: f64, pitch: f64) -> String {
    format!(
        "drone-dji:GimbalYawDegree=\"{yaw:+}\" drone-dji:GimbalPitchDegree=\"{pitch:+}\" \
         drone-dji:GimbalRollDegree=\"+0.5\" drone-dji:RelativeAltitude=\"+40.5\""
    )
}

pub(super) fn files(photos: &[(&str, Vec<u8>)]) -> Arc<dyn FileSet> {
    let photos = photos
        .iter()
        .map(|(name, bytes)| ((*name).to_owned(), bytes.clone()));
    Arc::new(MemoryFiles(photos.collect()))
}

/// Focal length in pixels, as calibrated and by the sensor's pixels, of a TIFF of that size which was taken with 5472 by
/// 3648 pixels, by what EXIF says of that and the middle that the maker calibrated.
fn focal_lengths(size: [u32; 2], taken: Option<[u32; 2]>, middle: Option<[f64; 2]>) -> [f64; 2] {
    let long = |tag: u16, value: u32| (tag, 4, 1, value.to_le_bytes().to_vec());
    let middle = middle.map_or_else(String::new, |[x, y]| {
        format!(
            "drone-dji:CalibratedOpticalCenterX=\"{x}\" drone-dji:CalibratedOpticalCenterY=\"{y}\""
        )
    });
    let xmp = format!(
        "<x:xmpmeta><rdf:Description drone-dji:CalibratedFocalLength=\"3666.67\" {middle}/></x:xmpmeta>"
    );
    let pointers = |photo: u32| {
        [
            long(exif::WIDTH, size[0]),
            long(exif::HEIGHT, size[1]),
            (exif::XMP, 1, xmp.len() as u32, xmp.clone().into_bytes()),
            long(0x8769, photo),
        ]
    };
    let at = 8 + directory(8, &pointers(0)).len();
    let mut of_photo = vec![(exif::FOCAL_LENGTH, 5, 1, ratio(&[(88, 10)]))];
    if let Some([width, height]) = taken {
        of_photo.extend([
            long(exif::PIXEL_WIDTH, width),
            long(exif::PIXEL_HEIGHT, height),
        ]);
    }
    // 4166.67 pixels to the centimetre are 2.4 µm each.
    of_photo.push((exif::FOCAL_PLANE_X, 5, 1, ratio(&[(12_500, 3)])));
    of_photo.push((exif::FOCAL_PLANE_UNIT, 3, 1, 3_u16.to_le_bytes().to_vec()));
    let image = directory(8, &pointers(at as u32));
    let bytes = [b"II*\0\x08\0\0\0", &*image, &*directory(at, &of_photo)].concat();
    let photo = read_photo(&MemoryBytes::new("a.tif", bytes)).unwrap();
    let by_pitch = photo.focal_length.unwrap() / photo.pixel_pitch.unwrap();
    [photo.calibrated_focal.unwrap(), by_pitch]
}

#[test]
fn a_photo_that_was_made_smaller_has_the_focal_length_in_its_own_pixels() {
    let taken = Some([5472, 3648]);
    let middle = Some([2736.0, 1824.0]);
    // 3666.67 px, and 8.8 mm of 2.4 µm a pixel; a quarter of both in a picture of a quarter of the size.
    let whole = [3666.67, 3666.67];
    let quarter = [916.67, 916.67];
    for (size, taken, middle, expected) in [
        ([5472, 3648], taken, middle, whole),
        ([5472, 3648], None, Some([2650.0, 1850.0]), whole),
        ([1368, 912], taken, None, quarter),
        // Turned to stand upright.
        ([912, 1368], taken, None, quarter),
        // The program told EXIF of the new size.
        ([1368, 912], Some([1368, 912]), middle, quarter),
        ([1368, 912], None, middle, quarter),
        // Cut out of the picture as it was.
        ([4000, 1000], taken, middle, whole),
    ] {
        let found = focal_lengths(size, taken, middle);
        for (found, expected) in found.iter().zip(expected) {
            assert!(
                (found - expected).abs() < 0.01,
                "{size:?} {taken:?}: {found}"
            );
        }
    }
}

#[test]
fn a_photo_says_when_and_where_it_was_taken() {
    let bytes = photo("30", "25", 10, &gimbal(90.0, -90.0));
    let photo = read_photo(&MemoryBytes::new("a.jpg", bytes)).unwrap();
    // date -u -d '2024-05-01 08:20:30' +%s
    assert_eq!(
        (photo.taken, photo.is_utc),
        (Some((1_714_551_630, 0.25)), true)
    );
    let place = photo.place.unwrap();
    assert!((place.latitude.to_degrees() + 30.0 + 10.0 / 3600.0).abs() < 1e-12);
    assert!((place.longitude.to_degrees() + 60.5).abs() < 1e-12);
    assert_eq!(place.altitude, Some(150.5));
    assert_eq!(
        (photo.width, photo.height, photo.orientation),
        (400, 300, 1)
    );
    assert_eq!(
        (photo.camera.as_str(), photo.focal_length_35),
        ("Test", Some(0.024))
    );
}

#[test]
fn what_is_not_sure_of_a_place_is_told_with_the_photos_that_say_so() {
    let sound = photo("30", "25", 10, "");
    let doubts = |bytes: &[u8]| {
        let source = MemoryBytes::new("a.jpg", bytes.to_vec());
        read_photo(&source).unwrap().doubts
    };
    assert_eq!(doubts(&sound), Vec::<String>::new());
    let letter = b"\x03\0\x02\0\x02\0\0\0W";
    let at = sound.windows(9).position(|nine| nine == letter).unwrap();
    let mut nameless = sound.clone();
    nameless[at + 8] = 0;
    assert!(doubts(&nameless)[0].contains("GPSLongitudeRef is missing, and east is taken"));
    // XMP of the same photo knows the hemisphere.
    let mut by_xmp = photo(
        "30",
        "25",
        10,
        "drone-dji:GpsLatitude=\"-30.003\" drone-dji:GpsLongitude=\"-60.5\"",
    );
    let at_letter = by_xmp.windows(9).position(|nine| nine == letter).unwrap();
    by_xmp[at_letter + 8] = 0;
    assert_eq!(
        doubts(&by_xmp),
        ["GPSLongitudeRef is missing, and west is taken, as XMP says"]
    );
    let place = read_photo(&MemoryBytes::new("a.jpg", by_xmp))
        .unwrap()
        .place;
    assert!((place.unwrap().longitude.to_degrees() + 60.5).abs() < 1e-9);
    let mut lost = nameless.clone();
    (lost[at], lost[at + 8]) = (exif::GPS_STATUS as u8, b'V');
    assert!(doubts(&lost)[1].contains("had lost its fix"));
    let mut local = nameless.clone();
    (local[at], local[at + 8]) = (exif::MAP_DATUM as u8, b'T');
    assert!(doubts(&local)[1].contains("GPSMapDatum says T"));
    let of_xmp = |south: f64| {
        let xmp = format!("drone-dji:GpsLatitude=\"-{south}\" drone-dji:GpsLongitude=\"-60.5\"");
        doubts(&photo("30", "25", 10, &xmp))
    };
    let rtk = doubts(&photo("30", "25", 10, "drone-dji:AltitudeType=\"RtkAlt\""));
    assert!(rtk[0].contains("above the ellipsoid"), "{rtk:?}");
    let mut third = sound.clone();
    // A byte in the place of the letter: above the ellipsoid.
    (third[at], third[at + 2]) = (exif::ALTITUDE_REF as u8, 1);
    (third[at + 4], third[at + 8]) = (1, 2);
    assert!(doubts(&third)[0].contains("above the ellipsoid"));
    assert!(of_xmp(30.1)[0].contains("EXIF and XMP"));
    assert!(of_xmp(30.003).is_empty());
    let files = files(&[
        ("a.jpg", sound),
        ("b.jpg", photo("31", "25", 11, "")),
        ("c.jpg", nameless),
    ]);
    let notes = read_photos(&files).unwrap().notes;
    let is_told = |note: &String| {
        note.starts_with("1 of 3 photos: GPSLongitudeRef") && note.ends_with(": c.jpg")
    };
    assert!(notes.iter().any(is_told), "{notes:?}");
}

#[test]
fn photos_are_a_log_of_what_they_tell_and_of_what_that_is() {
    let files = files(&[
        ("shots/a.jpg", photo("32", "5", 8, &gimbal(180.0, -80.0))),
        ("shots/b.JPG", photo("30", "25", 10, &gimbal(90.0, -90.0))),
        ("shots/c.jpg", photo("31", "5", 9, &gimbal(-179.0, -90.0))),
    ]);
    let folder = read_photos(&files).unwrap();
    let log = folder.log();
    let topic = log.first("photos").unwrap();
    assert_eq!(topic.times, [0.0, 1.25, 2.25]);
    assert_eq!(topic.texts("file").unwrap()[0], "shots/b.JPG");
    let near = |name: &str, wanted: [f64; 3]| {
        let values = topic.values(name).unwrap();
        let pairs = values.iter().zip(wanted);
        assert!(
            pairs.clone().all(|(a, b)| (a - b).abs() < 1e-9),
            "{name}: {values:?}"
        );
    };
    near("gimbal_pitch", [-90.0, -90.0, -80.0]);
    near("height_above_take_off", [40.5; 3]);
    near("focal_length_35", [24.0; 3]);
    let south = |seconds: f64| -30.0 - seconds / 3600.0;
    near("latitude", [south(10.0), south(9.0), south(8.0)]);
    assert!(topic.field("flight_yaw").is_none());
    // date -u -d '2024-05-01 08:20:30' +%s
    assert_eq!(log.utc_at_zero, Some(1_714_551_630.25));
    assert_eq!(log.vehicle, "Test");
    let beside = log_of_flight(&log, &folder.flight);
    let seen = overview(&log, &beside.measured());
    let pitch = seen.sensors.iter().find(|s| s.role == Role::Pitch).unwrap();
    assert_eq!(pitch.source, "photos.gimbal_pitch");
    assert!(!pitch.is_dead && pitch.samples == 3);
    assert!(
        log.report
            .remarks
            .iter()
            .any(|r| r.starts_with("Heading, pitch and roll are"))
    );
}

#[test]
fn a_folder_of_photos_is_a_flight_in_the_order_of_their_times() {
    let files = files(&[
        ("shots/a.jpg", photo("32", "5", 8, &gimbal(180.0, -80.0))),
        ("shots/b.JPG", photo("30", "25", 10, &gimbal(90.0, -90.0))),
        ("shots/c.jpg", photo("31", "5", 9, &gimbal(-179.0, -90.0))),
        ("shots/._b.JPG", vec![1, 2, 3]),
        ("shots/notes.txt", b"none".to_vec()),
    ]);
    let mut folder = read_photos(&files).unwrap();
    let flight = &folder.flight;
    assert_eq!(flight.name, "shots");
    let frames: Vec<_> = flight
        .frames
        .iter()
        .map(|f| (f.time, f.name.as_str()))
        .collect();
    assert_eq!(
        frames,
        [
            (0.0, "shots/b.JPG"),
            (1.25, "shots/c.jpg"),
            (2.25, "shots/a.jpg")
        ]
    );
    let value = |name, time| flight.value(name, time).unwrap();
    // A second of arc is 30.79 m there, and they go north.
    assert!((value(ChannelName::GpsNorth, 2.25) - 2.0 * 30.79).abs() < 0.05);
    assert!(value(ChannelName::GpsEast, 2.25).abs() < 1e-6);
    assert_eq!(value(ChannelName::HeightAboveGround, 0.0), 40.5);
    assert_eq!(value(ChannelName::GpsHeight, 0.0), 150.5);
    // The gimbal rolls by 0.5° about the view: straight down that turns the picture, elsewhere the pitch is
    // asin(sin 10° cos 0.5°).
    assert!((value(ChannelName::Heading, 0.0).to_degrees() - 90.5).abs() < 1e-9);
    assert!((value(ChannelName::Pitch, 2.25).to_degrees() - 9.999_615_317).abs() < 1e-8);
    assert!(value(ChannelName::Roll, 0.0).abs() < 1e-9);
    let origin = flight.frame_on_globe.unwrap().origin;
    assert_eq!(origin.height, 110.0);
    assert!((flight.camera.focal - 24.0 * 500.0 / 43.2666).abs() < 0.01);
    assert!(folder.frames.encoded(1).unwrap().starts_with(&[0xff, 0xd8]));
}

#[test]
fn photos_without_a_place_are_no_flight() {
    let plain = [b"\xff\xd8".to_vec(), segment(0xc0, &[8, 1, 44, 1, 144, 3])].concat();
    assert!(read_photos(&files(&[("a.jpg", plain.clone()), ("b.jpg", plain)])).is_none());
    let one = files(&[("a.jpg", photo("30", "25", 10, ""))]);
    assert!(read_photos(&one).is_none());
}

#[test]
fn frames_among_photos_that_have_no_place_are_told_with_what_would_give_them_one() {
    let bare = [
        b"\xff\xd8".to_vec(),
        segment(0xc0, &[8, 0, 30, 0, 40, 3, 0, 0, 0]),
        segment(0xda, &[0]),
    ];
    let beside = |table: &str| {
        read_photos(&files(&[
            ("a.jpg", photo("30", "0", 10, "")),
            ("b.jpg", photo("31", "0", 11, "")),
            ("of/frame1.jpg", bare.concat()),
            ("of/frame2.jpg", bare.concat()),
            ("of/frame3.jpg", bare.concat()),
            ("of/frame4.png", Vec::new()),
            ("frames.csv", table.as_bytes().to_vec()),
        ]))
    };
    // A table of them is the flight, and two originals beside it are none.
    let rows = [
        "file,lat",
        "\"frame1.jpg\",47",
        "of/frame2.jpg,47",
        "of\\frame3.jpg,47",
    ];
    assert!(beside(&rows.join("\r\n")).is_none());
    let folder = beside(&rows[..3].join("\n")).unwrap();
    assert_eq!(folder.flight.frames.len(), 2);
    let told = |words: &str| folder.notes.iter().any(|note| note.starts_with(words));
    assert!(
        told("3 of 5 photos are of another size"),
        "{:?}",
        folder.notes
    );
    assert!(
        told("3 of the photos left out do not say where"),
        "{:?}",
        folder.notes
    );
}

#[test]
fn photos_of_one_second_are_spread_over_it() {
    let files = files(&[
        ("a.jpg", photo("30", "", 10, "")),
        ("b.jpg", photo("30", "", 9, "")),
        ("c.jpg", photo("31", "", 8, "")),
    ]);
    let folder = read_photos(&files).unwrap();
    let times: Vec<_> = folder.flight.frames.iter().map(|f| f.time).collect();
    assert_eq!(times, [0.0, 0.5, 1.0]);
    assert!(
        folder
            .notes
            .iter()
            .any(|note| note.contains("whole seconds"))
    );
    assert!(folder.flight.channel(ChannelName::Heading).is_none());
}

/// A TIFF has the tags of EXIF in its own directories, and XMP in one of them.
#[test]
fn a_tiff_says_when_where_and_how_it_was_taken() {
    let xmp = format!(
        "<x:xmpmeta><rdf:Description {}/></x:xmpmeta>",
        gimbal(90.0, -88.0)
    );
    let photo_tags = [
        text(exif::DATE_TIME_ORIGINAL, "2024:05:01 10:20:30"),
        (exif::FOCAL_LENGTH, 5, 1, ratio(&[(88, 10)])),
    ];
    let gps_tags = [
        text(exif::LATITUDE_REF, "N"),
        (exif::LATITUDE, 5, 3, ratio(&[(47, 1), (30, 1), (36, 1)])),
        text(exif::LONGITUDE_REF, "E"),
        (exif::LONGITUDE, 5, 3, ratio(&[(8, 1), (15, 1), (0, 1)])),
    ];
    let image = |photo: u32, gps: u32| {
        let short = |value: u16| value.to_le_bytes().to_vec();
        [
            (exif::WIDTH, 3, 1, short(640)),
            (exif::HEIGHT, 3, 1, short(480)),
            text(exif::MODEL, "Multispectral"),
            (exif::XMP, 1, xmp.len() as u32, xmp.clone().into_bytes()),
            (0x8769, 4, 1, photo.to_le_bytes().to_vec()),
            (0x8825, 4, 1, gps.to_le_bytes().to_vec()),
        ]
    };
    // Pixels stand before the directories, beyond what is read of a JPEG.
    let pixels = vec![0; 300_000];
    let first = 8 + pixels.len();
    let at = first + directory(first, &image(0, 0)).len();
    let of_photo = directory(at, &photo_tags);
    let behind = at + of_photo.len();
    let file = [
        b"II*\0".to_vec(),
        (first as u32).to_le_bytes().to_vec(),
        pixels,
        directory(first, &image(at as u32, behind as u32)),
        of_photo,
        directory(behind, &gps_tags),
    ]
    .concat();
    let photo = read_photo(&MemoryBytes::new("a.tif", file.clone())).unwrap();
    assert_eq!((photo.width, photo.height), (640, 480));
    assert_eq!(photo.camera, "Multispectral");
    let place = photo.place.unwrap();
    assert!((place.latitude.to_degrees() - 47.51).abs() < 1e-9);
    assert!((place.longitude.to_degrees() - 8.25).abs() < 1e-9);
    assert_eq!(photo.taken, Some((1_714_558_830, 0.0)));
    assert!((photo.gimbal.unwrap().pitch.to_degrees() + 88.0).abs() < 1e-9);
    assert_eq!(photo.height_above_take_off, Some(40.5));
    assert!((photo.focal_length.unwrap() - 8.8e-3).abs() < 1e-9);
    for end in (0..file.len()).step_by(97) {
        let _ = read_photo(&MemoryBytes::new("a.tif", file[..end].to_vec()));
    }
}

/// A clock that was set when the photo was changed, and the satellites' at which it was taken.
#[test]
fn the_time_of_the_satellites_goes_before_that_of_a_change() {
    let file = |original: Option<&str>| {
        let photo_tags: Vec<Tag> = original
            .map(|time| text(exif::DATE_TIME_ORIGINAL, time))
            .into_iter()
            .collect();
        let gps_tags = [
            (exif::GPS_TIME, 5, 3, ratio(&[(10, 1), (20, 1), (305, 10)])),
            text(exif::GPS_DATE, "2024:05:01"),
        ];
        let image = |photo: u32, gps: u32| {
            [
                (exif::WIDTH, 3, 1, 640_u16.to_le_bytes().to_vec()),
                (exif::HEIGHT, 3, 1, 480_u16.to_le_bytes().to_vec()),
                text(exif::DATE_TIME, "2024:06:30 18:00:00"),
                (0x8769, 4, 1, photo.to_le_bytes().to_vec()),
                (0x8825, 4, 1, gps.to_le_bytes().to_vec()),
            ]
        };
        let at = 8 + directory(8, &image(0, 0)).len();
        let of_photo = directory(at, &photo_tags);
        let behind = at + of_photo.len();
        [
            b"II*\0\x08\0\0\0".to_vec(),
            directory(8, &image(at as u32, behind as u32)),
            of_photo,
            directory(behind, &gps_tags),
        ]
        .concat()
    };
    let taken = |original| {
        let photo = read_photo(&MemoryBytes::new("a.tif", file(original))).unwrap();
        photo.taken
    };
    assert_eq!(taken(None), Some((1_714_558_830, 0.5)));
    assert_eq!(
        taken(Some("2024:05:01 12:20:30")),
        Some((1_714_566_030, 0.0))
    );
}

#[test]
fn a_place_of_which_a_number_is_over_zero_is_left_out_but_for_one_behind_a_fraction() {
    let whole = photo("30", "0", 36, "");
    let own = ratio(&[(30, 1), (0, 1), (36, 1)]);
    let at = whole.windows(own.len()).position(|w| w == own).unwrap();
    let read = |parts: [(u32, u32); 3]| {
        let mut file = whole.clone();
        file[at..at + own.len()].copy_from_slice(&ratio(&parts));
        let photo = read_photo(&MemoryBytes::new("a.jpg", file)).unwrap();
        let latitude = photo.place.map(|place| place.latitude.to_degrees());
        (latitude, photo.doubts.concat())
    };
    assert!((read([(30, 1), (0, 1), (36, 1)]).0.unwrap() + 30.01).abs() < 1e-9);
    assert!((read([(30, 1), (126, 10), (0, 0)]).0.unwrap() + 30.21).abs() < 1e-9);
    assert!((read([(3021, 100), (0, 0), (0, 0)]).0.unwrap() + 30.21).abs() < 1e-9);
    for broken in [
        [(30, 1), (12, 1), (0, 0)],
        [(30, 1), (0, 0), (36, 1)],
        [(30, 1), (36, 0), (36, 1)],
        [(0, 0), (12, 1), (36, 1)],
        [(0, 0); 3],
    ] {
        let (latitude, doubts) = read(broken);
        assert_eq!(latitude, None, "{broken:?}");
        assert!(doubts.contains("over zero"), "{broken:?} {doubts}");
    }
}
