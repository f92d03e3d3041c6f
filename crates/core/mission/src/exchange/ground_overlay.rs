//! Pictures that KML lays on the ground.
//!
//! After OGC 12-007r2, `kml:GroundOverlay`, and Google's extension `gx:LatLonQuad`.

use pilotage_base::files::FileSet;

use super::ExchangeError;
use super::kml_links::{LinkedDocuments, linked, main_document, resolved};
use super::xml::{NamedText, XmlElement};

/// Most files that links lead to.
const MOST_FILES: usize = 20_000;
/// Most pictures.
const MOST_PICTURES: usize = 100_000;

/// A picture on the ground.
#[derive(Clone, Debug, PartialEq)]
pub struct GroundOverlay {
    /// Name of the picture among the files.
    pub picture: String,
    /// Longitude and latitude in degrees of its corners, from the top left one clockwise; longitudes may
    /// go beyond 180° where it lies over the date line.
    pub corners: [[f64; 2]; 4],
}

/// Pictures on the ground, in the order of the files, and what was left out, in sentences.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct GroundOverlays {
    /// The pictures.
    pub overlays: Vec<GroundOverlay>,
    /// Notes on pictures that were left out.
    pub notes: Vec<String>,
}

/// The pictures of the KML among `files`: of `name` where it says one, else of the main document of a KMZ.
/// Links to other files of the set are followed.
///
/// # Errors
/// A document that is not there or cannot be read, or a picture with impossible corners; named are file and
/// place.
pub fn ground_overlays(
    files: &dyn FileSet,
    name: Option<&str>,
) -> Result<GroundOverlays, ExchangeError> {
    let all = files.names();
    let first = match name {
        Some(name) => name.to_owned(),
        None => main_document(&all).ok_or_else(|| ExchangeError::File {
            file: "KMZ".to_owned(),
            cause: "there is no .kml in the zip".to_owned(),
        })?,
    };
    let mut walk = LinkWalk {
        files,
        names: all,
        found: GroundOverlays::default(),
        documents: LinkedDocuments::new(first, MOST_FILES),
    };
    while let Some(name) = walk.documents.next() {
        walk.document(&name)?;
    }
    Ok(walk.found)
}

/// A walk through linked documents.
struct LinkWalk<'a> {
    files: &'a dyn FileSet,
    names: Vec<String>,
    found: GroundOverlays,
    documents: LinkedDocuments,
}

impl LinkWalk<'_> {
    fn document(&mut self, name: &str) -> Result<(), ExchangeError> {
        let bytes = self.files.read(name).ok_or_else(|| ExchangeError::File {
            file: name.to_owned(),
            cause: "it cannot be read".to_owned(),
        })?;
        let text = String::from_utf8_lossy(&bytes);
        let source = NamedText {
            file: name,
            text: &text,
        };
        let root = source.root()?;
        self.element(&source, &root)
    }

    fn element(&mut self, source: &NamedText, element: &XmlElement) -> Result<(), ExchangeError> {
        match element.name.as_str() {
            "GroundOverlay" => self.overlay(source, element),
            "NetworkLink" => {
                self.link(source, element);
                Ok(())
            }
            _ => element
                .children
                .iter()
                .try_for_each(|child| self.element(source, child)),
        }
    }

    fn overlay(&mut self, source: &NamedText, element: &XmlElement) -> Result<(), ExchangeError> {
        let href = element
            .child("Icon")
            .and_then(|icon| icon.child_text("href"));
        let Some(href) = href else {
            return Ok(());
        };
        let Some(picture) = resolved(&self.names, source.file, href) else {
            self.found.notes.push(format!(
                "{}: the picture {href} is not in the file and is left out.",
                source.file
            ));
            return Ok(());
        };
        let Some(corners) = corners(element) else {
            return Err(source.error(
                element.begin,
                "a GroundOverlay without the four numbers of a LatLonBox or the four places of a LatLonQuad",
            ));
        };
        if self.found.overlays.len() == MOST_PICTURES {
            return Err(source.error(element.begin, "there are too many GroundOverlays"));
        }
        self.found.overlays.push(GroundOverlay { picture, corners });
        Ok(())
    }

    /// Takes note of the document that a link leads to.
    fn link(&mut self, source: &NamedText, element: &XmlElement) {
        let Some(href) = linked(element) else {
            return;
        };
        match resolved(&self.names, source.file, href) {
            Some(name) if name.to_ascii_lowercase().ends_with(".kml") => {
                self.documents.link_to(name);
            }
            other => {
                let end = other.map_or("out of the file", |_| "to no KML");
                self.found.notes.push(format!(
                    "{}: the link to {href} leads {end} and is not followed.",
                    source.file
                ));
            }
        }
    }
}

/// Longitude and latitude of the corners from the top left one clockwise.
fn corners(element: &XmlElement) -> Option<[[f64; 2]; 4]> {
    if let Some(quad) = element.child("LatLonQuad") {
        let places: Vec<[f64; 2]> = (quad.child_text("coordinates")?.split_whitespace())
            .filter_map(|place| {
                let mut numbers = place.split(',').map(|word| word.trim().parse().ok());
                Some([numbers.next()??, numbers.next()??])
            })
            .collect();
        // Counterclockwise from the bottom left one.
        let [a, b, c, d] = places[..] else {
            return None;
        };
        return sensible([d, c, b, a]);
    }
    let region = element.child("LatLonBox")?;
    let number = |name: &str| region.child_text(name)?.trim().parse::<f64>().ok();
    let (north, south) = (number("north")?, number("south")?);
    let (mut east, west) = (number("east")?, number("west")?);
    let turn = number("rotation").unwrap_or(0.0).to_radians();
    if east < west {
        east += 360.0;
    }
    let middle = [0.5 * (west + east), 0.5 * (south + north)];
    let half = [0.5 * (east - west), 0.5 * (north - south)];
    // It is turned on the ground, where degrees of longitude are shorter.
    let shrink = middle[1].to_radians().cos();
    let (sine, cosine) = turn.sin_cos();
    let corner = |right: f64, up: f64| {
        let (x, y) = (right * half[0] * shrink, up * half[1]);
        let (x, y) = (x * cosine - y * sine, x * sine + y * cosine);
        [middle[0] + x / shrink, middle[1] + y]
    };
    if turn == 0.0 {
        return sensible([[west, north], [east, north], [east, south], [west, south]]);
    }
    sensible([
        corner(-1.0, 1.0),
        corner(1.0, 1.0),
        corner(1.0, -1.0),
        corner(-1.0, -1.0),
    ])
}

/// The corners, if they are places on Earth; over the date line they stay together.
fn sensible(mut corners: [[f64; 2]; 4]) -> Option<[[f64; 2]; 4]> {
    let first = corners[0][0];
    let is_split = corners.iter().any(|[x, _]| (x - first).abs() > 180.0);
    let is_wide = corners.iter().all(|[x, _]| (-540.0..=540.0).contains(x));
    // A quad states its corners between -180° and 180°; a box counts on.
    if is_split && corners.iter().all(|[x, _]| x.abs() <= 180.0) && !is_whole_world(&corners) {
        for corner in &mut corners {
            if corner[0] < 0.0 {
                corner[0] += 360.0;
            }
        }
    }
    let is_place = corners
        .iter()
        .all(|[x, y]| x.is_finite() && (-90.6..=90.6).contains(y));
    (is_place && is_wide).then_some(corners)
}

/// Whether left and right corners are a box's that goes around most of the Earth.
fn is_whole_world(corners: &[[f64; 2]; 4]) -> bool {
    corners[0][0] == corners[3][0]
        && corners[1][0] == corners[2][0]
        && corners[0][0] < corners[1][0]
}

#[cfg(test)]
mod tests {
    use super::*;
    use pilotage_base::files::MemoryFiles;

    fn files(files: &[(&str, &str)]) -> MemoryFiles {
        let entries = files
            .iter()
            .map(|(name, text)| ((*name).to_owned(), text.as_bytes().to_vec()));
        MemoryFiles(entries.collect())
    }

    fn overlay(href: &str, place: &str) -> String {
        format!(
            "<kml><Document><Folder><GroundOverlay><Icon><href>{href}</href></Icon>{place}</GroundOverlay></Folder></Document></kml>"
        )
    }

    const BOX: &str =
        "<LatLonBox><north>47.1</north><south>47</south><east>8.2</east><west>8</west></LatLonBox>";

    #[test]
    fn a_box_is_its_corners_and_a_link_in_the_file_is_followed() {
        let link = "<kml><NetworkLink><Link><href>parts/a%20b.kml</href></Link></NetworkLink><NetworkLink><Link><href>http://there/x.kml</href></Link></NetworkLink></kml>";
        let files = files(&[
            ("doc.kml", link),
            ("parts/a b.kml", &overlay("../files/Ortho.png", BOX)),
            ("files/ortho.PNG", ""),
        ]);
        let found = ground_overlays(&files, None).unwrap();
        assert_eq!(found.overlays[0].picture, "files/ortho.PNG");
        assert_eq!(
            found.overlays[0].corners,
            [[8.0, 47.1], [8.2, 47.1], [8.2, 47.0], [8.0, 47.0]]
        );
        assert_eq!(found.notes.len(), 1);
        assert!(found.notes[0].contains("http://there/x.kml"));
    }

    #[test]
    fn a_turned_box_is_turned_counterclockwise_on_the_ground() {
        let turned = BOX.replace("</LatLonBox>", "<rotation>90</rotation></LatLonBox>");
        let text = overlay("a.png", &turned);
        let found = ground_overlays(&files(&[("doc.kml", &text), ("a.png", "")]), None).unwrap();
        // The top edge becomes the left one: its left end lies in the south-west.
        let [x, y] = found.overlays[0].corners[0];
        let shrink = 47.05_f64.to_radians().cos();
        assert!((x - (8.1 - 0.05 / shrink)).abs() < 1e-9, "{x}");
        assert!((y - (47.05 - 0.1 * shrink)).abs() < 1e-9, "{y}");
    }

    #[test]
    fn boxes_and_quads_over_the_date_line_stay_together() {
        let over = "<LatLonBox><north>1</north><south>0</south><east>-179</east><west>179</west></LatLonBox>";
        let quad = "<LatLonQuad><coordinates>179,0 -179,0 -179,1 179,1</coordinates></LatLonQuad>";
        for place in [over, quad] {
            let text = overlay("a.png", place);
            let found =
                ground_overlays(&files(&[("doc.kml", &text), ("a.png", "")]), None).unwrap();
            assert_eq!(
                found.overlays[0].corners,
                [[179.0, 1.0], [181.0, 1.0], [181.0, 0.0], [179.0, 0.0]]
            );
        }
    }

    #[test]
    fn a_box_without_its_numbers_is_named() {
        let text = overlay("a.png", "<LatLonBox><north>x</north></LatLonBox>");
        let error =
            ground_overlays(&files(&[("doc.kml", &text), ("a.png", "")]), None).unwrap_err();
        assert!(
            error.to_string().starts_with("doc.kml, line 1, column"),
            "{error}"
        );
    }
}
