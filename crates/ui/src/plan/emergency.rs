//! Page of a brief for when the aircraft cannot go on, or does not know where it is: from the middle of each leg the
//! nearest place to land at, and the landmark by which it is most likely to find its position again.

use std::fmt::Write as _;

use pilotage_core::frames::{GroundPoint, LocalFrame};
use pilotage_core::landmark::Landmark;
use pilotage_core::mission::{Mission, Route, WayPointAction};
use pilotage_core::text::without_markup;

use super::way_points::{altitude_words, course_words};
use super::words::{distance_text, place_words};
use crate::units::Units;

/// Most rows of legs that the page has room for.
const MOST_LEGS: usize = 26;
/// Part of the best probability with which a landmark is found from which on it counts as good as the best, so that the
/// nearest of them is taken.
const AS_GOOD: f64 = 0.8;

/// A place to land at.
#[derive(Clone, Debug, PartialEq)]
pub struct Refuge {
    /// Name for people.
    pub name: String,
    /// Place in the world.
    pub place: GroundPoint,
    /// Altitude at which the aircraft comes there, in words; empty for where it lands on its route.
    pub altitude: String,
}

/// Places to land at: the rally points of a mission, and where the route lands and takes off.
pub fn refuges(mission: &Mission, route: &Route, units: Units) -> Vec<Refuge> {
    let frame = LocalFrame::new(mission.origin);
    let rally = mission.rally.iter().map(|point| Refuge {
        name: point.name.clone(),
        place: point.position,
        altitude: altitude_words(&point.altitude, units),
    });
    let mut list: Vec<Refuge> = rally.collect();
    let own = |name: &str, place: GroundPoint| Refuge {
        name: name.to_owned(),
        place,
        altitude: String::new(),
    };
    let takes_off = route.way_points.first();
    let takes_off = takes_off.filter(|w| w.action == WayPointAction::TakeOff);
    let start = takes_off.map(|w| own("Place of take-off", w.position));
    let name = if route.lands() { "Landing" } else { "Home" };
    let landing = route.landing(&frame).map(|place| own(name, place));
    for place in start.into_iter().chain(landing) {
        // A route may land where it took off.
        if list
            .iter()
            .all(|known| known.place.distance(&place.place) > 1.0)
        {
            list.push(place);
        }
    }
    list
}

/// A landmark by which a position may be found again, and the probability with which it was found when it was tested.
pub struct KnownLandmark<'a> {
    /// The landmark.
    pub landmark: &'a Landmark,
    /// Probability; `None` if it was not tested.
    pub found: Option<f64>,
}

/// The landmark to look for from a place: the nearest of those that are found about as well as the best of all, and of
/// untested ones only where none is tested.
pub fn landmark_for<'a, 'b>(
    known: &'b [KnownLandmark<'a>],
    place: &GroundPoint,
) -> Option<&'b KnownLandmark<'a>> {
    let best = known.iter().filter_map(|it| it.found).fold(0.0, f64::max);
    let away = |it: &&KnownLandmark<'_>| it.landmark.reference.distance(place);
    let good = known
        .iter()
        .filter(|it| best == 0.0 || it.found.is_some_and(|found| found >= AS_GOOD * best));
    good.min_by(|a, b| away(a).total_cmp(&away(b)))
}

/// Content of the page.
pub struct EmergencyScene<'a> {
    /// Name of the mission.
    pub mission: &'a str,
    /// The route.
    pub route: &'a Route,
    /// Its way back home, if it returns.
    pub way_back: Option<[GroundPoint; 2]>,
    /// The world frame, if it has a place on the globe.
    pub frame: Option<LocalFrame>,
    /// Places to land at.
    pub refuges: &'a [Refuge],
    /// Landmarks that are looked for.
    pub landmarks: &'a [KnownLandmark<'a>],
    /// The user's units.
    pub units: Units,
}

/// True course in whole degrees and distance from one place to another.
fn way_words(from: &GroundPoint, to: &GroundPoint, units: Units) -> [String; 2] {
    let way = to.to_vector() - from.to_vector();
    let course = (way.norm() > 1e-6).then(|| way.y.atan2(way.x));
    [course_words(course), distance_text(way.norm(), units)]
}

/// The page, as HTML.
pub fn emergency(scene: &EmergencyScene<'_>) -> String {
    let mut text = String::new();
    // Writing into a string cannot fail.
    let _ = write!(
        text,
        "<h1>Emergency <small>{} · {}</small></h1>",
        without_markup(&scene.route.name),
        without_markup(scene.mission)
    );
    text.push_str(
        "<h2>Places to land</h2><table><tr><th></th><th>place</th><th>arrive at</th></tr>",
    );
    for refuge in scene.refuges {
        let place = place_words(&refuge.place, scene.frame.as_ref());
        let place = if place.is_empty() {
            let (factor, unit) = scene.units.length();
            let [north, east] = [refuge.place.north, refuge.place.east].map(|m| m * factor);
            format!("{north:.0} north, {east:.0} {unit} east")
        } else {
            place
        };
        let _ = write!(
            text,
            "<tr><td>{}</td><td>{place}</td><td>{}</td></tr>",
            without_markup(&refuge.name),
            without_markup(&refuge.altitude)
        );
    }
    text.push_str("</table>");
    legs(&mut text, scene);
    text
}

/// Middles of the legs with their names.
fn middles(scene: &EmergencyScene<'_>) -> Vec<(String, GroundPoint)> {
    let middle = |a: &GroundPoint, b: &GroundPoint| {
        GroundPoint::new(0.5 * (a.north + b.north), 0.5 * (a.east + b.east))
    };
    let pairs = scene.route.way_points.windows(2).enumerate();
    let legs = pairs.map(|(index, pair)| {
        let name = format!("{} to {}", index + 1, index + 2);
        (name, middle(&pair[0].position, &pair[1].position))
    });
    let back = scene.way_back.map(|[from, home]| {
        let name = format!("{} to home", scene.route.way_points.len());
        (name, middle(&from, &home))
    });
    legs.chain(back).collect()
}

fn legs(text: &mut String, scene: &EmergencyScene<'_>) {
    text.push_str(
        "<h2>From the middle of each leg <small>true courses</small></h2><table><tr><th>leg</th>\
         <th>nearest place to land</th><th>course</th><th>distance</th>\
         <th class=\"name\">position lost: look for</th><th>course</th><th>distance</th><th>found</th></tr>",
    );
    let middles = middles(scene);
    let left_out = match middles.len() {
        count if count > MOST_LEGS => MOST_LEGS - 2..count - 1,
        _ => 0..0,
    };
    for (index, (name, middle)) in middles.iter().enumerate() {
        if left_out.contains(&index) {
            if index == left_out.start {
                let count = left_out.len();
                let _ = write!(
                    text,
                    "<tr><td>…</td><td colspan=\"7\">and {count} legs more</td></tr>"
                );
            }
            continue;
        }
        let away = |refuge: &&Refuge| refuge.place.distance(middle);
        let nearest = scene.refuges.iter();
        let nearest = nearest.min_by(|a, b| away(a).total_cmp(&away(b)));
        let mut cells = vec![format!("<td>{name}</td>")];
        let none = || ["none".to_owned(), String::new(), String::new()];
        let [refuge, course, distance] = nearest.map_or_else(none, |refuge| {
            let [course, distance] = way_words(middle, &refuge.place, scene.units);
            [refuge.name.clone(), course, distance]
        });
        for cell in [refuge, course, distance] {
            cells.push(format!("<td>{}</td>", without_markup(&cell)));
        }
        let known = landmark_for(scene.landmarks, middle);
        let [landmark, course, distance] = known.map_or_else(none, |known| {
            let [course, distance] = way_words(middle, &known.landmark.reference, scene.units);
            [known.landmark.name.clone(), course, distance]
        });
        let found = match known.map(|known| known.found) {
            Some(Some(found)) => format!("{:.0} %", 100.0 * found),
            Some(None) => "not tested".to_owned(),
            None => String::new(),
        };
        cells.push(format!(
            "<td class=\"name\">{}</td>",
            without_markup(&landmark)
        ));
        for cell in [course, distance, found] {
            cells.push(format!("<td>{}</td>", without_markup(&cell)));
        }
        let _ = write!(text, "<tr>{}</tr>", cells.concat());
    }
    text.push_str("</table>");
}

#[cfg(test)]
mod tests {
    use super::*;
    use pilotage_core::frames::{Geodetic, GroundRect};
    use pilotage_core::mission::{RallyPoint, USUAL_ALTITUDE, WayPoint};

    fn mission() -> Mission {
        let mut mission = Mission::new("Ours", Geodetic::from_degrees(47.5, 8.25, 400.0));
        let at = |north, east| WayPoint::new(GroundPoint::new(north, east), USUAL_ALTITUDE);
        mission.routes.push(Route {
            name: "There & back".to_owned(),
            way_points: vec![at(0.0, 0.0), at(0.0, 1000.0), at(1000.0, 1000.0)],
            returns: true,
            ..Route::default()
        });
        let field = GroundPoint::new(300.0, 1500.0);
        mission.rally.push(RallyPoint::new(1, field));
        mission
    }

    fn landmark(id: u32, name: &str, north: f64, east: f64) -> Landmark {
        let place = GroundRect::centered(GroundPoint::new(north, east), 20.0, 20.0);
        Landmark::new(id, name, place)
    }

    #[test]
    fn places_to_land_are_rally_points_and_both_ends_once() {
        let mut mission = mission();
        let mut route = mission.routes.remove(0);
        let names = |mission: &Mission, route: &Route| -> Vec<String> {
            let list = refuges(mission, route, Units::Metric);
            list.into_iter().map(|refuge| refuge.name).collect()
        };
        assert_eq!(names(&mission, &route), ["Rally 1", "Home"]);
        route.way_points[0].action = WayPointAction::TakeOff;
        assert_eq!(names(&mission, &route), ["Rally 1", "Place of take-off"]);
        route.returns = false;
        route.way_points[2].action = WayPointAction::Land;
        mission.rally.clear();
        assert_eq!(names(&mission, &route), ["Place of take-off", "Landing"]);
    }

    #[test]
    fn of_landmarks_found_about_as_well_the_nearest_is_looked_for() {
        let list = [
            landmark(1, "far", 0.0, 900.0),
            landmark(2, "near", 0.0, 400.0),
            landmark(3, "seldom", 0.0, 10.0),
            landmark(4, "untested", 0.0, 5.0),
        ];
        let mut known: Vec<KnownLandmark<'_>> = list
            .iter()
            .zip([Some(0.95), Some(0.8), Some(0.3), None])
            .map(|(landmark, found)| KnownLandmark { landmark, found })
            .collect();
        let named = |known: &[KnownLandmark<'_>]| {
            let place = GroundPoint::default();
            landmark_for(known, &place).map(|it| it.landmark.name.clone())
        };
        assert_eq!(named(&known).as_deref(), Some("near"));
        for it in &mut known {
            it.found = None;
        }
        assert_eq!(named(&known).as_deref(), Some("untested"));
        assert_eq!(named(&[]), None);
    }

    #[test]
    fn each_leg_has_the_way_to_the_nearest_place_and_to_a_landmark() {
        let mission = mission();
        let route = &mission.routes[0];
        let frame = LocalFrame::new(mission.origin);
        let tower = landmark(1, "Tower <old>", 0.0, 800.0);
        let text = emergency(&EmergencyScene {
            mission: &mission.name,
            route,
            way_back: route.way_back(&frame),
            frame: Some(frame),
            refuges: &refuges(&mission, route, Units::Metric),
            landmarks: &[KnownLandmark {
                landmark: &tower,
                found: Some(0.93),
            }],
            units: Units::Metric,
        });
        // From 0, 500 home lies 500 m to the west and the tower 300 m to the east.
        let first = "<td>1 to 2</td><td>Home</td><td>270°</td><td>500 m</td>\
                     <td class=\"name\">Tower &lt;old&gt;</td><td>090°</td><td>300 m</td><td>93 %</td>";
        assert!(text.contains(first), "{text}");
        // From 500, 1000 the field is 500 m to the east and 200 to the south.
        let second = "<td>2 to 3</td><td>Rally 1</td><td>112°</td><td>539 m</td>";
        assert!(text.contains(second), "{text}");
        assert!(text.contains("<td>3 to home</td>"), "{text}");
        for words in ["There &amp; back", "N 47.50270°", "100 m above take-off"] {
            assert!(text.contains(words), "{words} in {text}");
        }
    }
}
