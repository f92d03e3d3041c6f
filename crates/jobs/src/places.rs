//! Places of jobs: the role of each worker, the program that a job needs, and the files that it names.

use super::{FlightSource, Job, MapSource, Program};

/// Roles of workers: one flies, one shows the map, one answers questions.
pub const ROLES: usize = 3;
/// Places of workers: each role may be filled twice, with the small program and with the whole one.
pub const PLACES: usize = ROLES * Program::ALL.len();

/// The place of a role in a program.
pub fn place(role: usize, program: Program) -> usize {
    role + ROLES * program as usize
}

/// The role of a place.
pub fn role_at(place: usize) -> usize {
    place % ROLES
}

/// The program of a place.
pub fn program_at(place: usize) -> Program {
    Program::ALL[place / ROLES]
}

/// The role that does a job.
pub fn role_for(job: &Job) -> usize {
    match job {
        Job::AssessShare(_, share) | Job::SuggestShare(_, share) => share.part,
        Job::Fly { .. }
        | Job::ReadLog { .. }
        | Job::MakeFlight { .. }
        | Job::Cut(_)
        | Job::Contest(_)
        | Job::Align(_)
        | Job::LogSeries { .. }
        | Job::AskLog(_)
        | Job::Assess(_)
        | Job::SumUp(..)
        | Job::Envelope(_)
        | Job::Suggest(_)
        | Job::Propose(..)
        | Job::Evaluate(_)
        | Job::Field(_)
        | Job::Train(_) => 0,
        Job::Tile { .. } | Job::DescribeMap(_) | Job::PrepareMap(_) => 1,
        Job::Provide { .. }
        | Job::LetGo { .. }
        | Job::Open { .. }
        | Job::ReadPlaces { .. }
        | Job::Distinctness { .. }
        | Job::ExplainMatch { .. }
        | Job::LayPhotos(_)
        | Job::DrapePhoto(_)
        | Job::DecodePicture { .. }
        | Job::Find(_)
        | Job::TakeHeights(_)
        | Job::Predict(_)
        | Job::Brief(_)
        | Job::Pack(_)
        | Job::Export(_) => 2,
    }
}

/// Keys of the files that a job names.
pub fn file_keys(job: &Job) -> Vec<&str> {
    let mut keys = Vec::new();
    let (flight, map) = match job {
        Job::Provide { .. }
        | Job::LetGo { .. }
        | Job::Align(_)
        | Job::DecodePicture { .. }
        | Job::Predict(_)
        | Job::SumUp(..)
        | Job::Find(_)
        | Job::Export(_) => (None, None),
        Job::Assess(order) | Job::AssessShare(order, _) | Job::Envelope(order) => {
            (None, Some(&order.map))
        }
        Job::Suggest(order) | Job::SuggestShare(order, _) | Job::Propose(order, _) => {
            (None, Some(&order.map))
        }
        Job::Evaluate(order) => (order.flight.as_ref(), Some(&order.about.map)),
        Job::Field(order) => (None, Some(&order.map)),
        Job::Train(order) => {
            let labelled = order.labelled.as_ref();
            (labelled.map(|frames| &frames.flight), Some(&order.map))
        }
        Job::Cut(order) => (Some(&order.flight), None),
        Job::Contest(order) => (Some(&order.flight), Some(&order.map)),
        Job::Brief(order) => (None, Some(&order.map)),
        Job::Pack(order) => (None, Some(&order.map)),
        Job::Open { key, .. }
        | Job::ReadPlaces { key }
        | Job::MakeFlight { key }
        | Job::ReadLog { key, .. }
        | Job::LogSeries { key, .. } => {
            keys.push(key.as_str());
            (None, None)
        }
        Job::AskLog(order) => {
            keys.push(order.key.as_str());
            (None, None)
        }
        Job::LayPhotos(order) => {
            keys.push(order.key.as_str());
            (None, Some(&order.map))
        }
        Job::DrapePhoto(order) => {
            keys.push(order.key.as_str());
            (None, None)
        }
        Job::TakeHeights(order) => {
            keys.push(order.key.as_str());
            (None, None)
        }
        Job::Fly { flight, map, .. } | Job::ExplainMatch { flight, map, .. } => {
            (Some(flight), Some(map))
        }
        Job::DescribeMap(map)
        | Job::PrepareMap(map)
        | Job::Tile { map, .. }
        | Job::Distinctness { map, .. } => (None, Some(map)),
    };
    if let Some(FlightSource::Files(key)) = flight {
        keys.push(key);
    }
    keys.extend(map.and_then(MapSource::key));
    keys
}

#[cfg(test)]
mod tests {
    use pilotage_core::flight::photo::PhotoSearch;
    use pilotage_core::frames::{GroundPoint, GroundRect};

    use super::*;
    use crate::PhotosOrder;

    #[test]
    fn photos_being_laid_keep_neither_their_flight_nor_the_map_waiting() {
        let lay = Job::LayPhotos(Box::new(PhotosOrder {
            key: "drop".to_owned(),
            names: vec!["a.jpg".to_owned()],
            map: MapSource::Files("map".to_owned()),
            origin: None,
            ground: GroundRect::centered(GroundPoint::default(), 100.0, 100.0),
            search: PhotoSearch::default(),
        }));
        let fly = Job::Fly {
            flight: FlightSource::Files("drop".to_owned()),
            map: MapSource::Files("map".to_owned()),
            mission: None,
        };
        let describe = Job::DescribeMap(MapSource::Files("map".to_owned()));
        assert_ne!(role_for(&lay), role_for(&fly));
        assert_ne!(role_for(&lay), role_for(&describe));
        assert_eq!(file_keys(&lay), ["drop", "map"]);
    }
}
