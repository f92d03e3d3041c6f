//! Jobs that are really done in tests.

use pilotage_jobs::{FlightSource, FlyOrder, Job};

/// Fate of the flights of studies.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Studies {
    /// They are flown.
    #[default]
    Flown,
    /// They are left undone.
    Left,
}

/// Whether a job is really done.
pub fn is_real(job: &Job) -> bool {
    matches!(
        job,
        Job::ReadLog(_)
            | Job::MakeFlight(_)
            | Job::LogSeries(_)
            | Job::AskLog(_)
            | Job::Calibrate(_)
            | Job::LayPhotos(_)
            | Job::DrapePhoto(_)
            | Job::Find(_)
            | Job::FindAmongRoads(_)
            | Job::Pack(_)
            | Job::Export(_)
            | Job::Smooth(_)
            | Job::Rehearse(_)
            | Job::ReadStudyPlan(_)
            | Job::StudyEnough(_)
            | Job::StudyFlights(_)
            | Job::Fly(FlyOrder {
                flight: FlightSource::Studied(_),
                ..
            })
    )
}
