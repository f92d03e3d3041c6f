//! Files that are no flight here, named for what they are by their content, and what to do with them.

/// Kind of a file that is not read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Foreign {
    /// Name of the kind, with its article: `an encrypted log of PX4`.
    pub what: &'static str,
    /// Advice to people, as a sentence without its stop.
    pub advice: &'static str,
}

/// Bytes at a place of a file that tell what it is.
struct FileSignature {
    offset: usize,
    bytes: &'static [u8],
    is: Foreign,
}

const fn mark(bytes: &'static [u8], what: &'static str, advice: &'static str) -> FileSignature {
    mark_at(0, bytes, what, advice)
}

const fn mark_at(
    offset: usize,
    bytes: &'static [u8],
    what: &'static str,
    advice: &'static str,
) -> FileSignature {
    FileSignature {
        offset,
        bytes,
        is: Foreign { what, advice },
    }
}

const UNPACK: &str = "unpack it and open what is in it";
const FILM: &str =
    "open it in the page beside the log of its flight; a film alone tells of no flight";
const PHOTO: &str = "put it into a folder with the other photos of the flight and open that";
const TO_MCAP: &str =
    "make an MCAP of it (`mcap convert in out.mcap`, or `ros2 bag convert`) and open that";
const TO_CSV: &str = "save its tables as CSV and open those";
const CONVERT: &str = "it holds routes or landmarks: `pilotage convert`, or open it in Plan";

/// Every mark, in the order in which they are tried.
const MARKS: &[FileSignature] = &[
    mark(
        b"ULogEnc",
        "an encrypted log of PX4 (.ulge)",
        "decrypt it with the private key of its aircraft (PX4's Tools/decrypt_ulog.py) and open the .ulg",
    ),
    mark(b"#ROSBAG V", "a bag of ROS 1", TO_MCAP),
    mark(
        b"SQLite format 3\0",
        "a database of SQLite, as bags of ROS 2 are (.db3)",
        TO_MCAP,
    ),
    mark(
        b"H Product:Blackbox",
        "a blackbox log of Betaflight, INAV or Cleanflight",
        "make a table of it (`blackbox_decode file`) and open the CSV",
    ),
    mark(
        &[0xa3, 0x95, 0x80],
        "a log of ArduPilot or an old one of PX4 (.px4log) whose beginning is damaged",
        "copy it again from the aircraft, if it is still there",
    ),
    mark(
        b"version https://git-lfs",
        "a pointer of Git LFS in place of a file",
        "fetch the file itself (`git lfs pull`) and open that",
    ),
    mark(
        b"/annex/objects/",
        "a pointer of git-annex in place of a file",
        "fetch the file itself (`git annex get`) and open that",
    ),
    mark(&[0x1f, 0x8b], "a file packed with gzip", UNPACK),
    mark(b"BZh", "a file packed with bzip2", UNPACK),
    mark(
        &[0xfd, b'7', b'z', b'X', b'Z', 0],
        "a file packed with xz",
        UNPACK,
    ),
    mark(
        &[0x28, 0xb5, 0x2f, 0xfd],
        "a file packed with Zstandard",
        UNPACK,
    ),
    mark(&[0x04, 0x22, 0x4d, 0x18], "a file packed with LZ4", UNPACK),
    mark(b"7z\xbc\xaf\x27\x1c", "a 7-Zip archive", UNPACK),
    mark(b"Rar!\x1a\x07", "a RAR archive", UNPACK),
    mark(
        b"PK\x03\x04",
        "a zip",
        "give it the ending .zip, and it opens with what is in it",
    ),
    mark_at(257, b"ustar", "a tar archive", UNPACK),
    mark_at(8, b"AVI ", "a film (AVI)", FILM),
    mark_at(
        8,
        b"WAVE",
        "a sound recording",
        "open the log of its flight",
    ),
    mark_at(
        8,
        b"WEBP",
        "a picture (WebP)",
        "save it as JPEG and open its folder",
    ),
    mark_at(
        4,
        b"ftypheic",
        "a photo (HEIC)",
        "save it as JPEG and open its folder",
    ),
    mark_at(
        4,
        b"ftypmif1",
        "a photo (HEIC)",
        "save it as JPEG and open its folder",
    ),
    mark_at(4, b"ftyp", "a film (MP4 or MOV)", FILM),
    mark_at(4, b"moov", "a film (MOV)", FILM),
    mark(&[0x1a, 0x45, 0xdf, 0xa3], "a film (Matroska or WebM)", FILM),
    mark(&[0xff, 0xd8, 0xff], "a photo (JPEG)", PHOTO),
    mark(
        b"\x89PNG\r\n\x1a\n",
        "a picture (PNG)",
        "open it as a map, with a world file beside it",
    ),
    mark(
        b"II*\0",
        "a picture or a map (TIFF)",
        "open it as a map, or its folder as photos",
    ),
    mark(
        b"MM\0*",
        "a picture or a map (TIFF)",
        "open it as a map, or its folder as photos",
    ),
    mark(b"II+\0", "a map (BigTIFF)", "open it as a map"),
    mark(b"GIF8", "a picture (GIF)", "open the log of its flight"),
    mark(b"PMTiles", "a map of tiles (PMTiles)", "open it as a map"),
    mark(b"%PDF", "a document (PDF)", "open the log of its flight"),
    mark(b"PAR1", "a Parquet table", TO_CSV),
    mark(
        b"\x89HDF\r\n\x1a\n",
        "an HDF5 file, as MATLAB 7.3 writes them",
        "save it with `save('file.mat', '-v7')`, or its tables as CSV, and open that",
    ),
    mark(b"\x93NUMPY", "an array of NumPy", TO_CSV),
    mark(
        &[0xd0, 0xcf, 0x11, 0xe0],
        "a workbook of Excel (.xls)",
        TO_CSV,
    ),
    mark_at(
        8,
        b".FIT",
        "an activity of Garmin (FIT)",
        "make a GPX or CSV of it (gpsbabel) and open that",
    ),
    mark(
        &[0xb5, 0x62],
        "a recording of a u-blox receiver (UBX)",
        "make a CSV or GPX of it (u-center, gpsbabel) and open that",
    ),
    mark(
        &[0x7f, b'E', b'L', b'F'],
        "a program",
        "open the log of its flight",
    ),
    mark(b"MZ", "a program of Windows", "open the log of its flight"),
    mark(
        &[0xd4, 0xc3, 0xb2, 0xa1],
        "a recording of a network (pcap)",
        "open the telemetry log that the ground station wrote",
    ),
    mark(
        &[0x0a, 0x0d, 0x0d, 0x0a],
        "a recording of a network (pcapng)",
        "open the telemetry log that the ground station wrote",
    ),
    mark(b"QGC WPL", "a mission of way-points", CONVERT),
];

/// Letters near the beginning of a text that tell what it is, in small letters.
const WORDS: &[(&str, Foreign)] = &[
    (
        " --> ",
        Foreign {
            what: "the subtitles of a film, as DJI writes them beside it (.SRT)",
            advice: "no place and time could be read in it",
        },
    ),
    (
        "rinex version",
        Foreign {
            what: "observations of a satellite receiver (RINEX)",
            advice: "compute positions of them (RTKLIB) and open those as CSV",
        },
    ),
    ("$gp", NMEA),
    ("$gn", NMEA),
    (
        "hfdte",
        Foreign {
            what: "a glider's flight record (IGC)",
            advice: "make a GPX or CSV of it (gpsbabel -i igc) and open that",
        },
    ),
    ("<!doctype html", WEB),
    ("<html", WEB),
    (
        "<gpx",
        Foreign {
            what: "a GPX file",
            advice: CONVERT,
        },
    ),
    (
        "<kml",
        Foreign {
            what: "a KML file",
            advice: CONVERT,
        },
    ),
];

const NMEA: Foreign = Foreign {
    what: "sentences of a satellite receiver (NMEA)",
    advice: "no two places could be read in them: they need GGA or RMC with a fix",
};
const WEB: Foreign = Foreign {
    what: "a web page",
    advice: "what was downloaded is a page about the file, not the file: download it again",
};

/// Kind of the file that begins with `head` ([`HEAD`](crate::log::HEAD) bytes of it are enough) and has `length`
/// bytes; `None` where nothing tells. Its name is not asked.
pub fn foreign(head: &[u8], length: u64) -> Option<Foreign> {
    if length == 0 {
        return Some(Foreign {
            what: "an empty file",
            advice: "copy it again from where it comes from",
        });
    }
    if head.len() >= 16 && head.iter().all(|byte| *byte == 0) {
        return Some(Foreign {
            what: "a file of zeros",
            advice: "its card or its copy was damaged: copy it again",
        });
    }
    let is_there = |mark: &&FileSignature| {
        head.get(mark.offset..)
            .is_some_and(|rest| rest.starts_with(mark.bytes))
    };
    if let Some(mark) = MARKS.iter().find(is_there) {
        return Some(mark.is);
    }
    if let Some(record) = dji(head, length) {
        return Some(record);
    }
    let is_mavlink = matches!(head, [0xfe, length, ..] if usize::from(*length) + 8 < head.len() && head[usize::from(*length) + 8] == 0xfe)
        || matches!(head, [0xfd, length, 0, ..] if usize::from(*length) + 12 < head.len() && head[usize::from(*length) + 12] == 0xfd);
    if is_mavlink {
        return Some(Foreign {
            what: "MAVLink messages without times (.raw, .rlog)",
            advice: "open the .tlog that the ground station wrote beside it",
        });
    }
    let text = String::from_utf8_lossy(head).to_lowercase();
    let is_text = !head.contains(&0);
    let word = WORDS.iter().find(|(word, _)| text.contains(word));
    word.filter(|_| is_text).map(|(_, is)| *is)
}

/// Flight records of DJI: `DJIFlightRecord….txt` of its apps, whose first eight bytes say where the details stand and
/// whose eleventh is a version, and `FLY….DAT` of the aircraft.
fn dji(head: &[u8], length: u64) -> Option<Foreign> {
    let has = |at: usize, bytes: &[u8]| head.get(at..).is_some_and(|rest| rest.starts_with(bytes));
    let is_aircraft = has(16, b"BUILD") || has(242, b"DJI_LOG_V3");
    let details = head.first_chunk().map(|bytes| u64::from_le_bytes(*bytes));
    let is_app = details.is_some_and(|at| (12..=length).contains(&at))
        && head
            .get(10)
            .is_some_and(|version| (1..=20).contains(version));
    let what = match (is_aircraft, is_app) {
        (true, _) => "a flight record of a DJI aircraft (FLY….DAT)",
        (false, true) => "a flight record of DJI's app (DJIFlightRecord….txt)",
        (false, false) => return None,
    };
    Some(Foreign {
        what,
        advice: "it is encrypted: make a CSV of it (AirData, or DatCon and TXTlogToCSVtool) and open that",
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn what(head: &[u8]) -> &'static str {
        foreign(head, head.len() as u64).map_or("", |is| is.what)
    }

    #[test]
    fn a_file_is_named_for_what_is_in_it() {
        let with = |at: usize, bytes: &[u8]| [&vec![1; at][..], bytes, &[9; 40]].concat();
        for (head, words) in [
            (b"ULogEnc\x01".to_vec(), "encrypted"),
            (b"#ROSBAG V2.0\n".to_vec(), "ROS 1"),
            (b"SQLite format 3\0".to_vec(), "ROS 2"),
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
            (with(16, b"BUILD"), "DJI aircraft"),
            (b"<!DOCTYPE html>".to_vec(), "web page"),
            (Vec::new(), "empty"),
            (vec![0; 64], "zeros"),
        ] {
            assert!(what(&head).contains(words), "{words}: {}", what(&head));
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
