//! Owners of jobs: whom the events of a job go to, so that none is dropped in silence.

use pilotage_jobs::{JobEvent, JobId};

use crate::feature_command::FeatureId;
use crate::short_map::ShortMap;

/// Part of the app that started a job and hears of it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum JobOwner {
    /// The flight that is flown.
    Flight,
    /// Camera pictures at the time cursor.
    FramePictures,
    /// The map: its description, its tiles, its overview.
    Map,
    /// Heights of the ground.
    Heights,
    /// Opened files that are looked through.
    Openings,
    /// Files given to the workers.
    Files,
    /// A feature.
    Feature(FeatureId),
}

/// Addressee of an event.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Addressee {
    /// The part that started the job, and waits for it.
    Owner(JobOwner),
    /// The part that started the job and left it while it ran: what it still says is of no use to that.
    Left(JobOwner),
    /// Nobody: the job was over when it was asked to stop.
    Over,
    /// Nobody: no such job was started, or it is over. A fault of the program.
    Nobody,
}

/// Jobs under way with their owners.
///
/// ```
/// use pilotage_jobs::JobEvent;
/// use pilotage_ui::job_owners::{Addressee, JobOwner, JobOwners};
///
/// let mut owners = JobOwners::default();
/// owners.own(7, JobOwner::Map);
/// assert_eq!(owners.addressee(7, &JobEvent::Finished), Addressee::Owner(JobOwner::Map));
/// assert_eq!(owners.addressee(7, &JobEvent::Finished), Addressee::Nobody);
/// ```
#[derive(Clone, Debug, Default)]
pub struct JobOwners(ShortMap<JobId, OwnedJob>);

/// Owner of a job, and whether it was left.
#[derive(Clone, Copy, Debug)]
struct OwnedJob {
    owner: JobOwner,
    is_left: bool,
}

impl JobOwners {
    /// Says whose a job is that was just started.
    pub fn own(&mut self, id: JobId, owner: JobOwner) {
        let is_left = false;
        self.0.insert(id, OwnedJob { owner, is_left });
    }

    /// Says that the owner of a job does not wait for it any more.
    pub fn leave(&mut self, id: JobId) {
        if let Some(job) = self.0.remove(&id) {
            let is_left = true;
            self.0.insert(id, OwnedJob { is_left, ..job });
        }
    }

    /// Addressee of an event of a job, which is forgotten with its last.
    pub fn addressee(&mut self, id: JobId, event: &JobEvent) -> Addressee {
        let Some(&OwnedJob { owner, is_left }) = self.0.get(&id) else {
            let is_told_twice = *event == JobEvent::Cancelled;
            return if is_told_twice {
                Addressee::Over
            } else {
                Addressee::Nobody
            };
        };
        if event.is_last() {
            self.0.remove(&id);
        }
        if is_left {
            Addressee::Left(owner)
        } else {
            Addressee::Owner(owner)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn events_go_to_the_owner_until_the_last_and_those_of_a_job_that_was_left_are_known_as_such() {
        let mut owners = JobOwners::default();
        let said = || JobEvent::Progress(0.5, "Flying".to_owned());
        owners.own(1, JobOwner::Flight);
        owners.own(2, JobOwner::Feature("outage"));
        assert_eq!(
            owners.addressee(1, &said()),
            Addressee::Owner(JobOwner::Flight)
        );
        owners.leave(2);
        let left = Addressee::Left(JobOwner::Feature("outage"));
        assert_eq!(owners.addressee(2, &said()), left);
        assert_eq!(owners.addressee(2, &JobEvent::Cancelled), left);
        assert_eq!(owners.addressee(2, &said()), Addressee::Nobody);
        owners.leave(2);
        assert_eq!(owners.addressee(2, &said()), Addressee::Nobody);
        let over = owners.addressee(1, &JobEvent::Finished);
        assert_eq!(over, Addressee::Owner(JobOwner::Flight));
        assert_eq!(owners.addressee(1, &JobEvent::Finished), Addressee::Nobody);
        assert_eq!(owners.addressee(1, &JobEvent::Cancelled), Addressee::Over);
    }
}
