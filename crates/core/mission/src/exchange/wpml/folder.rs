//! A folder of either file: its way-points as they stand.

use super::super::ExchangeError;
use super::super::xml::{NamedText, XmlElement};
use super::hover::hover;
use super::text_of;
use crate::mission::found::{LonLat, on_globe};

/// Members of a way-point that are written anew from what it states.
const OWN: [&str; 8] = [
    "Point",
    "index",
    "executeHeight",
    "waypointSpeed",
    "ellipsoidHeight",
    "height",
    "useGlobalHeight",
    "useGlobalSpeed",
];
/// Members of a folder that are written anew from what the route states.
const OWN_OF_FOLDER: [&str; 9] = [
    "Placemark",
    "templateType",
    "templateId",
    "waylineId",
    "executeHeightMode",
    "waylineCoordinateSysParam",
    "autoFlightSpeed",
    "distance",
    "duration",
];

/// A way-point as a file states it.
pub(super) struct Point {
    pub place: LonLat,
    pub index: Option<usize>,
    /// Metres above what the folder's mode says.
    pub height: Option<f64>,
    /// Metres above the ellipsoid, where the template says so beside that.
    pub ellipsoid: Option<f64>,
    /// Speed of the leg that leads away from it, m/s.
    pub speed: Option<f64>,
    /// Everything else.
    pub rest: String,
    /// Turns, the heading and actions, in the file's words.
    pub turn: Option<String>,
    pub heading: Option<String>,
    pub actions: Vec<String>,
    /// Seconds for which it hovers there.
    pub hover: Option<f64>,
}

/// A folder with way-points.
pub(super) struct WaylineFolder {
    pub id: Option<String>,
    pub name: Option<String>,
    /// Mode of heights, which says from where they count, in the file's word.
    pub mode: Option<String>,
    pub points: Vec<Point>,
    pub rest: String,
}

/// The folders of a file that have way-points.
pub(super) fn folders(
    source: &NamedText,
    root: &XmlElement,
) -> Result<Vec<WaylineFolder>, ExchangeError> {
    let mut found = Vec::new();
    gather(source, root, &mut found)?;
    Ok(found)
}

fn gather(
    source: &NamedText,
    element: &XmlElement,
    found: &mut Vec<WaylineFolder>,
) -> Result<(), ExchangeError> {
    let is_point = |placemark: &XmlElement| placemark.child("Point").is_some();
    for child in &element.children {
        if child.name == "Folder" && child.all("Placemark").any(is_point) {
            found.push(folder(source, child)?);
        } else {
            gather(source, child, found)?;
        }
    }
    Ok(())
}

fn folder(source: &NamedText, element: &XmlElement) -> Result<WaylineFolder, ExchangeError> {
    let system = element.child("waylineCoordinateSysParam");
    let mode = element
        .child_text("executeHeightMode")
        .or_else(|| system?.child_text("heightMode"));
    let common = Common {
        height: number(source, element, "globalHeight")?,
        speed: number(source, element, "autoFlightSpeed")?.filter(|v| *v > 0.0),
        heading: in_child(element, "globalWaypointHeadingParam", "waypointHeadingMode"),
        turn: element.child_text("globalWaypointTurnMode"),
        is_above_take_off: mode == Some("relativeToStartPoint"),
    };
    let mut points = Vec::new();
    for placemark in element.all("Placemark") {
        if let Some(point) = placemark.child("Point") {
            points.push(self::point(source, placemark, point, &common)?);
        }
    }
    // They are flown by their numbers, not as they stand.
    if points.iter().all(|p| p.index.is_some()) {
        points.sort_by_key(|p| p.index);
    }
    let other = |child: &&XmlElement| !OWN_OF_FOLDER.contains(&child.name.as_str());
    Ok(WaylineFolder {
        id: element.child_text("templateId").map(str::to_owned),
        name: element.child_text("name").map(str::to_owned),
        mode: mode.map(str::to_owned),
        points,
        // The name is KML's.
        rest: text_of(
            element
                .children
                .iter()
                .filter(other)
                .filter(|c| c.name != "name"),
        ),
    })
}

/// Values of a folder that all its way-points have in common.
struct Common<'a> {
    height: Option<f64>,
    speed: Option<f64>,
    heading: Option<&'a str>,
    turn: Option<&'a str>,
    is_above_take_off: bool,
}

fn point(
    source: &NamedText,
    placemark: &XmlElement,
    point: &XmlElement,
    common: &Common,
) -> Result<Point, ExchangeError> {
    let coordinates = point.child("coordinates").unwrap_or(point);
    let place = place(&coordinates.text).ok_or_else(|| {
        let cause = format!(
            "Placemark/Point/coordinates: `{}` is no longitude,latitude",
            coordinates.text
        );
        source.error(coordinates.begin, cause)
    })?;
    let is = |name: &str| {
        placemark
            .child_text(name)
            .is_some_and(|t| t == "1" || t == "true")
    };
    let flown = number(source, placemark, "executeHeight")?;
    let stated = number(source, placemark, "height")?;
    let all = common.height.filter(|_| is("useGlobalHeight"));
    let drawn = if common.is_above_take_off {
        all.or(stated)
    } else {
        stated.or(all)
    };
    let speed =
        number(source, placemark, "waypointSpeed")?.filter(|v| *v > 0.0 && !is("useGlobalSpeed"));
    let actions = placemark
        .all("actionGroup")
        .flat_map(|group| group.all("action"))
        .filter_map(|action| action.child_text("actionActuatorFunc"))
        .filter(|kind| *kind != "hover");
    let other = |child: &&XmlElement| !OWN.contains(&child.name.as_str());
    let kml =
        |child: &&XmlElement| !["name", "description", "styleUrl"].contains(&child.name.as_str());
    let turn = in_child(placemark, "waypointTurnParam", "waypointTurnMode").or(common.turn);
    let heading =
        in_child(placemark, "waypointHeadingParam", "waypointHeadingMode").or(common.heading);
    Ok(Point {
        place,
        index: placemark.child_text("index").and_then(|t| t.parse().ok()),
        height: flown.or(drawn),
        ellipsoid: number(source, placemark, "ellipsoidHeight")?,
        speed: speed.or(common.speed),
        rest: text_of(placemark.children.iter().filter(other).filter(kml)),
        turn: turn.map(str::to_owned),
        heading: heading.map(str::to_owned),
        actions: actions.map(str::to_owned).collect(),
        hover: hover(placemark.children.iter()),
    })
}

fn in_child<'a>(element: &'a XmlElement, child: &str, name: &str) -> Option<&'a str> {
    element.child(child)?.child_text(name)
}

fn place(text: &str) -> Option<LonLat> {
    let mut numbers = text.split(',').map(|part| part.trim().parse::<f64>().ok());
    let (longitude, latitude) = (numbers.next()??, numbers.next()??);
    on_globe(longitude, latitude).then_some((longitude, latitude))
}

/// A number that is stated, or what is wrong with it.
fn number(
    source: &NamedText,
    element: &XmlElement,
    name: &str,
) -> Result<Option<f64>, ExchangeError> {
    let Some(child) = element.child(name).filter(|c| !c.text.is_empty()) else {
        return Ok(None);
    };
    let value: Option<f64> = child.text.parse().ok().filter(|v: &f64| v.is_finite());
    let wrong = || {
        source.error(
            child.begin,
            format!("{name}: `{}` is no number", child.text),
        )
    };
    value.map(Some).ok_or_else(wrong)
}
