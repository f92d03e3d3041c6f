//! A flight at a glance: when it flew, what measured, what looks wrong, and what can be done with it.

mod ability;
mod air_data;
mod airborne;
mod causes;
mod glitch;
mod reading;
mod sensor;
mod states;
#[cfg(test)]
mod tests;

use pilotage_base::sorting::sort;
use serde::{Deserialize, Serialize};

pub use ability::Ability;
pub use air_data::{AirDataFit, fit_air_data};
pub use airborne::airborne;
pub use pilotage_flight::{Finding, Severity};
pub use sensor::{SampleGap, Sensor};
pub use states::modes;

use super::interpret::{MeasuredSeries, Role};
use super::log::Log;
use pilotage_base::text::capitalised;

/// A flight at a glance.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Overview {
    /// First and last time of the log, seconds in its time base.
    pub span: (f64, f64),
    /// Stretches in the air, seconds.
    pub airborne: Vec<(f64, f64)>,
    /// Distance over ground while in the air, metres.
    pub distance: f64,
    /// Least and greatest height above the start, metres, where known.
    pub heights: Option<(f64, f64)>,
    /// Greatest speed over ground, m/s, where known.
    pub greatest_speed: Option<f64>,
    /// Sensors of the flight, by role.
    pub sensors: Vec<Sensor>,
    /// Fit of airspeed, heading and the track, where all three are known.
    pub air_data: Option<AirDataFit>,
    /// Findings that look wrong, the worst first.
    pub findings: Vec<Finding>,
    /// Uses of the flight: those that are possible, and those that are not and why.
    pub abilities: Vec<Ability>,
}

impl Overview {
    /// Takes into account that the flight has so many pictures.
    pub fn add_pictures(&mut self, count: usize) {
        self.abilities.retain(|it| !ability::rests_on_pictures(it));
        let is_placed = !self.abilities.iter().any(ability::lacks_track);
        self.abilities
            .extend(ability::of_pictures(count, is_placed));
    }

    /// Tells what was assumed of the photos beside the log, or why they were left out.
    pub fn note_photos(&mut self, notes: &[String]) {
        let finding = |note: &String| Finding {
            severity: Severity::Note,
            title: "Photos beside the log".to_owned(),
            text: format!("{}.", capitalised(note)),
            span: None,
        };
        self.findings.extend(notes.iter().map(finding));
    }
}

/// Looks over a log and what was measured in it; of pictures nothing is known yet.
pub fn overview(log: &Log, measured: &MeasuredSeries<'_>) -> Overview {
    let found = measured.found;
    let of = |role| found.iter().find(|s| s.role == role);
    let span = log.span().unwrap_or((0.0, 0.0));
    // What the autopilot says of itself outweighs what speeds and heights look like.
    let said = states::airborne(log);
    let is_said = said.is_some();
    let airborne = said.unwrap_or_else(|| airborne(found));
    // What the autopilot estimates is told as such, and no second time as a receiver's.
    let measured_here = found.iter().filter(|series| !series.stands_in(found));
    let sensors: Vec<Sensor> = measured_here.map(Sensor::of).collect();
    let air_data = fit_air_data(found, &airborne);
    let speed = of(Role::GpsVelocityNorth).zip(of(Role::GpsVelocityEast));
    let greatest_speed = speed.map(|(north, east)| {
        let both = north.values.iter().zip(&east.values);
        both.map(|(n, e)| n.hypot(*e)).fold(0.0, f64::max)
    });
    let states = measured.track;
    let heights = [
        Role::GpsHeight,
        Role::BarometricHeight,
        Role::HeightAboveGround,
    ];
    let has_height = heights.into_iter().any(|role| of(role).is_some());
    let heights = states.iter().map(|s| -s.position.z);
    let heights = heights.map(|height| (height, height));
    let heights = heights.reduce(|a, b| (a.0.min(b.0), a.1.max(b.1)));
    let is_up = |time: f64| airborne.iter().any(|(a, b)| (*a..=*b).contains(&time));
    let steps = states.windows(2).filter(|w| is_up(w[1].time));
    let distance = steps
        .map(|w| (w[1].position - w[0].position).xy().norm())
        .fold(0.0, |sum, step| sum + step);
    let mut findings = reading::of_reading(log, found);
    findings.extend(states::several(log, &airborne, |pause| {
        is_said || states::is_watched(found, pause)
    }));
    findings.extend(causes::findings(&sensors, &airborne));
    findings.extend(glitch::findings(found, states));
    findings.extend(air_data.iter().flat_map(AirDataFit::findings));
    sort(&mut findings, &|a, b| b.severity.cmp(&a.severity));
    Overview {
        span,
        distance,
        heights: heights.filter(|_| has_height),
        greatest_speed,
        abilities: ability::abilities(measured, air_data.as_ref()),
        sensors,
        air_data,
        findings,
        airborne,
    }
}
