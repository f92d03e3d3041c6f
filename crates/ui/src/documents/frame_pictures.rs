//! Encoded camera pictures of the flight, in bounded memory.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

/// Memory for encoded pictures, bytes: some 600 of a usual camera. A film of thousands does not fit into a page.
const MOST: usize = 64 << 20;

/// Encoded camera pictures of the flight by the index of their frame: those nearest to where people look. Others were
/// told, and can be fetched again.
#[derive(Debug)]
pub struct FramePictures {
    kept: BTreeMap<usize, Arc<[u8]>>,
    told: BTreeSet<usize>,
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
            kept: BTreeMap::new(),
            told: BTreeSet::new(),
            bytes: 0,
            most,
        }
    }

    /// Takes the picture of frame `index`. Where there is no room for all, those go that are farthest from frame
    /// `looked_at`; one always stays.
    pub fn insert(&mut self, index: usize, encoded: Arc<[u8]>, looked_at: usize) {
        self.told.insert(index);
        self.bytes += encoded.len();
        if let Some(old) = self.kept.insert(index, encoded) {
            self.bytes -= old.len();
        }
        while self.bytes > self.most && self.kept.len() > 1 {
            self.drop_farthest(looked_at);
        }
    }

    fn drop_farthest(&mut self, looked_at: usize) {
        let ends = [self.kept.first_key_value(), self.kept.last_key_value()];
        let ends = ends.into_iter().flatten().map(|(index, _)| *index);
        let farthest = ends.max_by_key(|index| index.abs_diff(looked_at));
        if let Some(picture) = farthest.and_then(|index| self.kept.remove(&index)) {
            self.bytes -= picture.len();
        }
    }

    /// The picture of frame `index`, if it is here.
    pub fn get(&self, index: usize) -> Option<&Arc<[u8]>> {
        self.kept.get(&index)
    }

    /// Whether the picture of frame `index` was told and is not here any more.
    pub fn lacks(&self, index: usize) -> bool {
        self.told.contains(&index) && !self.kept.contains_key(&index)
    }

    /// Takes note that the picture of frame `index` cannot be had again.
    pub fn give_up(&mut self, index: usize) {
        self.told.remove(&index);
    }

    /// Number of pictures that were told.
    pub fn count(&self) -> usize {
        self.told.len()
    }

    /// Forgets all of them.
    pub fn clear(&mut self) {
        self.kept.clear();
        self.told.clear();
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
        let kept: Vec<usize> = pictures.kept.keys().copied().collect();
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
