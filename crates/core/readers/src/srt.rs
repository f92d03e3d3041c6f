//! The subtitles that DJI's aircraft write beside a film, as a flight: position, height and gimbal at the times of its
//! frames.

use std::collections::BTreeMap;
use std::sync::Arc;

use crate::beside_log::{BesideLogError, pictures_counted_from};
use crate::folder::{FlightFolder, FolderError, decoded};
use crate::gimbal::looking_down;
use crate::text_tables::{first_flight, flight_of_table, table};
use pilotage_base::files::FileSet;
use pilotage_base::frames::units::METRES_PER_FOOT;
use pilotage_base::frames::{Attitude, wrap_pi};
use pilotage_base::text::by_count;
use pilotage_flight::ChannelName;

/// Columns of the table, each with the names that firmware has given to its value in subtitles.
const VALUES: [(&str, &[&str]); 7] = [
    ("latitude [deg]", &["latitude", "lat"]),
    (
        "longitude [deg]",
        &["longitude", "longtitude", "lon", "lng"],
    ),
    (
        "height above takeoff [m]",
        &["rel_alt", "barometer", "hb", "h"],
    ),
    ("altitude msl [m]", &["abs_alt", "altitude", "alt"]),
    ("heading [deg]", &["gb_yaw"]),
    ("pitch [deg]", &["gb_pitch"]),
    ("roll [deg]", &["gb_roll"]),
];
const LATITUDE: usize = 0;
const LONGITUDE: usize = 1;
const HEIGHT: usize = 2;
const ALTITUDE: usize = 3;
const HEADING: usize = 4;
const PITCH: usize = 5;
const ROLL: usize = 6;

/// Ending of subtitles.
const ENDING: &str = ".srt";

/// The flight that subtitles among `files` tell of, with the frames of their film ([`crate::beside_log`]) at the film's
/// own times; `None` if no subtitles have places in them. Of several films the first is taken, and that is a note.
///
/// # Errors
/// Subtitles of which no flight can be made, or a table of frames that cannot be read.
pub fn flight_of_subtitles(files: &Arc<dyn FileSet>) -> Result<Option<FlightFolder>, FolderError> {
    let with_frames = |name: &str, bytes: &[u8]| {
        let film = of_film(name, bytes)?;
        film.map(|(folder, begins)| with_frames_of_film(name, folder, begins, files))
            .transpose()
    };
    let because = "it belongs to another film";
    first_flight(files.as_ref(), ENDING, because, with_frames)
}

/// The flight of a film that begins at that second of it, with the frames that lie beside it.
pub(crate) fn with_frames_of_film(
    name: &str,
    mut folder: FlightFolder,
    begins: f64,
    files: &Arc<dyn FileSet>,
) -> Result<FlightFolder, FolderError> {
    let zero = folder.flight.span().0 - begins;
    let frames = pictures_counted_from(zero, Some(name), &mut folder.flight, files);
    let broken = |cause: BesideLogError| FolderError::File {
        file: name.to_owned(),
        cause: cause.to_string(),
    };
    let (frames, notes) = frames.map_err(broken)?;
    if let Some(frames) = frames {
        folder.frames = frames;
    }
    folder.notes.extend(notes);
    // Pitch is that of the camera itself.
    if folder.flight.channel(ChannelName::Pitch).is_some() {
        folder.flight.camera.mount_deviation = 0.0;
    }
    Ok(folder)
}

/// The flight that subtitles tell of; `None` if `bytes` are no subtitles with places in them.
///
/// Times are seconds of the film. Heading, pitch and roll are those of the camera, where they are told; pitch 0 looks
/// straight down, as for photos.
///
/// # Errors
/// Subtitles of which no flight can be made, as the tables of a flight.
pub fn read_srt(name: &str, bytes: &[u8]) -> Result<Option<FlightFolder>, FolderError> {
    Ok(of_film(name, bytes)?.map(|(folder, _)| folder))
}

/// That flight, and the second of the film at which it begins.
fn of_film(name: &str, bytes: &[u8]) -> Result<Option<(FlightFolder, f64)>, FolderError> {
    let bytes = decoded(bytes);
    let Some((table, begins, notes)) = table_of(&String::from_utf8_lossy(&bytes)) else {
        return Ok(None);
    };
    let folder = flight_of_table(name, table, notes)?;
    Ok(folder.map(|folder| (folder, begins)))
}

/// Table with a line for each subtitle with a place, the time of the first, and what people should know of it.
fn table_of(text: &str) -> Option<(String, f64, Vec<String>)> {
    let mut rows: Vec<(f64, [Option<f64>; 7])> = Vec::new();
    let (mut cues, mut time, mut words, mut before) = (0, None, String::new(), String::new());
    let mut end = |time: Option<f64>, words: &str| {
        let Some(time) = time else { return };
        cues += 1;
        let values = values(words);
        let place = values[LATITUDE].zip(values[LONGITUDE]);
        if place.is_some_and(|place| place != (0.0, 0.0)) {
            rows.push((time, values));
        }
    };
    for line in text.lines() {
        if let Some((start, _)) = line.split_once("-->") {
            end(time, &words);
            time = seconds(start);
            before = std::mem::take(&mut words);
        } else {
            words.push_str(line);
            words.push('\n');
        }
    }
    let is_cut = is_cut(text, &before, words.trim_end());
    if !is_cut {
        end(time, &words);
    }
    if rows.len() < 2 {
        return None;
    }
    let has_attitude = rows.iter().any(|(_, values)| values[PITCH].is_some());
    let mut notes = vec!["times are those of the film beside it".to_owned()];
    if has_attitude {
        notes.push("heading, pitch and roll are those of the camera's gimbal".to_owned());
    }
    let has = |value: usize| rows.iter().any(|(_, values)| values[value].is_some());
    if has(ALTITUDE) && !has(HEIGHT) && !text.contains("abs_alt") {
        // Firmware has written both under that name.
        notes.push(
            "its subtitles do not say whether their altitude counts from the sea or from the take-off: it is taken for \
             that above the sea"
                .to_owned(),
        );
    }
    if is_cut {
        notes.push(
            "its last subtitle has no end and was left out: the file may be cut off".to_owned(),
        );
    }
    if rows.len() < cues {
        notes.push(format!(
            "{} of {cues} subtitles {} left out",
            cues - rows.len(),
            by_count(
                cues - rows.len(),
                "has no place and was",
                "have no place and were"
            )
        ));
    }
    let begins = rows.first()?.0;
    let rows: Vec<_> = (rows.into_iter())
        .map(|(time, values)| (format!("{time:.3}"), values))
        .collect();
    let columns = VALUES.map(|(column, _)| column);
    Some((table("time [s]", columns, &rows), begins, notes))
}

/// Whether a text ends within its last subtitle: without the end of a line, in a number or in other words than the
/// subtitle before it.
fn is_cut(text: &str, before: &str, words: &str) -> bool {
    // Behind the words of a subtitle stands the number of the next one.
    let is_number = |c: char| c.is_ascii_digit() || c.is_whitespace() || "+-.".contains(c);
    let plain = |text: &str| text.replace(is_number, "");
    !text.ends_with(['\n', '\r', '\0'])
        && (words.ends_with(|c: char| c.is_ascii_digit()) || plain(words) != plain(before))
}

/// Seconds of `00:01:02,033`.
fn seconds(text: &str) -> Option<f64> {
    let text = text.trim().replace(',', ".");
    let mut parts = text.split(':');
    let mut next = || parts.next()?.trim().parse::<f64>().ok();
    let (hours, minutes, seconds) = (next()?, next()?, next()?);
    Some(hours * 3600.0 + minutes * 60.0 + seconds)
}

/// The values in the words of a subtitle: `[latitude: 47.1]`, `[rel_alt: 1.5 abs_alt: 440]`, `BAROMETER:91.2`,
/// `GPS (8.5, 47.1, 15)` with the longitude first and satellites last, `GPS(47.1, 8.5, 0.0M) BAROMETER(91.2)` with the latitude
/// first and a height last, `H 20.0m`, `G.PRY (-90.0°, 0.0°, 90.0°)`, and Autel's `GPS(W: 8.5, N: 47.1, 20.00m)` with the
/// height above take-off last.
fn values(words: &str) -> [Option<f64>; 7] {
    let plain = with_points(&words.to_lowercase());
    let seam = |c: char| c.is_whitespace() || "[]<>,".contains(c);
    // `name: value` may have a blank behind the colon.
    let plain = plain.replace(": ", ":").replace(" :", ":");
    let mut found: BTreeMap<&str, f64> = BTreeMap::new();
    let mut before = "";
    for part in plain.split(seam).filter(|part| !part.is_empty()) {
        let (name, value) = part.split_once(':').unwrap_or((before, part));
        if let Some(value) = amount(value) {
            found.entry(name).or_insert(value);
        }
        before = part;
    }
    let mut values =
        VALUES.map(|(_, names)| names.iter().find_map(|name| found.get(name).copied()));
    if values[LATITUDE].zip(values[LONGITUDE]).is_none()
        && let Some(inside) = in_brackets(&plain, "gps")
    {
        let parts: Vec<&str> = inside.split(',').map(str::trim).collect();
        let order = if is_latitude_first(&parts) {
            [LATITUDE, LONGITUDE]
        } else {
            [LONGITUDE, LATITUDE]
        };
        for (place, usual) in parts.iter().zip(order) {
            if let Some((index, value)) = axis(place, usual) {
                values[index] = Some(value);
            }
        }
        let barometer = in_brackets(&plain, "barometer").and_then(amount);
        values[HEIGHT] = values[HEIGHT].or(barometer);
        let last = parts.get(2).copied().unwrap_or("");
        if last.ends_with(['m', 't']) {
            values[HEIGHT] = values[HEIGHT].or(amount(last));
        } else if last.contains('.') {
            values[ALTITUDE] = values[ALTITUDE].or(amount(last));
        }
    }
    if values[PITCH].is_none()
        && let Some(inside) = in_brackets(&plain, "g.pry")
    {
        let mut angles = inside.split(',').map(|angle| {
            angle
                .trim()
                .trim_end_matches('°')
                .trim()
                .parse::<f64>()
                .ok()
        });
        values[PITCH] = angles.next().flatten();
        values[ROLL] = angles.next().flatten();
        values[HEADING] = angles.next().flatten();
    }
    if let Some(pitch) = values[PITCH] {
        let radians = |index: usize| values[index].unwrap_or(0.0).to_radians();
        let camera = looking_down(Attitude {
            roll: radians(ROLL),
            pitch: pitch.to_radians(),
            yaw: radians(HEADING),
        });
        values[PITCH] = Some(in_degrees(camera.pitch));
        for (index, angle) in [(ROLL, camera.roll), (HEADING, camera.yaw)] {
            values[index] = values[index].map(|_| in_degrees(wrap_pi(angle)));
        }
    }
    values
}

/// Degrees without what radians between leave of them.
fn in_degrees(angle: f64) -> f64 {
    (1e6 * angle.to_degrees()).round() / 1e6
}

/// Whether the latitude is the first of `GPS(…)`: a number beyond 90 is the longitude, and firmware that writes a height last,
/// as of the Matrice 300 and the Avata 2, has the latitude first; where satellites are counted last, the longitude is.
fn is_latitude_first(parts: &[&str]) -> bool {
    let is_beyond = |at: usize| {
        let part = parts.get(at).map(|part| part.trim_end_matches('°'));
        let number = part.and_then(|part| part.parse::<f64>().ok());
        number.is_some_and(|number| number.abs() > 90.0)
    };
    let last = parts.get(2).copied().unwrap_or("");
    match (is_beyond(0), is_beyond(1)) {
        (true, _) => false,
        (_, true) => true,
        _ => last.ends_with('m') || last.contains('.'),
    }
}

/// The words with a point for the decimal comma of `latitude: 47,1`.
fn with_points(words: &str) -> String {
    let mut pointed = String::with_capacity(words.len());
    let mut is_behind_colon = false;
    let mut letters = words.chars().peekable();
    while let Some(letter) = letters.next() {
        let is_between = pointed.ends_with(|c: char| c.is_ascii_digit())
            && letters.peek().is_some_and(char::is_ascii_digit);
        let is_decimal = letter == ',' && is_behind_colon && is_between;
        is_behind_colon = match letter {
            ':' => true,
            '0'..='9' | '-' | ' ' => is_behind_colon,
            _ => false,
        };
        pointed.push(if is_decimal { '.' } else { letter });
    }
    pointed
}

/// The number of `12.5`, `12.5m` in metres, `41.0ft` in metres, `47.1°`, `33.9s` and `70.6°w` in degrees north and east.
fn amount(text: &str) -> Option<f64> {
    let text = text.trim_end_matches('°');
    let number = text.trim_end_matches(|c: char| c.is_ascii_lowercase());
    let factor = match &text[number.len()..] {
        "" | "m" | "n" | "e" => 1.0,
        "s" | "w" => -1.0,
        "ft" => METRES_PER_FOOT,
        _ => return None,
    };
    let number = number.trim_end_matches('°').trim();
    Some(number.parse::<f64>().ok()? * factor)
}

/// Text in round brackets behind a word.
fn in_brackets<'a>(text: &'a str, word: &str) -> Option<&'a str> {
    let (_, rest) = text.split_once(word)?;
    let rest = rest.trim_start_matches([' ', ':']).strip_prefix('(')?;
    rest.split_once(')').map(|(inside, _)| inside)
}

/// A coordinate and which of both it is: as its letter says (`w:8.5`, `w:8.5°`), else the usual one.
fn axis(text: &str, usual: usize) -> Option<(usize, f64)> {
    let text = text.trim_end_matches('°');
    let Some((letter, value)) = text.split_once(':') else {
        return Some((usual, text.parse().ok()?));
    };
    let value: f64 = value.trim().parse().ok()?;
    match letter.trim() {
        "n" => Some((LATITUDE, value)),
        "s" => Some((LATITUDE, -value)),
        "e" => Some((LONGITUDE, value)),
        "w" => Some((LONGITUDE, -value)),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use pilotage_base::files::MemoryFiles;
    use pilotage_flight::ChannelName;
    use pilotage_raster::raster::{Picture, encode_png};

    fn film(words: impl Fn(usize) -> String) -> String {
        let cue = |i: usize| {
            let time = |i: usize| format!("00:00:{:02},{:03}", i / 10, i % 10 * 100);
            format!(
                "{}\n{} --> {}\n{}\n\n",
                i + 1,
                time(i),
                time(i + 1),
                words(i)
            )
        };
        (0..50).map(cue).collect()
    }

    #[test]
    fn an_altitude_that_may_count_from_the_take_off_is_told() {
        let told = |height: &str| {
            let text = film(|i| {
                format!(
                    "[latitude: {:.6}] [longtitude: 8.5] {height}",
                    47.0 + 1e-6 * i as f64
                )
            });
            let folder = read_srt("a.SRT", text.as_bytes()).unwrap().unwrap();
            folder.notes.iter().any(|n| n.contains("from the take-off"))
        };
        assert!(told("[altitude: 43.1]"));
        assert!(!told("[rel_alt: 43.1 abs_alt: 480.1]"));
        assert!(!told("[altitude: 480.1] BAROMETER:43.1"));
    }

    #[test]
    fn the_latitude_is_first_where_a_height_is_last() {
        let place = |words: &str| {
            let values = values(words);
            (values[LATITUDE], values[LONGITUDE], values[HEIGHT])
        };
        for (words, right) in [
            (
                "GPS(-41.3899,74.0177,0.0M) BAROMETER:97.7M",
                (-41.3899, 74.0177, 97.7),
            ),
            ("GPS(36.5,-6.1,0.0M) BAROMETER: 3.5M", (36.5, -6.1, 3.5)),
            (
                "GPS(39.9,116.3,69.8) BAROMETER(91.2) HOME(39.9,116.4)",
                (39.9, 116.3, 91.2),
            ),
            (
                "HOME(131.1660,-25.2088)\nGPS(131.1660,-25.2088,14) BAROMETER:2.5",
                (-25.2088, 131.166, 2.5),
            ),
            ("GPS(8.5,47.1,16) Hb:118.5 Hs:n/a", (47.1, 8.5, 118.5)),
        ] {
            let right = (Some(right.0), Some(right.1), Some(right.2));
            assert_eq!(place(words), right, "{words}");
        }
    }

    #[test]
    fn subtitles_of_new_firmware_are_a_flight_with_the_gimbals_attitude() {
        let words = |i: usize| {
            format!(
                "<font size=\"28\">FrameCnt: {i}, DiffTime: 33ms\n2024-05-01 10:00:00.000\n[iso: 100] [shutter: 1/1000] \
                 [latitude: {:.6}] [longitude: -8.500000] [rel_alt: {:.3} abs_alt: 440.0] [gb_yaw: {i}.0 gb_pitch: -80.0 gb_roll: 0.5] </font>",
                47.0 + 1e-5 * i as f64,
                10.0 + 0.1 * i as f64
            )
        };
        let folder = read_srt("DJI_0001.SRT", film(words).as_bytes())
            .unwrap()
            .unwrap();
        let flight = &folder.flight;
        let (first, last) = flight.span();
        assert!((last - first - 4.9).abs() < 1e-9);
        let last = |name| {
            flight
                .channel(name)
                .unwrap()
                .values
                .last()
                .copied()
                .unwrap()
        };
        assert!((last(ChannelName::HeightAboveGround) - 14.9).abs() < 1e-9);
        // Of Rz(49°) Ry(10°) Rz(0.5°): pitch asin(sin 10° cos 0.5°), heading 49° + atan(tan 0.5° / cos 10°).
        assert!((last(ChannelName::Pitch).to_degrees() - 9.999_616).abs() < 1e-5);
        assert!((last(ChannelName::Heading).to_degrees() - 49.507_713).abs() < 1e-5);
        let origin = flight.frame_on_globe.unwrap().origin;
        assert!((origin.longitude.to_degrees() + 8.5).abs() < 1e-9);
        assert!(folder.notes.iter().any(|note| note.contains("gimbal")));
    }

    #[test]
    fn subtitles_of_old_firmware_have_the_longitude_first() {
        let words = |i: usize| {
            format!(
                "F/2.8, SS 206, ISO 100, EV 0, GPS ({:.4}, 28.2100, 18), D 24.6m, H 2{}.0m, H.S 0.1m/s",
                -81.1 + 1e-4 * i as f64,
                i % 10
            )
        };
        let found = values(&words(3));
        assert_eq!((found[LATITUDE], found[2]), (Some(28.21), Some(23.0)));
        assert!(found[LONGITUDE].is_some_and(|l| (l + 81.0997).abs() < 1e-9));
        let found = values(
            "HOME(149.0251,-20.2532) 2017.08.05 14:11:51\nGPS(149.0251,-20.2533,16) BAROMETER:1.9",
        );
        assert_eq!(
            (found[LATITUDE], found[LONGITUDE], found[2]),
            (Some(-20.2533), Some(149.0251), Some(1.9))
        );
        assert!(read_srt("a.srt", film(words).as_bytes()).unwrap().is_some());
    }

    #[test]
    fn subtitles_of_autel_name_the_hemispheres_and_end_in_the_height() {
        let words = |i: usize| {
            format!(
                "HOME(W: 8.000000, N: 47.000000) 2021-07-01 10:00:00\nISO:100 SHUTTER:500\n\
                 F.PRY (1.0°, -2.0°, 90.0°), G.PRY (-80.0°, 0.5°, 45.0°)\nGPS(W: 8.000000, S: {:.6}, 12.50m)",
                47.0 + 1e-5 * i as f64
            )
        };
        // Later firmware writes signs of degrees.
        let signed = words(0)
            .replace("8.000000", "8.000000°")
            .replace(", 12.50m", "°, 12.50m");
        assert_eq!(values(&signed), values(&words(0)));
        let found = values(&words(0));
        // Of Rz(45°) Ry(10°) Rz(0.5°), as above; roll atan(tan 10° sin 0.5°).
        let expected = [
            -47.0,
            -8.0,
            12.5,
            f64::NAN,
            45.507_713,
            9.999_616,
            0.088_163,
        ];
        for (found, expected) in found.iter().zip(expected) {
            assert!(
                found.map_or(expected.is_nan(), |f| (f - expected).abs() < 1e-5),
                "{found:?}"
            );
        }
        // What the file is called does not matter.
        let folder = read_srt("HOME_max.SRT", film(words).as_bytes());
        assert!(folder.unwrap().is_some());
    }

    #[test]
    fn numbers_are_read_with_decimal_commas_in_feet_and_by_short_names() {
        for (words, expected) in [
            (
                "[latitude: 47,123456] [longitude: -8,500000] [rel_alt: 10,500 abs_alt: 440,250]",
                [47.123_456, -8.5, 10.5, 440.25],
            ),
            (
                "F/2.8, GPS (-8.5000, 47.1000, 18), D 24.6ft, H 100.0ft, H.S 0.1ft/s",
                [47.1, -8.5, 30.48, f64::NAN],
            ),
            (
                "GPS(W: 8.5, N: 47.1, 100.0ft)",
                [47.1, -8.5, 30.48, f64::NAN],
            ),
            (
                "LAT: 33.9S LON: 70.6W ALT: 100.0ft",
                [-33.9, -70.6, f64::NAN, 30.48],
            ),
        ] {
            for (found, expected) in values(words).iter().zip(expected) {
                assert!(
                    found.map_or(expected.is_nan(), |f| (f - expected).abs() < 1e-9),
                    "{words}"
                );
            }
        }
    }

    #[test]
    fn a_last_subtitle_that_is_cut_off_is_left_out_and_told() {
        let words = |i: usize| {
            format!("[latitude: 47.{i:06}] [longitude: 8.512345] [rel_alt: 10.5 abs_alt: 440.0]")
        };
        let whole = film(words).replace(" --> ", "-->");
        let begin = whole.rfind("[latitude").unwrap();
        for cut in begin + 1..whole.len() {
            let (table, _, notes) = table_of(&whole[..cut]).unwrap();
            let is_told = notes.iter().any(|note| note.contains("has no end"));
            let rows = table.lines().count() - 1;
            let ends = whole[..cut].ends_with("440.0]") || whole[..cut].ends_with('\n');
            assert_eq!(
                (rows, is_told),
                if ends { (50, false) } else { (49, true) },
                "{}",
                &whole[begin..cut]
            );
        }
    }

    #[test]
    fn a_last_number_may_change_its_sign_and_is_not_cut_off() {
        let words = |i: usize| {
            let sign = if i == 49 { '+' } else { '-' };
            format!("[latitude: 47.{i:06}] [longitude: 8.512345] [rel_alt: 10.5] [ev : {sign}0.7]")
        };
        let whole = film(words).replace(" --> ", "-->");
        let (table, _, notes) = table_of(whole.trim_end()).unwrap();
        assert_eq!(table.lines().count(), 51, "{notes:?}");
    }

    #[test]
    fn subtitles_that_people_read_are_no_flight() {
        let found = read_srt("film.srt", film(|_| "Where are we?".to_owned()).as_bytes());
        assert!(found.unwrap().is_none());
    }

    #[test]
    fn frames_of_the_film_stand_at_the_films_own_times() {
        // The first two seconds have no place yet.
        let words = |i: usize| {
            let place = if i < 20 {
                (0.0, 0.0)
            } else {
                (47.0 + 1e-5 * i as f64, 8.5)
            };
            format!(
                "[latitude: {:.6}] [longitude: {:.6}] [rel_alt: 20.0 abs_alt: 440.0] [gb_yaw: 1.0 gb_pitch: -90.0 gb_roll: 0.0]",
                place.0, place.1
            )
        };
        let picture = encode_png(&Picture::filled(4, 4, [90; 3])).unwrap();
        let files = MemoryFiles(
            [
                ("DJI_0001.SRT".to_owned(), film(words).into_bytes()),
                (
                    "DJI_0001.MP4.frames/frames.csv".to_owned(),
                    b"time,file\n2.5,a.png\n4.0,b.png\n".to_vec(),
                ),
                ("DJI_0001.MP4.frames/a.png".to_owned(), picture.clone()),
                ("DJI_0001.MP4.frames/b.png".to_owned(), picture),
            ]
            .into(),
        );
        let folder = flight_of_subtitles(&(Arc::new(files) as Arc<dyn FileSet>))
            .unwrap()
            .unwrap();
        let flight = &folder.flight;
        let since: Vec<f64> = flight
            .frames
            .iter()
            .map(|f| f.time - flight.span().0)
            .collect();
        assert!(
            (since[0] - 0.5).abs() < 1e-9 && (since[1] - 2.0).abs() < 1e-9,
            "{since:?}"
        );
        assert_eq!(flight.camera.width, 4);
        assert!(
            folder.notes.iter().any(|note| note.contains("20 of 50")),
            "{:?}",
            folder.notes
        );
    }

    #[test]
    fn a_flight_has_the_pictures_of_its_own_film() {
        let place =
            |i: usize| format!("[latitude: {:.6}] [longitude: 8.5]", 47.0 + 1e-5 * i as f64);
        let (placed, words) = (
            film(place).into_bytes(),
            film(|_| "No fix".to_owned()).into_bytes(),
        );
        let picture = |side| encode_png(&Picture::filled(side, 4, [90; 3])).unwrap();
        // Pictures of the first film are 4 pixels wide, those of the second 5; the flight, its width and what is told of it.
        let flown = |first: &[u8], films: &[(&str, usize)]| {
            let mut files = MemoryFiles::default();
            files.0.insert("c/DJI_0001.SRT".to_owned(), first.to_vec());
            files.0.insert("c/DJI_0002.SRT".to_owned(), placed.clone());
            for (film, width) in films {
                let table = b"time,file\n1.0,a.png\n".to_vec();
                files.0.insert(format!("{film}.frames/frames.csv"), table);
                files
                    .0
                    .insert(format!("{film}.frames/a.png"), picture(*width));
            }
            let folder = flight_of_subtitles(&(Arc::new(files) as Arc<dyn FileSet>));
            let folder = folder.unwrap().unwrap();
            let width = (folder.flight.frames.len() == 1).then_some(folder.flight.camera.width);
            (width, folder.notes.join("; "))
        };
        let (first, second) = (("c/DJI_0001.MP4", 4), ("c/DJI_0002.MP4", 5));
        let left = |film: &str| format!("the pictures of {film} were left out");
        let (width, notes) = flown(&words, &[first, second]);
        assert_eq!(width, Some(5));
        assert!(notes.contains(&left("c/DJI_0001.MP4")), "{notes}");
        assert_eq!(flown(&words, &[first]).0, None);
        // The first flight has no film here, and that of the other is none of its own.
        let (width, notes) = flown(&placed, &[second]);
        assert_eq!(width, None);
        assert!(notes.contains(&left("c/DJI_0002.MP4")), "{notes}");
        assert_eq!(flown(&placed, &[("d/dji_0001.mp4", 4), second]).0, Some(4));
        assert_eq!(flown(&placed, &[("pictures", 6)]).0, None);
    }
}
