//! A camera picture of a flight.

use std::hash::{DefaultHasher, Hash, Hasher};

use pilotage_core::raster::decode_picture;
use serde::{Deserialize, Serialize};

use super::order::{Order, Urgency, WorkerRole, keys_of};
use super::running::once;
use super::{EncodedPicture, FlightSource, JobEvent, RunningJob, WorkerState};

/// Form in which a camera picture is asked for.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum PictureForm {
    /// Its pixels: event `FramePicture`.
    Pixels,
    /// Its pixels, by whoever has it encoded: that need not wait for the flight.
    PixelsOf(EncodedPicture),
    /// The file that it is in, or would be: event `FrameEncoded`.
    Encoded,
}

/// Camera picture of a flight. It crosses to the page once, decoded, when somebody looks at it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct FramePictureOrder {
    /// The flight.
    pub flight: FlightSource,
    /// Index of the frame.
    pub index: usize,
    /// Form in which it is wanted.
    pub form: PictureForm,
}

impl Order for FramePictureOrder {
    const URGENCY: Urgency = Urgency::First;

    /// The worker that flies has the flight open.
    fn role(&self) -> WorkerRole {
        match self.form {
            PictureForm::PixelsOf(_) => WorkerRole::Questions,
            PictureForm::Pixels | PictureForm::Encoded => WorkerRole::Flight,
        }
    }

    fn files(&self) -> Vec<&str> {
        match self.form {
            PictureForm::PixelsOf(_) => Vec::new(),
            PictureForm::Pixels | PictureForm::Encoded => keys_of(Some(&self.flight), None),
        }
    }

    fn is_small(&self) -> bool {
        matches!(self.form, PictureForm::PixelsOf(_)) || self.flight.is_small()
    }

    fn begin(self, _: &mut WorkerState) -> Box<dyn RunningJob> {
        once(move |worker, emit| {
            let index = self.index;
            let mut taken = || -> Result<_, String> {
                let open = worker.flight(&self.flight)?;
                let encoded = open.borrow_mut().frames.kept(index);
                encoded.map_err(|cause| cause.to_string())
            };
            let decoded = match &self.form {
                PictureForm::PixelsOf(encoded) => decode_picture(&encoded.0),
                PictureForm::Pixels => decode_picture(&taken()?),
                PictureForm::Encoded => {
                    let encoded = EncodedPicture(taken()?.to_vec());
                    emit(JobEvent::FrameEncoded { index, encoded });
                    return Ok(());
                }
            };
            let picture = decoded.map_err(|cause| cause.to_string())?;
            let opaque = |[r, g, b]: &[u8; 3]| [*r, *g, *b, u8::MAX];
            emit(JobEvent::FramePicture {
                index,
                width: picture.width(),
                pixels: picture.pixels().iter().flat_map(opaque).collect(),
            });
            Ok(())
        })
    }
}

/// Digest of an encoded picture: equal for equal bytes, and hardly ever for others.
pub fn digest(encoded: &[u8]) -> u64 {
    let mut hasher = DefaultHasher::new();
    encoded.hash(&mut hasher);
    hasher.finish()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{FlyOrder, InlineWorkers, Job, SimulationOptions};
    use pilotage_core::raster::{Raster, encode_png};

    fn asked(order: FramePictureOrder) -> Vec<(u64, JobEvent)> {
        let mut workers = InlineWorkers::new();
        workers.start(Job::FramePicture(order));
        workers.finish_jobs();
        workers.events()
    }

    #[test]
    fn a_picture_that_was_taken_is_told_decoded_once_it_is_asked_for() {
        let demo = SimulationOptions::demo();
        let (map, flight) = (demo.map(), FlightSource::Simulated(demo));
        let mut workers = InlineWorkers::new();
        let id = workers.start(Job::Fly(FlyOrder {
            flight: flight.clone(),
            map,
            mission: None,
        }));
        let mut taken = None;
        while taken.is_none() {
            taken = workers.events().into_iter().find_map(|(_, it)| match it {
                JobEvent::FrameTaken { index: 1, digest } => digest,
                JobEvent::FramePicture { .. } => panic!("nobody asked for it"),
                _ => None,
            });
        }
        workers.cancel(id);
        workers.events();
        let mut ask = |form| {
            workers.start(Job::FramePicture(FramePictureOrder {
                flight: flight.clone(),
                index: 1,
                form,
            }));
            workers.finish_jobs();
            workers.events()
        };
        let events = ask(PictureForm::Encoded);
        let [(_, JobEvent::FrameEncoded { encoded, .. }), _] = &events[..] else {
            panic!("{events:?}");
        };
        assert_eq!(taken, Some(digest(&encoded.0)));
        let events = ask(PictureForm::Pixels);
        let [
            (
                _,
                JobEvent::FramePicture {
                    index,
                    width,
                    pixels,
                },
            ),
            _,
        ] = &events[..]
        else {
            panic!("{events:?}");
        };
        assert_eq!((*index, *width), (1, 640));
        assert_eq!(pixels.len(), 4 * 640 * 480);
    }

    #[test]
    fn a_picture_that_comes_with_the_order_is_decoded_without_the_flight() {
        let encoded = encode_png(&Raster::filled(3, 2, [9, 8, 7])).unwrap();
        let events = asked(FramePictureOrder {
            flight: FlightSource::Files("nowhere".to_owned()),
            index: 4,
            form: PictureForm::PixelsOf(EncodedPicture(encoded)),
        });
        let pixels = [9, 8, 7, 255].repeat(6);
        let told = JobEvent::FramePicture {
            index: 4,
            width: 3,
            pixels,
        };
        assert_eq!(events[0].1, told);
    }

    #[test]
    fn a_picture_that_is_not_there_is_refused_in_words() {
        let events = asked(FramePictureOrder {
            flight: FlightSource::Simulated(SimulationOptions::demo()),
            index: 1_000_000,
            form: PictureForm::Pixels,
        });
        assert!(
            matches!(&events[..], [(_, JobEvent::Failed(_))]),
            "{events:?}"
        );
    }
}
