//! Places of jobs: the role of each worker, the program that a job needs, and the files that it names.

use super::Program;
use super::order::Role;

/// Number of roles of workers.
pub const ROLES: usize = Role::ALL.len();
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

#[cfg(test)]
mod tests {
    use pilotage_core::flight::photo::PhotoSearch;
    use pilotage_core::frames::{GroundPoint, GroundRect};

    use crate::{DescribeMapOrder, FlightSource, FlyOrder, Job, MapSource, PhotosOrder};

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
        let fly = Job::Fly(FlyOrder {
            flight: FlightSource::Files("drop".to_owned()),
            map: MapSource::Files("map".to_owned()),
            mission: None,
        });
        let describe = Job::DescribeMap(DescribeMapOrder(MapSource::Files("map".to_owned())));
        assert_ne!(lay.role(), fly.role());
        assert_ne!(lay.role(), describe.role());
        assert_eq!(lay.files(), ["drop", "map"]);
    }
}
