//! Encoded camera pictures of the flight, in bounded memory.

use std::sync::Arc;

/// Memory for encoded pictures, bytes: some 600 of a usual camera. A film of thousands does not fit into a page.
const MOST: usize = 64 << 20;

/// A picture as far as it is known.
#[derive(Debug, Default)]
enum Slot {
    /// It was not told.
    #[default]
    Unknown,
    /// It was told, and can be fetched again.
    Told,
    /// It is here.
    Kept(Arc<[u8]>),
}

/// Encoded camera pictures of the flight by the index of their frame: those nearest to where people look. Others were
/// told, and can be fetched again.
#[derive(Debug)]
pub struct FramePictures {
    slots: Vec<Slot>,
    bytes: usize,
    most: usize,
}

impl Default for FramePictures {
    fn default() -> Self {
        Self::within(MOST)
    }
}

impl FramePictures {
    /// No pictures yet, and memory for so many bytes.
    fn within(most: usize) -> Self {
        Self {
            slots: Vec::new(),
            bytes: 0,
            most,
        }
    }

    /// Takes the picture of frame `index`. Where there is no room for all, those go that are farthest from frame
    /// `looked_at`; one always stays.
    pub fn insert(&mut self, index: usize, encoded: Arc<[u8]>, looked_at: usize) {
        if self.slots.len() <= index {
            self.slots.resize_with(index + 1, Slot::default);
        }
        self.bytes += encoded.len();
        self.replace(index, Slot::Kept(encoded));
        while self.bytes > self.most && self.drop_farthest(looked_at) {}
    }

    /// Puts something in the place of a picture.
    fn replace(&mut self, index: usize, new: Slot) {
        if let Slot::Kept(old) = std::mem::replace(&mut self.slots[index], new) {
            self.bytes -= old.len();
        }
    }

    /// Lets go of the picture that is farthest from a frame; false if it is the last one.
    fn drop_farthest(&mut self, looked_at: usize) -> bool {
        let is_kept = |slot: &Slot| matches!(slot, Slot::Kept(_));
        let first = self.slots.iter().position(is_kept);
        let last = self.slots.iter().rposition(is_kept);
        let Some((first, last)) = first.zip(last).filter(|(first, last)| first < last) else {
            return false;
        };
        let is_first = first.abs_diff(looked_at) > last.abs_diff(looked_at);
        self.replace(if is_first { first } else { last }, Slot::Told);
        true
    }

    /// The picture of frame `index`, if it is here.
    pub fn get(&self, index: usize) -> Option<&Arc<[u8]>> {
        match self.slots.get(index)? {
            Slot::Kept(encoded) => Some(encoded),
            Slot::Told | Slot::Unknown => None,
        }
    }

    /// Whether the picture of frame `index` was told and is not here any more.
    pub fn lacks(&self, index: usize) -> bool {
        matches!(self.slots.get(index), Some(Slot::Told))
    }

    /// Takes note that the picture of frame `index` cannot be had again.
    pub fn give_up(&mut self, index: usize) {
        if self.lacks(index) {
            self.slots[index] = Slot::Unknown;
        }
    }

    /// Number of pictures that were told.
    pub fn count(&self) -> usize {
        let is_told = |slot: &&Slot| !matches!(slot, Slot::Unknown);
        self.slots.iter().filter(is_told).count()
    }

    /// Forgets all of them.
    pub fn clear(&mut self) {
        self.slots.clear();
        self.bytes = 0;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn picture(bytes: usize) -> Arc<[u8]> {
        vec![7; bytes].into()
    }

    #[test]
    fn a_long_film_stays_within_its_memory_around_the_frame_that_is_looked_at() {
        let mut pictures = FramePictures::within(1000);
        for index in 0..2000 {
            pictures.insert(index, picture(100), 1200);
            assert!(pictures.bytes <= 1000);
        }
        assert_eq!(pictures.count(), 2000);
        let kept: Vec<usize> = (0..2000).filter(|i| pictures.get(*i).is_some()).collect();
        assert_eq!(kept, (1195..1205).collect::<Vec<_>>());
        assert!(pictures.lacks(0) && !pictures.lacks(1200) && !pictures.lacks(3000));
        pictures.insert(0, picture(100), 0);
        assert!(pictures.get(0).is_some() && pictures.lacks(1204));
        pictures.give_up(5);
        assert!(!pictures.lacks(5));
    }

    #[test]
    fn a_picture_larger_than_the_memory_stays_alone_and_one_told_twice_counts_once() {
        let mut pictures = FramePictures::within(1000);
        pictures.insert(3, picture(400), 3);
        pictures.insert(3, picture(300), 3);
        assert_eq!((pictures.bytes, pictures.count()), (300, 1));
        pictures.insert(4, picture(5000), 4);
        assert!(pictures.get(4).is_some() && pictures.lacks(3));
        assert_eq!(pictures.bytes, 5000);
        pictures.clear();
        assert_eq!((pictures.bytes, pictures.count()), (0, 0));
    }
}
