//! Camera pictures at the time cursor, asked of the workers.

use pilotage_jobs::{FramePictureOrder, Job, JobEvent, JobId, PictureForm};

use crate::context::shown_frame;
use crate::documents::Documents;
use crate::host::Host;
use crate::job_owners::JobOwner;
use crate::timeline::Playback;
use crate::views::CameraView;

/// Pictures that are decoded at a time. A second one keeps the worker busy while the first is on its way.
const AT_A_TIME: usize = 2;

/// Pictures that were asked for: job, frame, and the frame of which the workers have its picture.
#[derive(Debug, Default)]
pub struct FramePictureRequests(Vec<(JobId, usize, usize)>);

impl FramePictureRequests {
    /// Asks for the picture that is looked at, then for those that are likely to be next.
    pub fn ask(
        &mut self,
        host: &mut dyn Host,
        documents: &Documents,
        playback: &Playback,
        camera: &CameraView,
    ) {
        let is_idle = |key: usize| {
            let is_under_way = self.0.iter().any(|(_, _, asked)| *asked == key);
            !is_under_way && !camera.is_prepared(key)
        };
        let wanted = camera.wanted().filter(|(_, key)| is_idle(*key));
        let next = match wanted {
            Some(wanted) if self.0.len() < AT_A_TIME => Some(wanted),
            None if self.0.is_empty() => likely(documents, playback).find(|(_, key)| is_idle(*key)),
            _ => None,
        };
        if let Some((frame, index)) = next {
            let order = FramePictureOrder {
                flight: documents.flight.source.clone(),
                index,
                form: PictureForm::Pixels,
            };
            let id = host.start(JobOwner::FramePictures, Job::FramePicture(order));
            self.0.push((id, frame, index));
        }
    }

    /// Takes what a worker says of a picture; false if no such picture is awaited, or nothing of that kind of it.
    pub fn take(&mut self, id: JobId, event: &JobEvent, camera: &mut CameraView) -> bool {
        let Some(place) = self.0.iter().position(|(own, ..)| *own == id) else {
            return false;
        };
        let (_, frame, key) = self.0[place];
        match event {
            JobEvent::FramePicture { width, pixels, .. } => {
                camera.prepare(frame, key, *width, pixels);
            }
            JobEvent::Failed(why) => camera.refuse(key, why),
            JobEvent::Progress(..) | JobEvent::Finished | JobEvent::Cancelled => {}
            _ => return false,
        }
        if event.is_last() {
            self.0.remove(place);
        }
        true
    }

    /// Wants none of them any more.
    pub fn leave(&mut self, host: &mut dyn Host) {
        for (id, ..) in self.0.drain(..) {
            host.leave(id);
        }
    }
}

/// Frames that are about to be shown and the pictures that they show: in playback the next ones, else those to which one
/// step leads.
fn likely(documents: &Documents, playback: &Playback) -> impl Iterator<Item = (usize, usize)> {
    let flight = documents.flight.measured.as_ref();
    let shown = flight.and_then(|flight| shown_frame(flight, playback.time));
    let next = shown.map_or(0, |shown| shown + 1);
    let frames = if playback.playing {
        [Some(next), Some(next + 1)]
    } else {
        [Some(next), next.checked_sub(2)]
    };
    let pictures = &documents.flight.pictures;
    let known = |frame| Some((frame, pictures.key(frame)?));
    frames.into_iter().flatten().filter_map(known)
}
