//! Files for other programs, as a job: the page needs no writer of theirs.

use pilotage_core::exchange::labels::write_labels;
use pilotage_core::exchange::{Places, WrittenFile, write_flown, write_places};
use pilotage_core::frames::LocalFrame;

use super::order::{Order, Urgency, WorkerRole};
use super::running::once;
use super::{ExportOrder, JobEvent, RunningJob, WorkerState};

impl ExportOrder {
    /// The file; the error says in words why there is none.
    pub fn write(&self) -> Result<WrittenFile, String> {
        match self {
            Self::Places {
                format,
                routes,
                landmarks,
                no_fly,
                rally,
                origin,
            } => {
                let places = Places {
                    routes,
                    landmarks,
                    no_fly,
                    rally: Some(rally),
                };
                write_places(*format, &places, &LocalFrame::new(*origin))
                    .map_err(|cause| cause.to_string())
            }
            Self::Track { format, track } => {
                write_flown(*format, track).map_err(|cause| cause.to_string())
            }
            Self::Labels {
                format,
                frames,
                landmarks,
            } => write_labels(*format, frames, landmarks).map_err(|cause| cause.to_string()),
        }
    }
}

impl Order for ExportOrder {
    const URGENCY: Urgency = Urgency::Asked;

    fn role(&self) -> WorkerRole {
        WorkerRole::Questions
    }

    fn begin(self, _: &mut WorkerState) -> Box<dyn RunningJob> {
        once(move |_, emit| {
            let WrittenFile { bytes, notes } = self.write()?;
            emit(JobEvent::Exported { bytes, notes });
            Ok(())
        })
    }
}
