//! Camera pictures as textures. Workers decode them; this says which is lacking.

use std::collections::VecDeque;
use std::sync::Arc;

use egui::{ColorImage, Context, TextureHandle, TextureId, TextureOptions};

/// Memory for decoded pictures, bytes: some 50 of a usual camera.
const MEMORY: usize = 64 << 20;
/// Pictures that are kept whatever they need.
const FEWEST: usize = 2;
/// Pictures that cannot be shown of which it is remembered.
const REFUSED: usize = 16;

/// Picture that a frame shows. Frames of equal keys show the same one.
#[derive(Clone, Copy, PartialEq)]
struct Shown {
    frame: usize,
    key: usize,
}

/// The texture of one frame, and decoded pictures: those that were shown or came last.
#[derive(Default)]
pub(super) struct PictureCache {
    shown: Option<(Shown, TextureHandle)>,
    /// Picture that is to be shown and is not decoded.
    wanted: Option<Shown>,
    /// Pictures that cannot be shown, and why.
    refused: VecDeque<(usize, String)>,
    prepared: VecDeque<(Shown, Arc<ColorImage>)>,
}

fn bytes(picture: &ColorImage) -> usize {
    4 * picture.pixels.len()
}

impl PictureCache {
    /// Takes the pixels of a picture: red, green, blue and opacity of each.
    pub fn prepare(&mut self, frame: usize, key: usize, width: usize, pixels: &[u8]) {
        let height = pixels.len() / (4 * width.max(1));
        if 4 * width * height != pixels.len() {
            return self.refuse(key, "its rows are of different lengths.");
        }
        let picture = ColorImage::from_rgba_premultiplied([width, height], pixels);
        self.prepared
            .push_back((Shown { frame, key }, Arc::new(picture)));
        let prepared = &mut self.prepared;
        let mut all: usize = prepared.iter().map(|(_, it)| bytes(it)).sum();
        while all > MEMORY && prepared.len() > FEWEST {
            all -= prepared.pop_front().map_or(0, |(_, it)| bytes(&it));
        }
    }

    /// Takes why a picture cannot be shown.
    pub fn refuse(&mut self, key: usize, why: &str) {
        let why = format!("This picture cannot be read: {why}");
        if self.refused.len() >= REFUSED {
            self.refused.pop_front();
        }
        self.refused.push_back((key, why));
    }

    /// Takes note that a picture is another one by now.
    pub fn forget(&mut self, key: usize) {
        self.prepared.retain(|(own, _)| own.key != key);
        self.refused.retain(|(own, _)| *own != key);
        if self.shown.as_ref().is_some_and(|(own, _)| own.key == key) {
            self.shown = None;
        }
    }

    /// Whether the pixels of a picture are here, or it is known that there are none.
    pub fn is_prepared(&self, key: usize) -> bool {
        self.shown.iter().any(|(own, _)| own.key == key)
            || self.refused.iter().any(|(own, _)| *own == key)
            || self.prepared.iter().any(|(own, _)| own.key == key)
    }

    /// Frame that is to be shown, and the picture that is lacking for it.
    pub fn wanted(&self) -> Option<(usize, usize)> {
        let Shown { frame, key } = self.wanted?;
        (!self.is_prepared(key)).then_some((frame, key))
    }

    /// Shows the picture of a frame, or on the way there the one before it; returns the frame that
    /// is shown.
    ///
    /// While the picture of a frame was not taken there is none: an older one would lie.
    pub fn update(&mut self, context: &Context, frame: usize, key: Option<usize>) -> Option<usize> {
        let Some(key) = key else {
            self.clear();
            return None;
        };
        if let Some((shown, _)) = &mut self.shown
            && shown.key == key
        {
            // Laps of a long flight share their pictures.
            shown.frame = frame;
            self.wanted = None;
            return Some(frame);
        }
        if self.refused.iter().any(|(own, _)| *own == key) {
            self.shown = None;
            self.wanted = Some(Shown { frame, key });
            return None;
        }
        if let Some(place) = self.nearest(frame, key)
            && let Some((mut own, picture)) = self.prepared.remove(place)
        {
            if own.key == key {
                own.frame = frame;
            }
            self.prepared.push_back((own, Arc::clone(&picture)));
            let options = TextureOptions::LINEAR;
            let texture = if let Some((_, mut texture)) = self.shown.take() {
                texture.set(picture, options);
                texture
            } else {
                context.load_texture("camera", picture, options)
            };
            self.shown = Some((own, texture));
        }
        let is_shown = self.shown.iter().any(|(own, _)| own.key == key);
        self.wanted = (!is_shown).then_some(Shown { frame, key });
        self.shown.as_ref().map(|(own, _)| own.frame)
    }

    /// The prepared picture that is closest to the wanted one: itself, or one on the way there from
    /// what is shown.
    fn nearest(&self, frame: usize, key: usize) -> Option<usize> {
        let mut prepared = self.prepared.iter();
        if let Some(place) = prepared.position(|(own, _)| own.key == key) {
            return Some(place);
        }
        let shown = self.shown.as_ref()?.0.frame;
        let (low, high) = (shown.min(frame), shown.max(frame));
        let between = |of: usize| low < of && of < high;
        let prepared = self.prepared.iter().enumerate();
        prepared
            .filter(|(_, (own, _))| between(own.frame))
            .min_by_key(|(_, (own, _))| own.frame.abs_diff(frame))
            .map(|(place, _)| place)
    }

    /// Shows nothing.
    pub fn clear(&mut self) {
        (self.shown, self.wanted) = (None, None);
    }

    /// Lets go of everything: the pictures are those of another flight.
    pub fn leave_flight(&mut self) {
        *self = Self::default();
    }

    /// The texture, if there is a picture.
    pub fn texture(&self) -> Option<TextureId> {
        self.shown.as_ref().map(|(_, texture)| texture.id())
    }

    /// Error of the picture, in words.
    pub fn trouble(&self) -> Option<&str> {
        let wanted = self.wanted.as_ref()?;
        let mut refused = self.refused.iter();
        let (_, why) = refused.find(|(own, _)| *own == wanted.key)?;
        Some(why)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_picture_is_asked_for_and_the_one_before_it_stays_until_it_comes() {
        let context = Context::default();
        let mut cache = PictureCache::default();
        assert_eq!(cache.update(&context, 4, Some(4)), None);
        assert_eq!(cache.wanted(), Some((4, 4)));
        cache.prepare(4, 4, 2, &[255; 16]);
        assert!(cache.wanted().is_none(), "it is here");
        assert_eq!(cache.update(&context, 4, Some(4)), Some(4));
        assert!(cache.texture().is_some());
        assert_eq!(cache.update(&context, 5, Some(5)), Some(4));
        assert!(cache.texture().is_some(), "no flicker");
        assert_eq!(cache.wanted(), Some((5, 5)));
        cache.prepare(5, 5, 2, &[0; 16]);
        assert_eq!(cache.update(&context, 5, Some(5)), Some(5));
        cache.forget(5);
        assert_eq!(
            cache.update(&context, 5, Some(5)),
            None,
            "it is another one"
        );
        assert_eq!(cache.update(&context, 6, None), None);
        assert!(cache.texture().is_none(), "an older picture would lie");
    }

    #[test]
    fn what_comes_on_the_way_of_a_long_scrub_is_shown() {
        let context = Context::default();
        let mut cache = PictureCache::default();
        let at = |cache: &mut PictureCache, frame| cache.update(&context, frame, Some(frame));
        cache.prepare(2, 2, 2, &[255; 16]);
        assert_eq!(at(&mut cache, 2), Some(2));
        cache.prepare(4, 4, 2, &[255; 16]);
        cache.prepare(5, 5, 2, &[255; 16]);
        cache.prepare(8, 8, 2, &[255; 16]);
        assert_eq!(at(&mut cache, 7), Some(5), "not 8, which is to come");
        assert_eq!(at(&mut cache, 3), Some(4), "on the way back");
    }

    #[test]
    fn a_picture_that_cannot_be_read_is_told_and_not_asked_for_again() {
        let context = Context::default();
        let mut cache = PictureCache::default();
        cache.update(&context, 0, Some(0));
        cache.refuse(0, "it is cut off.");
        assert_eq!(cache.update(&context, 0, Some(0)), None);
        assert!(cache.trouble().is_some_and(|why| why.contains("cut off")));
        assert!(cache.wanted().is_none());
        cache.update(&context, 1, Some(1));
        assert!(cache.trouble().is_none() && cache.wanted().is_some());
    }

    #[test]
    fn decoded_pictures_stay_within_their_memory_and_two_always_stay() {
        let mut cache = PictureCache::default();
        let of = |bytes: usize| vec![7; bytes];
        for frame in 0..40 {
            cache.prepare(frame, frame, 1024, &of(4 << 20));
        }
        let kept: Vec<usize> = (0..40).filter(|key| cache.is_prepared(*key)).collect();
        assert_eq!(kept, (24..40).collect::<Vec<_>>());
        for frame in 40..43 {
            cache.prepare(frame, frame, 1024, &of(48 << 20));
        }
        let kept: Vec<usize> = (0..43).filter(|key| cache.is_prepared(*key)).collect();
        assert_eq!(kept, [41, 42]);
    }
}
