//! Camera pictures of the flight that were taken: the workers have them, and decode one when it is looked at.

/// Frames whose pictures were taken.
#[derive(Debug, Default)]
pub struct FramePictures {
    taken: Vec<bool>,
    /// Number of frames after which the pictures repeat, of a flight that is flown lap after lap.
    lap: Option<usize>,
}

impl FramePictures {
    /// Takes note that the picture of frame `index` was taken; whether one was before.
    pub fn take(&mut self, index: usize) -> bool {
        if self.taken.len() <= index {
            self.taken.resize(index + 1, false);
        }
        std::mem::replace(&mut self.taken[index], true)
    }

    /// Frame of which the workers have the picture that frame `index` shows, if it was taken.
    pub fn key(&self, index: usize) -> Option<usize> {
        let key = self.lap.map_or(index, |lap| index % lap);
        self.taken.get(key).copied().unwrap_or(false).then_some(key)
    }

    /// Number of pictures that were taken.
    pub fn count(&self) -> usize {
        self.taken.iter().filter(|is_taken| **is_taken).count()
    }

    /// Lets the pictures of the first `lap` frames repeat.
    pub fn repeat(&mut self, lap: usize) {
        self.lap = (lap > 0).then_some(lap);
    }

    /// Forgets all of them.
    pub fn clear(&mut self) {
        *self = Self::default();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_picture_can_be_asked_for_once_it_was_taken_in_every_lap() {
        let mut pictures = FramePictures::default();
        assert!(!pictures.take(2));
        assert!(pictures.take(2));
        assert_eq!([pictures.key(1), pictures.key(2)], [None, Some(2)]);
        assert_eq!(pictures.key(12), None);
        pictures.repeat(5);
        assert_eq!([pictures.key(11), pictures.key(12)], [None, Some(2)]);
        assert_eq!(pictures.count(), 1);
        pictures.clear();
        assert_eq!((pictures.count(), pictures.key(12)), (0, None));
    }
}
