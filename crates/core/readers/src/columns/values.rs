//! Unit of a column by its values.

use super::{ColumnRole, ColumnSample};
use crate::cells::SEMICIRCLES;
use pilotage_flight::Quantity;

/// Standard gravity, m/s².
const GRAVITY: f64 = 9.806_65;

/// Names that the places of an activity of Garmin have in the profile of FIT, and with their message before.
const OF_FIT: [&str; 4] = [
    "position_lat",
    "position_long",
    "record.position_lat",
    "record.position_long",
];

/// A unit that values suggest: which, how surely, and why in words.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct UnitGuess {
    pub unit: &'static str,
    pub confidence: f64,
    pub reason: String,
}

fn guess(unit: &'static str, confidence: f64, reason: impl Into<String>) -> UnitGuess {
    UnitGuess {
        unit,
        confidence,
        reason: reason.into(),
    }
}

/// The unit of a column of that role for which none is stated. `has_degrees` says whether another angle of the table
/// is surely in degrees, or surely in radians.
pub(super) fn unit(
    role: ColumnRole,
    sample: &ColumnSample,
    has_degrees: Option<bool>,
) -> Option<UnitGuess> {
    let quantity = role.quantity()?;
    let reach = sample.reach();
    Some(match (role, quantity) {
        (ColumnRole::Latitude | ColumnRole::Longitude, _) => place(role, sample),
        (_, Quantity::Angle) => angle(sample, has_degrees),
        (_, Quantity::AngularRate) if reach > 35.0 => guess(
            "deg/s",
            0.9,
            format!("values reach {reach:.0}: nothing turns as fast in radians"),
        ),
        (_, Quantity::AngularRate) => match has_degrees {
            Some(true) if reach > 6.0 => guess("deg/s", 0.6, "angles are in degrees, too"),
            _ => guess("rad/s", 0.7, format!("values reach {reach:.1} only")),
        },
        (_, Quantity::Acceleration) => acceleration(sample),
        (_, Quantity::Speed) if reach > 1000.0 => {
            guess("cm/s", 0.7, format!("values reach {reach:.0}"))
        }
        (_, Quantity::Speed) => guess("m/s", 0.7, "no unit is stated"),
        (_, Quantity::Length) if reach > 40_000.0 && sample.is_whole() => {
            guess("mm", 0.6, format!("whole values reach {reach:.0}"))
        }
        (_, Quantity::Length) => guess("m", 0.8, "no unit is stated"),
    })
}

fn place(role: ColumnRole, sample: &ColumnSample) -> UnitGuess {
    let reach = sample.reach();
    let most = if role == ColumnRole::Latitude {
        90.0
    } else {
        360.0
    };
    if reach > most && sample.is_whole() && OF_FIT.contains(&sample.name.as_str()) {
        return guess(
            SEMICIRCLES,
            0.95,
            "whole numbers called so are semicircles of FIT, of which 2^31 are half a turn",
        );
    }
    if reach > 1.01e7 * most && role == ColumnRole::Latitude || reach > 3.7e9 {
        return guess(
            "deg1e8",
            0.95,
            format!("values reach {reach:.0}: degrees, a hundred million times"),
        );
    }
    if reach > most {
        return guess(
            "deg1e7",
            0.95,
            format!("values reach {reach:.0}: degrees, ten million times"),
        );
    }
    // Radians have all their digits behind the point and reach no further than half a turn.
    let most_radians = if role == ColumnRole::Latitude {
        std::f64::consts::FRAC_PI_2 + 0.001
    } else {
        std::f64::consts::PI + 0.001
    };
    if reach <= most_radians && reach > 0.0 {
        return guess("rad", 0.6, format!("values reach {reach:.3} only"));
    }
    guess("deg", 0.95, format!("values reach {reach:.1}"))
}

fn angle(sample: &ColumnSample, has_degrees: Option<bool>) -> UnitGuess {
    let reach = sample.reach();
    if reach > 3600.0 && sample.is_whole() {
        return guess("cdeg", 0.8, format!("whole values reach {reach:.0}"));
    }
    if reach > std::f64::consts::TAU + 0.01 {
        return guess(
            "deg",
            0.95,
            format!("values reach {reach:.0}: more than a turn in radians"),
        );
    }
    match has_degrees {
        Some(true) => guess("deg", 0.8, "another angle is in degrees"),
        Some(false) => guess("rad", 0.8, "another angle is in radians"),
        None => guess("rad", 0.6, format!("values reach {reach:.2} only")),
    }
}

fn acceleration(sample: &ColumnSample) -> UnitGuess {
    let median = sample.median().unwrap_or(0.0).abs();
    let reach = sample.reach();
    if (700.0..1300.0).contains(&median) || reach > 300.0 {
        return guess(
            "mg",
            0.8,
            format!("values lie about {median:.0} and reach {reach:.0}"),
        );
    }
    if (0.7..1.3).contains(&median) && reach < 5.0 || reach < 2.0 && reach > 0.0 {
        return guess(
            "g",
            0.6,
            format!("values lie about {median:.2} and reach {reach:.1}"),
        );
    }
    if (0.7 * GRAVITY..1.3 * GRAVITY).contains(&median) {
        return guess(
            "m/s2",
            0.95,
            format!("values lie about {median:.1}, as gravity does"),
        );
    }
    guess("m/s2", 0.7, "no unit is stated")
}

/// Whether a column is surely in degrees, or surely in radians, by its values.
pub(super) fn are_degrees(sample: &ColumnSample) -> Option<bool> {
    let reach = sample.reach();
    if reach > std::f64::consts::TAU + 0.01 {
        return Some(true);
    }
    // A heading that goes once round.
    let (low, high) = sample.range()?;
    (high - low > 4.0).then_some(false)
}
