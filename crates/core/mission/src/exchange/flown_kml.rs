//! Flown tracks as KML: a track in time, and a line coloured by the chosen series.

use std::fmt::Write;

use super::flown_track::{FlownPoint, FlownTrack, angles, finite};
use pilotage_base::text::utc_text;
use pilotage_base::text::without_markup;
use pilotage_base::viridis::VIRIDIS;

/// Colour where the series says nothing.
const NONE: [u8; 3] = [160, 160, 160];
const TRACK: [u8; 3] = [31, 119, 180];

/// The whole file.
pub(super) fn write(track: &FlownTrack) -> String {
    let mut text = String::from(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n\
         <kml xmlns=\"http://www.opengis.net/kml/2.2\" \
         xmlns:gx=\"http://www.google.com/kml/ext/2.2\">\n<Document>\n",
    );
    let _ = writeln!(text, "<name>{}</name>", without_markup(&track.name));
    style(&mut text, "track", TRACK);
    let range = range(track);
    if range.is_some() {
        style(&mut text, "none", NONE);
        for (step, colour) in VIRIDIS.into_iter().enumerate() {
            style(&mut text, &format!("step{step}"), colour);
        }
    }
    if let Some(values) = &track.values {
        let title = without_markup(&values.title());
        let _ = writeln!(
            text,
            "<Schema id=\"values\"><gx:SimpleArrayField name=\"value\" type=\"float\">\
             <displayName>{title}</displayName></gx:SimpleArrayField></Schema>"
        );
    }
    in_time(&mut text, track);
    if let Some(range) = range {
        coloured(&mut text, track, range);
    }
    text.push_str("</Document>\n</kml>\n");
    text
}

fn style(text: &mut String, id: &str, [red, green, blue]: [u8; 3]) {
    let _ = writeln!(
        text,
        "<Style id=\"{id}\"><LineStyle><color>ff{blue:02x}{green:02x}{red:02x}</color><width>3</width></LineStyle></Style>"
    );
}

/// Least and greatest value, if the series says anything.
fn range(track: &FlownTrack) -> Option<(f64, f64)> {
    let values = track.points.iter().filter_map(|point| finite(point.value));
    let both = values.map(|value| (value, value));
    both.reduce(|a, b| (a.0.min(b.0), a.1.max(b.1)))
}

fn mode(track: &FlownTrack) -> &'static str {
    if track.has_height {
        "absolute"
    } else {
        "clampToGround"
    }
}

/// The track with its times and values.
fn in_time(text: &mut String, track: &FlownTrack) {
    let name = without_markup(&track.name);
    let _ = writeln!(
        text,
        "<Placemark><name>{name}</name><styleUrl>#track</styleUrl>\n<gx:Track><altitudeMode>{}</altitudeMode>",
        mode(track)
    );
    for point in &track.points {
        let utc = utc_text(track.utc_at_zero.unwrap_or(0.0) + point.time);
        let _ = writeln!(text, "<when>{utc}</when>");
    }
    for point in &track.points {
        let (latitude, longitude) = angles(&point.place);
        let height = height(track, point);
        let _ = writeln!(text, "<gx:coord>{longitude} {latitude} {height}</gx:coord>");
    }
    if track.values.is_some() {
        text.push_str(
            "<ExtendedData><SchemaData schemaUrl=\"#values\"><gx:SimpleArrayData name=\"value\">\n",
        );
        for point in &track.points {
            let value = finite(point.value).map_or_else(String::new, |v| v.to_string());
            let _ = writeln!(text, "<gx:value>{value}</gx:value>");
        }
        text.push_str("</gx:SimpleArrayData></SchemaData></ExtendedData>\n");
    }
    text.push_str("</gx:Track></Placemark>\n");
}

fn height(track: &FlownTrack, point: &FlownPoint) -> f64 {
    if track.has_height {
        point.place.height
    } else {
        0.0
    }
}

/// The colour of a value between the least and the greatest, by its number.
fn step(value: Option<f64>, (least, greatest): (f64, f64)) -> Option<usize> {
    let value = finite(value)?;
    let share = (value - least) / (greatest - least).max(f64::MIN_POSITIVE);
    let last = VIRIDIS.len() - 1;
    Some(((share * VIRIDIS.len() as f64) as usize).min(last))
}

/// Lines of one colour each, in a folder that says which values they have; a piece has the colour of its first point.
fn coloured(text: &mut String, track: &FlownTrack, range: (f64, f64)) {
    let title = track
        .values
        .as_ref()
        .map(|values| without_markup(&values.title()));
    let _ = writeln!(
        text,
        "<Folder><name>{} from {} to {}</name>",
        title.unwrap_or_default(),
        range.0,
        range.1
    );
    let mut from = 0;
    while from + 1 < track.points.len() {
        let colour = step(track.points[from].value, range);
        let same = |point: &FlownPoint| step(point.value, range) == colour;
        let count = track.points[from..].iter().take_while(|p| same(p)).count();
        let to = (from + count).min(track.points.len() - 1);
        let style = colour.map_or_else(|| "none".to_owned(), |step| format!("step{step}"));
        let places: Vec<String> = track.points[from..=to]
            .iter()
            .map(|point| {
                let (latitude, longitude) = angles(&point.place);
                format!("{longitude},{latitude},{}", height(track, point))
            })
            .collect();
        let _ = writeln!(
            text,
            "<Placemark><styleUrl>#{style}</styleUrl><LineString><altitudeMode>{}</altitudeMode>\
             <coordinates>{}</coordinates></LineString></Placemark>",
            mode(track),
            places.join(" ")
        );
        from = to;
    }
    text.push_str("</Folder>\n");
}
