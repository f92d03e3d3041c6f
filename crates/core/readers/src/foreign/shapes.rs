//! Files that no fixed bytes or words tell, but the shape of their contents.

use super::kind::{
    CONVERT, Foreign, GRID, LOG, MODEL, OTHER_FILM, RECEIVER, TO_CSV, TO_GEOJSON, kind,
};
use super::receivers::{is_sbp, is_ubx};
use super::words::PARAMETERS;

/// Shape of bytes or of lines, and the kind that they are then.
type ShapeOfBytes = (fn(&[u8], u64) -> bool, Foreign);
type ShapeOfLines = (fn(&[&str]) -> bool, Foreign);

/// Microseconds since 1970 of telemetry logs: 2005 to 2070.
const STAMPS: std::ops::Range<u64> = 1_104_537_600_000_000..3_155_760_000_000_000;

/// Kind of the file that begins with `head` and has `length` bytes, by its shape.
pub(super) fn of_bytes(head: &[u8], length: u64) -> Option<Foreign> {
    let bytes: &[ShapeOfBytes] = &[
        (
            is_dji_aircraft,
            kind("a flight record of a DJI aircraft (FLY….DAT)", DJI),
        ),
        (
            is_dji_app,
            kind("a flight record of DJI's app (DJIFlightRecord….txt)", DJI),
        ),
        (
            is_mavlink,
            kind(
                "MAVLink messages without times (.raw, .rlog)",
                "open the .tlog that the ground station wrote beside it",
            ),
        ),
        (
            is_cut_tlog,
            kind(
                "a telemetry log (.tlog) that is cut off behind its first time",
                "copy it again from the ground station, if it is still there",
            ),
        ),
        (is_program, kind("a program of Windows", LOG)),
        (
            is_bitmap,
            kind(
                "a picture (BMP)",
                "save it as PNG and open that as a map, with a world file beside it",
            ),
        ),
        (
            is_stream,
            kind("a film (MPEG transport stream)", OTHER_FILM),
        ),
        (is_dbase, kind("the table of a shapefile (.dbf)", TO_CSV)),
        (
            are_tomtom_places,
            kind(
                "places of TomTom (.ov2)",
                "make a GPX of it (gpsbabel -i tomtom) and open that",
            ),
        ),
        (is_drawing, kind("a drawing of AutoCAD (DWG)", TO_GEOJSON)),
        (
            is_ubx,
            kind("a recording of a u-blox receiver (UBX)", RECEIVER),
        ),
        (
            is_sbp,
            kind("a recording of a Swift receiver (SBP)", SBP_ADVICE),
        ),
        (is_usgs, kind("heights of the ground (USGS .dem)", GRID)),
        (is_stl, kind("a model (STL)", MODEL)),
    ];
    bytes
        .iter()
        .find(|(is, _)| is(head, length))
        .map(|(_, is)| *is)
}

const SBP_ADVICE: &str = "make a CSV of it (Swift Console, `sbp2json`) with time, latitude, longitude and height, and open that";
const DJI: &str =
    "it is encrypted: make a CSV of it (AirData, or DatCon and TXTlogToCSVtool) and open that";

/// Kind of a text in small letters, by the shape of its lines.
pub(super) fn of_text(text: &str) -> Option<Foreign> {
    let texts: &[ShapeOfLines] = &[
        (
            are_parameters,
            kind("parameters of an autopilot (.param, .parm)", PARAMETERS),
        ),
        (
            are_rally_points,
            kind("rally points of ArduPilot (.ral)", CONVERT),
        ),
        (are_fence, kind("a fence of ArduPilot (.fen)", CONVERT)),
        (are_faces, kind("a model (OBJ)", MODEL)),
        (
            is_world_file,
            kind(
                "the world file of a picture (.pgw, .jgw, .tfw)",
                "open it together with its picture, as a map",
            ),
        ),
        (
            are_starts,
            kind(
                "places where a simulation of ArduPilot may start (locations.txt)",
                TABLE_OF_PLACES,
            ),
        ),
        (
            are_tomtom_text,
            kind("places of TomTom as text (.asc)", TABLE_OF_PLACES),
        ),
        (
            are_survey_points,
            kind(
                "points of a survey without names of columns (number, easting, northing, height, code)",
                GRID_OF_PLACES,
            ),
        ),
        (
            are_well_known,
            kind("places as well-known text", CONVERT_TABLE),
        ),
    ];
    let mut lines: Vec<&str> = text.lines().map(str::trim).collect();
    if text.len() >= crate::log::HEAD {
        // The last may be cut off.
        lines.pop();
    }
    lines.retain(|line| !line.is_empty() && !line.starts_with('#'));
    let found = texts.iter().find(|(is, _)| !lines.is_empty() && is(&lines));
    found.map(|(_, is)| *is)
}

const TABLE_OF_PLACES: &str = "write its places into a CSV with the columns name, latitude, longitude and altitude and open that in Plan";
const GRID_OF_PLACES: &str = "write the line `name,easting,northing,height,zone` above it, with the zone of UTM in each row, or bring its places to latitude and longitude (QGIS)";
const CONVERT_TABLE: &str = "write a line `WKT` above it, call it .csv, and open it in Plan";

fn has(head: &[u8], at: usize, bytes: &[u8]) -> bool {
    head.get(at..).is_some_and(|rest| rest.starts_with(bytes))
}

fn is_dji_aircraft(head: &[u8], _: u64) -> bool {
    let is_binary = head.iter().any(|byte| *byte < 9);
    is_binary && (has(head, 0, b"BUILD") || has(head, 16, b"BUILD"))
        || has(head, 242, b"DJI_LOG_V3")
}

/// Its first eight bytes say where the details stand, and its eleventh is a version.
fn is_dji_app(head: &[u8], length: u64) -> bool {
    let details = head.first_chunk().map(|bytes| u64::from_le_bytes(*bytes));
    let version = head.get(10);
    details.is_some_and(|at| (12..=length).contains(&at))
        && version.is_some_and(|version| (1..=20).contains(version))
}

fn is_mavlink(head: &[u8], _: u64) -> bool {
    let next =
        |length: u8, around: usize, mark: u8| head.get(usize::from(length) + around) == Some(&mark);
    match head {
        [0xfe, length, ..] => next(*length, 8, 0xfe),
        [0xfd, length, 0, ..] => next(*length, 12, 0xfd),
        _ => false,
    }
}

fn is_cut_tlog(head: &[u8], _: u64) -> bool {
    let time = head.first_chunk().map(|bytes| u64::from_be_bytes(*bytes));
    let is_begun = matches!(head.get(8), Some(0xfe | 0xfd));
    time.is_some_and(|time| STAMPS.contains(&time)) && is_begun && head.len() < 300
}

/// The old header says where the new one stands.
fn is_program(head: &[u8], _: u64) -> bool {
    has(head, 0, b"MZ") && head.len() >= 64 && head[..64].contains(&0)
}

fn is_bitmap(head: &[u8], length: u64) -> bool {
    let size = head.get(2..6).and_then(|bytes| bytes.first_chunk());
    let size = size.map(|bytes| u64::from(u32::from_le_bytes(*bytes)));
    let is_size = size == Some(length) || has(head, 14, &[40, 0, 0, 0]) || size == Some(0);
    has(head, 0, b"BM") && has(head, 6, &[0; 4]) && is_size
}

/// Packets of 188 bytes, or of 192 with their times.
fn is_stream(head: &[u8], length: u64) -> bool {
    let is_of = |first: usize, step: usize| {
        let marks: Vec<_> = head.iter().skip(first).step_by(step).collect();
        marks.len() >= 2 && marks.iter().all(|mark| **mark == 0x47)
    };
    length >= 376 && (is_of(0, 188) || is_of(4, 192))
}

fn is_dbase(head: &[u8], length: u64) -> bool {
    let [
        3 | 0x30 | 0x83 | 0x8b,
        _,
        month,
        day,
        _,
        _,
        _,
        _,
        low,
        high,
        ..,
    ] = head
    else {
        return false;
    };
    let header = u64::from(*low) + 256 * u64::from(*high);
    let is_header = header >= 33 && header <= length && (header % 32 == 1 || header % 32 == 0);
    let is_empty_here = head
        .get(12..28)
        .is_some_and(|rest| rest.iter().all(|b| *b == 0));
    (1..=12).contains(month) && (1..=31).contains(day) && is_header && is_empty_here
}

/// Records of places on the globe, and those that bound the ones behind them: each begins with its kind and its length.
fn are_tomtom_places(head: &[u8], length: u64) -> bool {
    let (mut at, mut count) = (0, 0_u32);
    let number = |at: usize| {
        let bytes = head.get(at..at + 4)?;
        Some(i32::from_le_bytes(bytes.try_into().ok()?))
    };
    while at as u64 != length && at < head.len() {
        let [Some(size), Some(longitude), Some(latitude)] = [1, 5, 9].map(|by| number(at + by))
        else {
            break;
        };
        let is_record = match head[at] {
            1 => size >= 21,
            0 | 2 | 3 => (14..1024).contains(&size),
            _ => false,
        };
        let is_place =
            longitude.unsigned_abs() <= 18_000_000 && latitude.unsigned_abs() <= 9_000_000;
        if !is_record || !is_place {
            return false;
        }
        // Bounds are followed by what they hold.
        at += if head[at] == 1 { 21 } else { size as usize };
        count += u32::from(head.get(at - 1) == Some(&0) || at as u64 >= length);
    }
    count > 0
}

/// The name of its map in letters, then level, pattern, system and zone as four numbers of six letters each (USGS Standards
/// for Digital Elevation Models, record A).
fn is_usgs(head: &[u8], _: u64) -> bool {
    let number = |at: usize| -> Option<i64> {
        let text = std::str::from_utf8(head.get(at..at + 6)?).ok()?;
        text.trim().parse().ok()
    };
    let is_text = head
        .get(..144)
        .is_some_and(|text| text.iter().all(|b| (b' '..=b'~').contains(b)));
    let [level, pattern, system, zone] = [144, 150, 156, 162].map(number);
    let is_in = |value: Option<i64>, range: std::ops::RangeInclusive<i64>| {
        value.is_some_and(|value| range.contains(&value))
    };
    is_text
        && is_in(level, 1..=4)
        && is_in(pattern, 1..=2)
        && is_in(system, 0..=20)
        && zone.is_some()
}

/// Eighty bytes of anything, a number of triangles, and as many of fifty bytes.
fn is_stl(head: &[u8], length: u64) -> bool {
    let count = head.get(80..84).and_then(|bytes| bytes.first_chunk());
    let count = count.map(|bytes| u64::from(u32::from_le_bytes(*bytes)));
    count.is_some_and(|count| count > 0 && 84 + 50 * count == length)
}

fn is_drawing(head: &[u8], _: u64) -> bool {
    has(head, 0, b"AC10")
        && head
            .get(4..6)
            .is_some_and(|v| v.iter().all(u8::is_ascii_digit))
        && head.contains(&0)
}

/// The numbers of a line, if it has nothing else.
fn numbers(line: &str, is_seam: fn(char) -> bool) -> Option<Vec<f64>> {
    let words = line.split(is_seam).filter(|word| !word.is_empty());
    words.map(|word| word.parse().ok()).collect()
}

/// Words with which names of parameters begin.
const GROUPS: [&str; 40] = [
    "acro", "ahrs", "airspeed", "arming", "atc", "arspd", "bat", "batt", "brd", "cal", "cam",
    "cbrk", "com", "compass", "ek", "ekf", "fence", "fltmode", "fs", "fw", "gps", "ins", "lim",
    "log", "mav", "mc", "mis", "mnt", "mot", "mpc", "nav", "pilot", "psc", "rc", "rtl", "sens",
    "serial", "servo", "sysid", "wpnav",
];

/// Lines of a name of an autopilot's parameter and its number, alone or behind system and component.
fn are_parameters(lines: &[&str]) -> bool {
    let is_parameter = |line: &&str| {
        let words: Vec<&str> = line
            .split([',', ' ', '\t', '=', ':'])
            .filter(|word| !word.is_empty())
            .collect();
        let (name, value) = match words[..] {
            [name, value] | [name, value, _] if name.starts_with(char::is_alphabetic) => {
                (name, value)
            }
            [system, component, name, value, kind]
                if [system, component, kind]
                    .iter()
                    .all(|n| n.parse::<u32>().is_ok()) =>
            {
                (name, value)
            }
            _ => return false,
        };
        let is_name = (2..=16).contains(&name.len())
            && name.starts_with(|c: char| c.is_ascii_lowercase())
            && name.chars().all(|c| c.is_ascii_alphanumeric() || c == '_');
        is_name && value.parse::<f64>().is_ok()
    };
    let with_seam = lines.iter().filter(|line| line.contains('_')).count();
    let count = lines.iter().filter(|line| is_parameter(line)).count();
    // Few lines of a name and a number may be of anything, unless their names are those of autopilots.
    let of_autopilots = |line: &&&str| {
        let mut words = line.split(|c: char| !c.is_ascii_alphanumeric());
        words.any(|word| GROUPS.contains(&word.trim_end_matches(|c: char| c.is_ascii_digit())))
    };
    let known = lines.iter().filter(of_autopilots).count();
    let least = if 2 * known >= count { 2 } else { 10 };
    lines.len() >= least && count == lines.len() && 2 * with_seam >= count
}

/// A name and a place a line, with its height and a heading behind: `NAME=latitude,longitude,height,heading`.
fn are_starts(lines: &[&str]) -> bool {
    lines.iter().all(|line| {
        let place = line.split_once('=').map(|(_, place)| place);
        let place = place.and_then(|place| numbers(place, |c| c == ','));
        place.is_some_and(|n| n.len() == 4 && n[0].abs() <= 90.0 && n[1].abs() <= 180.0)
    })
}

/// Longitude, latitude and a name in quotation marks a line, remarks behind semicolons.
fn are_tomtom_text(lines: &[&str]) -> bool {
    let mut places = lines
        .iter()
        .filter(|line| !line.starts_with(';'))
        .peekable();
    places.peek().is_some()
        && places.all(|line| {
            let place = line.split_once('"').map(|(place, _)| place);
            let place = place.and_then(|place| numbers(place, |c| c == ',' || c == ' '));
            let is_place =
                place.is_some_and(|n| n.len() == 2 && n[0].abs() <= 180.0 && n[1].abs() <= 90.0);
            is_place && line.ends_with('"')
        })
}

/// A number or name, easting, northing, height and a code that is no number a line.
fn are_survey_points(lines: &[&str]) -> bool {
    let is_point = |line: &&str| {
        let cells: Vec<&str> = line.split([',', '\t']).map(str::trim).collect();
        let [_, east, north, height, code] = cells[..] else {
            return false;
        };
        let number = |cell: &str| cell.parse::<f64>().ok();
        let is_of_grid = |cell| number(cell).is_some_and(|value| value.abs() > 1000.0);
        is_of_grid(east) && is_of_grid(north) && number(height).is_some() && number(code).is_none()
    };
    lines.len() > 1 && lines.iter().all(is_point)
}

/// Corners and faces of a model: letters that say which, numbers behind them.
fn are_faces(lines: &[&str]) -> bool {
    let words = ["v", "vn", "vt", "f", "o", "g", "s", "usemtl"];
    let first = |line: &&str| {
        line.split_whitespace()
            .next()
            .unwrap_or_default()
            .to_owned()
    };
    let firsts: Vec<String> = lines.iter().map(first).collect();
    let is_there = |word: &str| firsts.iter().any(|first| first == word);
    is_there("v") && firsts.iter().all(|first| words.contains(&first.as_str()))
}

fn are_rally_points(lines: &[&str]) -> bool {
    lines.iter().all(|line| {
        let rest = line.strip_prefix("rally");
        rest.and_then(|rest| numbers(rest, char::is_whitespace))
            .is_some_and(|numbers| (3..=6).contains(&numbers.len()))
    })
}

/// Latitude and longitude a line, the first of which is where to return to; the ring of the others is closed.
fn are_fence(lines: &[&str]) -> bool {
    let places = lines.iter().map(|line| {
        let pair = numbers(line, char::is_whitespace)?;
        let is_place = pair.len() == 2 && pair[0].abs() <= 90.0 && pair[1].abs() <= 180.0;
        is_place.then_some(pair)
    });
    let places: Option<Vec<Vec<f64>>> = places.collect();
    places.is_some_and(|places| places.len() >= 5 && places.last() == places.get(1))
}

/// Six numbers: two steps along each axis, of which that of rows mostly goes down, and a place.
fn is_world_file(lines: &[&str]) -> bool {
    let numbers: Option<Vec<f64>> = lines.iter().map(|line| line.parse().ok()).collect();
    numbers.is_some_and(|n| n.len() == 6 && n[0] > 0.0 && n[3] < 0.0 && n[1].abs() <= n[0].abs())
}

fn are_well_known(lines: &[&str]) -> bool {
    let tags = [
        "point",
        "linestring",
        "polygon",
        "multi",
        "geometrycollection",
    ];
    lines.iter().all(|line| {
        let is_tag = tags.iter().any(|tag| line.starts_with(tag));
        let inside = line
            .split_once('(')
            .map(|(_, rest)| rest.trim_start_matches(['(', ' ']));
        let is_number = |rest: &str| rest.starts_with(|c: char| c.is_ascii_digit() || c == '-');
        is_tag && line.ends_with(')') && inside.is_some_and(is_number)
    })
}

#[cfg(test)]
mod tests {
    use pilotage_base::bytes::MemoryBytes;

    use super::super::foreign_file;

    fn what(head: &[u8]) -> &'static str {
        let source = MemoryBytes::new("a", head);
        foreign_file(&source).map_or("", |is| is.what)
    }

    #[test]
    fn texts_are_named_by_the_shape_of_their_lines() {
        for (text, words) in [
            ("#NOTE: x\nACRO_LOCKING,0\nAHRS_EKF_TYPE,3\n", "parameters"),
            (
                "ACRO_BAL_PITCH   1.000000\nAHRS_EKF_TYPE    3\n",
                "parameters",
            ),
            (
                "# Onboard parameters for Vehicle 1\n#\n1\t1\tBAT_A_PER_V\t36.36\t9\n",
                "parameters",
            ),
            (
                "# no head\n1\t1\tBAT_A_PER_V\t36.36\t9\n1\t1\tBAT_N_CELLS\t4\t6\n",
                "parameters",
            ),
            ("#saved by APM Planner 1.3\n47.0 8.0\n47.1 8.0\n", "fence"),
            (
                "-35.36 149.16\n-35.35 149.16\n-35.35 149.15\n-35.37 149.15\n-35.35 149.16\n",
                "fence",
            ),
            ("RALLY\t-35.36\t149.16\t100\t40\t0\t0\n", "rally"),
            ("RALLY -35.36 149.16 100 40 0 0\n", "rally"),
            ("0.5\n0\n0\n-0.5\n2600000\n1200000\n", "world file"),
            ("ncols 4\nnrows 4\nxllcorner 8\n", "grid of heights"),
            ("<?xml version=\"1.0\"?>\n<TrainingCenterDatabase/>", "TCX"),
            ("<flight-plan xmlns=\"http://www8.garmin.com/\"/>", ".fpl"),
            ("<DivelementsFlightPlanner/>", ".flightplan"),
            ("<?xml version=\"1.0\"?><SimBase.Document/>", ".pln"),
            ("<mission><MISSIONITEM no=\"1\"/></mission>", "INAV"),
            ("{ \"type\" : \"Topology\" }", "TopoJSON"),
            (
                "{\"displayFieldName\":\"\",\"geometryType\":\"esriGeometryPoint\"}",
                "ArcGIS",
            ),
            ("GEOGCS[\"GCS_WGS_1984\",DATUM[]]", "reference system"),
            ("\n\nH Product:Blackbox flight data recorder\n", "blackbox"),
            (
                "\n\n [1] 1 1 \n\nArduCopter V2.9.1\nFree RAM: 1000\n",
                "before 2013",
            ),
            ("POINT (8 47)\nPOINT (8 48)\n", "well-known text"),
            (
                "#NAME=latitude,longitude,absolute-altitude,heading\nOSRF0=37.4003371,-122.0800351,0,353\nCMAC=-35.363261,149.165230,584,353\n",
                "simulation of ArduPilot",
            ),
            (
                "; Readable locations in x.ov2\n;\n8.54100 , 47.37100 , \"Zurich\"\n8.60 , 47.40 , \"B, C\"\n",
                "TomTom as text",
            ),
            (
                "1,465429.756,5246517.201,408.10,GCP\n2,465500.1,5246600.2,409.3,EP\n",
                "points of a survey",
            ),
        ] {
            assert!(
                what(text.as_bytes()).contains(words),
                "{text}: {}",
                what(text.as_bytes())
            );
        }
    }

    #[test]
    fn texts_and_bytes_that_are_something_else_get_no_name() {
        let noise: Vec<u8> = (0..4000_u32)
            .map(|i| (i.wrapping_mul(2_654_435_761) >> 13) as u8)
            .collect();
        for bytes in [
            &b"hello world\nthis is a text\n"[..],
            b"a: 1\nb: 2\n",
            b"Rally the troops\n",
            b"BUILD=release\nHOST=x\n",
            b"MZ,1,2\nMA,2,3\n",
            b"BM 12 is a road\n",
            b"points of view (many)\n",
            b"a=1\nb=2,3\n",
            b"1,2,3,4,x\n2,3,4,5,y\n",
            b"; only a remark\n",
            b"47.0 8.0\n47.1 8.0\n",
            b"speed 3\nheight 4\n",
            b"speed_max 3\nheight_max 4\n",
            b"wp_1,47.5,8.5\nwp_2,47.6,8.6\n",
            b"<?xml version=\"1.0\"?> <!-- by me --> <unknown/>\n",
            &noise,
        ] {
            assert_eq!(
                what(bytes),
                "",
                "{}",
                String::from_utf8_lossy(&bytes[..bytes.len().min(30)])
            );
        }
    }

    #[test]
    fn bytes_without_a_fixed_mark_are_named_by_their_shape() {
        let tlog = [&1_700_000_000_000_000_u64.to_be_bytes()[..], b"\xfe\x09\0"].concat();
        assert!(what(&tlog).contains(".tlog"));
        let stream = [&b"G@\0\x10"[..], &[0xff; 184]].concat().repeat(3);
        assert!(what(&stream).contains("transport stream"));
        let place = [
            &b"\x02\x10\0\0\0"[..],
            &850_000_i32.to_le_bytes(),
            &4_740_000_i32.to_le_bytes(),
            b"Ab\0",
        ]
        .concat();
        let bounds = [&b"\x01\x25\0\0\0"[..], &place[5..13], &place[5..13]].concat();
        assert!(what(&place.repeat(3)).contains("TomTom"));
        assert!(what(&[bounds, place].concat()).contains("TomTom"));
        let mut dbase = vec![3, 124, 5, 1, 2, 0, 0, 0, 65, 0, 20, 0];
        dbase.resize(105, 0);
        assert!(what(&dbase).contains(".dbf"));
        let bitmap = [&b"BM"[..], &54_u32.to_le_bytes(), &[0; 48]].concat();
        assert!(what(&bitmap).contains("BMP"));
        assert!(what(b"BUILD\0\0\0\x55\x34\0").contains("DJI aircraft"));
        assert!(what(&[0xff; 500]).contains("empty memory"));
        assert!(what(b"ULog\x01\x12").contains("cut off"));
    }
}
