//! The map over which a flight is flown that came without one.

use pilotage_core::frames::{Geodetic, LocalFrame};
use pilotage_jobs::MapSource;

use super::Documents;

/// Farthest from a flight that the origin of the map may lie that was open before, metres: what lies
/// further is a map of somewhere else.
const NEAR: f64 = 60_000.0;

impl Documents {
    /// The map that is open, if it lies where a flight is whose world frame is `frame`; else none.
    pub fn map_under(&self, frame: Option<LocalFrame>) -> MapSource {
        let open = &self.map.source;
        let map = self.map.info.as_ref();
        let at = open.origin().or_else(|| map.and_then(|map| map.origin));
        let is_near = |at: Geodetic| {
            let away = frame?.world_from_geodetic(&at);
            Some(away.x.hypot(away.y) < NEAR)
        };
        match at.and_then(is_near) {
            Some(true) => open.clone(),
            _ => MapSource::Nothing,
        }
    }
}

/// Whether two maps are the same one, in whichever worlds they were put.
pub fn is_same_map(one: &MapSource, other: &MapSource) -> bool {
    use MapSource::{Files, Picture, Placed, Web};
    match (one, other) {
        (Files(one) | Placed { key: one, .. }, Files(other) | Placed { key: other, .. }) => {
            one == other
        }
        (
            Picture {
                key, name, place, ..
            },
            Picture {
                key: other_key,
                name: other_name,
                place: other_place,
                ..
            },
        ) => (key, name, place) == (other_key, other_name, other_place),
        (Web(one), Web(other)) => one.template == other.template,
        _ => one == other,
    }
}

/// A map among a flight's own files, put into the world of the flight.
pub fn with_origin(map: MapSource, frame: Option<LocalFrame>) -> MapSource {
    match (map, frame) {
        (MapSource::Files(key), Some(frame)) => MapSource::Placed {
            key,
            origin: frame.origin,
        },
        (map, Some(frame)) => map.moved(frame.origin),
        (map, None) => map,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_map_is_the_same_one_in_another_world_and_another_set_of_files_is_not() {
        let origin = Geodetic::from_degrees(47.0, 8.0, 0.0);
        let files = |key: &str| MapSource::Files(key.to_owned());
        let placed = with_origin(files("opened-1"), Some(LocalFrame::new(origin)));
        assert!(is_same_map(&files("opened-1"), &placed));
        assert!(!is_same_map(&files("opened-2"), &placed));
        assert!(!is_same_map(&MapSource::Nothing, &placed));
        assert!(is_same_map(
            &MapSource::world("hall"),
            &MapSource::world("hall")
        ));
    }
}
