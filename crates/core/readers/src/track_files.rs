//! Tracks of `OziExplorer` (.plt), activities of Garmin (.tcx) and tracks with times in GPX and KML, as flights.

use std::sync::Arc;

use quick_xml::Reader;
use quick_xml::events::Event;

use crate::folder::{FlightFolder, FolderError, decoded};
use crate::text_tables::{first_flight, flight_of_table, table};
use crate::track_xml::{self, may_have_track, timed_track};
use pilotage_base::files::FileSet;
use pilotage_base::frames::units::METRES_PER_FOOT;
use pilotage_base::text::{by_count, utc_text};

/// Columns behind the time.
const COLUMNS: [&str; 3] = ["latitude [deg]", "longitude [deg]", "gps altitude [m]"];
/// First words of a track of `OziExplorer`, and its lines before the points.
const OZI: &str = "OziExplorer Track Point";
/// First words of the same of `Geolife`, a collection of tracks of walkers and travellers.
const GEOLIFE: &str = "Geolife trajectory";
const OZI_HEAD: usize = 6;
/// Days from 30 December 1899, from which these tracks count, to 1970.
const DAYS_TO_1970: f64 = 25_569.0;
/// Height in feet that says that none is known.
const NO_HEIGHT: f64 = -777.0;
/// Element of an activity, and that of a point of it.
const ACTIVITIES: &str = "<TrainingCenterDatabase";
const POINT: &str = "Trackpoint";

/// Time as text and values of [`COLUMNS`].
type Point = (String, [Option<f64>; 3]);

/// Whether the first bytes of a file are a track of `OziExplorer` or an activity of Garmin, or those of GPX or KML, which may
/// have tracks with times.
pub fn is_track(head: &[u8]) -> bool {
    let head = decoded(head);
    let text = String::from_utf8_lossy(&head);
    has_ozi_rows(text.trim_start_matches('\u{feff}'))
        || text.contains(ACTIVITIES)
        || may_have_track(&text)
}

/// Whether a text is a track of `OziExplorer`, or one of those that have its rows.
fn has_ozi_rows(text: &str) -> bool {
    text.starts_with(OZI) || text.starts_with(GEOLIFE)
}

/// Whether a datum is WGS 84 by its name, with blanks, hyphens and capitals or without.
fn is_wgs_84(datum: &str) -> bool {
    let letters = datum.chars().filter(char::is_ascii_alphanumeric);
    letters.collect::<String>().eq_ignore_ascii_case("WGS84")
}

/// The flight that the first such file among `files` tells of; `None` if there is none. Others are left out with a note.
///
/// # Errors
/// A track of which no flight can be made.
pub fn flight_of_track(files: &Arc<dyn FileSet>) -> Result<Option<FlightFolder>, FolderError> {
    let because = "it is a recording of its own";
    for ending in [".plt", ".tcx", ".gpx", ".kml"] {
        let found = first_flight(files.as_ref(), ending, because, read_track)?;
        if found.is_some() {
            return Ok(found);
        }
    }
    Ok(None)
}

/// The flight that a track tells of; `None` if it has fewer than two points with a time and a place. Heights are those of the
/// receiver.
///
/// # Errors
/// Places on another datum than WGS 84, and points of which no flight can be made.
///
/// ```
/// use pilotage_readers::track_files::read_track;
///
/// // 8.64 s are 0.0001 days; a ten-thousandth of a degree of latitude is 11.1 m.
/// let text = "OziExplorer Track Point File Version 2.1\nWGS 84\nAltitude is in Feet\nReserved 3\n0,2,255,,0,0\n2\n\
///             47.0000,8.5,1,1000,40097.5000,11-Oct-09,12:00:00\n47.0001,8.5,0,1000,40097.5001,11-Oct-09,12:00:08\n";
/// let folder = read_track("a.plt", text.as_bytes())?.ok_or("no two points")?;
/// let truth = folder.flight.truth.ok_or("no track")?;
/// assert!(((truth.states[1].position - truth.states[0].position).norm() - 11.1).abs() < 0.1);
/// assert!((truth.states[1].time - truth.states[0].time - 8.64).abs() < 0.01);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn read_track(name: &str, bytes: &[u8]) -> Result<Option<FlightFolder>, FolderError> {
    let bytes = decoded(bytes);
    let text = String::from_utf8_lossy(&bytes);
    let text = text.trim_start_matches('\u{feff}');
    let mut findings = Vec::new();
    if !has_ozi_rows(text) && !text.contains(ACTIVITIES) {
        let found = timed_track(text);
        if found.points.len() < 2 {
            return Ok(None);
        }
        let findings = (found.findings.into_iter())
            .chain(told_left_out(found.left_out))
            .collect();
        let table = table("time", track_xml::COLUMNS, &found.points);
        // Points of which no flight can be made are still a route.
        return Ok(flight_of_table(name, table, findings).unwrap_or_default());
    }
    let (points, left_out) = if has_ozi_rows(text) {
        let datum = text.lines().nth(1).unwrap_or_default().trim();
        if !is_wgs_84(datum) {
            return Err(FolderError::File {
                file: name.to_owned(),
                cause: format!(
                    "its places count on the datum {datum}, and WGS 84 alone is read: save it on that in OziExplorer"
                ),
            });
        }
        // Those of Geolife are in Greenwich time, as its guide says.
        if text.starts_with(OZI) {
            let told = "times of OziExplorer say no zone: they are taken for universal time";
            findings.push(told.to_owned());
        }
        of_ozi(text)
    } else {
        let (points, left_out, damage) = of_activity(text);
        findings.extend(damage);
        (points, left_out)
    };
    if points.len() < 2 {
        return Ok(None);
    }
    findings.extend(told_left_out(left_out));
    flight_of_table(name, table("time", COLUMNS, &points), findings)
}

/// Words on points without a time or a place.
fn told_left_out(count: usize) -> Option<String> {
    let words = by_count(
        count,
        "point was left out: it has",
        "points were left out: they have",
    );
    (count > 0).then(|| format!("{count} {words} no time or no place"))
}

/// Points of a track of `OziExplorer`, and how many lines are none.
fn of_ozi(text: &str) -> (Vec<Point>, usize) {
    let lines = text
        .lines()
        .skip(OZI_HEAD)
        .filter(|line| !line.trim().is_empty());
    let (mut points, mut left_out) = (Vec::new(), 0);
    for line in lines {
        let numbers: Vec<Option<f64>> = line
            .split(',')
            .map(|cell| cell.trim().parse().ok())
            .collect();
        match numbers[..] {
            [Some(latitude), Some(longitude), _, feet, Some(days), ..]
                if latitude.abs() <= 90.0 && longitude.abs() <= 180.0 && days > 0.0 =>
            {
                let height = feet.filter(|feet| *feet != NO_HEIGHT);
                let time = utc_text((days - DAYS_TO_1970) * 86_400.0);
                let metres = height.map(|feet| feet * METRES_PER_FOOT);
                points.push((time, [Some(latitude), Some(longitude), metres]));
            }
            _ => left_out += 1,
        }
    }
    (points, left_out)
}

/// Points of the activities, how many of them have no time or no place, and words on damage behind which nothing is read.
fn of_activity(text: &str) -> (Vec<Point>, usize, Option<String>) {
    let mut reader = Reader::from_str(text);
    let (mut points, mut left_out) = (Vec::new(), 0);
    let mut depth = 0_usize;
    let mut open = String::new();
    let mut point: Option<(Option<String>, [Option<f64>; 3])> = None;
    let damage = loop {
        let Ok(event) = reader.read_event() else {
            let byte = reader.error_position();
            break Some(format!(
                "the text is damaged at byte {byte}: what is behind it is left out"
            ));
        };
        match event {
            Event::Start(element) => {
                depth += 1;
                element.local_name().as_ref().clone_into(&mut open);
                if open == POINT {
                    point = Some((None, [None; 3]));
                }
            }
            Event::Text(words) => {
                let words = words.trim();
                if let Some((time, values)) = &mut point {
                    let number = words.parse().ok();
                    match open.as_str() {
                        "Time" if !words.contains(',') => *time = Some(words.to_owned()),
                        "LatitudeDegrees" => values[0] = number,
                        "LongitudeDegrees" => values[1] = number,
                        "AltitudeMeters" => values[2] = number,
                        _ => {}
                    }
                }
            }
            Event::End(element) => {
                depth = depth.saturating_sub(1);
                open.clear();
                if element.local_name().as_ref() == POINT {
                    match point.take() {
                        Some((Some(time), values @ [Some(_), Some(_), _])) => {
                            points.push((time, values));
                        }
                        _ => left_out += 1,
                    }
                }
            }
            Event::Eof => {
                let cut = || format!("the text is cut off at byte {}", text.len());
                break (depth > 0).then(cut);
            }
            _ => {}
        }
    };
    (points, left_out, damage)
}

#[cfg(test)]
mod tests {
    use super::*;
    use pilotage_flight::ChannelName;

    fn plt(datum: &str) -> String {
        let head = "OziExplorer Track Point File Version 2.1\r\n";
        let rest = "Altitude is in Feet\r\nReserved 3\r\n0,2,255,My Track,0,0,2,8421376\r\n0\r\n";
        let row = |i: u32| {
            format!(
                "{:.6},{:.6},0,{},{:.7},2009-10-11,14:04:{i:02}\r\n",
                -33.9 + 1e-4 * f64::from(i),
                18.4,
                if i == 3 { -777 } else { 1000 },
                40_097.586_458_3 + f64::from(i) / 86_400.0
            )
        };
        let rows: String = (0..20).map(row).collect();
        format!("{head}{datum}\r\n{rest}{rows},,0\r\n")
    }

    #[test]
    fn a_track_of_ozi_explorer_is_a_flight_in_feet_and_days() {
        let text = plt("WGS 84");
        assert!(is_track(text.as_bytes()));
        let folder = read_track("a.plt", text.as_bytes()).unwrap().unwrap();
        let origin = folder.flight.frame_on_globe.unwrap().origin;
        assert!((origin.latitude.to_degrees() + 33.9).abs() < 1e-9);
        let heights = folder.flight.channel(ChannelName::GpsHeight).unwrap();
        assert!((heights.values[0] - 304.8).abs() < 1e-6 && heights.times.len() == 19);
        // 11 October 2009, 14:04:30.
        let utc = folder.utc_at_zero().unwrap() + folder.flight.span().0;
        assert!((utc - 1_255_269_870.0).abs() < 0.1, "{utc}");
        assert!(
            folder
                .notes
                .iter()
                .any(|note| note.contains("1 point was left out: it has no"))
        );
    }

    #[test]
    fn a_track_of_geolife_is_one_of_ozi_explorer_by_its_rows() {
        let text = "Geolife trajectory\r\nWGS 84\r\nAltitude is in Feet\r\nReserved 3\r\n0,2,255,My Track,0,0,2,8421376\r\n0\r\n\
                    39.984702,116.318417,0,492,39744.1201851852,2008-10-23,02:53:04\r\n\
                    39.984683,116.31845,0,492,39744.1202546296,2008-10-23,02:53:10\r\n";
        assert!(is_track(text.as_bytes()));
        let folder = read_track("a.plt", text.as_bytes()).unwrap().unwrap();
        // date -u -d '2008-10-23 02:53:04' +%s
        let utc = folder.utc_at_zero().unwrap() + folder.flight.span().0;
        assert!((utc - 1_224_730_384.0).abs() < 0.1, "{utc}");
        let heights = folder.flight.channel(ChannelName::GpsHeight).unwrap();
        // 492 ft of 0.3048 m.
        assert!((heights.values[0] - 149.9616).abs() < 1e-9);
    }

    #[test]
    fn the_datum_may_be_written_without_its_blank() {
        for datum in ["WGS84", "wgs-84", "WGS 84"] {
            let read = read_track("a.plt", plt(datum).as_bytes());
            assert!(read.unwrap().is_some(), "{datum}");
        }
    }

    #[test]
    fn a_track_on_another_datum_is_refused_by_its_name() {
        let cause = read_track("a.plt", plt("Tokyo").as_bytes()).err().unwrap();
        assert!(cause.to_string().contains("Tokyo"), "{cause}");
    }

    #[test]
    fn the_points_of_an_activity_are_a_flight() {
        let point = |i: u32| {
            let place = if i == 2 {
                String::new()
            } else {
                format!(
                    "<Position><LatitudeDegrees>{:.6}</LatitudeDegrees><LongitudeDegrees>-0.42</LongitudeDegrees></Position>",
                    51.5 + 1e-4 * f64::from(i)
                )
            };
            format!(
                "<Trackpoint><Time>2024-05-01T10:00:{i:02}.000Z</Time>{place}<AltitudeMeters>{}</AltitudeMeters>\
                 <HeartRateBpm><Value>140</Value></HeartRateBpm></Trackpoint>",
                80 + i
            )
        };
        let points: String = (0..20).map(point).collect();
        let text = format!(
            "<?xml version=\"1.0\"?>\n<TrainingCenterDatabase xmlns=\"http://www.garmin.com/xmlschemas/TrainingCenterDatabase/v2\">\
             <Activities><Activity Sport=\"Other\"><Id>2024-05-01T10:00:00Z</Id><Lap StartTime=\"2024-05-01T10:00:00Z\"><Track>{points}\
             </Track></Lap></Activity></Activities></TrainingCenterDatabase>"
        );
        assert!(is_track(text.as_bytes()));
        let folder = read_track("a.tcx", text.as_bytes()).unwrap().unwrap();
        let truth = folder.flight.truth.as_ref().unwrap();
        assert_eq!(truth.states.len(), 19);
        let origin = folder.flight.frame_on_globe.unwrap().origin;
        assert!((origin.longitude.to_degrees() + 0.42).abs() < 1e-9);
        let heights = folder.flight.channel(ChannelName::GpsHeight).unwrap();
        assert_eq!(heights.values.last(), Some(&99.0));
        let utc = folder.utc_at_zero().unwrap() + folder.flight.span().0;
        assert!((utc - 1_714_557_600.0).abs() < 1e-3, "{utc}");
        let is_damage = |note: &String| note.contains("at byte");
        assert!(!folder.notes.iter().any(is_damage));
        // Of damaged and of cut text the points before are read, and the rest is told.
        let tenth = text.find("10:00:10").unwrap();
        let broken = format!("{}</Wrong>{}", &text[..tenth], &text[tenth..]);
        for (text, word) in [(broken.as_str(), "damaged"), (&text[..tenth], "cut off")] {
            let folder = read_track("a.tcx", text.as_bytes()).unwrap().unwrap();
            let truth = folder.flight.truth.as_ref().unwrap();
            assert_eq!(truth.states.len(), 9);
            let note = folder.notes.iter().find(|note| is_damage(note)).unwrap();
            assert!(note.contains(word), "{note}");
            let byte: usize = note
                .split_once("byte ")
                .and_then(|(_, rest)| rest.split(':').next()?.parse().ok())
                .unwrap();
            assert!(byte.abs_diff(tenth) < 10, "{note}");
        }
    }

    #[test]
    fn other_text_is_no_track() {
        for text in [
            "",
            "OziExplorer Waypoint File Version 1.1\nWGS 84\n",
            "<gpx/>",
        ] {
            assert!(!is_track(text.as_bytes()), "{text}");
            assert!(read_track("a", text.as_bytes()).unwrap().is_none());
        }
    }
}
