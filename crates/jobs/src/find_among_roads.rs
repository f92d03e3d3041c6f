//! The place of a picture among all roads of a mission.

use std::sync::Arc;

use pilotage_core::flight::FrameSource as _;
use pilotage_core::flight::photo::{PhotoLook, PhotoSearch, photo_pose};
use pilotage_core::frames::{Attitude, GroundPoint};
use pilotage_core::mission::Mission;
use pilotage_core::navigator::Control;
use pilotage_core::registration::{HeadingPrior, limit_of};
use pilotage_core::roads::RoadClass;
use pilotage_core::roads::lost::{
    LostBelief, LostPlace, LostSettings, LostShare, PartSettings, RoadParts, RoadView,
};
use serde::{Deserialize, Serialize};

use super::order::{Order, Urgency, WorkerRole, keys_of};
use super::photos::look_anywhere;
use super::road_view::road_view;
use super::{Advance, FlightSource, JobEvent, RoadsLostOrder, RunningJob, WorkerState};

/// Probability from which on something about the place of a picture among roads is believed.
pub const BELIEVED_AMONG_ROADS: f64 = 0.99;
/// Most places that are told.
const TOLD: usize = 8;
/// Least probability of a place that is told, but for the likeliest.
const LEAST_TOLD: f64 = 1e-3;
/// The least class of road that is searched.
const LEAST: RoadClass = RoadClass::Service;

/// Picture whose place is sought among roads.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum SoughtPicture {
    /// A camera picture of a flight, by its index.
    Frame(FlightSource, usize),
    /// A photo: key of the files that it is among, its name, and what is known of it better than it tells.
    Photo(String, String, PhotoSearch),
}

/// Search for a picture among all roads of a mission, with the height and the tilt that are told, anywhere on them and with
/// any heading unless a photo tells it: events `Progress`, and `Figures` with [`FoundAmongRoads`].
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct FindAmongRoadsOrder {
    /// The picture.
    pub picture: SoughtPicture,
    /// The mission: its roads, its camera, the noise of its height.
    pub mission: Mission,
}

/// Places that a picture may show, in the world frame of the mission whose roads were searched.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct FoundAmongRoads {
    /// The likeliest places, the likeliest first.
    pub places: Vec<PlaceAmongRoads>,
    /// Probability that it is none of those that were tried: elsewhere among the roads, or not among them.
    pub elsewhere: f64,
    /// Height and heading by which it was sought, in words.
    pub assumed: String,
}

/// Place that a picture may show.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PlaceAmongRoads {
    /// Point below the camera.
    pub below: GroundPoint,
    /// Heading of the camera's carrier, or of the top of a photo, radians clockwise from north.
    pub heading: f64,
    /// Probability that it is this place.
    pub probability: f64,
    /// Ground at the corners of the picture.
    pub outline: Vec<GroundPoint>,
}

/// Conclusion from the probabilities of all places.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PlaceVerdict {
    /// It is the likeliest place.
    Found,
    /// It is one of so many places, the likeliest first.
    Alike(usize),
    /// It is none of the places that were tried.
    NotHere,
    /// The picture does not tell.
    Unsure,
    /// The picture shows too few roads and crossings to be laid anywhere.
    NothingSeen,
}

impl FoundAmongRoads {
    fn of(belief: &LostBelief, seen: &Seen) -> Self {
        let told = |(number, place): &(usize, &LostPlace)| {
            *number == 0 || *number < TOLD && place.probability >= LEAST_TOLD
        };
        let places = belief.places.iter().enumerate().filter(told);
        let outline = &seen.view.outline;
        let place = |(_, place): (usize, &LostPlace)| PlaceAmongRoads {
            below: place.pose.place,
            heading: place.pose.turn,
            probability: place.probability,
            outline: outline.iter().map(|at| place.pose.on_map(*at)).collect(),
        };
        Self {
            places: places.map(place).collect(),
            elsewhere: belief.elsewhere,
            assumed: seen.assumed.clone(),
        }
    }

    /// Conclusion from them: believed is what has a probability of [`BELIEVED_AMONG_ROADS`] at least.
    ///
    /// ```
    /// use pilotage_jobs::{FoundAmongRoads, PlaceAmongRoads, PlaceVerdict};
    ///
    /// let place = |probability| PlaceAmongRoads {
    ///     below: Default::default(),
    ///     heading: 0.0,
    ///     probability,
    ///     outline: Vec::new(),
    /// };
    /// let found = |likely: &[f64], elsewhere| FoundAmongRoads {
    ///     places: likely.iter().map(|it| place(*it)).collect(),
    ///     elsewhere,
    ///     assumed: String::new(),
    /// };
    /// assert_eq!(found(&[0.995], 0.005).verdict(), PlaceVerdict::Found);
    /// assert_eq!(found(&[0.6, 0.395, 0.004], 0.001).verdict(), PlaceVerdict::Alike(2));
    /// assert_eq!(found(&[0.6, 0.1], 0.3).verdict(), PlaceVerdict::Unsure);
    /// assert_eq!(found(&[0.001], 0.998).verdict(), PlaceVerdict::NotHere);
    /// assert_eq!(found(&[], 1.0).verdict(), PlaceVerdict::NothingSeen);
    /// ```
    pub fn verdict(&self) -> PlaceVerdict {
        let mut together = 0.0;
        let mut sums = self.places.iter().map(|place| {
            together += place.probability;
            together
        });
        let needed = sums.position(|sum| sum >= BELIEVED_AMONG_ROADS);
        match needed {
            _ if self.places.is_empty() => PlaceVerdict::NothingSeen,
            Some(0) => PlaceVerdict::Found,
            Some(more) => PlaceVerdict::Alike(more + 1),
            None if self.elsewhere >= BELIEVED_AMONG_ROADS => PlaceVerdict::NotHere,
            None => PlaceVerdict::Unsure,
        }
    }
}

/// Roads of the picture, and what is known of it before they are laid on the map.
struct Seen {
    view: RoadView,
    settings: LostSettings,
    assumed: String,
}

impl FindAmongRoadsOrder {
    fn seen(&self, worker: &mut WorkerState) -> Result<Seen, String> {
        match &self.picture {
            SoughtPicture::Frame(flight, index) => self.in_frame(worker, flight, *index),
            SoughtPicture::Photo(key, name, search) => {
                let files = worker.files(key)?;
                in_photo(&look_anywhere(files.as_ref(), name, search)?, search)
            }
        }
    }

    fn in_frame(
        &self,
        worker: &mut WorkerState,
        flight: &FlightSource,
        index: usize,
    ) -> Result<Seen, String> {
        let open = worker.flight(flight)?;
        let mut open = open.borrow_mut();
        let flown = self.mission.flown(&open.flight);
        let frame = flown.frames.get(index);
        let frame = frame.ok_or("the flight has no such picture")?;
        let now = Control::of(&flown, frame.time);
        let is_told = now.height > 0.0;
        if !is_told {
            return Err("nothing tells the camera's height above the ground then".to_owned());
        }
        let picture = open.frames.picture(index).map_err(|why| why.to_string())?;
        let attitude = Attitude {
            roll: now.roll,
            pitch: now.pitch,
            yaw: 0.0,
        };
        let camera = flown.camera_of_frame(index);
        let usual = LostSettings::default();
        let of_height = self.mission.navigator.sensors.height / now.height;
        Ok(Seen {
            view: road_view(&camera, attitude, now.height, &picture)?,
            settings: LostSettings {
                // Ground that is taken to be level is never known better.
                scale: of_height.max(usual.scale),
                ..usual
            },
            assumed: format!("{:.0} m above level ground, any heading", now.height),
        })
    }
}

/// Roads in a photo that looks down by what it tells or is known of it.
fn in_photo(photo: &PhotoLook, search: &PhotoSearch) -> Result<Seen, String> {
    let told = photo_pose(&photo.told).height.filter(|it| *it > 0.0);
    if search.height.or(told).is_none() {
        let why = "the photo does not tell its height above the ground; state it under \"Photos on the map\"";
        return Err(why.to_owned());
    }
    let prior = &photo.prior;
    let attitude = Attitude {
        roll: prior.roll,
        pitch: prior.pitch,
        yaw: 0.0,
    };
    let usual = LostSettings::default();
    let (turn, within_turn) = match prior.heading {
        HeadingPrior::Around {
            heading, deviation, ..
        } => (heading, limit_of(deviation)),
        HeadingPrior::Unknown => (usual.turn, usual.within_turn),
    };
    Ok(Seen {
        view: road_view(&photo.camera, attitude, prior.height, &photo.picture)?,
        settings: LostSettings {
            turn,
            within_turn,
            scale: prior.log_height_deviation.max(usual.scale),
            ..usual
        },
        assumed: photo.assumed.join("; "),
    })
}

/// A search under way: a part of the map is a slice.
struct FindAmongRoads {
    order: FindAmongRoadsOrder,
    search: Option<Search>,
}

/// Parts of the map, and what was found in those before the next.
struct Search {
    seen: Seen,
    next: RoadsLostOrder,
    shares: Vec<LostShare>,
}

impl Search {
    fn begin(order: &mut FindAmongRoadsOrder, worker: &mut WorkerState) -> Result<Self, String> {
        let lines = std::mem::take(&mut order.mission.roads);
        let seen = order.seen(worker)?;
        let wanted = PartSettings::of_views(LEAST, &seen.view, &[], seen.settings.scale);
        let parts = RoadParts::new(lines.to_vec(), &wanted).map_err(|why| why.to_string())?;
        Ok(Self {
            next: RoadsLostOrder {
                parts: Arc::new(parts),
                part: 0,
                views: Arc::new((seen.view.clone(), Vec::new())),
                settings: seen.settings,
            },
            seen,
            shares: Vec::new(),
        })
    }
}

impl RunningJob for FindAmongRoads {
    fn advance(
        &mut self,
        worker: &mut WorkerState,
        _clock: &dyn Fn() -> f64,
        emit: &mut dyn FnMut(JobEvent),
    ) -> Result<Advance, String> {
        let Some(search) = &mut self.search else {
            emit(JobEvent::Progress(0.0, "Looking for roads".to_owned()));
            self.search = Some(Search::begin(&mut self.order, worker)?);
            return Ok(Advance::More);
        };
        let count = search.next.parts.count();
        let done = search.next.part as f32 / count as f32;
        emit(JobEvent::Progress(done, "Searching the roads".to_owned()));
        search.shares.push(search.next.share()?);
        search.next.part += 1;
        if search.next.part < count {
            return Ok(Advance::More);
        }
        let belief = LostBelief::of_parts(std::mem::take(&mut search.shares));
        let found = FoundAmongRoads::of(&belief, &search.seen);
        emit(JobEvent::of_figures(&found)?);
        emit(JobEvent::Finished);
        Ok(Advance::Done)
    }
}

impl Order for FindAmongRoadsOrder {
    const URGENCY: Urgency = Urgency::Awaited;

    fn role(&self) -> WorkerRole {
        WorkerRole::Questions
    }

    fn files(&self) -> Vec<&str> {
        match &self.picture {
            SoughtPicture::Frame(flight, _) => keys_of(Some(flight), None),
            SoughtPicture::Photo(key, ..) => vec![key],
        }
    }

    fn begin(self, _: &mut WorkerState) -> Box<dyn RunningJob> {
        Box::new(FindAmongRoads {
            order: self,
            search: None,
        })
    }
}

#[cfg(test)]
mod tests {
    use pilotage_core::simulate::{Overrides, Scenario};

    use super::*;
    use crate::SimulationOptions;
    use crate::running::{figures, finished};

    fn flight() -> (SimulationOptions, Mission) {
        let scenario = Scenario::named("blended-1000ft").unwrap();
        let options = SimulationOptions {
            scenario: scenario.name.to_owned(),
            ..SimulationOptions::demo()
        };
        (options, scenario.mission())
    }

    /// From 1000 ft over the generated country: crossings below the first picture, and fields below the other.
    #[test]
    fn a_camera_picture_is_found_among_the_roads_of_its_country_unless_it_shows_none() {
        let (options, mission) = flight();
        let scenario = Scenario::named(&options.scenario).unwrap();
        let flown = scenario.fly(options.seed, &Overrides::default());
        let found = |index| -> FoundAmongRoads {
            figures(FindAmongRoadsOrder {
                picture: SoughtPicture::Frame(FlightSource::Simulated(options.clone()), index),
                mission: mission.clone(),
            })
        };
        let seen = found(0);
        assert_eq!(seen.verdict(), PlaceVerdict::Found, "{seen:?}");
        let truth = flown.truth.unwrap();
        let truth = truth.position(flown.frames[0].time).unwrap();
        let place = &seen.places[0];
        let off = place.below.distance(&GroundPoint::new(truth.x, truth.y));
        assert!(off < 15.0, "{off} m");
        assert!(place.outline.len() >= 4);
        assert!(seen.assumed.contains("305 m above"), "{}", seen.assumed);
        assert_eq!(found(100).verdict(), PlaceVerdict::NothingSeen);
    }

    #[test]
    fn pictures_without_height_or_roads_are_refused_in_words() {
        let (options, mission) = flight();
        let refused = |order: FindAmongRoadsOrder| match finished(order).pop() {
            Some(JobEvent::Failed(why)) => why,
            other => panic!("{other:?}"),
        };
        let picture = |index| SoughtPicture::Frame(FlightSource::Simulated(options.clone()), index);
        let why = refused(FindAmongRoadsOrder {
            picture: picture(100_000),
            mission: mission.clone(),
        });
        assert!(why.contains("no such picture"), "{why}");
        let why = refused(FindAmongRoadsOrder {
            picture: picture(0),
            mission: Mission {
                roads: Vec::new().into(),
                ..mission
            },
        });
        assert!(why.contains("road"), "{why}");
    }
}
