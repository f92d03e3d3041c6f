//! Decoding of camera pictures into textures, once per frame.

use std::collections::VecDeque;

use egui::{Color32, ColorImage, Context, TextureHandle, TextureId, TextureOptions};
use pilotage_core::raster::decode_picture;

/// Pictures kept that were decoded before their time.
const PREPARED: usize = 3;

/// Which encoded picture the texture shows.
#[derive(Clone, Copy, PartialEq)]
struct Key {
    index: usize,
    address: usize,
    length: usize,
}

impl Key {
    fn of(index: usize, bytes: &[u8]) -> Self {
        Self {
            index,
            address: bytes.as_ptr() as usize,
            length: bytes.len(),
        }
    }
}

/// The texture of one frame.
#[derive(Default)]
pub(super) struct PictureCache {
    key: Option<Key>,
    texture: Option<TextureHandle>,
    trouble: Option<String>,
    prepared: VecDeque<(Key, ColorImage)>,
}

impl PictureCache {
    /// Takes the pixels of an encoded picture: red, green, blue and opacity of each.
    pub fn prepare(&mut self, index: usize, bytes: &[u8], width: usize, pixels: &[u8]) {
        let height = pixels.len() / (4 * width.max(1));
        if 4 * width * height != pixels.len() {
            return;
        }
        let picture = ColorImage::from_rgba_premultiplied([width, height], pixels);
        if self.prepared.len() >= PREPARED {
            self.prepared.pop_front();
        }
        self.prepared.push_back((Key::of(index, bytes), picture));
    }

    /// Whether the pixels of a picture are here.
    pub fn is_prepared(&self, index: usize, bytes: &[u8]) -> bool {
        let key = Key::of(index, bytes);
        self.key == Some(key) || self.prepared.iter().any(|(own, _)| *own == key)
    }

    /// Shows `bytes`, decoded now unless they are what is shown already, or were prepared.
    ///
    /// While the bytes of a frame have not arrived there is no picture: an older one would lie.
    pub fn update(&mut self, context: &Context, index: usize, bytes: Option<&[u8]>) {
        let Some(bytes) = bytes else {
            self.key = None;
            self.texture = None;
            self.trouble = None;
            return;
        };
        let key = Key::of(index, bytes);
        if self.key == Some(key) {
            return;
        }
        self.key = Some(key);
        match self.take_prepared(key).map_or_else(|| decode(bytes), Ok) {
            Ok(picture) => {
                self.trouble = None;
                match &mut self.texture {
                    Some(texture) => texture.set(picture, TextureOptions::LINEAR),
                    None => {
                        self.texture =
                            Some(context.load_texture("camera", picture, TextureOptions::LINEAR));
                    }
                }
            }
            Err(trouble) => {
                self.texture = None;
                self.trouble = Some(trouble);
            }
        }
    }

    fn take_prepared(&mut self, key: Key) -> Option<ColorImage> {
        let place = self.prepared.iter().position(|(own, _)| *own == key)?;
        self.prepared.remove(place).map(|(_, picture)| picture)
    }

    /// The texture, if there is a picture.
    pub fn texture(&self) -> Option<TextureId> {
        self.texture.as_ref().map(TextureHandle::id)
    }

    /// What is wrong with the picture, in words.
    pub fn trouble(&self) -> Option<&str> {
        self.trouble.as_deref()
    }
}

fn decode(bytes: &[u8]) -> Result<ColorImage, String> {
    let picture =
        decode_picture(bytes).map_err(|error| format!("This picture cannot be read: {error}"))?;
    let size = [picture.width(), picture.height()];
    let pixels = picture.pixels().iter();
    let pixels = pixels.map(|[r, g, b]| Color32::from_rgb(*r, *g, *b));
    Ok(ColorImage::new(size, pixels.collect()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_prepared_picture_is_shown_without_decoding_it_again() {
        let context = Context::default();
        let mut cache = PictureCache::default();
        let bytes = b"not a picture";
        assert!(!cache.is_prepared(4, bytes));
        cache.prepare(4, bytes, 2, &[255; 16]);
        assert!(cache.is_prepared(4, bytes) && !cache.is_prepared(5, bytes));
        cache.update(&context, 4, Some(bytes));
        assert!(cache.texture().is_some() && cache.trouble().is_none());
        assert!(cache.is_prepared(4, bytes));
        cache.update(&context, 5, Some(bytes));
        assert!(cache.trouble().is_some());
    }
}
