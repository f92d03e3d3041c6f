//! Tasks of `SeeYou`, which stand behind the places of its files: routes over them.

use super::found::GeodeticContent;
use crate::mission::found::{LonLat, ReadRoute};
use crate::mission::{USUAL_ALTITUDE, WayPoint};
use pilotage_base::frames::GroundPoint;

/// The line between places and tasks.
const SEAM: &str = "-----Related Tasks-----";
/// First cells of lines that say more about the task before them.
const MORE: [&str; 4] = ["options", "version", "obszone", "point"];
/// Name of a place that is left open.
const OPEN: &str = "???";

/// The places of a file and, where there are any, the lines of tasks behind them.
pub(super) fn without_tasks(content: &str) -> (&str, Option<&str>) {
    let Some(at) = content
        .find(SEAM)
        .filter(|at| content[..*at].ends_with('\n'))
    else {
        return (content, None);
    };
    let tasks = &content[at..];
    let tasks = tasks.split_once('\n').map_or("", |(_, tasks)| tasks);
    // The places have the end of their last line.
    (&content[..at], Some(tasks))
}

/// Adds a route for each task over the places of `found`, and notes on what it lacks.
pub(super) fn add_tasks(tasks: &str, found: &mut GeodeticContent) {
    let place = |name: &str| -> Option<LonLat> {
        let is_called = |other: &Option<String>| {
            other
                .as_deref()
                .is_some_and(|other| other.trim().eq_ignore_ascii_case(name))
        };
        let mut all = found.landmarks.iter();
        all.find(|landmark| is_called(&landmark.name))?.reference
    };
    let mut reader = csv::ReaderBuilder::new()
        .has_headers(false)
        .flexible(true)
        .trim(csv::Trim::All)
        .from_reader(tasks.as_bytes());
    let (mut routes, mut unknown) = (Vec::new(), Vec::new());
    for record in reader.records().map_while(Result::ok) {
        let first = record.get(0).unwrap_or("").to_lowercase();
        let is_more = |word: &str| {
            first
                .strip_prefix(word)
                .is_some_and(|r| r.is_empty() || r.starts_with('='))
        };
        if MORE.iter().any(|word| is_more(word)) {
            continue;
        }
        let mut way_points = Vec::new();
        for name in record
            .iter()
            .skip(1)
            .filter(|name| !name.is_empty() && *name != OPEN)
        {
            match place(name) {
                Some(place) => {
                    let way_point = WayPoint::new(GroundPoint::default(), USUAL_ALTITUDE);
                    way_points.push((place, way_point));
                }
                None => unknown.push(name.to_owned()),
            }
        }
        if way_points.len() < 2 {
            continue;
        }
        let name = record.get(0).filter(|name| !name.is_empty());
        routes.push(ReadRoute {
            name: name.map(str::to_owned),
            way_points,
            ..ReadRoute::default()
        });
    }
    if !unknown.is_empty() {
        found.notes.push(format!(
            "its tasks go to places that it does not have and that are left out: {}",
            unknown.join(", ")
        ));
    }
    if routes.is_empty() {
        return;
    }
    found.notes.push(format!(
        "its tasks are routes; they state no altitude: {USUAL_ALTITUDE} is taken, and the zones around their places are left out"
    ));
    found.routes.extend(routes);
}

#[cfg(test)]
mod tests {
    use super::super::csv_read::read;

    const PLACES: &str = "name,code,country,lat,lon,elev,style,rwdir,rwlen,freq,desc\r\n\
         \"Alpha\",\"A\",CH,4722.272N,00832.526E,400.0m,1,,,,\r\n\
         \"Beta, north\",\"B\",CH,4732.272N,00842.526E,500.0m,1,,,,\r\n\
         \"Gamma\",\"C\",CH,4742.272N,00852.526W,500.0m,1,,,,\r\n";

    #[test]
    fn tasks_are_routes_over_the_places_before_them() {
        let tasks = "-----Related Tasks-----\r\n\
             \"Triangle\",\"???\",\"Alpha\",\"Beta, north\",\"GAMMA\",\"Alpha\",\"???\"\r\n\
             Options,NoStart=12:34:56\r\nObsZone=0,Style=2,R1=400m\r\nObsZone=1,Style=0,R1=400m\r\n\
             ,\"Gamma\",\"Delta\",\"Alpha\"\r\n\"short\",\"Alpha\"\r\n";
        let found = read("a.cup", &format!("{PLACES}{tasks}")).unwrap();
        assert_eq!(found.landmarks.len(), 3);
        let names: Vec<_> = found
            .routes
            .iter()
            .map(|route| route.name.as_deref())
            .collect();
        assert_eq!(names, [Some("Triangle"), None]);
        let right = [
            (8.5421, 47.3712),
            (8.708_766_7, 47.537_866_7),
            (-8.875_433_3, 47.704_533_3),
            (8.5421, 47.3712),
        ];
        let way_points = &found.routes[0].way_points;
        assert_eq!(way_points.len(), 4);
        for ((place, _), (longitude, latitude)) in way_points.iter().zip(right) {
            assert!(
                (place.0 - longitude).hypot(place.1 - latitude) < 1e-7,
                "{place:?}"
            );
        }
        assert_eq!(found.routes[1].way_points.len(), 2);
        assert!(
            found
                .notes
                .iter()
                .any(|note| note.contains("left out: Delta")),
            "{:?}",
            found.notes
        );
    }

    #[test]
    fn places_without_tasks_and_damaged_tasks_have_no_routes() {
        for behind in [
            "",
            "-----Related Tasks-----",
            "-----Related Tasks-----\r\n\"\"\",\"a\n,,,\n",
        ] {
            let found = read("a.cup", &format!("{PLACES}{behind}")).unwrap();
            assert_eq!(
                (found.landmarks.len(), found.routes.len()),
                (3, 0),
                "{behind}"
            );
        }
    }
}
