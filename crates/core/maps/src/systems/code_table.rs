//! The table of EPSG codes: longitude and latitude of other datums by their own table, projected systems by
//! `codes.txt`.

use std::f64::consts::FRAC_PI_2;

use pilotage_base::frames::{Datum, ProjectionMethod, SystemNumbers};

use super::{datums, methods, units};

/// The table; its first lines say how it is written.
const TABLE: &str = include_str!("codes.txt");

/// A code's line of the table.
struct CodeRow {
    /// Number of codes of its family before this one.
    step: u32,
    /// EPSG code of the datum's longitude and latitude.
    datum: u32,
    /// Metres in the unit of the coordinates, and what the name says of it.
    unit: (f64, &'static str),
    name: &'static str,
    projection: &'static str,
}

/// Numbers of the system with that code.
pub(super) fn numbers(code: u32) -> Option<SystemNumbers> {
    match row(code) {
        Some(row) => row.numbers(),
        None => geographic(code),
    }
}

/// Name for people of the system with that code.
pub(super) fn name(code: u32) -> Option<String> {
    match row(code) {
        Some(row) => row.name(),
        None => {
            datums::by_code(code).map(|datum| format!("{}, longitude and latitude", datum.name))
        }
    }
}

/// Longitude and latitude of another datum.
fn geographic(code: u32) -> Option<SystemNumbers> {
    let datum = datums::by_code(code)?;
    let mut numbers = plain_numbers(datum, ProjectionMethod::Geographic);
    if code == 4807 {
        numbers.prime_meridian = PARIS;
        numbers.unit = std::f64::consts::PI / 200.0;
    }
    Some(numbers)
}

/// Longitude of the Paris meridian, radians.
const PARIS: f64 = 2.337_229_166_666_667 * std::f64::consts::PI / 180.0;

/// Numbers of a projection without any of its own, in metres or degrees.
pub(super) fn plain_numbers(datum: Datum, method: ProjectionMethod) -> SystemNumbers {
    SystemNumbers {
        datum,
        method,
        prime_meridian: 0.0,
        latitude_0: 0.0,
        longitude_0: 0.0,
        parallels: [0.0; 2],
        scale: 1.0,
        offset: [0.0; 2],
        unit: if method == ProjectionMethod::Geographic {
            1.0_f64.to_radians()
        } else {
            1.0
        },
    }
}

/// Codes, name and projection of every line.
pub(super) fn rows() -> impl Iterator<Item = (&'static str, &'static str, &'static str)> {
    let lines = TABLE.lines().filter(|line| !line.starts_with('#'));
    lines.filter_map(|line| {
        let mut parts = line.split('|');
        Some((parts.next()?, parts.next()?, parts.next()?))
    })
}

/// First and last code, code of the datum, and letter of the unit.
pub(super) fn codes_of(codes: &'static str) -> impl Iterator<Item = (u32, u32, u32, &'static str)> {
    codes.split(' ').filter_map(|entry| {
        let (range, datum) = entry.split_once(':')?;
        let (first, last) = range.split_once('-').unwrap_or((range, range));
        let digits = datum.trim_end_matches(|c: char| c.is_ascii_alphabetic());
        Some((
            first.parse().ok()?,
            last.parse().ok()?,
            digits.parse().ok()?,
            &datum[digits.len()..],
        ))
    })
}

pub(super) fn unit_of(letter: &str) -> (f64, &'static str) {
    match letter {
        "s" => (units::SURVEY_FOOT, " (ftUS)"),
        "f" => (units::FOOT, " (ft)"),
        _ => (1.0, ""),
    }
}

fn row(code: u32) -> Option<CodeRow> {
    rows().find_map(|(codes, name, projection)| {
        let (first, _, datum, unit) =
            codes_of(codes).find(|(first, last, ..)| (*first..=*last).contains(&code))?;
        Some(CodeRow {
            step: code - first,
            datum,
            unit: unit_of(unit),
            name,
            projection,
        })
    })
}

impl CodeRow {
    fn name(&self) -> Option<String> {
        let datum = datums::by_code(self.datum)?.name;
        let rest = stepped(self.name, self.step)?;
        Some(format!("{datum} / {rest}{}", self.unit.1))
    }

    fn numbers(&self) -> Option<SystemNumbers> {
        let mut words = self.projection.split_whitespace();
        let method = match words.next()? {
            "tmerc" => ProjectionMethod::TransverseMercator,
            "merc" => ProjectionMethod::Mercator,
            "lcc" => ProjectionMethod::LambertConformal,
            "aea" => ProjectionMethod::Albers,
            "laea" => ProjectionMethod::LambertAzimuthal,
            "stere" => ProjectionMethod::PolarStereographic,
            "sterea" => ProjectionMethod::ObliqueStereographic,
            "somerc" => ProjectionMethod::SwissOblique,
            "krovak" => ProjectionMethod::Krovak,
            _ => return None,
        };
        let mut numbers = plain_numbers(datums::by_code(self.datum)?, method);
        numbers.unit = self.unit.0;
        if self.datum == 4807 {
            numbers.prime_meridian = PARIS;
        }
        let mut parallels = [None; 2];
        let mut true_scale = None;
        for (key, value) in words.filter_map(|word| word.split_once('=')) {
            let value = self.value(value)?;
            match key {
                "lat_0" => numbers.latitude_0 = value.to_radians(),
                "lon_0" => numbers.longitude_0 = value.to_radians(),
                "lat_1" => parallels[0] = Some(value.to_radians()),
                "lat_2" => parallels[1] = Some(value.to_radians()),
                "lat_ts" => true_scale = Some(value.to_radians()),
                "k" => numbers.scale = value,
                "x_0" => numbers.offset[0] = value,
                "y_0" => numbers.offset[1] = value,
                _ => return None,
            }
        }
        numbers.parallels = parallels.map(|parallel| parallel.unwrap_or(numbers.latitude_0));
        if let Some(parallel) = true_scale {
            numbers.scale = methods::scale_for(&numbers, parallel);
        }
        // Exactly at the pole.
        if method == ProjectionMethod::PolarStereographic {
            numbers.latitude_0 = FRAC_PI_2.copysign(numbers.latitude_0);
        }
        Some(numbers)
    }

    /// A number of the table, for this code of its family.
    fn value(&self, text: &str) -> Option<f64> {
        let sign = text
            .char_indices()
            .skip(1)
            .find(|(_, c)| matches!(c, '+' | '-'));
        let (first, step) = text.split_at(sign.map_or(text.len(), |(at, _)| at));
        let first: f64 = first.parse().ok()?;
        if step.is_empty() {
            return Some(first);
        }
        let step: f64 = step.parse().ok()?;
        Some(first + f64::from(self.step) * step)
    }
}

/// A name with the number in braces brought to that code of its family.
pub(super) fn stepped(name: &str, step: u32) -> Option<String> {
    let Some((before, rest)) = name.split_once('{') else {
        return Some(name.to_owned());
    };
    let (number, after) = rest.split_once('}')?;
    let (first, by) = number.split_once('+').unwrap_or((number, "1"));
    let (first, by): (u32, u32) = (first.parse().ok()?, by.parse().ok()?);
    Some(format!("{before}{}{after}", first + by * step))
}

/// Every code.
pub(super) fn all() -> Vec<u32> {
    let projected = rows()
        .flat_map(|(codes, ..)| codes_of(codes))
        .flat_map(|(first, last, ..)| first..=last);
    projected
        .chain(
            datums::DATUMS
                .iter()
                .map(|known| known.code)
                .filter(|code| *code > 0),
        )
        .collect()
}
