//! Decoding of camera pictures into textures, once per frame.

use egui::{ColorImage, Context, TextureHandle, TextureId, TextureOptions};

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
        match image::load_from_memory(bytes) {
            Ok(picture) => {
                let picture = picture.to_rgb8();
                let size = [picture.width() as usize, picture.height() as usize];
                let picture = ColorImage::from_rgb(size, picture.as_raw());
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
