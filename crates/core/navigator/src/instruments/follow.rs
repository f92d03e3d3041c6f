//! A filter led through the measurements of a flight in the order in which they were true.

use nalgebra::{Matrix2, Vector2};
use serde::{Deserialize, Serialize};

use super::models::Airplane;
use super::outlook::Outlook;
use super::readings::Readings;
use super::walker::{AirInputs, Walker};
use pilotage_base::frames::GroundPoint;
use pilotage_estimation::filter::FilterError;

/// A position from elsewhere than satellite navigation, such as a landmark that was seen.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct PositionFix {
    /// When the vehicle was there, seconds in the flight's time base.
    pub time: f64,
    /// Position of the vehicle.
    pub position: GroundPoint,
    /// Covariance (north, east), m².
    pub covariance: Matrix2<f64>,
}

/// Event that a filter meets on its way.
#[derive(Clone, Copy, Debug)]
pub(super) enum FilterEvent {
    Position(Vector2<f64>),
    Velocity(Vector2<f64>),
    Fix(PositionFix),
    /// Satellite navigation is lost, with what is known by then.
    Outage(Option<Outlook>),
    /// Somebody wants to know.
    Report,
}

/// Events with their true times, in order: what satellite navigation stamped with t was true `delay` seconds
/// before.
#[derive(Clone, Debug, Default)]
pub(super) struct FilterEvents(Vec<(f64, FilterEvent)>);

impl FilterEvents {
    /// Positions and velocities with stamps after `from` and up to `to`.
    pub(super) fn gps(mut self, readings: &Readings, (from, to): (f64, f64), delay: f64) -> Self {
        let positions = readings.positions.between(from, to);
        self.0
            .extend(positions.map(|(stamp, p)| (stamp - delay, FilterEvent::Position(p))));
        let velocities = readings.velocities.between(from, to);
        self.0
            .extend(velocities.map(|(stamp, v)| (stamp - delay, FilterEvent::Velocity(v))));
        self
    }

    /// Fixes after `from` and up to `to`.
    pub(super) fn fixes(mut self, fixes: &[PositionFix], (from, to): (f64, f64)) -> Self {
        let inside = fixes.iter().filter(|f| f.time > from && f.time <= to);
        self.0
            .extend(inside.map(|f| (f.time, FilterEvent::Fix(*f))));
        self
    }

    /// An outage that begins at `time`, with what is known by then.
    pub(super) fn outage(mut self, time: f64, outlook: Option<Outlook>) -> Self {
        self.0.push((time, FilterEvent::Outage(outlook)));
        self
    }

    /// Reports at these times.
    pub(super) fn reports(mut self, times: impl IntoIterator<Item = f64>) -> Self {
        self.0
            .extend(times.into_iter().map(|time| (time, FilterEvent::Report)));
        self
    }

    /// Leads `walker` through all of them; `report` is told the walker at every report, after whatever was
    /// measured at that time.
    pub(super) fn lead<const N: usize, V: Airplane<N>>(
        mut self,
        walker: &mut Walker<N, V>,
        inputs: &AirInputs<'_>,
        mut report: impl FnMut(&Walker<N, V>),
    ) -> Result<(), FilterError> {
        let rank = |event: &FilterEvent| match event {
            FilterEvent::Report => 2,
            FilterEvent::Outage(_) => 1,
            _ => 0,
        };
        self.0
            .sort_by(|a, b| a.0.total_cmp(&b.0).then(rank(&a.1).cmp(&rank(&b.1))));
        for (time, event) in self.0 {
            walker.advance(inputs, time)?;
            match event {
                FilterEvent::Position(place) => walker.take_position(place)?,
                FilterEvent::Velocity(velocity) => walker.take_velocity(inputs, velocity)?,
                FilterEvent::Fix(fix) => {
                    let place = Vector2::new(fix.position.north, fix.position.east);
                    walker.take_fix(place, &fix.covariance)?;
                }
                FilterEvent::Outage(outlook) => walker.lose_gps(outlook.as_ref())?,
                FilterEvent::Report => report(walker),
            }
        }
        Ok(())
    }
}
