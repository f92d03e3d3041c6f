//! Reading a mission of DJI: places, heights and speeds are those of the waylines, which are flown; the
//! template says which of the heights are above mean sea level or the ground.

use serde_json::Value;

use super::super::found::GeodeticContent;
use super::super::item::counted;
use super::super::item_route::{GROUND_SPEED, OVER_GROUND};
use super::super::xml::{NamedText, XmlElement};
use super::super::{ExchangeError, kml_read};
use super::folder::{Point, WaylineFolder, folders};
use super::{
    EXECUTED, GO_HOME, IN_TEMPLATE, IN_WAYLINES, INDEX, MISSION, OWN_NAME_SPACE, UNDULATION,
    ending, is_shadow, is_text, text_of,
};
use crate::mission::found::ReadRoute;
use crate::mission::{HOME, USUAL_ALTITUDE, WayPoint, WayPointAction};
use pilotage_base::files::{FileSet, ZipFiles};
use pilotage_base::frames::{Altitude, AltitudeFrame, GroundPoint};

/// Farthest that places of both files are apart, degrees.
const SAME_DEGREES: f64 = 1e-6;
/// More than the geoid is from the ellipsoid anywhere, metres.
const FARTHEST_GEOID: f64 = 110.0;

/// Part of the format: the flown waylines or the template.
struct WpmlPart {
    name: String,
    text: String,
    root: XmlElement,
    folders: Vec<WaylineFolder>,
}

/// Reads the zip, or one of the two files alone.
pub(in super::super) fn read(file: &str, bytes: &[u8]) -> Result<GeodeticContent, ExchangeError> {
    let error = |cause: &str| ExchangeError::File {
        file: file.to_owned(),
        cause: cause.to_owned(),
    };
    let (mut waylines, mut template, mut others) = (None, None, 0);
    if bytes.starts_with(b"PK") {
        let zip = ZipFiles::open(bytes).map_err(|cause| error(&cause))?;
        let part =
            |end| ending(&zip, end).map(|(name, bytes)| part(&format!("{file}: {name}"), &bytes));
        waylines = part(".wpml").transpose()?;
        template = part("template.kml").transpose()?;
        let known = ["/", ".wpml", "template.kml"];
        let is_other = |name: &&String| {
            let lower = name.to_ascii_lowercase();
            !is_shadow(name) && !known.iter().any(|end| lower.ends_with(end))
        };
        others = zip.names().iter().filter(is_other).count();
    } else {
        let only = part(file, bytes)?;
        let is_flown = only.text.contains("executeHeight");
        *(if is_flown {
            &mut waylines
        } else {
            &mut template
        }) = Some(only);
    }
    let mut found = GeodeticContent::default();
    let mut told = WpmlNotes {
        site: template.as_ref().and_then(|part| site(&part.root)),
        ..WpmlNotes::default()
    };
    let drawn = template.as_ref().map_or(&[][..], |part| &part.folders);
    let flown = waylines.as_ref().map_or(&[][..], |part| &part.folders);
    for folder in flown {
        let same = drawn.iter().find(|drawn| is_same(folder, drawn));
        found.routes.push(told.route(folder, same, true));
    }
    if flown.is_empty() {
        for folder in drawn {
            found.routes.push(told.route(folder, None, false));
        }
    }
    if found.routes.is_empty() {
        let Some(part) = template.or(waylines) else {
            return Err(error(
                "the zip holds neither waylines.wpml nor template.kml of DJI",
            ));
        };
        let mut found = kml_read::read(&part.name, &part.text)?;
        found.notes.push(
            "the mission of DJI has no waylines: its area is shown, the way-points are made when it \
             is opened in DJI's program"
                .to_owned(),
        );
        return Ok(found);
    }
    let root = [&waylines, &template]
        .into_iter()
        .flatten()
        .next()
        .map(|part| &part.root);
    if let Some(root) = root {
        for route in &mut found.routes {
            told.mission(root, route);
        }
    }
    if let Some(root) = template.as_ref().map(|part| &part.root) {
        for route in &mut found.routes {
            home(root, route);
        }
    }
    found.notes = told.notes();
    if others > 0 {
        found
            .notes
            .push(format!("{others} × other file in the zip is left out"));
    }
    let stem = file.rsplit(['/', '\\']).next().unwrap_or(file);
    let stem = stem.rsplit_once('.').map_or(stem, |(stem, _)| stem);
    let is_only = found.routes.len() == 1;
    for (i, route) in found.routes.iter_mut().enumerate() {
        let name = if is_only {
            stem.to_owned()
        } else {
            format!("{stem} {}", i + 1)
        };
        route.name.get_or_insert(name);
    }
    Ok(found)
}

fn part(name: &str, bytes: &[u8]) -> Result<WpmlPart, ExchangeError> {
    let text = String::from_utf8_lossy(bytes);
    let text = text.trim_start_matches('\u{feff}').to_owned();
    let source = NamedText {
        file: name,
        text: &text,
    };
    let root = source.root()?;
    let folders = folders(&source, &root)?;
    Ok(WpmlPart {
        name: name.to_owned(),
        root,
        folders,
        text,
    })
}

/// Whether a template has the same way-points as the waylines.
fn is_same(flown: &WaylineFolder, drawn: &WaylineFolder) -> bool {
    let near = |(a, b): (&Point, &Point)| {
        let apart = (a.place.0 - b.place.0, a.place.1 - b.place.1);
        apart.0.abs().max(apart.1.abs()) < SAME_DEGREES
    };
    flown.id == drawn.id
        && flown.points.len() == drawn.points.len()
        && flown.points.iter().zip(&drawn.points).all(near)
}

/// Height of mean sea level above the ellipsoid, metres, where a template states a height above both, as that of
/// an area does for all of it.
fn site(template: &XmlElement) -> Option<f64> {
    if find(template, "heightMode")?.text != "EGM96" {
        return None;
    }
    difference(template).filter(|metres| metres.abs() < FARTHEST_GEOID)
}

/// Height above the ellipsoid less that above the sea in the first element that has both, metres.
fn difference(element: &XmlElement) -> Option<f64> {
    let number = |name: &str| element.child_text(name)?.parse::<f64>().ok();
    let own = number("ellipsoidHeight").zip(number("height"));
    let own = own.map(|(ellipsoid, sea)| ellipsoid - sea);
    own.or_else(|| element.children.iter().find_map(difference))
}

/// The reference take-off point, where the geoid is known there.
fn home(root: &XmlElement, route: &mut ReadRoute) {
    let undulation = route
        .way_points
        .iter()
        .find_map(|(_, way_point)| way_point.properties.get(UNDULATION)?.parse::<f64>().ok());
    let point = find(root, "takeOffRefPoint").map(|element| {
        let numbers = element
            .text
            .split(',')
            .map(|part| part.trim().parse::<f64>());
        numbers.flatten().collect::<Vec<f64>>()
    });
    if let (Some(undulation), Some([latitude, longitude, height])) = (undulation, point.as_deref())
    {
        let home = Value::from(vec![*latitude, *longitude, height - undulation]);
        route.properties.insert(HOME.to_owned(), home.to_string());
    }
}

fn find<'a>(element: &'a XmlElement, name: &str) -> Option<&'a XmlElement> {
    let deeper = || element.children.iter().find_map(|child| find(child, name));
    element.child(name).or_else(deeper)
}

/// Notes on a file, by their kind.
#[derive(Default)]
struct WpmlNotes {
    turns: Vec<String>,
    headings: Vec<String>,
    actions: Vec<String>,
    finish: Vec<String>,
    modes: Vec<String>,
    ellipsoid: usize,
    heightless: usize,
    speeds: usize,
    /// Height of mean sea level above the ellipsoid where the template says so, metres.
    site: Option<f64>,
    by_site: usize,
}

impl WpmlNotes {
    fn route(
        &mut self,
        folder: &WaylineFolder,
        drawn: Option<&WaylineFolder>,
        is_flown: bool,
    ) -> ReadRoute {
        let mut route = ReadRoute {
            name: folder.name.clone(),
            ..ReadRoute::default()
        };
        let mut keep = |key: &str, text: &str| {
            if !text.is_empty() {
                route
                    .properties
                    .insert(key.to_owned(), Value::from(text).to_string());
            }
        };
        keep(
            if is_flown { IN_WAYLINES } else { IN_TEMPLATE },
            &folder.rest,
        );
        keep(IN_TEMPLATE, drawn.map_or("", |drawn| &drawn.rest));
        let mut speed = None;
        for (i, point) in folder.points.iter().enumerate() {
            let template =
                drawn.and_then(|drawn| Some((drawn.mode.as_deref()?, drawn.points.get(i)?)));
            let (altitude, height) = self.altitude(folder.mode.as_deref(), point, template);
            let mut way_point = WayPoint::new(GroundPoint::default(), altitude);
            // A file states the speed of the leg that leads away.
            way_point.speed = speed;
            if point.hover.is_some() {
                way_point.action = WayPointAction::Wait {
                    radius: 0.0,
                    seconds: point.hover,
                };
            }
            let has_speed = speed.is_some();
            self.speeds += usize::from(has_speed);
            speed = point.speed;
            let mut keep = |key: &str, value: Value| {
                way_point
                    .properties
                    .insert(key.to_owned(), value.to_string());
            };
            keep(INDEX, Value::from(point.index.unwrap_or(i)));
            if has_speed {
                keep(GROUND_SPEED, Value::Bool(true));
            }
            if let Some((key, value)) = height {
                keep(key, value);
            }
            let own = if is_flown { IN_WAYLINES } else { IN_TEMPLATE };
            keep(own, Value::from(point.rest.as_str()));
            if let Some((_, template)) = template {
                keep(IN_TEMPLATE, Value::from(template.rest.as_str()));
            }
            self.turns.extend(point.turn.clone());
            self.headings.extend(point.heading.clone());
            self.actions.extend(point.actions.iter().cloned());
            route.way_points.push((point.place, way_point));
        }
        route
    }

    /// The altitude of a way-point; the second is a property, what the file says of its height beside that: the undulation,
    /// null where the altitude is above the ellipsoid and nothing is known of the geoid.
    fn altitude(
        &mut self,
        mode: Option<&str>,
        point: &Point,
        template: Option<(&str, &Point)>,
    ) -> (Altitude, Option<(&'static str, Value)>) {
        let undulation = |value: Value| Some((UNDULATION, value));
        let Some(height) = point.height else {
            self.heightless += 1;
            return (USUAL_ALTITUDE, None);
        };
        let drawn = template.and_then(|(mode, point)| Some((mode, point.height?)));
        let mode = mode.or(drawn.map(|(mode, _)| mode));
        match mode {
            Some("relativeToStartPoint") => {
                (Altitude::new(height, AltitudeFrame::AboveTakeOff), None)
            }
            Some("realTimeFollowSurface" | "aboveGroundLevel" | "AGL") => {
                (Altitude::new(height, AltitudeFrame::AboveGround), None)
            }
            Some("EGM96") => {
                let apart = point.ellipsoid.map(|ellipsoid| ellipsoid - height);
                let apart = apart.filter(|metres| metres.abs() < FARTHEST_GEOID);
                let altitude = Altitude::new(height, AltitudeFrame::Amsl);
                (altitude, apart.and_then(|metres| undulation(metres.into())))
            }
            Some("WGS84") => match drawn {
                Some(("EGM96", above_sea)) if (height - above_sea).abs() < FARTHEST_GEOID => {
                    let altitude = Altitude::new(above_sea, AltitudeFrame::Amsl);
                    (altitude, undulation(Value::from(height - above_sea)))
                }
                Some(("aboveGroundLevel", above_ground)) => {
                    let (longitude, latitude) = point.place;
                    let executed = Value::from(vec![height, latitude, longitude, above_ground]);
                    let altitude = Altitude::new(above_ground, AltitudeFrame::AboveGround);
                    (altitude, Some((EXECUTED, executed)))
                }
                _ => {
                    if let Some(site) = self.site {
                        self.by_site += 1;
                        let altitude = Altitude::new(height - site, AltitudeFrame::Amsl);
                        return (altitude, undulation(Value::from(site)));
                    }
                    self.ellipsoid += 1;
                    let altitude = Altitude::new(height, AltitudeFrame::Amsl);
                    (altitude, undulation(Value::Null))
                }
            },
            other => {
                self.modes.push(other.unwrap_or("none").to_owned());
                (Altitude::new(height, USUAL_ALTITUDE.frame), None)
            }
        }
    }

    /// Keeps the mission's configuration and the name space of DJI's elements.
    fn mission(&mut self, root: &XmlElement, route: &mut ReadRoute) {
        if let Some(config) = find(root, "missionConfig") {
            let text = text_of(config.children.iter());
            route
                .properties
                .insert(MISSION.to_owned(), Value::from(text).to_string());
            let finish = config.child_text("finishAction");
            route.returns = finish == Some(GO_HOME);
            self.finish.extend(finish.map(str::to_owned));
        }
        if let Some(name_space) = root
            .attribute("wpml")
            .filter(|uri| is_text(&format!("{uri}/")))
        {
            let name_space = Value::from(name_space).to_string();
            route
                .properties
                .insert(OWN_NAME_SPACE.to_owned(), name_space);
        }
    }

    fn notes(self) -> Vec<String> {
        let mut notes = Vec::new();
        let mut kept = |what: &str, names: &[String]| {
            if !names.is_empty() {
                notes.push(format!(
                    "{what} are kept, and not shown: {}",
                    counted(names)
                ));
            }
        };
        kept("turns at way-points", &self.turns);
        kept("headings", &self.headings);
        kept("actions", &self.actions);
        if let Some(finish) = self.finish.first() {
            notes.push(if finish == GO_HOME {
                format!("the aircraft returns home at the end ({finish})")
            } else {
                format!("what is done at the end is kept, and not shown: {finish}")
            });
        }
        if self.ellipsoid > 0 {
            notes.push(format!(
                "{} of the heights are above the ellipsoid, up to 107 m from mean sea level: they are taken \
                 as they are",
                self.ellipsoid
            ));
        }
        if self.speeds > 0 {
            notes.push(OVER_GROUND.to_owned());
        }
        if self.by_site > 0 {
            notes.push(format!(
                "{} of the heights are above the ellipsoid: they are given above mean sea level, which the \
                 template says is {:.2} m above it",
                self.by_site,
                self.site.unwrap_or(0.0)
            ));
        }
        if self.heightless > 0 {
            notes.push(format!(
                "way-points without a height are at {USUAL_ALTITUDE}"
            ));
        }
        if !self.modes.is_empty() {
            notes.push(format!(
                "heights whose mode is not known are taken to count from take-off: {}",
                counted(&self.modes)
            ));
        }
        notes
    }
}
