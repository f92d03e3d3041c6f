//! Tracks with times in GPX and KML: points in the order in which somebody passed them.

use quick_xml::Reader;
use quick_xml::events::{BytesStart, Event};

use crate::cells::date_and_time;
use pilotage_base::text::by_count;

/// Columns behind the time.
pub(crate) const COLUMNS: [&str; 6] = [
    "latitude [deg]",
    "longitude [deg]",
    "gps altitude [m]",
    "height above ground [m]",
    "ground speed [m/s]",
    "course [deg]",
];
/// Fewest points of a KML that have a time each and are a track by that: those of a few places are their dates.
const LEAST_STAMPED: usize = 10;

/// Time as text and values of [`COLUMNS`].
pub(crate) type TrackPoint = (String, [Option<f64>; 6]);

/// Track of a file, and sentences on it.
pub(crate) struct TimedTrack {
    pub points: Vec<TrackPoint>,
    /// Points without a time or a place.
    pub left_out: usize,
    pub findings: Vec<String>,
}

/// Whether a text begins as a file that may have such tracks.
pub(crate) fn may_have_track(head: &str) -> bool {
    let roots = ["<gpx ", "<gpx>", ":gpx ", "<kml ", "<kml>", ":kml "];
    roots.iter().any(|root| head.contains(root))
}

/// The track of a text. Of several that overlap in time it is the one with most points, others follow one another.
pub(crate) fn timed_track(text: &str) -> TimedTrack {
    let mut walk = Walk::default();
    let mut findings = Vec::new();
    let mut reader = Reader::from_str(text);
    loop {
        let Ok(event) = reader.read_event() else {
            let byte = reader.error_position();
            findings.push(format!(
                "the text is damaged at byte {byte}: what is behind it is left out"
            ));
            break;
        };
        match event {
            Event::Start(element) => walk.begin(&element),
            Event::Empty(element) => {
                walk.begin(&element);
                walk.end();
            }
            Event::Text(words) => walk.text.push_str(words.trim()),
            Event::CData(words) => walk.text.push_str(words.trim()),
            Event::End(_) => walk.end(),
            Event::Eof => {
                if !walk.open.is_empty() {
                    findings.push(format!("the text is cut off at byte {}", text.len()));
                }
                break;
            }
            _ => {}
        }
    }
    walk.close_track();
    let stamped = std::mem::take(&mut walk.stamped);
    if walk.tracks.is_empty() && stamped.len() >= LEAST_STAMPED && are_in_order(&stamped) {
        walk.tracks.push(stamped);
    }
    if walk.has_loose_heights {
        let told = "heights of a track that says no altitudeMode are taken above mean sea level";
        findings.push(told.to_owned());
    }
    let mut points = joined(walk.tracks, &mut findings);
    // Points that all have the time at which the file was written are a line.
    let first = points.first().and_then(seconds);
    if points.iter().all(|point| seconds(point) == first) {
        points.clear();
    }
    TimedTrack {
        points,
        left_out: walk.left_out,
        findings,
    }
}

/// Seconds since 1970 of a point.
fn seconds(point: &TrackPoint) -> Option<f64> {
    date_and_time(&point.0).map(|moment| moment.since(None))
}

/// Whether points have times of day, each behind the one before.
fn are_in_order(points: &[TrackPoint]) -> bool {
    let times: Option<Vec<f64>> = points.iter().map(seconds).collect();
    times.is_some_and(|times| times.windows(2).all(|pair| pair[0] < pair[1]))
}

/// The tracks as one: the one with most points, with those that overlap none that is taken already before and behind it.
fn joined(mut tracks: Vec<Vec<TrackPoint>>, findings: &mut Vec<String>) -> Vec<TrackPoint> {
    tracks.sort_by_key(|track| std::cmp::Reverse(track.len()));
    let mut taken: Vec<(f64, f64, Vec<TrackPoint>)> = Vec::new();
    let mut left_out = 0;
    for track in tracks {
        let times = track.iter().filter_map(seconds);
        let (first, last) = times.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), time| {
            (a.min(time), b.max(time))
        });
        let overlaps = |other: &(f64, f64, _)| first <= other.1 && last >= other.0;
        if taken.iter().any(overlaps) {
            left_out += 1;
        } else {
            taken.push((first, last, track));
        }
    }
    if left_out > 0 {
        findings.push(format!(
            "{left_out} {} left out: at the same time as the one with most points, somebody else was there",
            by_count(left_out, "track is", "tracks are")
        ));
    }
    if taken.len() > 1 {
        findings.push(format!("{} tracks follow one another", taken.len()));
    }
    taken.sort_by(|a, b| a.0.total_cmp(&b.0));
    taken.into_iter().flat_map(|(_, _, track)| track).collect()
}

/// State of a reading.
#[derive(Default)]
struct Walk {
    /// Local names of the elements that are open.
    open: Vec<String>,
    /// Text of the innermost one.
    text: String,
    tracks: Vec<Vec<TrackPoint>>,
    track: Vec<TrackPoint>,
    left_out: usize,
    /// Time and values of a point of GPX that is open.
    point: Option<(String, [Option<f64>; 6])>,
    /// Times, coordinates and altitude mode of a track of KML, and the same of a placemark.
    whens: Vec<String>,
    places: Vec<String>,
    mode: String,
    /// Points of placemarks with a time each.
    stamped: Vec<TrackPoint>,
    has_loose_heights: bool,
}

impl Walk {
    fn begin(&mut self, element: &BytesStart<'_>) {
        let name = element.local_name().as_ref().to_owned();
        self.text.clear();
        match name.as_str() {
            "trkpt" => {
                let mut values = [None; 6];
                for attribute in element.attributes().flatten() {
                    let number = || attribute.value.trim().parse::<f64>().ok();
                    match attribute.key.local_name().as_ref() {
                        "lat" => values[0] = number(),
                        "lon" => values[1] = number(),
                        _ => {}
                    }
                }
                self.point = Some((String::new(), values));
            }
            "trk" => self.close_track(),
            "Track" | "Placemark" => {
                self.whens.clear();
                self.places.clear();
                self.mode.clear();
            }
            _ => {}
        }
        self.open.push(name);
    }

    fn end(&mut self) {
        let Some(name) = self.open.pop() else { return };
        let text = std::mem::take(&mut self.text);
        let within = self.open.last().map_or("", String::as_str);
        match (name.as_str(), &mut self.point) {
            ("time", Some((time, _))) if within == "trkpt" => *time = text,
            ("ele", Some((_, values))) => values[2] = text.parse().ok(),
            ("speed", Some((_, values))) => values[4] = text.parse().ok(),
            ("course", Some((_, values))) => values[5] = text.parse().ok(),
            ("trkpt", point) => {
                let point = point.take();
                self.add(point);
            }
            ("when", _) if ["Track", "TimeStamp"].contains(&within) => self.whens.push(text),
            ("coord", _) if within == "Track" => self.places.push(text),
            ("coordinates", _) if within == "Point" => self.places.push(text),
            ("altitudeMode", _) if ["Track", "Point"].contains(&within) => self.mode = text,
            ("Track", _) => {
                let points = self.points_of_kml(|c: char| c.is_whitespace());
                for point in points {
                    self.add(point);
                }
                self.close_track();
            }
            ("Placemark", _) if self.whens.len() == 1 && self.places.len() == 1 => {
                let points = self.points_of_kml(|c: char| c == ',');
                self.stamped.extend(points.into_iter().flatten());
            }
            _ => {}
        }
    }

    /// Points of times and coordinates between seams; `None` stands for one of which something is missing.
    fn points_of_kml(&mut self, is_seam: fn(char) -> bool) -> Vec<Option<TrackPoint>> {
        let whens = std::mem::take(&mut self.whens);
        let places = std::mem::take(&mut self.places);
        let mode = std::mem::take(&mut self.mode);
        let unpaired = whens.len().abs_diff(places.len());
        let point = |(when, place): (String, String)| {
            let numbers = place.split(is_seam).filter(|part| !part.is_empty());
            let numbers: Vec<f64> = numbers.map_while(|part| part.trim().parse().ok()).collect();
            let (longitude, latitude) = (*numbers.first()?, *numbers.get(1)?);
            let height = numbers.get(2).copied();
            let above_ground = height.filter(|_| mode == "relativeToGround");
            let above_sea = height.filter(|_| mode == "absolute" || mode.is_empty());
            let values = [
                Some(latitude),
                Some(longitude),
                above_sea,
                above_ground,
                None,
                None,
            ];
            Some((when, values))
        };
        let points: Vec<Option<TrackPoint>> = whens.into_iter().zip(places).map(point).collect();
        let has_height = |point: &TrackPoint| point.1[2].is_some_and(|height| height != 0.0);
        if mode.is_empty() {
            let is_told = points.iter().flatten().any(has_height);
            self.has_loose_heights |= is_told;
            if !is_told {
                let bare = |(when, [latitude, longitude, ..]): TrackPoint| {
                    (when, [latitude, longitude, None, None, None, None])
                };
                let bare = points.into_iter().map(|point| point.map(bare));
                return bare.chain(std::iter::repeat_n(None, unpaired)).collect();
            }
        }
        points
            .into_iter()
            .chain(std::iter::repeat_n(None, unpaired))
            .collect()
    }

    /// Adds a point that has all that is needed; others are counted.
    fn add(&mut self, point: Option<TrackPoint>) {
        match point {
            Some(point @ (_, [Some(latitude), Some(longitude), ..]))
                if latitude.abs() <= 90.0
                    && longitude.abs() <= 180.0
                    && !point.0.contains(',')
                    && date_and_time(&point.0).is_some() =>
            {
                self.track.push(point);
            }
            _ => self.left_out += 1,
        }
    }

    fn close_track(&mut self) {
        let track = std::mem::take(&mut self.track);
        if !track.is_empty() {
            self.tracks.push(track);
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::folder::FlightFolder;
    use crate::track_files::{is_track, read_track};
    use pilotage_flight::ChannelName;

    fn read(name: &str, text: &str) -> FlightFolder {
        assert!(is_track(text.as_bytes()), "{text}");
        read_track(name, text.as_bytes())
            .unwrap()
            .expect("a flight")
    }

    /// Latitude, longitude and height of a point of a winding way, degrees and metres.
    fn place(i: u32) -> (f64, f64, f64) {
        let i = f64::from(i);
        (
            -33.85 + 2e-3 * (i / 20.0).sin(),
            18.42 + 1e-4 * i,
            100.0 + i,
        )
    }

    fn clock(i: u32) -> String {
        format!("{:02}:{:02}", i / 60, i % 60)
    }

    fn gpx_of(points: std::ops::Range<u32>, minutes: &str) -> String {
        let point = |i: u32| {
            let (latitude, longitude, height) = place(i);
            format!(
                "<trkpt lat=\"{latitude:.7}\" lon=\"{longitude:.7}\"><ele>{height}</ele><time>2024-05-01T10:{}{minutes}</time>\
                 <extensions><x:speed>12.5</x:speed></extensions></trkpt>",
                clock(i)
            )
        };
        let points: String = points.map(point).collect();
        format!("<trk><name>a</name><trkseg>{points}</trkseg></trk>")
    }

    fn gpx(inside: &str) -> String {
        format!(
            "<?xml version=\"1.0\"?><gpx version=\"1.1\" xmlns:x=\"y\"><metadata><time>2001-01-01T00:00:00Z</time></metadata>\
             <wpt lat=\"1\" lon=\"2\"><time>2001-01-01T00:00:00Z</time></wpt>{inside}</gpx>"
        )
    }

    /// Holds a flight against 100 points a second apart from 10 o'clock on 1 May 2024.
    fn check(folder: &FlightFolder, count: usize) {
        let flight = &folder.flight;
        let states = &flight.truth.as_ref().unwrap().states;
        assert_eq!(states.len(), count, "{:?}", folder.notes);
        let utc = folder.utc_at_zero().unwrap() + flight.span().0;
        assert!((utc - 1_714_557_600.0).abs() < 1e-3, "{utc}");
        let frame = flight.frame_on_globe.unwrap();
        let last = frame.geodetic_from_ground(&pilotage_base::frames::GroundPoint {
            north: states[99].position.x,
            east: states[99].position.y,
        });
        assert!((last.latitude.to_degrees() - place(99).0).abs() < 1e-7);
        assert!((last.longitude.to_degrees() - place(99).1).abs() < 1e-7);
    }

    #[test]
    fn a_track_of_gpx_with_times_is_a_flight() {
        let folder = read("a.gpx", &gpx(&gpx_of(0..100, "Z")));
        check(&folder, 100);
        let heights = folder.flight.channel(ChannelName::GpsHeight).unwrap();
        assert_eq!(heights.values[99], 199.0);
        // Two segments of the day, the later first; a point without a time.
        let text = gpx(&(gpx_of(50..100, "Z")
            + &gpx_of(0..50, "Z")
            + "<trk><trkseg><trkpt lat=\"1\" lon=\"2\"/></trkseg></trk>"));
        let folder = read("a.gpx", &text);
        check(&folder, 100);
        let told = |word: &str| folder.notes.iter().any(|note| note.contains(word));
        assert!(
            told("1 point was left out") && told("2 tracks follow"),
            "{:?}",
            folder.notes
        );
        // Two aircraft at a time.
        let folder = read(
            "a.gpx",
            &gpx(&(gpx_of(0..40, ".5Z") + &gpx_of(0..100, "Z"))),
        );
        check(&folder, 100);
        assert!(
            folder
                .notes
                .iter()
                .any(|note| note.contains("1 track is left out"))
        );
        // Cut off within a point.
        let whole = gpx(&gpx_of(0..100, "Z"));
        let folder = read(
            "a.gpx",
            &whole[..whole.find("10:00:60").or(whole.find("10:01:00")).unwrap()],
        );
        assert!(
            folder
                .notes
                .iter()
                .any(|note| note.contains("cut off at byte"))
        );
        assert_eq!(folder.flight.truth.unwrap().states.len(), 60);
        // With prefixes.
        let prefixed = gpx(&gpx_of(0..100, "Z"))
            .replace('<', "<g:")
            .replace("<g:/", "</g:");
        let prefixed = prefixed.replace("<g:?", "<?").replace("x:speed", "speed");
        check(&read("a.gpx", &prefixed), 100);
        // Times of when a line was drawn.
        let (before, point) = whole.split_at(whole.find("<trkpt").unwrap());
        let point = point.split_inclusive("</trkpt>").next().unwrap();
        let drawn = format!("{before}{}</trkseg></trk></gpx>", point.repeat(20));
        assert!(read_track("a.gpx", drawn.as_bytes()).unwrap().is_none());
        // A planned track and routes have no times.
        let planned = gpx(
            "<trk><trkseg><trkpt lat=\"1\" lon=\"2\"/><trkpt lat=\"1\" lon=\"3\"/></trkseg></trk>",
        );
        assert!(read_track("a.gpx", planned.as_bytes()).unwrap().is_none());
    }

    fn kml(mode: &str, inside: &str) -> String {
        format!(
            "<kml xmlns=\"k\" xmlns:gx=\"g\"><Document><Placemark><gx:MultiTrack><gx:Track>{mode}{inside}</gx:Track>\
             </gx:MultiTrack></Placemark></Document></kml>"
        )
    }

    #[test]
    fn a_track_of_kml_is_a_flight_in_any_zone_and_height() {
        let when = |i| format!("<when>2024-05-01T12:{}+02:00</when>", clock(i));
        let whens: Vec<String> = (0..100).map(when).collect();
        let whens = whens.concat();
        let coordinate = |i: u32| {
            let (latitude, longitude, height) = place(i);
            format!("<gx:coord>{longitude:.7} {latitude:.7} {height}</gx:coord>")
        };
        let places: String = (0..100).map(coordinate).collect();
        for (mode, heights) in [
            (
                "<altitudeMode>absolute</altitudeMode>",
                Some(ChannelName::GpsHeight),
            ),
            ("", Some(ChannelName::GpsHeight)),
            (
                "<altitudeMode>relativeToGround</altitudeMode>",
                Some(ChannelName::HeightAboveGround),
            ),
            ("<altitudeMode>clampToGround</altitudeMode>", None),
        ] {
            let folder = read("a.kml", &kml(mode, &format!("{whens}{places}")));
            check(&folder, 100);
            if let Some(name) = heights {
                let heights = folder.flight.channel(name).unwrap();
                assert_eq!(heights.values[99], 199.0, "{mode}");
            }
            assert_eq!(
                folder
                    .notes
                    .iter()
                    .any(|note| note.contains("altitudeMode")),
                mode.is_empty()
            );
        }
        let missing = kml(
            "",
            &format!(
                "{whens}<gx:coord/>{}",
                places.split_once("</gx:coord>").unwrap().1
            ),
        );
        let folder = read("a.kml", &missing);
        assert_eq!(folder.flight.truth.unwrap().states.len(), 99);
        // Points with a time each; a few of them are places with dates.
        let point = |i: u32| {
            let (latitude, longitude, height) = place(i);
            format!(
                "<Placemark><TimeStamp><when>2024-05-01T10:{}Z</when></TimeStamp><Point><altitudeMode>absolute</altitudeMode>\
                 <coordinates>{longitude:.7},{latitude:.7},{height}</coordinates></Point></Placemark>",
                clock(i)
            )
        };
        let stamped = |count: u32| {
            format!(
                "<kml xmlns=\"k\">{}</kml>",
                (0..count).map(point).collect::<String>()
            )
        };
        check(&read("a.kml", &stamped(100)), 100);
        assert!(
            read_track("a.kml", stamped(5).as_bytes())
                .unwrap()
                .is_none()
        );
    }
}
