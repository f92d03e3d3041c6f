//! Jobs that keep their place without working, and turns between two programs of one role.

use super::{Assigned, Job, JobId, Request, WorkerPool, WorkerPort, role_at};

impl<P: WorkerPort> WorkerPool<P> {
    /// Lets every flight that is being flown keep its place without working.
    pub fn hold_flights(&mut self) {
        let is_flight = |(_, assigned): &(&JobId, &Assigned)| matches!(assigned.job, Job::Fly(_));
        let flights: Vec<JobId> = self
            .jobs
            .iter()
            .filter(is_flight)
            .map(|(id, _)| *id)
            .collect();
        for id in flights {
            self.hold(id, true);
        }
    }

    /// Tells the worker of a job whether to work on it.
    pub(super) fn tell_hold(&mut self, id: JobId) {
        let is_held = self.held.contains(&id) || self.waiting.contains(&id);
        if let Some(assigned) = self.jobs.get(&id)
            && let Some(port) = &mut self.seats[assigned.seat].port
        {
            port.send(&Request::Hold(id, is_held));
        }
    }

    /// Lets the jobs of a role wait for more urgent ones that the other program does.
    pub(super) fn take_turns(&mut self, role: usize) {
        let mut changed = Vec::new();
        for (id, assigned) in &self.jobs {
            if role_at(assigned.seat) != role {
                continue;
            }
            let is_before = |(other, its): (&JobId, &Assigned)| {
                role_at(its.seat) == role
                    && its.seat != assigned.seat
                    && !self.held.contains(other)
                    && its.job.urgency() < assigned.job.urgency()
            };
            if self.jobs.iter().any(is_before) != self.waiting.contains(id) {
                changed.push(*id);
            }
        }
        for id in changed {
            if !self.waiting.remove(&id) {
                self.waiting.insert(id);
            }
            self.tell_hold(id);
        }
    }
}
