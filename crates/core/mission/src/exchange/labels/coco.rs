//! COCO: one JSON file for all pictures.

use std::collections::BTreeMap;

use serde::Deserialize;
use serde_json::value::RawValue;
use serde_json::{Value, json};

use super::ExchangeError;
use super::found::{FoundLabels, left_out, stated_box};
use super::outline::extent;
use crate::mission::text::{ObjectMembers, Text};
use crate::mission::{FrameLabels, MissionError};

/// Prefix of properties that are members, as JSON text.
pub(super) const MEMBER: &str = "coco:";
/// Member of a picture with the categories that are certainly not in it.
const ABSENT: &str = "pilotage_absent";
/// Member of a picture with its flight.
const FLIGHT: &str = "pilotage_flight";
/// Member of a category that says that its number is that of a landmark.
const OWN: &str = "pilotage_landmark";

/// Reads a data set.
pub(super) fn read(file: &str, text: &str) -> Result<FoundLabels, ExchangeError> {
    parse(&Text(text)).map_err(|cause| ExchangeError::of_json(file, cause))
}

fn parse(text: &Text<'_>) -> Result<FoundLabels, MissionError> {
    let mut members = text.members(text.0)?;
    let mut list = |name: &str| -> Result<Vec<&RawValue>, MissionError> {
        match members.remove(name) {
            Some(piece) => text.elements(piece.get()),
            None => Err(text.error(text.0, format!("`{name}` is missing"))),
        }
    };
    let (images, annotations, categories) =
        (list("images")?, list("annotations")?, list("categories")?);
    let mut found = FoundLabels::default();
    for (name, piece) in members {
        if !matches!(piece.get().trim(), "[]" | "{}" | "null") {
            found
                .notes
                .push(format!("`{name}` of the data set is left out"));
        }
    }
    let mut known: BTreeMap<u64, (u32, String)> = BTreeMap::new();
    for piece in categories {
        let mut category = text.members(piece.get())?;
        let id = required(text, piece, &mut category, "id")?;
        let name = required(text, piece, &mut category, "name")?;
        let own: u32 = text.take(&mut category, OWN)?.unwrap_or(0);
        known.insert(id, (own, name));
    }
    let mut places: BTreeMap<u64, usize> = BTreeMap::new();
    for piece in images {
        let mut image = text.members(piece.get())?;
        let id: u64 = required(text, piece, &mut image, "id")?;
        let width: u32 = required(text, piece, &mut image, "width")?;
        let height: u32 = required(text, piece, &mut image, "height")?;
        let absent: Vec<u64> = text.take(&mut image, ABSENT)?.unwrap_or_default();
        let absent = absent.iter().filter_map(|id| known.get(id));
        let absent: Vec<u32> = absent
            .map(|(own, name)| {
                found.names.insert(*own, name.clone());
                *own
            })
            .collect();
        places.insert(id, found.frames.len());
        found.frames.push(FrameLabels {
            flight: text.take(&mut image, FLIGHT)?.unwrap_or_default(),
            frame: required(text, piece, &mut image, "file_name")?,
            size: (width, height),
            absent,
            properties: kept(image),
            ..FrameLabels::default()
        });
    }
    let (mut crowds, mut faults) = (0, BTreeMap::new());
    for piece in annotations {
        let mut annotation = text.members(piece.get())?;
        let image: u64 = required(text, piece, &mut annotation, "image_id")?;
        let category: u64 = required(text, piece, &mut annotation, "category_id")?;
        let corners = corners(text, piece, &mut annotation)?;
        let lost = |what: &str, id| text.error(piece.get(), format!("there is no {what} {id}"));
        let frame = places.get(&image).ok_or_else(|| lost("image", image))?;
        let (own, name) = known
            .get(&category)
            .ok_or_else(|| lost("category", category))?;
        let mut flag = |name: &str| -> Result<bool, MissionError> {
            let flag: Option<Value> = text.take(&mut annotation, name)?;
            Ok(flag == Some(json!(1)) || flag == Some(json!(true)))
        };
        let is_crowd = flag("iscrowd")?;
        let (is_difficult, is_truncated) = (flag("difficult")?, flag("truncated")?);
        if is_crowd {
            crowds += 1;
            continue;
        }
        let labels = &mut found.frames[*frame];
        let label = corners.and_then(|corners| stated_box(*own, name, corners, labels.size));
        let mut label = match label {
            Ok(label) => label,
            Err(reason) => {
                *faults.entry(reason).or_default() += 1;
                continue;
            }
        };
        label.difficult = is_difficult;
        label.truncated |= is_truncated;
        annotation.remove("id");
        annotation.remove("area");
        if annotation
            .get("segmentation")
            .is_some_and(|s| s.get() == "[]")
        {
            annotation.remove("segmentation");
        }
        label.properties = kept(annotation);
        labels.boxes.push(label);
    }
    found.notes.extend(left_out("", faults));
    if crowds > 0 {
        found.notes.push(format!("{crowds} crowds are left out"));
    }
    Ok(found)
}

/// The box that an annotation states, else that around its outline; the inner error says, behind a count, that it has neither.
fn corners<'a>(
    text: &Text<'a>,
    of: &'a RawValue,
    annotation: &mut ObjectMembers<'a>,
) -> Result<Result<[[f64; 2]; 2], &'static str>, MissionError> {
    let stated: Option<Value> = text.take(annotation, "bbox")?;
    let is_stated = |value: &Value| {
        value
            .as_array()
            .map_or(!value.is_null(), |list| !list.is_empty())
    };
    match stated
        .filter(is_stated)
        .map(serde_json::from_value::<[f64; 4]>)
    {
        Some(Ok([x, y, width, height])) => Ok(Ok([[x, y], [x + width, y + height]])),
        Some(Err(_)) => Err(text.error(of.get(), "`bbox` is no list of four numbers")),
        None => {
            let outline = annotation.get("segmentation").and_then(|s| extent(s.get()));
            Ok(outline.ok_or("label without a box or an outline is left out"))
        }
    }
}

fn required<'a, T: for<'d> Deserialize<'d>>(
    text: &Text<'a>,
    of: &'a RawValue,
    members: &mut ObjectMembers<'a>,
    name: &str,
) -> Result<T, MissionError> {
    let value = text.take(members, name)?;
    value.ok_or_else(|| text.error(of.get(), format!("`{name}` is missing")))
}

fn kept(members: ObjectMembers<'_>) -> BTreeMap<String, String> {
    let kept =
        |(name, value): (String, &RawValue)| (format!("{MEMBER}{name}"), value.get().to_owned());
    members.into_iter().map(kept).collect()
}

/// The data set of all pictures.
pub(super) fn write(frames: &[FrameLabels], names: &BTreeMap<u32, String>) -> String {
    let categories: Vec<Value> = names
        .iter()
        .map(|(id, name)| json!({ "id": id, "name": name, "supercategory": "landmark", OWN: id }))
        .collect();
    let (mut images, mut annotations) = (Vec::new(), Vec::new());
    for (number, frame) in (1..).zip(frames) {
        let (width, height) = frame.size;
        let mut image = json!({
            "id": number, "file_name": frame.frame, "width": width, "height": height,
        });
        if !frame.flight.is_empty() {
            image[FLIGHT] = json!(frame.flight);
        }
        if !frame.absent.is_empty() {
            image[ABSENT] = json!(frame.absent);
        }
        add_kept(&mut image, &frame.properties);
        images.push(image);
        for label in &frame.boxes {
            let [width, height] = label.size();
            let mut annotation = json!({
                "id": annotations.len() + 1,
                "image_id": number,
                "category_id": label.landmark,
                "bbox": [label.min[0], label.min[1], width, height],
                "area": width * height,
                "iscrowd": 0,
                "segmentation": [],
                "difficult": u8::from(label.difficult),
                "truncated": u8::from(label.truncated),
            });
            add_kept(&mut annotation, &label.properties);
            annotations.push(annotation);
        }
    }
    let whole = json!({
        "images": images, "annotations": annotations, "categories": categories,
    });
    format!("{whole:#}\n")
}

/// Adds members that a file had and we do not know.
fn add_kept(object: &mut Value, properties: &BTreeMap<String, String>) {
    for (name, raw) in properties {
        if let Some(name) = name.strip_prefix(MEMBER)
            && let Ok(value) = serde_json::from_str(raw)
        {
            object[name] = value;
        }
    }
}
