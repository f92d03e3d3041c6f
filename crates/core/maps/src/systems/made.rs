//! A system made of its numbers, which are checked and kept, and the formulas that it counts by.

use std::f64::consts::PI;
use std::sync::{Mutex, PoisonError};

use pilotage_base::frames::{
    Ellipsoid, Geodetic, OtherSystem, ProjectionMethod, ReferenceSystem, SystemMethods,
    SystemNumbers, wrap_pi,
};

use super::{code_table, datums, methods, well_known_text_out};

/// The system of these numbers, by its own type where it is one of WGS 84. The error says which number is
/// impossible.
pub(super) fn of_numbers(
    code: Option<u32>,
    numbers: SystemNumbers,
) -> Result<ReferenceSystem, String> {
    checked(&numbers)?;
    let numbers =
        kept(&numbers).ok_or_else(|| format!("more than {MOST_SYSTEMS} systems were opened"))?;
    let other = OtherSystem {
        code,
        numbers,
        methods: &Methods,
    };
    Ok(simpler(&other).unwrap_or(ReferenceSystem::Other(other)))
}

/// Most systems that a program keeps: people have a handful.
const MOST_SYSTEMS: usize = 5000;

/// The same numbers for the life of the program; `None` if there are too many already.
fn kept(numbers: &SystemNumbers) -> Option<&'static SystemNumbers> {
    static KEPT: Mutex<Vec<&'static SystemNumbers>> = Mutex::new(Vec::new());
    let mut kept = KEPT.lock().unwrap_or_else(PoisonError::into_inner);
    // A stated shift has an accuracy that is not a number and is equal to none, so bits are compared.
    let bits = |numbers: &SystemNumbers| {
        let mut plain = *numbers;
        let accuracy = plain.datum.accuracy.to_bits();
        plain.datum.accuracy = 0.0;
        (plain, accuracy)
    };
    let own = bits(numbers);
    if let Some(known) = kept.iter().find(|known| bits(known) == own) {
        return Some(known);
    }
    if kept.len() >= MOST_SYSTEMS {
        return None;
    }
    let new: &'static SystemNumbers = Box::leak(Box::new(*numbers));
    kept.push(new);
    Some(new)
}

/// The system of WGS 84 that is the same, where there is one.
fn simpler(other: &OtherSystem) -> Option<ReferenceSystem> {
    let numbers = other.numbers;
    if numbers.datum.accuracy != 0.0 || numbers.prime_meridian != 0.0 {
        return None;
    }
    let is_near = |a: f64, b: f64| (a - b).abs() < 1e-9 * b.abs().max(1.0);
    match numbers.method {
        ProjectionMethod::Geographic => {
            is_near(numbers.unit.to_degrees(), 1.0).then_some(ReferenceSystem::Geographic)
        }
        ProjectionMethod::TransverseMercator => {
            let zone = (numbers.longitude_0.to_degrees() + 183.0) / 6.0;
            let is_south = numbers.offset[1] > 0.0;
            let is_utm = is_near(zone, zone.round())
                && (1.0..=60.0).contains(&zone.round())
                && is_near(numbers.scale, 0.9996)
                && is_near(numbers.latitude_0, 0.0)
                && is_near(numbers.offset[0], 500_000.0)
                && (numbers.offset[1] == 0.0 || is_near(numbers.offset[1], 1e7))
                && is_near(numbers.unit, 1.0);
            is_utm.then_some(ReferenceSystem::Utm {
                zone: zone.round() as u8,
                is_south,
            })
        }
        _ => None,
    }
}

/// The error names the first number with which no place can be computed.
fn checked(numbers: &SystemNumbers) -> Result<(), String> {
    let Ellipsoid {
        semi_major,
        flattening,
    } = numbers.datum.ellipsoid;
    let latitudes = [
        numbers.latitude_0,
        numbers.parallels[0],
        numbers.parallels[1],
    ];
    let wrong = |what: &str| Err(format!("{what} is missing or impossible"));
    if !(6.3e6..=6.4e6).contains(&semi_major) || !(0.0..=0.01).contains(&flattening) {
        return wrong("the size of its ellipsoid");
    }
    if !latitudes.iter().all(|v| v.abs() <= PI / 2.0 + 1e-12) {
        return wrong("a latitude of its origin or parallels");
    }
    if !(numbers.longitude_0.abs() <= 2.0 * PI && numbers.prime_meridian.abs() <= PI) {
        return wrong("a longitude of its origin");
    }
    if !(0.01..=10.0).contains(&numbers.scale) {
        return wrong("its scale factor");
    }
    if !numbers.offset.iter().all(|v| v.abs() <= 1e9) {
        return wrong("a false easting or northing");
    }
    let unit = numbers.unit;
    if !(unit.is_finite() && unit > 0.0 && unit <= 1e5) {
        return wrong("its unit");
    }
    if !numbers.datum.shift.iter().all(|v| v.abs() <= 1e4) {
        return wrong("its shift to WGS 84");
    }
    let is_cone = matches!(
        numbers.method,
        ProjectionMethod::LambertConformal | ProjectionMethod::Albers
    );
    if is_cone && (numbers.parallels[0] + numbers.parallels[1]).abs() < 1e-6 {
        return wrong("a standard parallel");
    }
    let is_polar = (numbers.latitude_0.abs() - PI / 2.0).abs() < 1e-9;
    if (numbers.method == ProjectionMethod::PolarStereographic) != is_polar
        && matches!(
            numbers.method,
            ProjectionMethod::PolarStereographic
                | ProjectionMethod::ObliqueStereographic
                | ProjectionMethod::SwissOblique
        )
    {
        return wrong("the latitude of its origin");
    }
    Ok(())
}

/// The formulas of these modules.
struct Methods;

impl SystemMethods for Methods {
    fn geodetic(&self, system: &OtherSystem, x: f64, y: f64) -> Option<Geodetic> {
        let numbers = system.numbers;
        let (x, y) = (x * numbers.unit, y * numbers.unit);
        let (latitude, longitude) = if numbers.method == ProjectionMethod::Geographic {
            (y, x)
        } else {
            let (x, y) = (x - numbers.offset[0], y - numbers.offset[1]);
            let (latitude, longitude) = methods::unproject(numbers, x, y)?;
            (latitude, longitude + numbers.longitude_0)
        };
        let is_place = latitude.abs() <= 90.6_f64.to_radians() && longitude.abs() <= 4.0 * PI;
        if !is_place {
            return None;
        }
        let latitude = latitude.clamp(-PI / 2.0, PI / 2.0);
        let place = datums::to_wgs84(&numbers.datum, latitude, longitude + numbers.prime_meridian);
        Some(Geodetic {
            latitude: place.0,
            longitude: place.1,
            height: 0.0,
        })
    }

    fn coordinates(&self, system: &OtherSystem, place: &Geodetic) -> Option<(f64, f64)> {
        let numbers = system.numbers;
        let (latitude, longitude) =
            datums::from_wgs84(&numbers.datum, place.latitude, place.longitude);
        let longitude = longitude - numbers.prime_meridian;
        let (x, y) = if numbers.method == ProjectionMethod::Geographic {
            (wrap_pi(longitude), latitude)
        } else {
            let from_middle = wrap_pi(longitude - numbers.longitude_0);
            let (x, y) = methods::project(numbers, latitude, from_middle)?;
            (x + numbers.offset[0], y + numbers.offset[1])
        };
        let (x, y) = (x / numbers.unit, y / numbers.unit);
        (x.is_finite() && y.is_finite()).then_some((x, y))
    }

    fn name(&self, system: &OtherSystem) -> String {
        if let Some(name) = system.code.and_then(code_table::name) {
            return name;
        }
        let numbers = system.numbers;
        let degrees = |radians: f64| (radians.to_degrees() * 1e6).round() / 1e6;
        let datum = numbers.datum.name;
        match numbers.method {
            ProjectionMethod::Geographic => format!("{datum}, longitude and latitude"),
            method => format!(
                "{datum}, {} around {}°, {}°",
                methods::name(method),
                degrees(numbers.latitude_0),
                degrees(numbers.longitude_0 + numbers.prime_meridian),
            ),
        }
    }

    fn well_known_text(&self, system: &OtherSystem) -> String {
        well_known_text_out::write(system, &self.name(system))
    }
}
