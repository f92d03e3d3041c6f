//! GDAL's metadata of a band beside its samples: scale, offset and unit.
//!
//! `<GDALMetadata><Item name="SCALE" sample="0" role="scale">0.1</Item>…</GDALMetadata>`, after the
//! description of GDAL's `GTiff` driver.

use super::super::tiff::{Directory, Tag, TiffError};

/// Meaning of the samples of a band: value = scale · sample + offset, in the unit.
#[derive(Clone, Debug, PartialEq)]
pub struct BandMetadata {
    /// Value per unit of the samples, 1 where the file does not say it.
    pub scale: f64,
    /// Value of the sample 0, 0 where the file does not say it.
    pub offset: f64,
    /// Name of the unit of the values, as the file has it.
    pub unit: Option<String>,
}

impl BandMetadata {
    /// Reads the metadata of GDAL in `directory` of the band with that index, counted from zero; an error if
    /// scale or offset are no numbers or the scale makes all values the same.
    pub fn of(directory: &Directory, band: usize) -> Result<Self, TiffError> {
        let mut found = Self {
            scale: 1.0,
            offset: 0.0,
            unit: None,
        };
        let text = directory.text(Tag::GdalMetadata).unwrap_or_default();
        for item in text.split("<Item").skip(1) {
            let Some((head, rest)) = item.split_once('>') else {
                continue;
            };
            let value = rest.split_once("</Item").map_or(rest, |(value, _)| value);
            let value = value.trim();
            if attribute(head, "sample").and_then(|index| index.trim().parse().ok()) != Some(band) {
                continue;
            }
            let number = |role: &str| {
                let number: Option<f64> = value.parse().ok().filter(|v: &f64| v.is_finite());
                number.ok_or_else(|| {
                    let shown: String = value.chars().take(40).collect();
                    (directory.blame(&Tag::GdalMetadata.name()))
                        .damaged(format!("{role} \"{shown}\" is not a number"))
                })
            };
            match attribute(head, "role") {
                Some("scale") => found.scale = number("scale")?,
                Some("offset") => found.offset = number("offset")?,
                Some("unittype") if !value.is_empty() => found.unit = Some(value.to_owned()),
                _ => {}
            }
        }
        if found.scale == 0.0 {
            return Err((directory.blame(&Tag::GdalMetadata.name()))
                .damaged("scale 0 makes all samples the same"));
        }
        Ok(found)
    }
}

/// Value of an attribute among those of a tag of XML, in either kind of quotes.
fn attribute<'a>(head: &'a str, name: &str) -> Option<&'a str> {
    let mut rest = head;
    loop {
        let (key, after) = rest.split_once('=')?;
        let after = after.trim_start();
        let quote = after.chars().next().filter(|c| matches!(c, '"' | '\''))?;
        let (value, next) = after[1..].split_once(quote)?;
        if key.trim() == name {
            return Some(value);
        }
        rest = next;
    }
}
