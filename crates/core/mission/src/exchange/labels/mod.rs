//! Labels as programs for labelling and training read and write them: Pascal VOC and COCO.
//!
//! Ours count pixels from the outer corner of the top left one. VOC counts pixels themselves from
//! one, both ends included, as the development kit of its challenge does: xmin = left + 1,
//! xmax = right. COCO counts as we do.

mod coco;
mod found;
mod outline;
#[cfg(test)]
mod tests;
mod voc;

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use super::{ExchangeError, WrittenFile};
use crate::mission::FrameLabels;
use pilotage_base::files::{FileSink as _, ZipSink};
use pilotage_vision::landmark::Landmark;

pub use found::FoundLabels;

/// A format of labels.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub enum LabelFormat {
    /// Pascal VOC: an XML file for each picture, zipped.
    Voc,
    /// COCO: a JSON file for all.
    Coco,
}

impl LabelFormat {
    /// Name for people.
    pub fn name(self) -> &'static str {
        match self {
            Self::Voc => "Pascal VOC",
            Self::Coco => "COCO",
        }
    }

    /// The end of the file's name.
    pub fn ending(self) -> &'static str {
        match self {
            Self::Voc => "labels-voc.zip",
            Self::Coco => "labels-coco.json",
        }
    }

    /// The format of a file, told by its content.
    pub fn of(bytes: &[u8]) -> Option<Self> {
        let has = |words: &[u8]| bytes.windows(words.len()).any(|w| w == words);
        let first = bytes.iter().find(|b| !b.is_ascii_whitespace());
        match first {
            Some(b'<' | 0xef) if has(b"<annotation") => Some(Self::Voc),
            Some(b'{' | 0xef) if has(b"\"annotations\"") && has(b"\"images\"") => Some(Self::Coco),
            _ => None,
        }
    }
}

/// Reads a file of labels in either format, told by its content; errors name the file and the place.
pub fn read_labels(name: &str, bytes: &[u8]) -> Result<FoundLabels, ExchangeError> {
    let wrong = |cause: &str| ExchangeError::File {
        file: name.to_owned(),
        cause: cause.to_owned(),
    };
    let format = LabelFormat::of(bytes)
        .ok_or_else(|| wrong("it is neither an annotation of Pascal VOC nor a COCO data set"))?;
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    let text = std::str::from_utf8(bytes)
        .map_err(|e| wrong(&format!("byte {} is not UTF-8 text", e.valid_up_to())))?;
    match format {
        LabelFormat::Voc => voc::read(name, text),
        LabelFormat::Coco => coco::read(name, text),
    }
}

/// Writes labels in a format.
pub fn write_labels(
    format: LabelFormat,
    frames: &[FrameLabels],
    landmarks: &[Landmark],
) -> Result<WrittenFile, ExchangeError> {
    let names = names(frames, landmarks);
    let boxes: usize = frames.iter().map(|f| f.boxes.len()).sum();
    let mut notes = vec![format!("{boxes} boxes in {} pictures", frames.len())];
    notes.extend(of_other_formats(format, frames));
    let bytes = match format {
        LabelFormat::Coco => coco::write(frames, &names).into_bytes(),
        LabelFormat::Voc => {
            let mut zip = ZipSink::default();
            let (files, numbered) = voc::file_names(frames);
            if numbered > 0 {
                notes.push(format!(
                    "{numbered} annotations have a number behind their name, which is that of another picture, too"
                ));
            }
            let mut pack = || {
                for (frame, file) in frames.iter().zip(&files) {
                    zip.write(file, voc::write(frame, &names).as_bytes())?;
                }
                Ok(())
            };
            let packed = pack().and_then(|()| zip.finish());
            packed.map_err(|cause: String| ExchangeError::File {
                file: format.ending().to_owned(),
                cause,
            })?
        }
    };
    Ok(WrittenFile { bytes, notes })
}

/// Note on the properties of pictures and boxes that a file of another format had, which this one has no place for.
fn of_other_formats(format: LabelFormat, frames: &[FrameLabels]) -> Option<String> {
    let own = match format {
        LabelFormat::Voc => voc::ELEMENT,
        LabelFormat::Coco => coco::MEMBER,
    };
    let boxes = frames.iter().flat_map(|frame| &frame.boxes);
    let properties = boxes.map(|label| &label.properties);
    let properties = properties.chain(frames.iter().map(|frame| &frame.properties));
    let names = properties.flat_map(BTreeMap::keys);
    let mut counts = BTreeMap::<&str, usize>::new();
    for name in names.filter(|name| !name.starts_with(own)) {
        let name = name.split_once(':').map_or(name.as_str(), |(_, name)| name);
        *counts.entry(name).or_default() += 1;
    }
    let counts = counts
        .iter()
        .map(|(name, count)| format!("{count} × `{name}`"));
    let counts = counts.collect::<Vec<_>>().join(", ");
    let format = format.name();
    (!counts.is_empty())
        .then(|| format!("{counts} of another format are left out: {format} has no place for them"))
}

/// Names of all landmarks that have labels, by id: the mission's, or else those of the labels.
fn names(frames: &[FrameLabels], landmarks: &[Landmark]) -> BTreeMap<u32, String> {
    let boxes = frames.iter().flat_map(|f| &f.boxes);
    let mut names: BTreeMap<u32, String> = boxes.map(|b| (b.landmark, b.name.clone())).collect();
    for id in frames.iter().flat_map(|f| &f.absent) {
        names.entry(*id).or_insert_with(|| format!("Landmark {id}"));
    }
    for landmark in landmarks {
        if let Some(name) = names.get_mut(&landmark.id) {
            name.clone_from(&landmark.name);
        }
    }
    names
}
