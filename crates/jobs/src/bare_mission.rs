//! The mission of a flight that came without one: one policy for page and terminal.

use pilotage_core::flight::Flight;
use pilotage_core::mission::Mission;
use pilotage_core::navigator::NavigatorSettings;

use super::MapSource;

/// Mission without landmarks with which a flight is flown that came without one, and the reason for its settings.
#[derive(Clone, Debug, PartialEq)]
pub struct BareMission {
    /// The mission, so that landmarks can be picked over it.
    pub mission: Mission,
    /// Sentence for people that says by what the flight is navigated, and why.
    pub why: &'static str,
}

impl BareMission {
    /// Mission of `flight` over a map: its pictures are laid on the map as a whole where it has any and the map is one of
    /// files, which was photographed and can be read wherever it lies; else its instruments alone carry the estimate.
    ///
    /// A generated world is not what the camera of a recorded flight saw, and of a map of the web nobody fetches the tiles
    /// along a flight that is not known yet.
    ///
    /// ```
    /// use pilotage_core::flight::{Flight, StartFix};
    /// use pilotage_core::camera::CameraModel;
    /// use pilotage_core::frames::GroundPoint;
    /// use pilotage_jobs::{BareMission, MapSource};
    ///
    /// let flight = Flight {
    ///     name: "a log".to_owned(),
    ///     frame_on_globe: None,
    ///     camera: CameraModel::pinhole(320, 240, 1.0),
    ///     ground_down: 0.0,
    ///     channels: Vec::new(),
    ///     frames: Vec::new(),
    ///     start: StartFix { time: 0.0, position: GroundPoint::default(), standard_deviation: 1.0 },
    ///     truth: None,
    /// };
    /// let bare = BareMission::of(&flight, &MapSource::Files("map".to_owned()));
    /// assert!(bare.mission.navigator.whole_frames.is_none());
    /// assert!(bare.why.contains("no pictures"));
    /// ```
    pub fn of(flight: &Flight, map: &MapSource) -> Self {
        let (by_frames, why) = if flight.frames.is_empty() {
            (
                false,
                "It has no pictures: its instruments alone carry the estimate.",
            )
        } else {
            match map {
                MapSource::Files(_) | MapSource::Placed { .. } | MapSource::Picture { .. } => (
                    true,
                    "Its pictures are laid on the map as a whole, one after the other; the filter settings turn that off.",
                ),
                MapSource::Web(_) => (
                    false,
                    "Of a map of the web nothing is fetched along the flight: its instruments alone carry the estimate.",
                ),
                MapSource::World(_) | MapSource::Nothing => (
                    false,
                    "No map of the ground that its pictures show is open: its instruments alone carry the estimate.",
                ),
            }
        };
        let origin = flight
            .frame_on_globe
            .map_or_else(pilotage_core::simulate::world_origin, |frame| frame.origin);
        let mission = Mission {
            navigator: NavigatorSettings::without_mission(flight, by_frames),
            ..Mission::new(flight.name.clone(), origin)
        };
        Self { mission, why }
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use pilotage_core::frames::Geodetic;
    use pilotage_core::imagery::Blank;
    use pilotage_core::navigator::unused_pictures;
    use pilotage_core::simulate::{Overrides, Scenario};

    use super::super::flights::OpenFlight;
    use super::super::{
        Abilities, Advance, FlightSource, FlyOrder, JobEvent, Order as _, WorkerState,
    };
    use super::*;

    #[test]
    fn pictures_are_laid_on_a_map_of_files_and_on_no_other() {
        let scenario = Scenario::named("distinct-400ft-calm").unwrap();
        let flight = scenario.simulate(1, &Overrides::default()).flight;
        let key = || "map".to_owned();
        let placed = MapSource::Placed {
            key: key(),
            origin: Geodetic::from_degrees(47.0, 8.0, 0.0),
        };
        let is_laid = |flight: &Flight, map: &MapSource| {
            let bare = BareMission::of(flight, map);
            assert!(bare.mission.landmarks.is_empty());
            let is_laid = bare.mission.navigator.whole_frames.is_some();
            assert_eq!(
                is_laid,
                bare.why.contains("laid on the map"),
                "{}",
                bare.why
            );
            is_laid
        };
        for map in [MapSource::Files(key()), placed] {
            assert!(is_laid(&flight, &map), "{map:?}");
        }
        for map in [MapSource::Nothing, MapSource::world("countryside")] {
            assert!(!is_laid(&flight, &map), "{map:?}");
        }
        let blind = Flight {
            frames: Vec::new(),
            ..flight
        };
        assert!(!is_laid(&blind, &MapSource::Files(key())));
    }

    /// A worker with a flight none of whose pictures can be had, over a map of one colour, and the order to fly it.
    fn without_pictures(map: MapSource) -> (WorkerState, FlyOrder) {
        let scenario = Scenario::named("distinct-400ft-calm").unwrap();
        let flight = scenario.simulate(1, &Overrides::default()).flight;
        let mut worker = WorkerState::new(Abilities::WHOLE.opens);
        worker.keep_flight("log", OpenFlight::without_pictures(flight));
        worker.insert_map(&map, Arc::new(Blank));
        let order = FlyOrder {
            flight: FlightSource::Files("log".to_owned()),
            map,
            mission: None,
        };
        (worker, order)
    }

    /// Whether the order of page and terminal lays whole pictures of a flight that came without a mission, once it is told
    /// why.
    fn is_flown_by_pictures(map: MapSource) -> bool {
        let (mut worker, order) = without_pictures(map);
        let mut job = order.begin(&mut worker);
        let mut events = Vec::new();
        while !events
            .iter()
            .any(|e| matches!(e, JobEvent::WithoutMission(_)))
        {
            let more = job.advance(&mut worker, &|| 0.0, &mut |event| events.push(event));
            assert_eq!(more, Ok(Advance::More), "{events:?}");
        }
        let settings = |event: &JobEvent| match event {
            JobEvent::RunStarted(head) => Some(head.settings.whole_frames.is_some()),
            _ => None,
        };
        events.iter().find_map(settings).unwrap()
    }

    #[test]
    fn the_order_of_page_and_terminal_decides_by_it_and_says_so() {
        assert!(is_flown_by_pictures(MapSource::Files("map".to_owned())));
        assert!(!is_flown_by_pictures(MapSource::Nothing));
    }

    #[test]
    fn a_run_whose_pictures_could_not_be_used_says_so_and_why() {
        let (mut worker, order) = without_pictures(MapSource::Files("map".to_owned()));
        let (mut run, mut count) = (None, 0);
        let mut job = order.begin(&mut worker);
        let mut more = Advance::More;
        while more == Advance::More {
            more = job
                .advance(&mut worker, &|| 0.0, &mut |event| match event {
                    JobEvent::Flight(flight) => count = flight.frames.len(),
                    JobEvent::RunStarted(head) => run = Some(*head),
                    JobEvent::Steps(steps) => run.as_mut().unwrap().steps.extend(steps),
                    _ => {}
                })
                .unwrap();
        }
        let mut run = run.unwrap();
        let told = unused_pictures(&run).unwrap();
        let beginning = format!("None of its {count} pictures corrected the estimate");
        assert!(told.starts_with(&beginning), "{told}");
        let mut frames = run.steps.iter().filter_map(|step| step.frame.as_ref());
        let trouble = frames.find_map(|frame| frame.trouble.as_deref());
        assert!(told.contains(trouble.unwrap()), "{told}");
        run.steps.retain(|step| step.frame.is_none());
        assert_eq!(unused_pictures(&run), None);
    }
}
