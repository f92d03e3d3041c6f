//! Camera pictures as textures. They are decoded by workers; this says which it lacks.

use std::collections::VecDeque;
use std::sync::Arc;

use egui::{ColorImage, Context, TextureHandle, TextureId, TextureOptions};

/// Pictures kept that were decoded before their time.
const PREPARED: usize = 4;
/// Pictures that cannot be read of which it is remembered.
const REFUSED: usize = 16;

/// A frame's encoded picture; the same bytes are the same picture.
#[derive(Clone)]
struct Encoded {
    frame: usize,
    bytes: Arc<[u8]>,
}

impl Encoded {
    fn is(&self, bytes: &Arc<[u8]>) -> bool {
        Arc::ptr_eq(&self.bytes, bytes)
    }
}

/// The texture of one frame, and pictures that are decoded for others.
#[derive(Default)]
pub(super) struct PictureCache {
    shown: Option<(Encoded, TextureHandle)>,
    /// Picture that is to be shown and is not decoded.
    wanted: Option<Encoded>,
    /// Pictures that cannot be read, and why.
    refused: VecDeque<(Encoded, String)>,
    prepared: VecDeque<(Encoded, ColorImage)>,
}

impl PictureCache {
    /// Takes the pixels of an encoded picture: red, green, blue and opacity of each.
    pub fn prepare(&mut self, frame: usize, bytes: &Arc<[u8]>, width: usize, pixels: &[u8]) {
        let height = pixels.len() / (4 * width.max(1));
        if 4 * width * height != pixels.len() {
            return self.refuse(frame, bytes, "its rows are of different lengths.");
        }
        let picture = ColorImage::from_rgba_premultiplied([width, height], pixels);
        if self.prepared.len() >= PREPARED {
            self.prepared.pop_front();
        }
        let bytes = Arc::clone(bytes);
        self.prepared.push_back((Encoded { frame, bytes }, picture));
    }

    /// Takes why a picture cannot be decoded.
    pub fn refuse(&mut self, frame: usize, bytes: &Arc<[u8]>, why: &str) {
        let bytes = Arc::clone(bytes);
        let why = format!("This picture cannot be read: {why}");
        if self.refused.len() >= REFUSED {
            self.refused.pop_front();
        }
        self.refused.push_back((Encoded { frame, bytes }, why));
    }

    /// Whether the pixels of a picture are here, or it is known that there are none.
    pub fn is_prepared(&self, bytes: &Arc<[u8]>) -> bool {
        self.shown.iter().any(|(own, _)| own.is(bytes))
            || self.refused.iter().any(|(own, _)| own.is(bytes))
            || self.prepared.iter().any(|(own, _)| own.is(bytes))
    }

    /// The frame and the encoded picture that is to be shown and has to be decoded for it.
    pub fn wanted(&self) -> Option<(usize, &Arc<[u8]>)> {
        let wanted = self.wanted.as_ref()?;
        let lacks = !self.is_prepared(&wanted.bytes);
        lacks.then_some((wanted.frame, &wanted.bytes))
    }

    /// Shows the picture of a frame, or on the way there the one before it; returns the frame that
    /// is shown.
    ///
    /// While the bytes of a frame have not arrived there is no picture: an older one would lie.
    pub fn update(
        &mut self,
        context: &Context,
        frame: usize,
        bytes: Option<Arc<[u8]>>,
    ) -> Option<usize> {
        let Some(bytes) = bytes else {
            self.clear();
            return None;
        };
        if let Some((shown, _)) = &mut self.shown
            && shown.is(&bytes)
        {
            // Laps of a long flight share their pictures.
            shown.frame = frame;
            self.wanted = None;
            return Some(frame);
        }
        if self.refused.iter().any(|(own, _)| own.is(&bytes)) {
            self.shown = None;
            self.wanted = Some(Encoded { frame, bytes });
            return None;
        }
        if let Some(place) = self.nearest(frame, &bytes)
            && let Some((mut own, picture)) = self.prepared.remove(place)
        {
            if own.is(&bytes) {
                own.frame = frame;
            }
            let options = TextureOptions::LINEAR;
            let texture = if let Some((_, mut texture)) = self.shown.take() {
                texture.set(picture, options);
                texture
            } else {
                context.load_texture("camera", picture, options)
            };
            self.shown = Some((own, texture));
        }
        let is_shown = self.shown.iter().any(|(own, _)| own.is(&bytes));
        self.wanted = (!is_shown).then_some(Encoded { frame, bytes });
        self.shown.as_ref().map(|(own, _)| own.frame)
    }

    /// The prepared picture that is closest to the wanted one: itself, or one on the way there from
    /// what is shown.
    fn nearest(&self, frame: usize, bytes: &Arc<[u8]>) -> Option<usize> {
        let mut prepared = self.prepared.iter();
        if let Some(place) = prepared.position(|(own, _)| own.is(bytes)) {
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

    /// The texture, if there is a picture.
    pub fn texture(&self) -> Option<TextureId> {
        self.shown.as_ref().map(|(_, texture)| texture.id())
    }

    /// Error of the picture, in words.
    pub fn trouble(&self) -> Option<&str> {
        let wanted = self.wanted.as_ref()?;
        let mut refused = self.refused.iter();
        let (_, why) = refused.find(|(own, _)| own.is(&wanted.bytes))?;
        Some(why)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn encoded(text: &str) -> Arc<[u8]> {
        Arc::from(text.as_bytes())
    }

    #[test]
    fn a_picture_is_asked_for_and_the_one_before_it_stays_until_it_comes() {
        let context = Context::default();
        let mut cache = PictureCache::default();
        let (first, second) = (encoded("first"), encoded("second"));
        assert_eq!(cache.update(&context, 4, Some(first.clone())), None);
        assert!(
            cache
                .wanted()
                .is_some_and(|(f, b)| f == 4 && Arc::ptr_eq(b, &first))
        );
        cache.prepare(4, &first, 2, &[255; 16]);
        assert!(cache.wanted().is_none(), "it is here");
        assert_eq!(cache.update(&context, 4, Some(first.clone())), Some(4));
        assert!(cache.texture().is_some());
        assert_eq!(cache.update(&context, 5, Some(second.clone())), Some(4));
        assert!(cache.texture().is_some(), "no flicker");
        assert_eq!(cache.wanted().map(|w| w.0), Some(5));
        cache.prepare(5, &second, 2, &[0; 16]);
        assert_eq!(cache.update(&context, 5, Some(second)), Some(5));
        assert_eq!(cache.update(&context, 6, None), None);
        assert!(cache.texture().is_none(), "an older picture would lie");
    }

    #[test]
    fn what_comes_on_the_way_of_a_long_scrub_is_shown() {
        let context = Context::default();
        let mut cache = PictureCache::default();
        let pictures: Vec<_> = (0..9).map(|i| encoded(&i.to_string())).collect();
        let at = |cache: &mut PictureCache, frame: usize| {
            cache.update(&context, frame, Some(pictures[frame].clone()))
        };
        cache.prepare(2, &pictures[2], 2, &[255; 16]);
        assert_eq!(at(&mut cache, 2), Some(2));
        cache.prepare(4, &pictures[4], 2, &[255; 16]);
        cache.prepare(5, &pictures[5], 2, &[255; 16]);
        cache.prepare(8, &pictures[8], 2, &[255; 16]);
        assert_eq!(at(&mut cache, 7), Some(5), "not 8, which is to come");
        assert_eq!(at(&mut cache, 3), Some(4), "on the way back");
    }

    #[test]
    fn a_picture_that_cannot_be_read_is_told_and_not_asked_for_again() {
        let context = Context::default();
        let mut cache = PictureCache::default();
        let (broken, good) = (encoded("broken"), encoded("good"));
        cache.update(&context, 0, Some(broken.clone()));
        cache.refuse(0, &broken, "it is cut off.");
        assert_eq!(cache.update(&context, 0, Some(broken.clone())), None);
        assert!(cache.trouble().is_some_and(|why| why.contains("cut off")));
        assert!(cache.wanted().is_none());
        cache.update(&context, 1, Some(good));
        assert!(cache.trouble().is_none() && cache.wanted().is_some());
    }
}
