//! Files that are no flight here, named for what they are by their content, and what to do with them.
//!
//! A new kind is a row: of `signatures` where bytes at a place tell it, of `words` where words of its text do, of
//! `archives` where names within do (zips, databases, old documents of Office, films), of `endings` where nothing in it does.

mod archives;
mod endings;
mod kind;
mod receivers;
mod shapes;
mod signatures;
mod words;

use pilotage_base::bytes::ByteSource;

use crate::log::HEAD;
use kind::{AGAIN, kind};

pub use kind::Foreign;

/// Kind of a file by its content, or by the ending of its name where nothing in such files tells; `None` where neither does.
pub fn foreign_file(source: &dyn ByteSource) -> Option<Foreign> {
    let length = source.length();
    let head = source.read(0, (HEAD as u64).min(length) as usize).ok()?;
    archives::within(&head, source)
        .or_else(|| of_beginning(&head, length))
        .or_else(|| endings::of(source.name(), &head))
}

/// Kind of the file that begins with `head` ([`HEAD`] bytes of it are enough) and has `length` bytes; `None` where nothing
/// tells.
fn of_beginning(head: &[u8], length: u64) -> Option<Foreign> {
    if length == 0 {
        return Some(kind("an empty file", AGAIN));
    }
    if head.len() >= 16 && head.iter().all(|byte| *byte == 0) {
        return Some(kind(
            "a file of zeros",
            "its card or its copy was damaged: copy it again",
        ));
    }
    if head.len() >= 16 && head.iter().all(|byte| *byte == 0xff) {
        return Some(kind(
            "a file of empty memory (all bytes are 0xFF)",
            "nothing was written into it: copy it again",
        ));
    }
    signatures::of(head)
        .or_else(|| shapes::of_bytes(head, length))
        .or_else(|| {
            let text = text(head)?;
            words::of(&text).or_else(|| shapes::of_text(&text))
        })
}

/// The beginning of a text, in small letters; `None` of bytes that are none.
fn text(head: &[u8]) -> Option<String> {
    if let Some(wide) = pilotage_base::text::of_utf_16(head) {
        return Some(wide.to_lowercase());
    }
    let is_text = !head.contains(&0);
    is_text.then(|| String::from_utf8_lossy(head).to_lowercase())
}

#[cfg(test)]
mod tests {
    use pilotage_base::bytes::MemoryBytes;

    use super::*;

    fn what(head: &[u8]) -> &'static str {
        let source = MemoryBytes::new("a", head);
        foreign_file(&source).map_or("", |is| is.what)
    }

    #[test]
    fn a_file_is_named_for_what_is_in_it() {
        let with = |at: usize, bytes: &[u8]| [&vec![1; at][..], bytes, &[9; 40]].concat();
        for (head, words) in [
            (b"ULogEnc\x01".to_vec(), "encrypted"),
            (b"#ROSBAG V2.0\n".to_vec(), "ROS 1"),
            (b"SQLite format 3\0".to_vec(), "SQLite"),
            (b"\xd3\0\x13\x3e\xd0".to_vec(), "RTCM"),
            (b"\xd3\x01\x2a\x43\x50".to_vec(), "RTCM"),
            (b"\x7e\0\x81\x41\xdb\xd0\x08\x02\xb3\x8b\x7e".to_vec(), "GDL 90"),
            (b"A\r\n4\r\nACFT, Aircraft/".to_vec(), "X-Plane"),
            (b"\0\x01\0\0Standard Jet DB\0".to_vec(), "Access"),
            (b"RIFF\xf0\0\0\0AVI LIST".to_vec(), "film"),
            (b"\0\0\0\x18ftypmp42".to_vec(), "film"),
            (b"\xff\xd8\xff\xe1".to_vec(), "JPEG"),
            (b"\x1f\x8b\x08".to_vec(), "gzip"),
            (with(257, b"ustar"), "tar"),
            (
                b"H Product:Blackbox flight data recorder by Nicholas Sherlock\n".to_vec(),
                "blackbox",
            ),
            (b"1\n00:00:00,000 --> 00:00:00,033\n".to_vec(), "subtitles"),
            (b"$GPGGA,1,2\r\n".to_vec(), "NMEA"),
            (
                b"1\t120633.0\t[2314]\t 10,N\t 20,E\t 190,V\t-33.85,Lat\t18.42,Lon\t150.0,Ellh\t0.01, 0.01, 0.02\t50,Q\n".to_vec(),
                "receiver of DJI",
            ),
            (b"#BESTPOSA,COM1,0,55.0,FINESTEERING\r\n".to_vec(), "NovAtel"),
            (with(16, b"BUILD"), "DJI aircraft"),
            (
                b"OziExplorer Map Data File Version 2.2\r\n".to_vec(),
                "where a picture lies",
            ),
            (
                b"OziExplorer Track Point File Version 2.1\r\n".to_vec(),
                "a track of OziExplorer",
            ),
            (
                b"2015-03-03T11:54:05.776,FE,1C,7D, 1, 1,1E,mavlink_attitude_t,time_boot_ms,490309,roll,0.1,,Len,36\n".to_vec(),
                "Mission Planner",
            ),
            (
                b"FileType=text/acmi/tacview\nFileVersion=2.2\n".to_vec(),
                "Tacview",
            ),
            (
                b"2024-05-01 10:00:00.00: ATTITUDE {time_boot_ms : 94705, roll : 0.1}\n".to_vec(),
                "pymavlink",
            ),
            (b"pitch:0;roll:1;yaw:2;vgx:0;vgy:0;vgz:0;\r\n".to_vec(), "Tello"),
            (b"!table\n!version 300\n".to_vec(), "MapInfo"),
            (b"I\n1100 Version\nCYCLE 1710\n".to_vec(), "X-Plane"),
            (b"I\r\n3 version\r\n1\r\n4\r\n".to_vec(), "X-Plane"),
            (b"G  WGS 84\r\nU  1\r\n".to_vec(), "CompeGPS"),
            (
                b"$FLYS,1\r\n$COL,IMU,time,wx,wy,wz\r\n".to_vec(),
                "FlySight",
            ),
            (
                b"<?xml version=\"1.0\"?><rss version=\"2.0\">".to_vec(),
                "GeoRSS",
            ),
            (b"<!DOCTYPE html>".to_vec(), "web page"),
            (b"[ {\"t\": 1}, {\"t\": 2} ]".to_vec(), "JSON of no kind"),
            (b"msid\0\0\0\0".to_vec(), "MrSID"),
            (b"NITF02.10".to_vec(), "NITF"),
            (b"DSBB\x02\0".to_vec(), "Surfer"),
            (b"\0\0\0\x0d\x0a\x09OSMHeader\x18".to_vec(), "OpenStreetMap"),
            (b"AC W\nAN WAVE\nAL FL100\nAH FL195\n".to_vec(), "OpenAir"),
            (
                b"NROWS 4\nNCOLS 4\nNBITS 8\nBYTEORDER I\nLAYOUT BIL\n".to_vec(),
                "header of a grid",
            ),
            (
                b"OTTAWA W, ON".iter().copied().chain([b' '; 132]).chain(*b"     1     1     0     0   0.0").collect(),
                "USGS",
            ),
            (b"v 1.0 2.0 3.0\nv 1 1 1\nv 3 2 1\nf 1 2 3\n".to_vec(), "OBJ"),
            (b"\x0e\x03\x13\x01\0".to_vec(), "HDF 4"),
            (
                [&[7; 80][..], &1_u32.to_le_bytes(), &[3; 50]].concat(),
                "STL",
            ),
            (Vec::new(), "empty"),
            (vec![0; 64], "zeros"),
        ] {
            assert!(what(&head).contains(words), "{words}: {}", what(&head));
        }
    }

    /// Endings that a regular expression of a script of the page lists: `const NAME = /\.(mp4|mov)$/i`.
    fn endings_in<'s>(script: &'s str, name: &str) -> Vec<&'s str> {
        let list = script.split_once(&format!("const {name} = /\\.("));
        let list = list.and_then(|(_, list)| list.split_once(")$/i"));
        list.expect("a list of endings").0.split('|').collect()
    }

    #[test]
    fn a_film_that_the_page_does_not_take_is_to_be_converted_to_one_that_it_takes() {
        let decoded = endings_in(include_str!("../../../../../www/video.js"), "FILM");
        let by_pieces = endings_in(include_str!("../../../../../www/files.js"), "PIECES");
        for ending in crate::gpmf::FILMS {
            assert!(
                decoded.contains(&ending) || by_pieces.contains(&ending),
                "{ending}"
            );
        }
        assert!(decoded.contains(&"mp4"), "{decoded:?}");
        let taken = |head: &[u8]| {
            let found = foreign_file(&MemoryBytes::new("a", head)).expect("a film");
            !found.sentence("a").contains("Convert it to MP4")
        };
        for other in [
            &b"RIFF\xf0\0\0\0AVI LIST"[..],
            b"FLV\x01\x05\0\0\0\x09",
            b"\0\0\x01\xba\x44\0\x04\0",
            b"\0\0\0\x01\x67\x42\0\x1e",
        ] {
            assert!(!taken(other), "{other:?}");
        }
        for film in [&b"\0\0\0\x18ftypmp42"[..], b"\x1a\x45\xdf\xa3\x9f\x42"] {
            assert!(taken(film), "{film:?}");
        }
    }

    #[test]
    fn what_is_not_known_has_no_name_and_names_nothing_wrongly() {
        for head in [
            &b"time,lat,lon\n0,47,8\n"[..],
            b"{\"pilotage_file\": 2}",
            b"\x07\x11\x22",
        ] {
            assert_eq!(what(head), "");
        }
    }
}
