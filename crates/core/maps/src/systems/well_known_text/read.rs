//! A reference system out of well-known text.

use std::f64::consts::{FRAC_PI_2, PI};

use pilotage_base::frames::{Datum, Ellipsoid, ProjectionMethod, ReferenceSystem};

use super::tree::{WktNode, WktValue};
use crate::systems::definition::{ParameterRole, ProjectedDefinition};
use crate::systems::made::of_numbers;
use crate::systems::names::{plain, shortened};
use crate::systems::{SystemError, by_code, code_table, datums};

const PROJECTED: [&str; 3] = ["PROJCS", "PROJCRS", "PROJECTEDCRS"];
const GEOGRAPHIC: [&str; 6] = [
    "GEOGCS",
    "GEOGCRS",
    "GEODCRS",
    "GEODETICCRS",
    "GEOGRAPHICCRS",
    "BASEGEOGCRS",
];
const UNITS: [&str; 3] = ["UNIT", "LENGTHUNIT", "ANGLEUNIT"];

/// The system that a text describes.
pub(in super::super) fn read(text: &str) -> Result<ReferenceSystem, SystemError> {
    let unknown = || SystemError::unknown(format!("\"{}\"", shortened(text)));
    let root = WktNode::parse(text).ok_or_else(unknown)?;
    let (node, shift) = horizontal(&root).ok_or_else(unknown)?;
    let described = match node.keyword.as_str() {
        keyword if PROJECTED.contains(&keyword) => projected(node, shift),
        keyword if GEOGRAPHIC.contains(&keyword) => geographic(node, shift),
        _ => Err(unknown()),
    };
    let named = node.code().and_then(|code| by_code(code).ok());
    match (described, named) {
        // The table has the name, and the same numbers with all their digits.
        (Ok(described), Some(named)) if is_same(&described, &named) => Ok(named),
        (Ok(described), _) => Ok(described),
        // A code says all that the description lacks, but for a shift of its own.
        (Err(_), Some(named)) if shift.is_none() && !text.contains("TOWGS84") => Ok(named),
        (Err(cause), _) => Err(cause),
    }
}

/// The part about what lies on the ground, and a shift to WGS 84 that stands outside of it.
fn horizontal(root: &WktNode) -> Option<(&WktNode, Option<[f64; 7]>)> {
    match root.keyword.as_str() {
        "COMPD_CS" | "COMPOUNDCRS" => horizontal(root.children().next()?),
        "BOUNDCRS" => {
            let source = root.child(&["SOURCECRS"])?.children().next()?;
            let transformation = root.child(&["ABRIDGEDTRANSFORMATION"])?;
            let (node, _) = horizontal(source)?;
            Some((node, Some(abridged(transformation)?)))
        }
        _ => Some((root, None)),
    }
}

/// The shift of an abridged transformation; `None` if it is not one of three or seven numbers.
fn abridged(transformation: &WktNode) -> Option<[f64; 7]> {
    let mut shift = [0.0; 7];
    let method = plain(transformation.child(&["METHOD", "PROJECTION"])?.name());
    let sign = if method.contains("COORDINATEFRAME") {
        -1.0
    } else {
        1.0
    };
    for parameter in transformation
        .children()
        .filter(|child| child.keyword == "PARAMETER")
    {
        let value = *parameter.numbers().first()?;
        let name = plain(parameter.name());
        let names = [
            "XAXISTRANS",
            "YAXISTRANS",
            "ZAXISTRANS",
            "XAXISROT",
            "YAXISROT",
            "ZAXISROT",
            "SCALE",
        ];
        let index = names.iter().position(|start| name.starts_with(start))?;
        let unit = parameter.child(&UNITS).or(parameter.child(&["SCALEUNIT"]));
        let size = unit.and_then(|unit| unit.numbers().first().copied());
        shift[index] = match index {
            0..=2 => value * size.unwrap_or(1.0),
            3..=5 => {
                let seconds = size.map_or(1.0, |radians| radians.to_degrees() * 3600.0);
                sign * value * seconds
            }
            // A scale is written as its difference from 1 in parts per million, or as it is.
            _ if (value - 1.0).abs() < 0.01 && size.is_none_or(|size| size == 1.0) => {
                (value - 1.0) * 1e6
            }
            _ => value * size.unwrap_or(1e-6) * 1e6,
        };
    }
    Some(shift)
}

fn projected(node: &WktNode, shift: Option<[f64; 7]>) -> Result<ReferenceSystem, SystemError> {
    let name = format!("\"{}\"", shortened(node.name()));
    let number = |cause: &str| SystemError::Number {
        name: name.clone(),
        cause: cause.to_owned(),
    };
    let base = node
        .child(&GEOGRAPHIC)
        .ok_or_else(|| number("it names no datum"))?;
    let conversion = node.child(&["CONVERSION"]).unwrap_or(node);
    let method = conversion
        .child(&["PROJECTION", "METHOD"])
        .ok_or_else(|| number("it names no projection"))?
        .name();
    // Most call both ways to count by one name.
    let is_eastward = axes(node).any(|direction| direction == "EAST")
        || parameter(conversion, "XSCALE") == Some(-1.0)
            && parameter(conversion, "XYPLANEROTATION") == Some(90.0);
    let method = match plain(method).as_str() {
        "KROVAK" if is_eastward => "Krovak (North Orientated)",
        _ => method,
    };
    if axes(node).any(|direction| direction == "WEST") {
        return Err(number(
            "its coordinates count westward, which is not read here",
        ));
    }
    let datum = datum(base, shift, &name)?;
    let unit = unit(node).unwrap_or(1.0);
    let angle = unit_of_angles(base);
    let mut definition = ProjectedDefinition {
        name: name.clone(),
        datum,
        prime_meridian: prime_meridian(base),
        unit,
        ..ProjectedDefinition::default()
    };
    for parameter in conversion
        .children()
        .filter(|child| child.keyword == "PARAMETER")
    {
        let (Some(role), Some(value)) =
            (role(parameter.name()), parameter.numbers().first().copied())
        else {
            continue;
        };
        let own = parameter
            .child(&UNITS)
            .and_then(|unit| unit.numbers().first().copied());
        let size = match role {
            ParameterRole::Scale => 1.0,
            ParameterRole::Easting | ParameterRole::Northing => own.unwrap_or(unit),
            _ => own.unwrap_or(angle),
        };
        definition.numbers[role as usize] = Some(value * size);
    }
    definition.system(method)
}

fn geographic(node: &WktNode, shift: Option<[f64; 7]>) -> Result<ReferenceSystem, SystemError> {
    let name = format!("\"{}\"", shortened(node.name()));
    let datum = datum(node, shift, &name)?;
    let mut numbers = code_table::plain_numbers(datum, ProjectionMethod::Geographic);
    numbers.unit = unit_of_angles(node);
    numbers.prime_meridian = prime_meridian(node);
    of_numbers(None, numbers).map_err(|cause| SystemError::Number { name, cause })
}

/// The datum of a system of longitude and latitude.
fn datum(node: &WktNode, shift: Option<[f64; 7]>, name: &str) -> Result<Datum, SystemError> {
    let datum = node.child(&["DATUM", "GEODETICDATUM", "TRF", "ENSEMBLE"]);
    let unknown = || SystemError::Datum {
        name: name.to_owned(),
        datum: shortened(datum.map_or("", WktNode::name)),
    };
    let datum = datum.ok_or_else(unknown)?;
    let known = datums::named(datum.name())
        .or_else(|| datums::by_datum_code(datum.code()?))
        .or_else(|| datums::by_code(node.code()?));
    let in_text = || Some(datum.child(&["TOWGS84"])?.numbers());
    let stated = shift.map(Vec::from).or_else(in_text);
    let known = match stated {
        Some(shift) => datums::stated(known, ellipsoid(datum), shift),
        None => known,
    };
    known.ok_or_else(unknown)
}

fn ellipsoid(datum: &WktNode) -> Option<Ellipsoid> {
    let node = datum.child(&["SPHEROID", "ELLIPSOID"])?;
    let numbers = node.numbers();
    let [semi_major, inverse, ..] = numbers[..] else {
        return None;
    };
    let unit = node
        .child(&UNITS)
        .and_then(|unit| unit.numbers().first().copied());
    Some(Ellipsoid {
        semi_major: semi_major * unit.unwrap_or(1.0),
        flattening: if inverse == 0.0 { 0.0 } else { 1.0 / inverse },
    })
}

/// Metres in the unit of the coordinates.
fn unit(node: &WktNode) -> Option<f64> {
    let own = node.child(&["UNIT", "LENGTHUNIT"]);
    let axis = || node.child(&["AXIS"])?.child(&["UNIT", "LENGTHUNIT"]);
    own.or_else(axis)?.numbers().first().copied()
}

/// Radians in the unit of a system of longitude and latitude.
fn unit_of_angles(node: &WktNode) -> f64 {
    let own = node.child(&["UNIT", "ANGLEUNIT"]);
    let axis = || node.child(&["AXIS"])?.child(&["UNIT", "ANGLEUNIT"]);
    let size = own
        .or_else(axis)
        .and_then(|unit| unit.numbers().first().copied());
    // A degree with all its digits.
    match size {
        Some(size) if (size - PI / 180.0).abs() > 1e-9 => size,
        _ => PI / 180.0,
    }
}

/// Longitudes of prime meridians from Greenwich, degrees. Files write them in degrees or in the unit of the
/// system, and names are plain.
const MERIDIANS: [(&str, f64); 9] = [
    ("GREENWICH", 0.0),
    ("PARIS", 2.337_229_166_666_667),
    ("LISBON", -9.131_906_111_111_11),
    ("ROME", 12.452_333_333_333_333),
    ("BERN", 7.439_583_333_333_333),
    ("MADRID", -3.687_938_888_888_889),
    ("FERRO", -17.666_666_666_666_668),
    ("OSLO", 10.722_916_666_666_667),
    ("ATHENS", 23.716_337_5),
];

/// Longitude of the prime meridian from Greenwich, radians.
fn prime_meridian(node: &WktNode) -> f64 {
    let meridian = node.child(&["PRIMEM", "PRIMEMERIDIAN"]).or_else(|| {
        node.child(&["DATUM", "GEODETICDATUM"])?
            .child(&["PRIMEM", "PRIMEMERIDIAN"])
    });
    let Some(meridian) = meridian else {
        return 0.0;
    };
    let name = plain(meridian.name());
    let known = MERIDIANS.iter().find(|(known, _)| name.starts_with(known));
    if let Some((_, degrees)) = known {
        return degrees.to_radians();
    }
    let unit = meridian
        .child(&UNITS)
        .and_then(|unit| unit.numbers().first().copied());
    let value = meridian.numbers().first().copied().unwrap_or(0.0);
    value * unit.unwrap_or_else(|| unit_of_angles(node))
}

/// Directions of the axes, in capitals.
fn axes(node: &WktNode) -> impl Iterator<Item = String> {
    let axes = node.children().filter(|child| child.keyword == "AXIS");
    axes.filter_map(|axis| {
        axis.values.iter().find_map(|value| match value {
            WktValue::Word(word) => Some(word.to_ascii_uppercase()),
            _ => None,
        })
    })
}

/// The number of a parameter with that plain name.
fn parameter(node: &WktNode, name: &str) -> Option<f64> {
    let mut parameters = node.children().filter(|child| child.keyword == "PARAMETER");
    let found = parameters.find(|child| plain(child.name()) == name)?;
    found.numbers().first().copied()
}

/// Role of a parameter, by its name in any of the dialects.
fn role(name: &str) -> Option<ParameterRole> {
    Some(match plain(name).as_str() {
        "LATITUDEOFORIGIN"
        | "LATITUDEOFCENTER"
        | "LATITUDEOFCENTRE"
        | "LATITUDEOFNATURALORIGIN"
        | "LATITUDEOFFALSEORIGIN"
        | "LATITUDEOFPROJECTIONCENTRE"
        | "CENTRALPARALLEL" => ParameterRole::Latitude,
        "CENTRALMERIDIAN"
        | "LONGITUDEOFORIGIN"
        | "LONGITUDEOFCENTER"
        | "LONGITUDEOFCENTRE"
        | "LONGITUDEOFNATURALORIGIN"
        | "LONGITUDEOFFALSEORIGIN"
        | "LONGITUDEOFPROJECTIONCENTRE" => ParameterRole::Longitude,
        "STANDARDPARALLEL1"
        | "LATITUDEOF1STSTANDARDPARALLEL"
        | "LATITUDEOFSTANDARDPARALLEL"
        | "STANDARDPARALLEL"
        | "LATITUDEOFPSEUDOSTANDARDPARALLEL"
        | "PSEUDOSTANDARDPARALLEL1" => ParameterRole::FirstParallel,
        "STANDARDPARALLEL2" | "LATITUDEOF2NDSTANDARDPARALLEL" => ParameterRole::SecondParallel,
        "SCALEFACTOR"
        | "SCALEFACTORATNATURALORIGIN"
        | "SCALEFACTORATPROJECTIONCENTRE"
        | "SCALEFACTORONINITIALLINE"
        | "SCALEFACTORONPSEUDOSTANDARDPARALLEL" => ParameterRole::Scale,
        "FALSEEASTING" | "EASTINGATFALSEORIGIN" | "EASTINGATPROJECTIONCENTRE" => {
            ParameterRole::Easting
        }
        "FALSENORTHING" | "NORTHINGATFALSEORIGIN" | "NORTHINGATPROJECTIONCENTRE" => {
            ParameterRole::Northing
        }
        "AZIMUTH"
        | "AZIMUTHOFINITIALLINE"
        | "AZIMUTHATPROJECTIONCENTRE"
        | "COLATITUDEOFCONEAXIS" => ParameterRole::Azimuth,
        _ => return None,
    })
}

/// Whether a description is the same as that of the table, to a hundredth of a millimetre.
fn is_same(described: &ReferenceSystem, named: &ReferenceSystem) -> bool {
    let (ReferenceSystem::Other(a), ReferenceSystem::Other(b)) = (described, named) else {
        return described == named;
    };
    let is_near = |a: f64, b: f64, most: f64| (a - b).abs() <= most;
    let (a, b) = (a.numbers, b.numbers);
    let is_cone = |method| {
        matches!(
            method,
            ProjectionMethod::LambertConformal | ProjectionMethod::Albers
        )
    };
    let parallels = |numbers: &pilotage_base::frames::SystemNumbers| {
        let [first, second] = numbers.parallels;
        (first.min(second), first.max(second))
    };
    let ((a1, a2), (b1, b2)) = (parallels(a), parallels(b));
    let datum = (a.datum.name, a.datum.shift) == (b.datum.name, b.datum.shift);
    datum
        && a.method == b.method
        && is_near(a.prime_meridian, b.prime_meridian, 1e-9)
        && is_near(a.latitude_0, b.latitude_0, 1e-11)
        && is_near(a.longitude_0, b.longitude_0, 1e-11)
        && (!is_cone(a.method) || is_near(a1, b1, 1e-11) && is_near(a2, b2, 1e-11))
        && is_near(a.scale, b.scale, 1e-10)
        && is_near(a.offset[0], b.offset[0], 1e-4)
        && is_near(a.offset[1], b.offset[1], 1e-4)
        && is_near(a.unit, b.unit, 1e-9)
        && a.latitude_0.abs() <= FRAC_PI_2 + 1e-9
}
