//! Camera pictures that were let go of for lack of room, fetched again where people look.

use super::App;
use crate::context::shown_frame;
use crate::host::Host;
use pilotage_jobs::{FramePictureOrder, Job, JobEvent, JobId};

/// Pictures that are fetched at a time.
const FETCHED_AT_A_TIME: usize = 2;

impl App {
    /// Index of the frame at the time cursor; zero before the first.
    pub(super) fn frame_looked_at(&self) -> usize {
        let flight = self.documents.flight.as_ref();
        let shown = flight.and_then(|flight| shown_frame(flight, self.playback.time));
        shown.unwrap_or(0)
    }

    /// Fetches the picture at the time cursor and the next ones, where they are not here any more.
    pub(super) fn fetch_pictures(&mut self, host: &mut dyn Host) {
        let now = self.frame_looked_at();
        let documents = &self.documents;
        let wanted = [Some(now), Some(now + 1), now.checked_sub(1)];
        let wanted = wanted.into_iter().flatten();
        let lacking: Vec<usize> = wanted
            .filter(|index| documents.pictures.lacks(*index))
            .collect();
        for index in lacking {
            let fetching = &mut self.jobs.fetching_pictures;
            let is_under_way = fetching.iter().any(|(_, asked)| *asked == index);
            if is_under_way || fetching.len() >= FETCHED_AT_A_TIME {
                continue;
            }
            let flight = self.documents.flight_source.clone();
            let id = host.start(Job::FramePicture(FramePictureOrder { flight, index }));
            fetching.push((id, index));
        }
    }

    /// Takes what a worker says of a picture that was fetched; whether `id` was about one.
    pub(super) fn fetched_picture_event(&mut self, id: JobId, event: &JobEvent) -> bool {
        let fetching = &mut self.jobs.fetching_pictures;
        let Some(place) = fetching.iter().position(|(own, _)| *own == id) else {
            return false;
        };
        let (_, index) = fetching[place];
        match event {
            JobEvent::FramePicture { index, encoded } => {
                let looked_at = self.frame_looked_at();
                let encoded = encoded.as_slice().into();
                self.documents.pictures.insert(*index, encoded, looked_at);
            }
            JobEvent::Failed(_) => self.documents.pictures.give_up(index),
            _ => {}
        }
        if event.is_last() {
            self.jobs.fetching_pictures.remove(place);
        }
        true
    }
}
