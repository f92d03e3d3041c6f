//! Labels as a file brought them, before they are given to landmarks.

use std::collections::{BTreeMap, BTreeSet};

use serde::{Deserialize, Serialize};

use crate::mission::{FrameLabels, LabelBox};
use pilotage_vision::landmark::Landmark;

/// Labels out of a file; its landmarks are known by name.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct FoundLabels {
    /// The pictures; ids of landmarks are what the file says, 0 if it says none.
    pub frames: Vec<FrameLabels>,
    /// Names of landmarks that are not in a picture, by picture and the id there.
    pub(super) names: BTreeMap<u32, String>,
    /// Notes on all that was assumed, kept aside or left out, in sentences for people.
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
        let mut by_number: BTreeMap<(String, u32), usize> = BTreeMap::new();
        let mut twice = 0;
        let id_of = |name: &str, id: u32| {
            let named = landmarks.iter().find(|l| is_called(l, name));
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
                let is_named = |l: &&Landmark| l.id == id && !is_called(l, &label.name);
                if let Some(other) = landmarks.iter().find(is_named) {
                    let names = (label.name.clone(), other.id);
                    *by_number.entry(names).or_default() += 1;
                }
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
        for ((name, id), count) in by_number {
            let taken = landmarks.iter().find(|l| l.id == id);
            notes.push(format!(
                "{count} × “{name}” is taken for “{}”, which has its number",
                taken.map_or("", |l| l.name.as_str())
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

/// Whether a landmark has that name, however it is written.
fn is_called(landmark: &Landmark, name: &str) -> bool {
    landmark.name.trim().eq_ignore_ascii_case(name.trim())
}

/// A box that a file states, in our pixels, cut where the picture ends; one that ends with the picture is as the file says. The
/// error says, in words that stand behind a count, why it is none.
pub(super) fn stated_box(
    landmark: u32,
    name: &str,
    corners: [[f64; 2]; 2],
    size: (u32, u32),
) -> Result<LabelBox, &'static str> {
    let [a, b] = corners;
    if b[0] <= a[0] || b[1] <= a[1] {
        return Err("box without an area is left out");
    }
    let outside = "box outside of its picture is left out";
    let mut label = LabelBox::new(landmark, name, corners, size).ok_or(outside)?;
    let ends_in = |low: f64, high: f64, side: u32| low < 0.0 || high > f64::from(side);
    label.truncated = ends_in(a[0], b[0], size.0) || ends_in(a[1], b[1], size.1);
    Ok(label)
}

/// Boxes that are left out, by the reason, as notes behind `prefix`.
pub(super) fn left_out(
    prefix: &str,
    counts: BTreeMap<&'static str, usize>,
) -> impl Iterator<Item = String> {
    let note = move |(reason, count)| format!("{prefix}{count} × {reason}");
    counts.into_iter().map(note)
}
