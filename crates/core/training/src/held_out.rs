//! The photos by which a training is judged.

use super::photo::{Photographer, TrainingPhoto};
use pilotage_base::frames::GroundPoint;

/// Of the photos, one in so many is of a look-alike, if there are any.
const LOOK_ALIKE_EVERY: usize = 4;

/// Photos in their order.
pub type TrainingPhotos = Box<dyn Iterator<Item = TrainingPhoto> + Send>;

/// Takes the photos by which a training is judged, in their order; they need nothing of the training, and
/// may be taken by another thread meanwhile. Ends early if the landmark does not fit into the pictures.
pub(super) struct HeldOutPhotos {
    photographer: Photographer,
    look_alikes: Vec<GroundPoint>,
    next: usize,
    count: usize,
}

impl HeldOutPhotos {
    pub fn new(photographer: Photographer, look_alikes: &[GroundPoint], count: usize) -> Self {
        Self {
            photographer,
            look_alikes: look_alikes.to_vec(),
            next: 0,
            count,
        }
    }
}

impl Iterator for HeldOutPhotos {
    type Item = TrainingPhoto;

    fn next(&mut self) -> Option<TrainingPhoto> {
        if self.next >= self.count {
            return None;
        }
        let place = look_alike(&self.look_alikes, self.next);
        self.next += 1;
        match place {
            Some(place) => self.photographer.take_elsewhere(place),
            None => self.photographer.take(),
        }
    }
}

/// The look-alike that photo `number` is of.
pub(super) fn look_alike(places: &[GroundPoint], number: usize) -> Option<GroundPoint> {
    let turn = number % LOOK_ALIKE_EVERY == LOOK_ALIKE_EVERY - 1;
    (turn && !places.is_empty()).then(|| places[number / LOOK_ALIKE_EVERY % places.len()])
}
