//! Pascal VOC: one XML file for a picture.

use std::collections::BTreeMap;
use std::fmt::Write as _;

use super::ExchangeError;
use super::found::{FoundLabels, left_out, stated_box};
use crate::exchange::xml::{NamedText, XmlElement};
use crate::mission::FrameLabels;
use pilotage_base::text::distinct_names;
use pilotage_base::text::without_markup;

/// Element that holds what only we know: ids, the flight, and landmarks that are not in the picture.
const OWN: &str = "pilotage";
/// Prefix of properties that are elements, as they stand.
pub(super) const ELEMENT: &str = "voc:";
/// Elements that are read of a picture; others are kept.
const OF_PICTURE: [&str; 4] = ["filename", "size", "object", OWN];
/// Elements that are read of an object.
const OF_OBJECT: [&str; 5] = ["name", "bndbox", "difficult", "truncated", OWN];

/// Reads the annotation of one picture.
pub(super) fn read(file: &str, text: &str) -> Result<FoundLabels, ExchangeError> {
    let source = NamedText { file, text };
    let root = source.root()?;
    if root.name != "annotation" {
        let cause = format!("<{}> is no <annotation> of Pascal VOC", root.name);
        return Err(source.error(root.begin, cause));
    }
    let lacking =
        |of: &XmlElement, name: &str| source.error(of.begin, format!("<{name}> is missing"));
    let frame = root
        .child_text("filename")
        .ok_or_else(|| lacking(&root, "filename"))?;
    let stated = root.child("size").ok_or_else(|| lacking(&root, "size"))?;
    let side = |name: &str| {
        let value = number(&source, stated, name)?;
        let is_side = (1.0..=65_535.0).contains(&value);
        is_side.then_some(value as u32).ok_or_else(|| {
            source.error(
                stated.begin,
                format!("<{name}> {value} is no side of a picture"),
            )
        })
    };
    let size = (side("width")?, side("height")?);
    let mut found = FoundLabels::default();
    let flight = root.child(OWN).and_then(|own| own.child_text("flight"));
    let mut labels = FrameLabels {
        flight: flight.unwrap_or_default().to_owned(),
        frame: frame.to_owned(),
        size,
        properties: kept(&source, &root, &OF_PICTURE),
        ..FrameLabels::default()
    };
    let mut faults = BTreeMap::new();
    for object in root.all("object") {
        let name = object
            .child_text("name")
            .ok_or_else(|| lacking(object, "name"))?;
        let edges = object
            .child("bndbox")
            .ok_or_else(|| lacking(object, "bndbox"))?;
        let edge = |name: &str| number(&source, edges, name);
        let low = [edge("xmin")? - 1.0, edge("ymin")? - 1.0];
        let high = [edge("xmax")?, edge("ymax")?];
        let id = object.child(OWN).map_or(0, id_of);
        let mut label = match stated_box(id, name, [low, high], size) {
            Ok(label) => label,
            Err(reason) => {
                *faults.entry(reason).or_default() += 1;
                continue;
            }
        };
        label.difficult = object.child_text("difficult") == Some("1");
        label.truncated |= object.child_text("truncated") == Some("1");
        label.properties = kept(&source, object, &OF_OBJECT);
        if object.child("part").is_some() {
            found
                .notes
                .push(format!("{file}: parts of “{name}” are kept as they stand"));
        }
        labels.boxes.push(label);
    }
    found.notes.extend(left_out(&format!("{file}: "), faults));
    for absent in root.child(OWN).iter().flat_map(|own| own.all("absent")) {
        let id = id_of(absent);
        found.names.insert(id, absent.text.clone());
        labels.absent.push(id);
    }
    found.frames.push(labels);
    Ok(found)
}

fn id_of(element: &XmlElement) -> u32 {
    let id = element.attribute("landmark").map(str::parse);
    id.and_then(Result::ok).unwrap_or(0)
}

fn number(source: &NamedText<'_>, of: &XmlElement, name: &str) -> Result<f64, ExchangeError> {
    let Some(element) = of.child(name) else {
        return Err(source.error(of.begin, format!("<{name}> is missing")));
    };
    let value = element.text.parse().ok().filter(|v: &f64| v.is_finite());
    value.ok_or_else(|| {
        let text: String = element.text.chars().take(20).collect();
        source.error(element.begin, format!("<{name}> “{text}” is no number"))
    })
}

/// Elements that are not read, as they stand; those of one name stand together.
fn kept(source: &NamedText<'_>, of: &XmlElement, read: &[&str]) -> BTreeMap<String, String> {
    let mut kept: BTreeMap<String, String> = BTreeMap::new();
    for child in &of.children {
        if !read.contains(&child.name.as_str())
            && let Some(raw) = source.text.get(child.begin..child.end)
        {
            kept.entry(format!("{ELEMENT}{}", child.name))
                .or_default()
                .push_str(raw);
        }
    }
    kept
}

/// Names of the annotations of pictures, and how many have a number because other pictures have their name.
pub(super) fn file_names(frames: &[FrameLabels]) -> (Vec<String>, usize) {
    let stem = |frame: &FrameLabels| {
        let own = frame.frame.rsplit(['/', '\\']).next().unwrap_or_default();
        own.rsplit_once('.')
            .map_or(own, |(stem, _)| stem)
            .to_owned()
    };
    let stems: Vec<String> = frames.iter().map(stem).collect();
    let names = distinct_names(stems.iter().cloned(), []);
    let numbered = names.iter().zip(&stems).filter(|(name, stem)| name != stem);
    let numbered = numbered.count();
    let entry = |name: &String| format!("Annotations/{name}.xml");
    (names.iter().map(entry).collect(), numbered)
}

/// The annotation of one picture.
pub(super) fn write(frame: &FrameLabels, names: &BTreeMap<u32, String>) -> String {
    let mut text = String::from("<annotation>\n");
    // Writing into a string cannot fail.
    let raw = |text: &mut String, properties: &BTreeMap<String, String>, indent: &str| {
        for (name, raw) in properties {
            if name.starts_with(ELEMENT) {
                let _ = writeln!(text, "{indent}{raw}");
            }
        }
    };
    let _ = writeln!(
        text,
        "\t<filename>{}</filename>",
        without_markup(&frame.frame)
    );
    let (width, height) = frame.size;
    let _ = writeln!(
        text,
        "\t<size><width>{width}</width><height>{height}</height><depth>3</depth></size>"
    );
    raw(&mut text, &frame.properties, "\t");
    for label in &frame.boxes {
        let name = names.get(&label.landmark).unwrap_or(&label.name);
        let _ = writeln!(
            text,
            "\t<object>\n\t\t<name>{}</name>",
            without_markup(name)
        );
        raw(&mut text, &label.properties, "\t\t");
        let flag = |on: bool| u8::from(on);
        let _ = writeln!(
            text,
            "\t\t<truncated>{}</truncated>\n\t\t<difficult>{}</difficult>\n\t\t<bndbox>\
             <xmin>{}</xmin><ymin>{}</ymin><xmax>{}</xmax><ymax>{}</ymax></bndbox>\n\
             \t\t<{OWN} landmark=\"{}\"/>\n\t</object>",
            flag(label.truncated),
            flag(label.difficult),
            label.min[0] + 1.0,
            label.min[1] + 1.0,
            label.max[0],
            label.max[1],
            label.landmark,
        );
    }
    if !(frame.absent.is_empty() && frame.flight.is_empty()) {
        let _ = writeln!(text, "\t<{OWN}>");
        if !frame.flight.is_empty() {
            let flight = without_markup(&frame.flight);
            let _ = writeln!(text, "\t\t<flight>{flight}</flight>");
        }
        for id in &frame.absent {
            let name = names.get(id).map_or("", String::as_str);
            let _ = writeln!(
                text,
                "\t\t<absent landmark=\"{id}\">{}</absent>",
                without_markup(name)
            );
        }
        let _ = writeln!(text, "\t</{OWN}>");
    }
    text.push_str("</annotation>\n");
    text
}
