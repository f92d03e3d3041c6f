//! The mission brief: one page to be printed, with a unit at every number.

use std::fmt::Write as _;

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use pilotage_core::frames::{GroundPoint, GroundRect, LocalFrame};
use pilotage_core::landmark::Landmark;
use pilotage_core::mission::{NoFlyZone, RallyPoint, Route};
use pilotage_core::plan::RoutePrediction;
use pilotage_core::text::without_markup;

use super::actions::action_words;
use super::corridor_paint::{corridor_sides, room_beside};
use super::legs::{Leg, time_text, totals};
use super::marks::radius_around;
use super::printing::BriefLandmark;
use super::way_points::{altitude_words, course_words};
use super::words::{PredictionFigures, distance_text, place_words};
use crate::units::Units;
use pilotage_core::plan::cruise;
use pilotage_jobs::{BriefPictures, EncodedPicture};

/// Width over height of the picture of the map.
const ASPECT: f64 = 1.75;
/// Most landmarks with a thumbnail, and most rows of legs: what one page has room for.
pub const MOST_LANDMARKS: usize = 12;
const MOST_ROWS: usize = 7;
/// Width of the drawing over the map, in its own units.
const WIDTH: f64 = 1000.0;

/// Style sheet of the page.
pub const STYLE: &str = include_str!("../../style/brief.css");

/// Content of a brief.
pub struct BriefScene<'a> {
    /// Name of the mission.
    pub mission: &'a str,
    /// The route.
    pub route: &'a Route,
    /// Bank with which it is flown, radians.
    pub bank: f64,
    /// Its legs, last the way back.
    pub legs: &'a [Leg],
    /// The way back home, if it returns.
    pub way_back: Option<[GroundPoint; 2]>,
    /// Rally points of the mission.
    pub rally: &'a [RallyPoint],
    /// The page for emergencies, as HTML, if there is a place to land at.
    pub emergency: Option<String>,
    /// The world frame, if it has a place on the globe.
    pub frame: Option<LocalFrame>,
    /// Energy left at each way-point, watt hours.
    pub left: Option<Vec<f64>>,
    /// Prediction along the route.
    pub prediction: Option<&'a RoutePrediction>,
    /// The limit of the standard deviation, metres.
    pub limit: f64,
    /// Wind, height, camera and what else is assumed, in sentences.
    pub assumptions: Vec<String>,
    /// Warnings about no-fly areas.
    pub warnings: Vec<String>,
    /// No-fly areas of the mission.
    pub no_fly: &'a [NoFlyZone],
    /// Landmarks in the order of the pictures.
    pub landmarks: &'a [BriefLandmark],
    /// Number of landmarks beyond these.
    pub more_landmarks: usize,
    /// Whom to thank for the map.
    pub attribution: &'a str,
    /// The ground that the picture of the map shows.
    pub area: GroundRect,
    /// The pictures.
    pub pictures: &'a BriefPictures,
    /// The user's units.
    pub units: Units,
}

/// The ground that the map of a brief shows around places: with a margin, and as wide as the page.
pub fn brief_area(places: impl IntoIterator<Item = GroundPoint>) -> Option<GroundRect> {
    let around = GroundRect::around(places)?;
    let around = around.grown((0.06 * around.width().max(around.height())).max(40.0));
    let height = around.height().max(around.width() / ASPECT);
    Some(GroundRect::centered(
        around.center(),
        height,
        height * ASPECT,
    ))
}

/// The body of the page, as HTML.
pub fn brief(scene: &BriefScene<'_>) -> String {
    let mut text = String::new();
    // Writing into a string cannot fail.
    let _ = write!(
        text,
        "<h1>{} <small>{} · <time></time></small></h1>",
        without_markup(&scene.route.name),
        without_markup(scene.mission)
    );
    for warning in &scene.warnings {
        let _ = write!(text, "<p class=\"warning\">{}</p>", without_markup(warning));
    }
    map(&mut text, scene);
    let _ = write!(text, "<p class=\"key\">{}</p>", key_to_map(scene));
    if !scene.attribution.is_empty() {
        let _ = write!(text, "<p>Map: {}</p>", without_markup(scene.attribution));
    }
    text.push_str("<div class=\"columns\"><section>");
    outlook(&mut text, scene);
    text.push_str("<h2>Assumed</h2><ul>");
    for sentence in &scene.assumptions {
        let _ = write!(text, "<li>{}</li>", without_markup(sentence));
    }
    text.push_str("</ul></section><section>");
    legs(&mut text, scene);
    text.push_str("</section></div>");
    landmarks(&mut text, scene);
    match &scene.emergency {
        Some(emergency) => {
            let sheet = |page: &str| format!("<div class=\"sheet\">{page}</div>");
            sheet(&text) + &sheet(emergency)
        }
        None => text,
    }
}

fn data_address(picture: &EncodedPicture) -> String {
    format!("data:image/jpeg;base64,{}", STANDARD.encode(&picture.0))
}

fn map(text: &mut String, scene: &BriefScene<'_>) {
    let area = scene.area;
    let scale = WIDTH / area.width().max(1e-6);
    let height = area.height() * scale;
    let at = |p: &GroundPoint| ((p.east - area.west) * scale, (area.north - p.north) * scale);
    let points = |places: &mut dyn Iterator<Item = GroundPoint>| -> String {
        let pairs = places.map(|p| {
            let (x, y) = at(&p);
            format!("{x:.1},{y:.1}")
        });
        pairs.collect::<Vec<_>>().join(" ")
    };
    let _ = write!(
        text,
        "<svg class=\"map\" viewBox=\"0 0 {WIDTH:.0} {height:.0}\" role=\"img\" aria-label=\"Map with the \
         route and its landmarks\"><image href=\"{}\" width=\"{WIDTH:.0}\" height=\"{height:.0}\" \
         preserveAspectRatio=\"none\"/>",
        data_address(&scene.pictures.map)
    );
    if let Some(prediction) = scene.prediction {
        let samples = &prediction.samples;
        let sides = samples.iter().zip(room_beside(samples));
        let sides: Vec<_> = sides.map(|(s, room)| corridor_sides(s, room)).collect();
        let [left, right] = [0, 1].map(|side| sides.iter().map(move |ends| ends[side]));
        let ring = points(&mut right.chain(left.rev()));
        let _ = write!(text, "<polygon class=\"corridor\" points=\"{ring}\"/>");
    }
    for zone in scene.no_fly {
        // A hole is a ring of its own: the rule of even and odd leaves it out.
        let rings = std::iter::once(&zone.corners).chain(&zone.holes);
        let rings = rings.map(|ring| format!("M{}Z", points(&mut ring.iter().copied())));
        let path = rings.collect::<Vec<_>>().concat();
        let _ = write!(text, "<path class=\"no-fly\" d=\"{path}\"/>");
        if let Some(first) = zone.corners.first() {
            let (x, y) = at(first);
            let name = without_markup(&zone.name);
            let _ = write!(
                text,
                "<text class=\"halo\" x=\"{x:.1}\" y=\"{y:.1}\">{name}</text>"
            );
        }
    }
    for known in scene.landmarks {
        let b = known.landmark.bounds;
        let outline = known.landmark.outline().unwrap_or_else(|| {
            [
                (b.north, b.west),
                (b.north, b.east),
                (b.south, b.east),
                (b.south, b.west),
            ]
            .map(|(n, e)| GroundPoint::new(n, e))
            .to_vec()
        });
        let ring = points(&mut outline.into_iter());
        let _ = write!(text, "<polygon class=\"landmark\" points=\"{ring}\"/>");
    }
    if let Some(ends) = scene.way_back {
        way_back(text, ends.map(|place| at(&place)));
    }
    let line = points(&mut scene.route.way_points.iter().map(|w| w.position));
    let _ = write!(
        text,
        "<polyline class=\"under\" points=\"{line}\"/><polyline class=\"route\" points=\"{line}\"/>"
    );
    // The line of the route does not run over the letters.
    for (index, known) in scene.landmarks.iter().enumerate() {
        let b = known.landmark.bounds;
        let (x, y) = at(&GroundPoint::new(b.north, b.center().east));
        let _ = write!(
            text,
            "<text class=\"halo\" x=\"{x:.1}\" y=\"{:.1}\">{}</text>",
            y - 4.0,
            letter(index)
        );
    }
    for (index, way_point) in scene.route.way_points.iter().enumerate() {
        let (x, y) = at(&way_point.position);
        if let Some(radius) = radius_around(way_point, scene.bank) {
            let radius = radius * scale;
            let _ = write!(
                text,
                "<circle class=\"around\" cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"{radius:.1}\"/>"
            );
        }
        let _ = write!(
            text,
            "<circle class=\"point\" cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"9\"/>\
             <text class=\"number\" x=\"{x:.1}\" y=\"{:.1}\">{}</text>",
            y + 3.5,
            index + 1
        );
    }
    for point in scene.rally {
        rally_mark(text, at(&point.position), &point.name);
    }
    scale_bar(text, scene, scale, height);
    text.push_str("</svg>");
}

/// The way back home.
fn way_back(text: &mut String, [from, home]: [(f64, f64); 2]) {
    let line = format!("{:.1},{:.1} {:.1},{:.1}", from.0, from.1, home.0, home.1);
    let _ = write!(
        text,
        "<polyline class=\"under\" points=\"{line}\"/><polyline class=\"route back\" points=\"{line}\"/>\
         <text class=\"halo\" x=\"{:.1}\" y=\"{:.1}\">home</text>",
        home.0,
        home.1 - 12.0
    );
}

/// The mark of a rally point with its name.
fn rally_mark(text: &mut String, (x, y): (f64, f64), name: &str) {
    let _ = write!(
        text,
        "<path class=\"point\" d=\"M {x:.1} {:.1} l 11 11 l -11 11 l -11 -11 z\"/>\
         <text class=\"number\" x=\"{x:.1}\" y=\"{:.1}\">R</text>\
         <text class=\"halo\" x=\"{x:.1}\" y=\"{:.1}\">{}</text>",
        y - 11.0,
        y + 3.5,
        y + 25.0,
        without_markup(name)
    );
}

/// A bar of a round length with its unit, and an arrow to the north.
fn scale_bar(text: &mut String, scene: &BriefScene<'_>, scale: f64, height: f64) {
    let (factor, unit) = scene.units.length();
    let wanted = 160.0 / scale * factor;
    let power = 10_f64.powf(wanted.log10().floor());
    let round = [5.0, 2.0, 1.0].map(|m| m * power);
    let round = round.into_iter().find(|r| *r <= wanted).unwrap_or(power);
    let length = round / factor * scale;
    let (right, y) = (WIDTH - 20.0, height - 18.0);
    let left = right - length;
    let _ = write!(
        text,
        "<line class=\"under\" x1=\"{left:.1}\" y1=\"{y:.1}\" x2=\"{right:.1}\" y2=\"{y:.1}\"/>\
         <line class=\"bar\" x1=\"{left:.1}\" y1=\"{y:.1}\" x2=\"{right:.1}\" y2=\"{y:.1}\"/>\
         <text class=\"halo\" x=\"{:.1}\" y=\"{:.1}\">{round:.0} {unit}</text>\
         <path class=\"north\" d=\"M {right:.1} 14 l 7 22 l -7 -5 l -7 5 z\"/>\
         <text class=\"halo\" x=\"{right:.1}\" y=\"52\">N</text>",
        0.5 * (left + right),
        y - 8.0
    );
}

fn outlook(text: &mut String, scene: &BriefScene<'_>) {
    text.push_str("<h2>Predicted error of position</h2>");
    let Some(outlook) = scene.prediction.and_then(PredictionFigures::of) else {
        text.push_str("<p>It is not predicted.</p>");
        return;
    };
    let rows = [
        (
            "largest error (1σ), longer axis",
            scene.units.short(outlook.sigma),
        ),
        (
            "95 % corridor, largest half width",
            format!("±{}", scene.units.short(outlook.across)),
        ),
        (
            "longest dead reckoning",
            format!("{:.0} s", outlook.dead_reckoning),
        ),
        ("limit (1σ)", scene.units.short(scene.limit)),
        ("over the limit", distance_text(outlook.over, scene.units)),
    ];
    text.push_str("<table class=\"facts\">");
    for (name, value) in rows {
        let _ = write!(
            text,
            "<tr><td>{name}</td><td>{}</td></tr>",
            without_markup(&value)
        );
    }
    text.push_str("</table>");
    let landmarks: Vec<&Landmark> = scene.landmarks.iter().map(|l| &l.landmark).collect();
    if let Some(worst) = outlook
        .sentences(scene.limit, &landmarks, scene.units)
        .first()
    {
        let _ = write!(text, "<p>{}</p>", without_markup(worst));
    }
}

fn legs(text: &mut String, scene: &BriefScene<'_>) {
    let (length, time) = totals(scene.legs);
    let _ = write!(
        text,
        "<h2>Legs <small>{}, {} in the wind</small></h2><table><tr><th></th><th>altitude</th>\
         <th>course</th><th>distance</th><th>time</th><th>airspeed</th>{}</tr>",
        distance_text(length, scene.units),
        time_words(time),
        if scene.left.is_some() {
            "<th>left</th>"
        } else {
            ""
        }
    );
    let way_points = &scene.route.way_points;
    // Of too many rows the first ones and the last are shown.
    let left_out = match way_points.len() {
        count if count > MOST_ROWS => MOST_ROWS - 2..count - 1,
        _ => 0..0,
    };
    for (index, way_point) in way_points.iter().enumerate() {
        if left_out.contains(&index) {
            if index == left_out.start {
                let (count, last) = (left_out.len(), left_out.end);
                let _ = write!(
                    text,
                    "<tr><td>…</td><td colspan=\"5\">and {count} more, up to way-point {last}</td></tr>"
                );
            }
            continue;
        }
        let leg = index.checked_sub(1).and_then(|i| scene.legs.get(i));
        let mut altitude = altitude_words(&way_point.altitude, scene.units);
        if let Some(action) = action_words(&way_point.action) {
            altitude = format!("{altitude}, {action}");
        }
        let (factor, unit) = scene.units.speed();
        let cells = match leg {
            None => [
                "start".to_owned(),
                String::new(),
                String::new(),
                String::new(),
            ],
            Some(leg) => [
                course_words(leg.course),
                distance_text(leg.distance, scene.units),
                time_words(leg.time),
                format!(
                    "{:.1} {unit}",
                    way_point.speed.unwrap_or_else(cruise) * factor
                ),
            ],
        };
        let _ = write!(
            text,
            "<tr><td>{}</td><td>{}{}</td>",
            index + 1,
            without_markup(&altitude),
            below(&place_words(&way_point.position, scene.frame.as_ref()))
        );
        for cell in cells {
            let _ = write!(text, "<td>{}</td>", without_markup(&cell));
        }
        if let Some(left) = scene.left.as_ref().and_then(|l| l.get(index)) {
            let _ = write!(text, "<td>{left:.0} Wh</td>");
        }
        text.push_str("</tr>");
    }
    if let (Some(_), Some(leg)) = (scene.way_back, scene.legs.last()) {
        let (factor, unit) = scene.units.speed();
        let _ = write!(
            text,
            "<tr><td></td><td>return to the start</td><td>{}</td><td>{}</td><td>{}</td><td>{:.1} {unit}</td>",
            course_words(leg.course),
            without_markup(&distance_text(leg.distance, scene.units)),
            time_words(leg.time),
            cruise() * factor
        );
        if let Some(left) = scene.left.as_ref().and_then(|l| l.last()) {
            let _ = write!(text, "<td>{left:.0} Wh</td>");
        }
        text.push_str("</tr>");
    }
    text.push_str("</table>");
}

/// A place in a line of its own, if there are words for it.
fn below(place: &str) -> String {
    match place {
        "" => String::new(),
        place => format!("<br><small>{place}</small>"),
    }
}

/// Minutes and seconds, with their unit.
fn time_words(seconds: Option<f64>) -> String {
    match seconds {
        Some(_) => format!("{} min", time_text(seconds)),
        None => time_text(None),
    }
}

fn landmarks(text: &mut String, scene: &BriefScene<'_>) {
    let (factor, unit) = scene.units.length();
    text.push_str("<h2>Landmarks</h2><div class=\"landmarks\">");
    if scene.landmarks.is_empty() {
        text.push_str("<p>None is switched on.</p>");
    }
    for (index, known) in scene.landmarks.iter().enumerate() {
        let l = &known.landmark;
        let picture = scene
            .pictures
            .thumbnails
            .get(index)
            .map_or_else(String::new, data_address);
        let category = l.category();
        let category = if category.is_empty() {
            String::new()
        } else {
            format!("{category}, ")
        };
        let _ = write!(
            text,
            "<figure><img src=\"{picture}\" alt=\"\"><figcaption><b>{} {}</b><br>{}{:.0} × {:.0} {unit}<br>\
             {}</figcaption></figure>",
            letter(index),
            without_markup(&l.name),
            without_markup(&category),
            l.bounds.width() * factor,
            l.bounds.height() * factor,
            without_markup(&known.found)
        );
    }
    text.push_str("</div>");
    if scene.more_landmarks > 0 {
        let _ = write!(
            text,
            "<p>and {} more in the mission file</p>",
            scene.more_landmarks
        );
    }
}

/// The letter of a landmark on the map.
fn letter(index: usize) -> char {
    char::from(b'A' + (index % 26) as u8)
}

/// Says what the marks of the map are, as far as there are any.
fn key_to_map(scene: &BriefScene<'_>) -> String {
    let lettered = letter(scene.landmarks.len().saturating_sub(1));
    let marks = [
        (!scene.landmarks.is_empty()).then(|| match lettered {
            'A' => "A: landmark, shown below".to_owned(),
            last => format!("A to {last}: landmarks, shown below"),
        }),
        Some("numbers: way-points".to_owned()),
        (!scene.rally.is_empty()).then(|| "R: rally point".to_owned()),
        (scene.prediction.is_some()).then(|| "blue: 95 % corridor".to_owned()),
        (!scene.no_fly.is_empty()).then(|| "red: no-fly area".to_owned()),
    ];
    marks.into_iter().flatten().collect::<Vec<_>>().join(" · ")
}

#[cfg(test)]
mod tests {
    use super::*;
    use pilotage_core::frames::{Altitude, Geodetic};
    use pilotage_core::mission::{USUAL_ALTITUDE, WayPoint};

    fn page(units: Units) -> String {
        page_of(units, 2)
    }

    fn page_of(units: Units, count: usize) -> String {
        let altitude: Altitude = USUAL_ALTITUDE;
        let at = |e| WayPoint::new(GroundPoint::new(0.0, e), altitude);
        let route = Route {
            name: "There & back".into(),
            way_points: (0..count).map(|i| at(600.0 * i as f64)).collect(),
            ..Route::default()
        };
        let legs = super::super::legs::legs(
            &route,
            None,
            (20.0, 0.55),
            &pilotage_core::simulate::Wind::default(),
        );
        let bounds = GroundRect::centered(GroundPoint::new(30.0, 300.0), 20.0, 20.0);
        let landmarks = [BriefLandmark {
            landmark: Landmark::new(1, "Barn <old>", bounds),
            found: "found in 80 % of pictures".into(),
        }];
        let corner = |n, e| GroundPoint::new(n, e);
        let zones = [NoFlyZone {
            name: "<Area>".into(),
            corners: vec![corner(0.0, 100.0), corner(0.0, 140.0), corner(40.0, 120.0)],
            ..NoFlyZone::default()
        }];
        let area = brief_area(route.way_points.iter().map(|w| w.position)).expect("an area");
        brief(&BriefScene {
            mission: "Trip",
            route: &route,
            legs: &legs,
            frame: Some(LocalFrame::new(Geodetic {
                latitude: 47.5_f64.to_radians(),
                longitude: -8.25_f64.to_radians(),
                height: 0.0,
            })),
            way_back: None,
            bank: 0.55,
            rally: &[],
            emergency: None,
            left: None,
            prediction: None,
            limit: 10.0,
            assumptions: vec!["No wind.".into()],
            warnings: vec!["Leg 1 crosses <Area> for 40 m.".into()],
            no_fly: &zones,
            landmarks: &landmarks,
            more_landmarks: 5,
            attribution: "© <us>",
            area,
            pictures: &BriefPictures::default(),
            units,
        })
    }

    #[test]
    fn no_fly_areas_are_drawn_and_what_leads_over_them_stands_at_the_top() {
        let text = page(Units::Metric);
        let warning = text.find("Leg 1 crosses &lt;Area&gt; for 40 m.");
        assert!(warning < text.find("<svg"), "{text}");
        assert!(text.contains("class=\"no-fly\"") && text.contains(">&lt;Area&gt;</text>"));
    }

    #[test]
    fn what_the_marks_of_the_map_are_is_said_below_it_and_no_line_covers_a_letter() {
        let text = page(Units::Metric);
        let key = "A: landmark, shown below · numbers: way-points · red: no-fly area";
        assert!(text.find("</svg>") < text.find(key), "{text}");
        assert!(text.contains(key) && !text.contains("corridor"), "{text}");
        assert!(text.find("class=\"route\"") < text.find(">A</text>"));
    }

    #[test]
    fn of_many_legs_the_first_and_the_last_are_on_the_page_and_the_rest_is_counted() {
        let text = page_of(Units::Metric, 90);
        assert!(text.contains("<tr><td>5</td>") && text.contains("<tr><td>90</td>"));
        assert!(!text.contains("<tr><td>6</td>"));
        assert!(text.contains("and 84 more, up to way-point 89"), "{text}");
        assert!(!page_of(Units::Metric, 7).contains("way-point 6"));
    }

    #[test]
    fn names_are_escaped_and_numbers_have_units() {
        let text = page(Units::Metric);
        assert!(text.contains("There &amp; back") && text.contains("Barn &lt;old&gt;"));
        for words in [
            "600 m",
            "0:30 min",
            "090°",
            "100 m above take-off",
            "N 47.50000° W 8.25000°",
            "20 × 20 m",
        ] {
            assert!(text.contains(words), "{words} in {text}");
        }
        assert!(text.contains("and 5 more") && text.contains("Map: © &lt;us&gt;"));
        assert!(!text.contains("style="), "the page's rules forbid it");
        assert!(page(Units::Aviation).contains(" NM"));
    }
}
