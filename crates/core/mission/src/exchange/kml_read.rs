//! Reading KML, and KMZ, which is KML in a zip. Styles are not needed.

use std::collections::{BTreeMap, BTreeSet};

use serde_json::Value;

use super::decoded_text::decoded;
use super::embedded::{self, EmbeddedItem};
use super::found::{GeodeticContent, POINT_BOX};
use super::kml_data::data_of;
use super::kml_links::{LinkedDocuments, linked, main_document, resolved};
use super::kml_pilot::PilotMission;
use super::kml_places::{place, tuples};
use super::kmz::{KmzFiles, document_of};
use super::shadow::is_shadow;
use super::xml::{NamedText, XmlElement};
use super::{ExchangeError, kml_elements};
use crate::mission::found::{FoundLandmark, LandmarkExtent, LonLat, ReadRoute};
use crate::mission::{USUAL_ALTITUDE, WayPoint};
use pilotage_base::files::FileSet;
use pilotage_base::frames::{Altitude, AltitudeFrame, GroundPoint};

/// Geometries that a placemark may have.
const GEOMETRIES: [&str; 7] = [
    "Point",
    "LineString",
    "LinearRing",
    "Polygon",
    "MultiGeometry",
    "Track",
    "MultiTrack",
];

/// Most documents of an archive that links lead to.
const MOST_DOCUMENTS: usize = 1000;

/// Reads a zip: its main document, and the documents among its files that links lead to, each once.
pub(super) fn read_packed(file: &str, bytes: &[u8]) -> Result<GeodeticContent, ExchangeError> {
    let error = |cause: String| ExchangeError::File {
        file: file.to_owned(),
        cause,
    };
    let zip = KmzFiles::open(bytes).map_err(error)?;
    let names = zip.names();
    let main =
        main_document(&names).ok_or_else(|| error("there is no .kml in the zip".to_owned()))?;
    let mut found = GeodeticContent::default();
    let mut documents = LinkedDocuments::new(main.clone(), MOST_DOCUMENTS);
    let mut counts = BTreeMap::new();
    // Notes on documents beside the main one, with the first that has them.
    let mut shared: BTreeMap<String, (String, usize)> = BTreeMap::new();
    let mut faults = Vec::new();
    while let Some(name) = documents.next() {
        let is_main = name == main;
        let mut notes = Vec::new();
        let whole = format!("{file}/{name}");
        let called = if is_main { file } else { whole.as_str() };
        let archive = KmlArchive {
            names: &names,
            document: &name,
        };
        let bytes = zip
            .read(&name)
            .ok_or_else(|| error(format!("{name} in the zip cannot be unpacked")));
        let read = bytes
            .and_then(|bytes| read_document(called, &decoded(&bytes, &mut notes), Some(&archive)));
        let document = match read {
            Ok(document) => document,
            Err(fault) if is_main => return Err(fault),
            Err(fault) => {
                faults.push(fault);
                continue;
            }
        };
        let content = document.content;
        found.routes.extend(content.routes);
        found.landmarks.extend(content.landmarks);
        found.no_fly.extend(content.no_fly);
        found.rally.extend(content.rally);
        notes.extend(content.notes);
        for (note, count) in document.counts {
            *counts.entry(note).or_default() += count;
        }
        if is_main {
            found.notes.extend(notes);
        } else {
            for note in notes {
                shared.entry(note).or_insert_with(|| (name.clone(), 0)).1 += 1;
            }
        }
        document
            .links
            .into_iter()
            .for_each(|link| documents.link_to(link));
    }
    found.notes.extend(counted(counts));
    found.notes.extend(shared_notes(shared));
    let is_empty = found.routes.is_empty()
        && found.landmarks.is_empty()
        && found.no_fly.is_empty()
        && found.rally.is_empty();
    match faults.first() {
        Some(_) if is_empty => return Err(faults.remove(0)),
        _ => found.notes.extend(fault_notes(&faults)),
    }
    let left_out = documents.left_out();
    if left_out > 0 {
        found.notes.push(format!(
            "{left_out} linked documents are left out: {MOST_DOCUMENTS} of a file are read at most"
        ));
    }
    let is_kml = |name: &&String| name.to_ascii_lowercase().ends_with(".kml") && !is_shadow(name);
    let others = names.iter().filter(is_kml);
    let others = others.filter(|name| !documents.has(name)).count();
    if others > 0 {
        found.notes.push(format!(
            "{others} other .kml in the zip, which no link leads to, are left out"
        ));
    }
    Ok(found)
}

/// Notes on linked documents, each with the first document that has it and the number of others.
fn shared_notes(shared: BTreeMap<String, (String, usize)>) -> impl Iterator<Item = String> {
    let words = |(note, (first, count)): (String, (String, usize))| match count {
        1 => format!("{first}: {note}"),
        _ => format!("{first} and {} more documents: {note}", count - 1),
    };
    shared.into_iter().map(words)
}

/// Notes on linked documents that cannot be read: the first fault, and the number of others.
fn fault_notes(faults: &[ExchangeError]) -> Vec<String> {
    let first = faults.first();
    let mut notes: Vec<String> = first
        .map(|fault| format!("{fault}: this document is left out"))
        .into_iter()
        .collect();
    if faults.len() > 1 {
        notes.push(format!(
            "{} more linked documents cannot be read, and are left out",
            faults.len() - 1
        ));
    }
    notes
}

/// Notes with the number of times that they apply.
fn counted(counts: BTreeMap<String, usize>) -> impl Iterator<Item = String> {
    let words = |(note, count)| format!("{count} × {note}");
    counts.into_iter().map(words)
}

/// A document as it was read.
struct KmlDocument {
    content: GeodeticContent,
    counts: BTreeMap<String, usize>,
    /// Documents of the archive that links lead to.
    links: Vec<String>,
}

/// Files around a document.
struct KmlArchive<'a> {
    names: &'a [String],
    document: &'a str,
}

/// Reads all placemarks, however they lie in folders.
pub(super) fn read(file: &str, text: &str) -> Result<GeodeticContent, ExchangeError> {
    let mut document = read_document(file, text, None)?;
    document.content.notes.extend(counted(document.counts));
    Ok(document.content)
}

/// Reads all placemarks of a document, and finds the documents around it that links lead to.
fn read_document(
    file: &str,
    text: &str,
    archive: Option<&KmlArchive>,
) -> Result<KmlDocument, ExchangeError> {
    let source = NamedText { file, text };
    let root = source.root()?;
    let pilot = PilotMission::find(&source, &root);
    let mut reader = KmlReader {
        source,
        pilot,
        found: GeodeticContent::default(),
        counts: BTreeMap::new(),
        archive,
        links: Vec::new(),
    };
    reader.walk(&root)?;
    reader.styles(&root);
    Ok(KmlDocument {
        content: reader.found,
        counts: reader.counts,
        links: reader.links,
    })
}

struct KmlReader<'a> {
    source: NamedText<'a>,
    /// The mission of DJI Pilot in the document, if it has one.
    pilot: Option<PilotMission>,
    found: GeodeticContent,
    counts: BTreeMap<String, usize>,
    archive: Option<&'a KmlArchive<'a>>,
    /// Documents of the archive that links lead to.
    links: Vec<String>,
}

/// Texts of a placemark beside its geometry.
#[derive(Default, Clone)]
struct Said {
    name: Option<String>,
    own: Option<String>,
    properties: BTreeMap<String, String>,
}

impl KmlReader<'_> {
    fn count(&mut self, note: impl Into<String>) {
        *self.counts.entry(note.into()).or_default() += 1;
    }

    fn walk(&mut self, element: &XmlElement) -> Result<(), ExchangeError> {
        for child in &element.children {
            match child.name.as_str() {
                "Placemark" => self.placemark(child)?,
                "NetworkLink" if self.archive.is_some() => self.link(child),
                "GroundOverlay" | "NetworkLink" | "ScreenOverlay" | "PhotoOverlay" | "Tour" => {
                    self.count(format!("{} is left out", child.name));
                }
                _ => self.walk(child)?,
            }
        }
        Ok(())
    }

    /// Takes note of the document that a link leads to, or that it leads to none or out of the file.
    fn link(&mut self, element: &XmlElement) {
        let (Some(href), Some(archive)) = (linked(element), self.archive) else {
            return self.count("NetworkLink without a reference is left out");
        };
        let file = resolved(archive.names, archive.document, href);
        let document = file.map(|file| document_of(archive.names, file));
        match document {
            Some(Some(name)) => self.links.push(name),
            Some(None) => self.count(format!(
                "link to {href} leads to no KML that can be read, and is not followed"
            )),
            None => self.count(format!(
                "link to {href} leads out of the file, and is not followed"
            )),
        }
    }

    /// Says which styles the file refers to and does not have; the references are kept.
    fn styles(&mut self, root: &XmlElement) {
        let (mut own, mut wanted) = (BTreeSet::new(), Vec::new());
        gather_styles(root, &mut own, &mut wanted);
        for name in wanted {
            match name.strip_prefix('#') {
                Some(id) if own.contains(id) => {}
                Some(id) => self.count(format!(
                    "style `{id}` is missing in the file: its places have our colours"
                )),
                None => self.count(format!(
                    "style `{name}` lies in another file, which is not opened: its places have our \
                     colours"
                )),
            }
        }
    }

    /// The texts of a placemark.
    fn said(&self, placemark: &XmlElement) -> Said {
        let mut said = Said {
            name: placemark.child_text("name").map(str::to_owned),
            ..Said::default()
        };
        // Those of one name stand together.
        let mut elements: BTreeMap<&str, String> = BTreeMap::new();
        for child in &placemark.children {
            match child.name.as_str() {
                "name" => {}
                "ExtendedData" => {
                    let data = data_of(self.source.text, child);
                    said.own = data.own.or(said.own);
                    said.properties.extend(data.properties);
                }
                name if GEOMETRIES.contains(&name) => {}
                name => {
                    let raw = self.source.text.get(child.begin..child.end).unwrap_or("");
                    elements.entry(name).or_default().push_str(raw);
                }
            }
        }
        for (name, raw) in elements {
            let key = format!("{}{name}", kml_elements::ELEMENT);
            said.properties.insert(key, Value::from(raw).to_string());
        }
        said
    }

    fn placemark(&mut self, placemark: &XmlElement) -> Result<(), ExchangeError> {
        if let Some(mission) = &self.pilot {
            if mission.has_point(placemark) {
                return Ok(());
            }
            if mission.is_line(placemark) {
                let said = self.said(placemark);
                let (route, notes) = mission.route(said.name, said.properties);
                self.found.routes.push(route);
                self.found.notes.extend(notes);
                return Ok(());
            }
        }
        let said = self.said(placemark);
        let geometries: Vec<&XmlElement> = placemark
            .children
            .iter()
            .filter(|c| GEOMETRIES.contains(&c.name.as_str()))
            .collect();
        if geometries.is_empty() {
            self.count(if placemark.child("Model").is_some() {
                "Model is left out"
            } else {
                "placemark without geometry is left out"
            });
        }
        for geometry in geometries {
            self.geometry(geometry, None, &said)?;
        }
        Ok(())
    }

    /// Takes a geometry; its altitudes count from what it says, else from what the one around it says (`gx:MultiTrack`).
    fn geometry(
        &mut self,
        geometry: &XmlElement,
        around: Option<&str>,
        said: &Said,
    ) -> Result<(), ExchangeError> {
        let altitude_mode = geometry.child_text("altitudeMode").or(around);
        match geometry.name.as_str() {
            "Point" => {
                let places = self.places(geometry, geometry)?;
                let Some(&(place, _)) = places.first() else {
                    self.count("point without coordinates is left out");
                    return Ok(());
                };
                if self.embedded(said, &[place], &[]) {
                    return Ok(());
                }
                self.count(format!("point, which gets a box of {POINT_BOX} m"));
                self.landmark(LandmarkExtent::Point(place), said);
            }
            "Polygon" => {
                let ring = geometry
                    .child("outerBoundaryIs")
                    .and_then(|b| b.child("LinearRing"))
                    .unwrap_or(geometry);
                let corners: Vec<LonLat> =
                    self.places(geometry, ring)?.iter().map(|p| p.0).collect();
                if corners.len() < 3 {
                    self.count("polygon of fewer than three corners is left out");
                    return Ok(());
                }
                let holes = self.holes(geometry)?;
                if !self.embedded(said, &corners, &holes) {
                    self.landmark(LandmarkExtent::Corners(corners), said);
                    if let Some(landmark) = self.found.landmarks.last_mut() {
                        landmark.holes = holes;
                    }
                }
            }
            "LineString" | "LinearRing" | "Track" => {
                let empty = geometry.all("coord").filter(|c| c.text.is_empty()).count();
                for _ in 0..empty {
                    self.count("moment of a track without a place (an empty gx:coord) is left out");
                }
                let mut places = self.places(geometry, geometry)?;
                // Google Earth moves the whole line by so much.
                let offset = geometry.child_text("altitudeOffset");
                if let Some(offset) = offset.and_then(|text| text.trim().parse::<f64>().ok()) {
                    for metres in places.iter_mut().filter_map(|(_, height)| height.as_mut()) {
                        *metres += offset;
                    }
                }
                self.line(altitude_mode, &places, said);
            }
            _ => {
                for child in &geometry.children {
                    if GEOMETRIES.contains(&child.name.as_str()) {
                        self.geometry(child, altitude_mode, said)?;
                    }
                }
            }
        }
        Ok(())
    }

    /// The rings of a polygon that are not part of it.
    fn holes(&mut self, polygon: &XmlElement) -> Result<Vec<Vec<LonLat>>, ExchangeError> {
        let mut holes = Vec::new();
        let inner = polygon.all("innerBoundaryIs");
        for ring in inner.flat_map(|boundary| boundary.all("LinearRing")) {
            let corners: Vec<LonLat> = self.places(polygon, ring)?.iter().map(|p| p.0).collect();
            if corners.len() < 3 {
                self.count("hole of fewer than three corners is left out");
            } else {
                holes.push(corners);
            }
        }
        Ok(holes)
    }

    fn landmark(&mut self, extent: LandmarkExtent, said: &Said) {
        self.found.landmarks.push(FoundLandmark {
            name: said.name.clone(),
            properties: said.properties.clone(),
            ..FoundLandmark::new(extent)
        });
    }

    /// Takes what we have written ourselves; otherwise says no.
    fn embedded(&mut self, said: &Said, places: &[LonLat], holes: &[Vec<LonLat>]) -> bool {
        let Some((item, is_changed)) = said
            .own
            .as_deref()
            .and_then(|own| embedded::read(own, places, holes))
        else {
            return false;
        };
        if is_changed {
            self.count(format!(
                "line, which was changed elsewhere: its way-points are at {USUAL_ALTITUDE}"
            ));
        }
        let properties = said.properties.clone();
        match item {
            EmbeddedItem::Route(mut route) => {
                route.name.clone_from(&said.name);
                route.properties.extend(properties);
                self.found.routes.push(route);
            }
            EmbeddedItem::Landmark(mut landmark) => {
                landmark.name.clone_from(&said.name);
                landmark.properties.extend(properties);
                self.found.landmarks.push(landmark);
            }
            EmbeddedItem::NoFly(mut zone) => {
                zone.name.clone_from(&said.name);
                zone.properties.extend(properties);
                self.found.no_fly.push(zone);
            }
            EmbeddedItem::Rally(mut point) => {
                point.name.clone_from(&said.name);
                point.properties.extend(properties);
                self.found.rally.push(point);
            }
        }
        true
    }

    fn line(&mut self, altitude_mode: Option<&str>, places: &[(LonLat, Option<f64>)], said: &Said) {
        let lon_lats: Vec<LonLat> = places.iter().map(|p| p.0).collect();
        if self.embedded(said, &lon_lats, &[]) {
            return;
        }
        if places.is_empty() {
            self.count("line without coordinates is left out");
            return;
        }
        let frame = match altitude_mode {
            Some("absolute") => Some(AltitudeFrame::Amsl),
            Some("relativeToGround") => Some(AltitudeFrame::AboveGround),
            _ => None,
        };
        let altitude = |height: Option<f64>| {
            frame
                .zip(height)
                .map_or(USUAL_ALTITUDE, |(frame, m)| Altitude::new(m, frame))
        };
        let states_some = frame.is_some() && places.iter().any(|p| p.1.is_some());
        if states_some && places.iter().any(|p| p.1.is_none()) {
            self.count(format!(
                "line of which points state no altitude: they are at {USUAL_ALTITUDE}"
            ));
        } else if !states_some {
            self.count(format!(
                "line, which lies on the ground: its way-points are at {USUAL_ALTITUDE}"
            ));
        }
        let way_points = places
            .iter()
            .map(|(place, height)| {
                (
                    *place,
                    WayPoint::new(GroundPoint::default(), altitude(*height)),
                )
            })
            .collect();
        self.found.routes.push(ReadRoute {
            name: said.name.clone(),
            properties: said.properties.clone(),
            way_points,
            ..ReadRoute::default()
        });
    }

    /// The coordinates that stand in `holder`, a part of `geometry`.
    fn places(
        &self,
        geometry: &XmlElement,
        holder: &XmlElement,
    ) -> Result<Vec<(LonLat, Option<f64>)>, ExchangeError> {
        let path = format!("Placemark/{}/coordinates", geometry.name);
        let mut places = Vec::new();
        for list in holder.all("coordinates") {
            for tuple in tuples(&list.text) {
                let place = place(tuple.split(',')).ok_or_else(|| {
                    let cause = format!("{path}: `{tuple}` is no longitude,latitude,altitude");
                    self.source.error(list.begin, cause)
                })?;
                places.push(place);
            }
        }
        for coord in holder.all("coord") {
            // A receiver without a fix: the moment has no place.
            if coord.text.is_empty() {
                continue;
            }
            let place = place(coord.text.split_whitespace()).ok_or_else(|| {
                let cause = format!("gx:coord: `{}` is no place", coord.text);
                self.source.error(coord.begin, cause)
            })?;
            places.push(place);
        }
        Ok(places)
    }
}

/// Identities of the styles in an element, and what its placemarks and style maps refer to.
fn gather_styles<'a>(
    element: &'a XmlElement,
    own: &mut BTreeSet<&'a str>,
    wanted: &mut Vec<&'a str>,
) {
    for child in &element.children {
        match child.name.as_str() {
            "Style" | "StyleMap" => own.extend(child.attribute("id")),
            "styleUrl" if !child.text.is_empty() => wanted.push(&child.text),
            _ => {}
        }
        gather_styles(child, own, wanted);
    }
}
