//! Labels as programs for labelling and training read and write them: Pascal VOC and COCO.
//!
//! Ours count pixels from the outer corner of the top left one. VOC counts pixels themselves from
//! one, both ends included, as the development kit of its challenge does: xmin = left + 1,
//! xmax = right. COCO counts as we do.

mod coco;
#[cfg(test)]
mod tests;
mod voc;

use std::collections::{BTreeMap, BTreeSet};

use serde::{Deserialize, Serialize};

use super::{ExchangeError, Written};
use crate::mission::{FrameLabels, LabelBox};
use pilotage_base::files::{FileSink as _, ZipSink};
use pilotage_vision::landmark::Landmark;

/// A format of labels.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub enum LabelFormat {
    /// One XML file for each picture, zipped.
    Voc,
    /// One JSON file for all.
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

/// What a file of labels brought; its landmarks are known by name.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct FoundLabels {
    /// The pictures; ids of landmarks are what the file says, 0 if it says none.
    pub frames: Vec<FrameLabels>,
    /// Names of landmarks that are not in a picture, by picture and the id there.
    names: BTreeMap<u32, String>,
    /// What was assumed, kept aside or left out, in sentences for people.
    pub notes: Vec<String>,
}

impl FoundLabels {
    /// Adds what another file brought.
    pub fn add(&mut self, other: Self) {
        self.frames.extend(other.frames);
        self.names.extend(other.names);
        self.notes.extend(other.notes);
    }

    /// Gives the labels to the landmarks of a mission, by name, or else by the id that our own files
    /// state. What belongs to none is left out and told.
    pub fn placed(mut self, landmarks: &[Landmark]) -> (Vec<FrameLabels>, Vec<String>) {
        let mut left_out: BTreeMap<String, usize> = BTreeMap::new();
        let mut twice = 0;
        let id_of = |name: &str, id: u32| {
            let same = |l: &&Landmark| l.name.trim().eq_ignore_ascii_case(name.trim());
            let named = landmarks.iter().find(same);
            let numbered = || landmarks.iter().find(|l| l.id == id);
            named.or_else(numbered).map(|l| l.id)
        };
        for frame in &mut self.frames {
            let mut seen = BTreeSet::new();
            frame.boxes.retain_mut(|label| {
                let Some(id) = id_of(&label.name, label.landmark) else {
                    *left_out.entry(label.name.clone()).or_default() += 1;
                    return false;
                };
                label.landmark = id;
                let is_first = seen.insert(id);
                twice += usize::from(!is_first);
                is_first
            });
            let names = &self.names;
            let known = |id: &u32| id_of(names.get(id).map_or("", String::as_str), *id);
            frame.absent = frame.absent.iter().filter_map(known).collect();
            frame.absent.retain(|id| !seen.contains(id));
        }
        let mut notes = self.notes;
        for (name, count) in left_out {
            notes.push(format!(
                "{count} × “{name}” is left out: no landmark of the mission has that name"
            ));
        }
        if twice > 0 {
            notes.push(format!(
                "{twice} boxes are left out: their landmark has one in the same picture already"
            ));
        }
        self.frames
            .retain(|f| !(f.boxes.is_empty() && f.absent.is_empty()));
        (self.frames, notes)
    }
}

impl FoundLabels {
    /// The labels by themselves, where there is no mission: landmarks are numbered in the order of their names, as which
    /// each name counts once. With what was left out, in sentences.
    pub fn numbered(mut self) -> (Vec<FrameLabels>, Vec<String>) {
        let boxes = self.frames.iter().flat_map(|frame| &frame.boxes);
        let boxes = boxes.map(|label| label.name.trim().to_owned());
        let named: BTreeSet<String> = boxes.chain(self.names.values().cloned()).collect();
        let numbers: BTreeMap<String, u32> = named.into_iter().zip(1..).collect();
        for frame in &mut self.frames {
            for label in &mut frame.boxes {
                label.landmark = numbers.get(label.name.trim()).copied().unwrap_or(0);
            }
            let number = |id: &u32| numbers.get(self.names.get(id)?).copied();
            frame.absent = frame.absent.iter().filter_map(number).collect();
        }
        (self.frames, self.notes)
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
) -> Result<Written, ExchangeError> {
    let names = names(frames, landmarks);
    let bytes = match format {
        LabelFormat::Coco => coco::write(frames, &names).into_bytes(),
        LabelFormat::Voc => {
            let mut zip = ZipSink::default();
            let mut pack = || {
                for frame in frames {
                    let text = voc::write(frame, &names);
                    zip.write(&voc::file_name(&frame.frame), text.as_bytes())?;
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
    let boxes: usize = frames.iter().map(|f| f.boxes.len()).sum();
    let notes = vec![format!("{boxes} boxes in {} pictures", frames.len())];
    Ok(Written { bytes, notes })
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

/// A box that a file states, in our pixels; the error says what is wrong with it.
fn stated_box(
    landmark: u32,
    name: &str,
    corners: [[f64; 2]; 2],
    size: (u32, u32),
) -> Result<LabelBox, String> {
    let [a, b] = corners;
    if b[0] <= a[0] || b[1] <= a[1] {
        return Err(format!("the box of “{name}” has no area"));
    }
    let outside = || {
        let (width, height) = size;
        format!("the box of “{name}” is not in the picture of {width} × {height} pixels")
    };
    let mut label = LabelBox::new(landmark, name, corners, size).ok_or_else(outside)?;
    label.truncated = false;
    Ok(label)
}
