//! The place of views among all roads of a map, sought part by part.

use std::sync::Arc;

use pilotage_core::roads::lost::{LostSettings, LostShare, RoadParts, RoadView, ViewMotion};

use super::order::{Order, Urgency, WorkerRole};
use super::running::once;
use super::{JobEvent, RunningJob, WorkerState};

/// Part of a road map that is made ready and searched for the last of several views: event `Figures` with a
/// [`pilotage_core::roads::lost::LostShare`], to be weighed with those of the other parts.
#[derive(Clone, Debug)]
pub struct RoadsLostOrder {
    /// The map.
    pub parts: Arc<RoadParts>,
    /// Number of the part.
    pub part: usize,
    /// The first view, and those after each motion.
    pub views: Arc<(RoadView, Vec<(ViewMotion, RoadView)>)>,
    /// Knowledge before the views are laid on the map.
    pub settings: LostSettings,
}

impl RoadsLostOrder {
    /// Places in the part; none where its roads have no crossing.
    ///
    /// # Errors
    /// Why the views cannot be looked for, in words.
    pub(super) fn share(&self) -> Result<LostShare, String> {
        let (first, then) = &*self.views;
        let index = self.parts.index(self.part);
        let places = index.map(|index| index.places_along(first, then, &self.settings));
        let places = places.transpose().map_err(|why| why.to_string())?;
        Ok(places.unwrap_or_default())
    }
}

impl Order for RoadsLostOrder {
    const URGENCY: Urgency = Urgency::Awaited;

    fn role(&self) -> WorkerRole {
        WorkerRole::Questions
    }

    fn begin(self, _: &mut WorkerState) -> Box<dyn RunningJob> {
        once(move |_, emit| {
            emit(JobEvent::of_figures(&self.share()?)?);
            Ok(())
        })
    }
}

#[cfg(test)]
mod tests {
    use pilotage_core::frames::GroundPoint;
    use pilotage_core::roads::lost::{LostBelief, PartSettings, RoadIndex};
    use pilotage_core::roads::{RoadClass, RoadJoining, RoadLine, RoadMap};

    use super::super::running::finished;
    use super::*;

    /// Streets of a town without regular blocks.
    fn town() -> Vec<RoadLine> {
        let off = |row: i32, column: i32, k: i32| {
            let value = f64::from(row * 37 + column * 101 + k * 53).sin() * 43_758.5;
            70.0 * (value - value.floor() - 0.5)
        };
        let corner = |row: i32, column: i32| {
            let (north, east) = (110.0 * f64::from(row), 110.0 * f64::from(column));
            GroundPoint::new(north + off(row, column, 1), east + off(row, column, 2))
        };
        let street = |from: (i32, i32), to: (i32, i32)| RoadLine {
            course: vec![corner(from.0, from.1), corner(to.0, to.1)],
            ..RoadLine::default()
        };
        let blocks = (0..12).flat_map(|row| (0..12).map(move |column| (row, column)));
        let streets = blocks.flat_map(|(row, column)| {
            let own = (row, column);
            [
                street(own, (row + 1, column)),
                street(own, (row, column + 1)),
            ]
        });
        streets.collect()
    }

    #[test]
    fn parts_that_are_sent_to_and_fro_tell_what_the_map_as_one_tells() {
        let lines = town();
        let seen = lines.iter().filter(|line| {
            (line.course.iter()).all(|p| (300.0..900.0).contains(&p.north) && p.east < 700.0)
        });
        let seen = RoadMap::new(seen.cloned().collect(), RoadJoining::SHARED_POINTS);
        let view = RoadView::of_map(&seen).unwrap();
        let settings = LostSettings::default();
        let map = RoadMap::new(lines.clone(), RoadJoining::SHARED_POINTS);
        let index = RoadIndex::new(&map, RoadClass::Service).unwrap();
        let whole = index.locate_along(&view, &[], &settings).unwrap();
        let of_views = PartSettings::of_views(RoadClass::Service, &view, &[], settings.scale);
        let small = PartSettings {
            area: 1e6,
            ..of_views
        };
        let parts = Arc::new(RoadParts::new(lines, &small).unwrap());
        assert!(parts.count() > 3);
        let views = Arc::new((view, Vec::new()));
        let shares = (0..parts.count()).map(|part| {
            let events = finished(RoadsLostOrder {
                parts: Arc::clone(&parts),
                part,
                views: Arc::clone(&views),
                settings,
            });
            events[0].read_figures::<LostShare>().unwrap()
        });
        let belief = LostBelief::of_parts(shares.collect());
        let (own, other) = (belief.places[0], whole.places[0]);
        assert!(own.probability > 0.99, "{own:?}");
        assert!(own.pose.place.distance(&other.pose.place) < 0.5);
    }
}
