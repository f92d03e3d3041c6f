//! `NAME.aux.xml`, which GDAL writes beside a picture that has no room for reference system and place.

use pilotage_base::georeference::{Georeference, WorldFile};

/// Place of a picture as such a file says it.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct AuxiliaryXml {
    /// Reference system: well-known text, or its code.
    pub system: Option<String>,
    /// Place of the pixels, without a system.
    pub place: Option<Georeference>,
}

impl AuxiliaryXml {
    /// Reads the text of such a file; what it does not say is left open.
    pub fn read(text: &str) -> Self {
        let numbers = element(text, "GeoTransform").and_then(|numbers| {
            let numbers = numbers.split(',').map(|number| number.trim().parse());
            let numbers: Vec<f64> = numbers.collect::<Result<_, _>>().ok()?;
            <[f64; 6]>::try_from(numbers).ok()
        });
        let place = numbers.filter(|numbers| numbers.iter().all(|number| number.is_finite()));
        Self {
            system: element(text, "SRS").filter(|text| !text.is_empty()),
            // GDAL counts from the corner of the first pixel, world files from its middle.
            place: place.map(|[x, a, b, y, d, e]| {
                Georeference::of_world_file(WorldFile {
                    a,
                    d,
                    b,
                    e,
                    c: x + 0.5 * (a + b),
                    f: y + 0.5 * (d + e),
                })
            }),
        }
    }
}

/// Text of the first element of a name, its entities replaced.
fn element(text: &str, name: &str) -> Option<String> {
    let (_, rest) = text.split_once(&format!("<{name}"))?;
    let (head, rest) = rest.split_once('>')?;
    let is_name = head.is_empty() || head.starts_with(char::is_whitespace);
    let (inside, _) = rest.split_once(&format!("</{name}>"))?;
    let mut inside = inside.trim().to_owned();
    for (entity, sign) in [
        ("&quot;", "\""),
        ("&apos;", "'"),
        ("&lt;", "<"),
        ("&gt;", ">"),
        ("&amp;", "&"),
    ] {
        inside = inside.replace(entity, sign);
    }
    is_name.then_some(inside)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn system_and_place_are_those_that_gdal_wrote() {
        let text = r#"<PAMDataset><SRS dataAxisToSRSAxisMapping="1,2">PROJCS[&quot;A &amp; B&quot;]</SRS>
            <GeoTransform> 5.0e+05, 0.5, 0.0, 5.2e+06, 0.0,-0.5</GeoTransform></PAMDataset>"#;
        let found = AuxiliaryXml::read(text);
        assert_eq!(found.system.as_deref(), Some("PROJCS[\"A & B\"]"));
        let Some(Georeference::Metres(file)) = found.place else {
            panic!("{found:?}");
        };
        assert_eq!((file.a, file.e), (0.5, -0.5));
        assert_eq!((file.c, file.f), (500_000.25, 5_199_999.75));
        let statistics = "<PAMDataset><PAMRasterBand band=\"1\"/></PAMDataset>";
        assert_eq!(AuxiliaryXml::read(statistics), AuxiliaryXml::default());
    }
}
