//! GeoJSON: our own features, and anybody else's points, lines and polygons.

use std::collections::BTreeMap;

use serde_json::Value;

use super::fence::{CIRCLE_CORNERS, circle_corners};
use super::file_look::{Claim, FileForm, FileLook};
use super::format_info::{FormatInfo, HeldBeside, HeldTogether};
use super::format_work::{FormatWork, Read, TrackWork};
use super::found::{GeodeticContent, POINT_BOX};
use super::written::WrittenFile;
use super::{ExchangeError, Places, flown_text};
use crate::mission::found::{
    FoundLandmark, FoundNoFly, LandmarkExtent, LonLat, ReadRoute, on_globe,
};
use crate::mission::text::Text;
use crate::mission::{
    FEATURE_MEMBER, NO_FLY_MARK, USUAL_ALTITUDE, WayPoint, add_geometry_members, no_fly_feature,
    rally_feature, read_features, write_features,
};
use pilotage_base::frames::{Altitude, AltitudeFrame, GroundPoint, LocalFrame};
use pilotage_base::loose_json::without_not_a_number;

/// The format.
pub(super) const INFO: FormatInfo = FormatInfo {
    name: "GeoJSON",
    as_words: "GeoJSON",
    extensions: &["geojson", "json"],
    anybodys: &["json"],
    maker: None,
    together: HeldTogether::Both,
    holds_tracks: true,
    beside: HeldBeside::AreasAndRally,
};

/// Any JSON that is nobody else's.
fn claims(look: &FileLook<'_>) -> Claim {
    match look.form {
        FileForm::Json if look.has(b"\"FeatureCollection\"") => Claim::Likely,
        FileForm::Json => Claim::Possible,
        _ => look.named_text(&INFO),
    }
}

/// Its reader and writers.
pub(super) const WORK: FormatWork = FormatWork {
    claims,
    read: Read::Text(read),
    write: |places, frame| Ok(WrittenFile::of_text(write(places, frame))),
    track: Some(TrackWork {
        write: |track| Ok(flown_text::geojson(track).into_bytes()),
        undated: Some("the date is not known: times are seconds"),
    }),
};

/// Deepest nesting of collections.
const DEEPEST: usize = 8;

/// Reads a collection, a single feature or a bare geometry.
pub(super) fn read(file: &str, content: &str) -> Result<GeodeticContent, ExchangeError> {
    // A piece is put into a collection on its own first line, so that lines stay what they are.
    let numbers = without_not_a_number(content);
    let content = numbers.as_ref().map_or(content, |(content, _)| content);
    let lines = feature_lines(content);
    let content = lines.as_deref().unwrap_or(content);
    let whole: Option<Value> = serde_json::from_str(content).ok();
    let system_note = whole
        .as_ref()
        .map_or(Ok(None), |whole| system(file, whole))?;
    if let Some(cause) = whole.as_ref().and_then(other_json) {
        return Err(ExchangeError::File {
            file: file.to_owned(),
            cause: cause.to_owned(),
        });
    }
    let kind = whole.and_then(|value| value.get("type")?.as_str().map(str::to_owned));
    let feature = |geometry: &str| {
        format!("{{\"type\":\"Feature\",\"properties\":{{}},\"geometry\":{geometry}}}")
    };
    let collection =
        |feature: &str| format!("{{\"type\":\"FeatureCollection\",\"features\":[{feature}]}}");
    let content = match kind.as_deref() {
        Some("Feature") => collection(content),
        Some(kind) if kind != "FeatureCollection" => collection(&feature(content)),
        _ => content.to_owned(),
    };
    let text = Text(&content);
    let (features, _) = read_features(&text).map_err(|e| ExchangeError::of_json(file, e))?;
    let mut found = GeodeticContent {
        routes: features.routes,
        landmarks: features.landmarks,
        no_fly: features.no_fly,
        rally: features.rally,
        notes: system_note.into_iter().collect(),
        origin: features.origin,
    };
    let mut other = Others::default();
    for piece in &features.others {
        let error = |cause: String| ExchangeError::of_json(file, text.error(piece.get(), cause));
        let feature: Value = serde_json::from_str(piece.get()).map_err(|e| error(e.to_string()))?;
        other.feature(&feature, &mut found, 0).map_err(error)?;
    }
    if other.heights > 0 {
        found.notes.push(
            "heights in the coordinates are taken for altitudes above mean sea level".to_owned(),
        );
    }
    let counted = [
        (
            numbers.map_or(0, |(_, count)| count),
            "of the numbers are none (NaN, Infinity), which JSON does not have: they are taken to be missing".to_owned(),
        ),
        (
            other.plain_lines,
            format!("of the lines state no altitude: {USUAL_ALTITUDE} is taken"),
        ),
        (
            other.heightless,
            format!("of the points of lines with heights state none: {USUAL_ALTITUDE} is taken"),
        ),
        (
            other.circles,
            format!(
                "of the places are circles: each is an area of {CIRCLE_CORNERS} corners around it"
            ),
        ),
        (
            other.points,
            format!("of the places are points: each gets a box of {POINT_BOX} m"),
        ),
        (
            other.empty,
            "of the geometries have no coordinates, and are left out".to_owned(),
        ),
        (
            other.rings,
            "of the polygons have fewer than three corners, and are left out".to_owned(),
        ),
        (
            other.skipped,
            "features are neither point, line nor polygon, and are left out".to_owned(),
        ),
    ];
    let counted = counted.iter().filter(|(count, _)| *count > 0);
    found
        .notes
        .extend(counted.map(|(count, words)| format!("{count} {words}")));
    Ok(found)
}

/// A sequence of features, one a line, as a collection with the same lines; `None` if the text is none.
fn feature_lines(content: &str) -> Option<String> {
    // A record may begin with its separator.
    let bare = |line: &str| line.trim().trim_start_matches('\u{1e}').to_owned();
    let lines: Vec<String> = content
        .lines()
        .map(bare)
        .filter(|l| !l.is_empty())
        .collect();
    let is_feature = |line: &String| {
        let value: Option<Value> = serde_json::from_str(line).ok();
        value.is_some_and(|value| value.get("type").is_some_and(|kind| kind == "Feature"))
    };
    let is_sequence =
        (lines.len() > 1 || content.contains('\u{1e}')) && lines.iter().all(is_feature);
    is_sequence.then(|| {
        format!(
            "{{\"type\":\"FeatureCollection\",\"features\":[{}]}}",
            lines.join(",\n")
        )
    })
}

/// Why JSON of other programs with places in it is not read, and what to do.
fn other_json(whole: &Value) -> Option<&'static str> {
    let has = |member: &str| whole.get(member).is_some();
    if whole.get("type").is_some_and(|kind| kind == "Topology") {
        return Some(
            "it is TopoJSON, which is not read: save it as GeoJSON (mapshaper, `topo2geo`)",
        );
    }
    let is_esri = !has("type") && (has("geometryType") || has("displayFieldName"));
    (is_esri && has("features")).then_some(
        "it is the JSON of ArcGIS, which is not read: ask for f=geojson, or save it as GeoJSON (`ogr2ogr`)",
    )
}

/// A note on the reference system that a file of before 2016 may state, or its refusal.
fn system(file: &str, whole: &Value) -> Result<Option<String>, ExchangeError> {
    let stated = |member: &str| whole.pointer("/crs/properties")?.get(member);
    // Before 2008 its number stood alone.
    let Some(name) = stated("name").or(stated("code")).and_then(name_of) else {
        return Ok(None);
    };
    let code = name.rsplit([':', '/']).next().unwrap_or(&name);
    match code {
        "4326" | "4979" | "CRS84" | "CRS84h" | "WGS84" => Ok(None),
        "4258" | "4937" | "4269" | "4283" | "7844" | "4167" => Ok(Some(format!(
            "the coordinates are in {name}: they are taken for those of WGS 84, under 2 m away"
        ))),
        _ => Err(ExchangeError::File {
            file: file.to_owned(),
            cause: format!(
                "its coordinates are in {name}, not in longitude and latitude on WGS 84: save it in EPSG:4326"
            ),
        }),
    }
}

/// Numbers of the features that are not ours, by kind.
#[derive(Default)]
struct Others {
    points: usize,
    heights: usize,
    plain_lines: usize,
    heightless: usize,
    circles: usize,
    rings: usize,
    skipped: usize,
    empty: usize,
}

impl Others {
    /// Takes a feature, or those of a collection that stands in its place.
    fn feature(
        &mut self,
        feature: &Value,
        found: &mut GeodeticContent,
        depth: usize,
    ) -> Result<(), String> {
        let is_collection = feature
            .get("type")
            .is_some_and(|kind| kind == "FeatureCollection");
        let within = feature.get("features").and_then(Value::as_array);
        if let Some(within) = within.filter(|_| is_collection && depth < DEEPEST) {
            return within
                .iter()
                .try_for_each(|feature| self.feature(feature, found, depth + 1));
        }
        let geometry = feature.get("geometry").unwrap_or(&Value::Null);
        self.geometry(geometry, feature, found)
    }

    fn geometry(
        &mut self,
        geometry: &Value,
        feature: &Value,
        found: &mut GeodeticContent,
    ) -> Result<(), String> {
        let kind = geometry.get("type").and_then(Value::as_str).unwrap_or("");
        let coordinates = geometry.get("coordinates").unwrap_or(&Value::Null);
        let each =
            |value: &'_ Value| -> Vec<Value> { value.as_array().cloned().unwrap_or_default() };
        // RFC 7946, 3.1: a geometry without coordinates is as good as none.
        if coordinates.as_array().is_some_and(Vec::is_empty) {
            self.empty += 1;
            return Ok(());
        }
        match kind {
            "Point" => self.point(coordinates, (geometry, feature), found)?,
            "MultiPoint" => {
                for point in each(coordinates) {
                    self.point(&point, (geometry, feature), found)?;
                }
            }
            "LineString" => self.line(coordinates, feature, found)?,
            "MultiLineString" => {
                for line in each(coordinates) {
                    self.line(&line, feature, found)?;
                }
            }
            "MultiPolygon" => {
                for polygon in each(coordinates) {
                    self.polygon(&polygon, (geometry, feature), found)?;
                }
            }
            "Polygon" => self.polygon(coordinates, (geometry, feature), found)?,
            "GeometryCollection" => {
                for geometry in each(geometry.get("geometries").unwrap_or(&Value::Null)) {
                    self.geometry(&geometry, feature, found)?;
                }
            }
            _ => self.skipped += 1,
        }
        Ok(())
    }

    /// Adds a point, or the circle about it where its geometry states one (ED-318).
    fn point(
        &mut self,
        coordinates: &Value,
        (geometry, feature): (&Value, &Value),
        found: &mut GeodeticContent,
    ) -> Result<(), String> {
        let place = position(coordinates)?.0;
        let circle = circle(geometry).and_then(|radius| circle_corners(place, radius));
        let is_point = circle.is_none();
        self.points += usize::from(is_point);
        self.circles += usize::from(!is_point);
        let mut properties = properties(feature);
        add_geometry_members(geometry, &mut properties);
        found.landmarks.push(FoundLandmark {
            name: name(feature),
            properties,
            ..FoundLandmark::new(
                circle.map_or(LandmarkExtent::Point(place), LandmarkExtent::Corners),
            )
        });
        Ok(())
    }

    /// Adds a polygon with its holes: a landmark, or a no-fly area where its feature says so.
    fn polygon(
        &mut self,
        rings: &Value,
        (geometry, feature): (&Value, &Value),
        found: &mut GeodeticContent,
    ) -> Result<(), String> {
        let rings = rings.as_array().map_or(&[][..], Vec::as_slice);
        let mut rings = rings.iter().map(|ring| {
            let corners = ring.as_array().map_or(&[][..], Vec::as_slice);
            let corners = corners.iter().map(|corner| Ok(position(corner)?.0));
            corners.collect::<Result<Vec<LonLat>, String>>()
        });
        let corners = rings.next().transpose()?.unwrap_or_default();
        if corners.len() < 3 {
            self.empty += usize::from(corners.is_empty());
            self.rings += usize::from(!corners.is_empty());
            return Ok(());
        }
        let mut holes: Vec<Vec<LonLat>> = rings.collect::<Result<_, _>>()?;
        // A hole without corners is none.
        holes.retain(|hole| hole.len() >= 3);
        let (name, mut properties) = (name(feature), properties(feature));
        add_geometry_members(geometry, &mut properties);
        let (mark, marked) = NO_FLY_MARK;
        if properties.get(mark).is_some_and(|value| value == marked) {
            properties.remove(mark);
            let open = |mut ring: Vec<LonLat>| {
                if ring.len() > 3 && ring.first() == ring.last() {
                    ring.pop();
                }
                ring
            };
            found.no_fly.push(FoundNoFly {
                name,
                corners: open(corners),
                holes: holes.into_iter().map(open).collect(),
                properties,
            });
        } else {
            found.landmarks.push(FoundLandmark {
                holes,
                name,
                properties,
                ..FoundLandmark::new(LandmarkExtent::Corners(corners))
            });
        }
        Ok(())
    }

    fn line(
        &mut self,
        coordinates: &Value,
        feature: &Value,
        found: &mut GeodeticContent,
    ) -> Result<(), String> {
        let positions = coordinates
            .as_array()
            .ok_or("a line needs a list of positions")?;
        let mut way_points = Vec::with_capacity(positions.len());
        let mut without = 0;
        for value in positions {
            let (place, height) = position(value)?;
            without += usize::from(height.is_none());
            let altitude = height.map_or(USUAL_ALTITUDE, |m| Altitude::new(m, AltitudeFrame::Amsl));
            way_points.push((place, WayPoint::new(GroundPoint::default(), altitude)));
        }
        let has_heights = without < positions.len();
        self.heights += usize::from(has_heights);
        self.plain_lines += usize::from(!has_heights);
        self.heightless += if has_heights { without } else { 0 };
        found.routes.push(ReadRoute {
            name: name(feature),
            way_points,
            properties: properties(feature),
            ..ReadRoute::default()
        });
        Ok(())
    }
}

/// Radius of the circle that the geometry of a point states about it, metres.
fn circle(geometry: &Value) -> Option<f64> {
    let extent = geometry.get("extent")?;
    let is_circle = extent.get("subType").is_some_and(|kind| kind == "Circle");
    extent.get("radius")?.as_f64().filter(|_| is_circle)
}

/// Longitude and latitude of a position, and its height where it has one.
fn position(value: &Value) -> Result<(LonLat, Option<f64>), String> {
    let number = |i: usize| value.get(i).and_then(Value::as_f64);
    match (number(0), number(1)) {
        (Some(longitude), Some(latitude)) if on_globe(longitude, latitude) => {
            Ok(((longitude, latitude), number(2)))
        }
        _ => Err(format!(
            "{value} is no position: it needs a longitude and a latitude in degrees"
        )),
    }
}

/// Text of a member that may be a name: numbers are names as well.
fn name_of(value: &Value) -> Option<String> {
    match value {
        Value::String(text) => Some(text.clone()),
        Value::Number(number) => Some(number.to_string()),
        _ => None,
    }
}

fn name(feature: &Value) -> Option<String> {
    let properties = feature.get("properties")?;
    let mut names = ["name", "Name", "title"].iter();
    names.find_map(|key| name_of(properties.get(key)?))
}

/// Everything that a feature says of itself, as JSON text.
fn properties(feature: &Value) -> BTreeMap<String, String> {
    let members = |value: Option<&Value>| value.and_then(Value::as_object).cloned();
    let own = members(feature.get("properties")).unwrap_or_default();
    let own = own
        .into_iter()
        .filter(|(name, value)| name != "name" || !value.is_null() && name_of(value).is_none())
        .map(|(name, value)| match name.as_str() {
            // The names that we write ourselves.
            "name" | "id" | "reference" | "height_m" | "enabled" | "way_points" => {
                (format!("{name}_in_file"), value)
            }
            _ => (name, value),
        });
    let beside = members(Some(feature)).unwrap_or_default();
    let beside = beside
        .into_iter()
        .filter(|(name, _)| !["type", "geometry", "properties"].contains(&name.as_str()))
        .map(|(name, value)| (format!("{FEATURE_MEMBER}{name}"), value));
    own.chain(beside)
        .map(|(name, value)| (name, value.to_string()))
        .collect()
}

/// Routes, landmarks, no-fly areas and rally points as a collection of features.
pub(super) fn write(places: &Places, frame: &LocalFrame) -> (String, Vec<String>) {
    let mut features = write_features(places.routes, places.landmarks, frame);
    features.extend(places.no_fly.iter().map(|zone| no_fly_feature(zone, frame)));
    let rally = places.rally.unwrap_or_default().iter();
    features.extend(rally.map(|point| rally_feature(point, frame)));
    let text = format!(
        "{{\n  \"type\": \"FeatureCollection\",\n  \"features\": [\n    {}\n  ]\n}}\n",
        features.join(",\n    ")
    );
    (text, Vec::new())
}
