//! Photos of several makers and cameras, made here.

use super::tests::{files, gimbal, photo};
use super::*;
use pilotage_base::bytes::MemoryBytes;

#[test]
fn the_gimbal_of_every_maker_is_read_by_its_namespace() {
    let dji = "xmlns:d=\"http://www.dji.com/drone-dji/1.0/\" d:GimbalYawDegree=\"30\" d:GimbalPitchDegree=\"-90\" \
               d:GimbalRollDegree=\"0.5\" d:RelativeAltitude=\"+81.5\"";
    let autel = dji.replace(
        "http://www.dji.com/drone-dji/1.0/",
        "http://www.autelrobotics.com/drone/1.0/",
    );
    let parrot = "xmlns:p=\"http://www.parrot.com/drone-parrot/1.0/\" p:CameraYawDegree=\"30\" p:CameraPitchDegree=\"-90\" \
                  p:CameraRollDegree=\"0.5\" xmlns:c=\"http://pix4d.com/camera/1.0/\" c:AboveGroundAltitude=\"815/10\"";
    let sense_fly = "xmlns:Camera=\"http://ns.sensefly.com/Camera/1.0/\" Camera:Yaw=\"30\" Camera:Pitch=\"0\" Camera:Roll=\"0.5\" \
                     Camera:AboveGroundAltitude=\"81.5\"";
    for xmp in [dji, &autel, parrot, sense_fly] {
        let photo = read_photo(&MemoryBytes::new("a.jpg", photo("30", "25", 10, xmp))).unwrap();
        let gimbal = photo.gimbal.expect(xmp);
        let degrees = [gimbal.roll, gimbal.pitch, gimbal.yaw].map(f64::to_degrees);
        for (found, wanted) in degrees.iter().zip([0.5, -90.0, 30.0]) {
            assert!((found - wanted).abs() < 1e-9, "{xmp}: {degrees:?}");
        }
        assert_eq!(photo.height_above_take_off, Some(81.5), "{xmp}");
        let pose = photo_pose(&photo);
        let degrees = [Some(pose.roll), pose.heading].map(|a| a.map_or(f64::NAN, f64::to_degrees));
        // Straight down a roll about the view turns the picture; one about its top leans it.
        let expected = if xmp == sense_fly {
            [0.5, 30.0]
        } else {
            [0.0, 30.5]
        };
        for (found, wanted) in degrees.iter().zip(expected) {
            assert!((found - wanted).abs() < 1e-9, "{xmp}: {degrees:?}");
        }
    }
}

#[test]
fn of_two_cameras_that_with_most_photos_is_the_flight_and_the_other_is_told() {
    let other = |seconds: &str, north: u32| {
        let bytes = photo(seconds, "0", north, &gimbal(90.0, -90.0));
        let at = bytes.windows(5).position(|w| w == b"Test\0").unwrap();
        let mut bytes = bytes;
        bytes[at..at + 4].copy_from_slice(b"Hand");
        bytes
    };
    let of_drone = |seconds: &str, north: u32| photo(seconds, "0", north, &gimbal(90.0, -90.0));
    let folder = read_photos(&files(&[
        ("shots/a.jpg", of_drone("30", 10)),
        ("shots/b.jpg", of_drone("31", 9)),
        ("shots/c.jpg", other("32", 8)),
        ("shots/d.jpg", of_drone("33", 7)),
    ]));
    let folder = folder.unwrap();
    assert_eq!(folder.flight.frames.len(), 3);
    let is_told = |note: &String| note.contains("1 by Hand");
    assert!(folder.notes.iter().any(is_told), "{:?}", folder.notes);
}

#[test]
fn of_two_lenses_that_take_one_size_one_is_the_flight() {
    let zoomed = |mut bytes: Vec<u8>| {
        // FocalLengthIn35mmFilm (0xa405) as one number of two bytes.
        let wide = [0x05, 0xa4, 3, 0, 1, 0, 0, 0, 24, 0];
        let at = bytes.windows(10).position(|w| w == wide).unwrap();
        bytes[at + 8] = 162;
        bytes
    };
    let made: Vec<(String, Vec<u8>)> = (0..10_u32)
        .map(|i| {
            let bytes = photo(&format!("{}", 30 + i), "0", 30 - i, &gimbal(90.0, -90.0));
            let of_wide = (format!("DJI_{i:04}_W.JPG"), bytes.clone());
            if i < 6 {
                of_wide
            } else {
                (format!("DJI_{i:04}_Z.JPG"), zoomed(bytes))
            }
        })
        .collect();
    let made: Vec<(&str, Vec<u8>)> = made.iter().map(|(n, b)| (n.as_str(), b.clone())).collect();
    let folder = read_photos(&files(&made)).unwrap();
    assert_eq!(folder.flight.frames.len(), 6);
    let is_told = |note: &String| note.contains("4 of 162 mm");
    assert!(folder.notes.iter().any(is_told), "{:?}", folder.notes);
}

#[test]
fn a_photo_of_another_year_takes_only_itself() {
    let with_year = |seconds: &str, north: u32, year: &[u8; 4]| {
        let mut bytes = photo(seconds, "0", north, &gimbal(90.0, -90.0));
        let at = bytes.windows(5).position(|w| w == b"2024:").unwrap();
        bytes[at..at + 4].copy_from_slice(year);
        bytes
    };
    let folder = read_photos(&files(&[
        ("a.jpg", with_year("30", 10, b"1970")),
        ("b.jpg", with_year("31", 9, b"2024")),
        ("c.jpg", with_year("35", 8, b"2024")),
    ]));
    let folder = folder.unwrap();
    let times: Vec<f64> = folder
        .flight
        .frames
        .iter()
        .map(|frame| frame.time)
        .collect();
    assert_eq!(times, [0.0, 4.0]);
    assert!(
        folder
            .notes
            .iter()
            .any(|note| note.contains("another day than the rest"))
    );
}

#[test]
fn photos_without_places_say_which_tags_lack() {
    let nowhere = files(&[("a.jpg", b"none".to_vec())]);
    assert!(
        photos_lack(nowhere.as_ref())
            .unwrap()
            .contains("can be read")
    );
    let one = files(&[("a.jpg", photo("30", "0", 1, ""))]);
    assert!(photos_lack(one.as_ref()).unwrap().contains("GPSLatitude"));
    assert_eq!(photos_lack(files(&[]).as_ref()), None);
}
