//! Decoding of camera pictures into textures, once per frame.

use egui::{Color32, ColorImage, Context, TextureHandle, TextureId, TextureOptions};
use pilotage_core::raster::decode_picture;

/// Which encoded picture the texture shows.
#[derive(Clone, Copy, PartialEq)]
struct Key {
    index: usize,
    address: usize,
    length: usize,
}

/// The texture of one frame.
#[derive(Default)]
pub(super) struct PictureCache {
    key: Option<Key>,
    texture: Option<TextureHandle>,
    trouble: Option<String>,
}

impl PictureCache {
    /// Decodes `bytes` unless they are what is shown already.
    ///
    /// While the bytes of a frame have not arrived there is no picture: an older one would lie.
    pub fn update(&mut self, context: &Context, index: usize, bytes: Option<&[u8]>) {
        let Some(bytes) = bytes else {
            *self = Self::default();
            return;
        };
        let key = Key {
            index,
            address: bytes.as_ptr() as usize,
            length: bytes.len(),
        };
        if self.key == Some(key) {
            return;
        }
        self.key = Some(key);
        match decode_picture(bytes) {
            Ok(picture) => {
                let size = [picture.width(), picture.height()];
                let pixels = picture.pixels().iter();
                let pixels = pixels.map(|[r, g, b]| Color32::from_rgb(*r, *g, *b));
                let picture = ColorImage::new(size, pixels.collect());
                self.trouble = None;
                match &mut self.texture {
                    Some(texture) => texture.set(picture, TextureOptions::LINEAR),
                    None => {
                        self.texture =
                            Some(context.load_texture("camera", picture, TextureOptions::LINEAR));
                    }
                }
            }
            Err(error) => {
                self.texture = None;
                self.trouble = Some(format!("This picture cannot be read: {error}"));
            }
        }
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
