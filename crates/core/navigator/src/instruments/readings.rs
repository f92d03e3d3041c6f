//! Readings of a flight's instruments, cleaned of what cannot be.

use nalgebra::Vector2;

use super::series::Series;
use pilotage_base::frames::wrap_pi;
use pilotage_flight::{Channel, ChannelName, Finding, Flight, Quantity, Severity};

/// Cleaned series of the instruments that dead reckoning needs; SI and radians, times in seconds of the
/// flight's time base as they were logged.
#[derive(Clone, Debug, Default)]
pub struct Readings {
    /// Airspeed, m/s.
    pub airspeed: Series,
    /// Heading, radians clockwise from north, unwrapped.
    pub heading: Series,
    /// Roll, radians, unwrapped.
    pub roll: Series,
    /// Pitch, radians.
    pub pitch: Series,
    /// Turn rates about the nose, the right wing and the belly, rad/s.
    pub rates: [Series; 3],
    /// Specific force along the right wing, m/s².
    pub side_force: Series,
    /// Positions by satellite navigation, metres north and east of the origin.
    pub positions: Series<Vector2<f64>>,
    /// Velocities over ground by satellite navigation, m/s north and east.
    pub velocities: Series<Vector2<f64>>,
    /// Height by air pressure, or else above ground, metres; nothing but whether it flew depends on it.
    pub height: Series,
    /// Whether that is above the ground, so that zero is the ground and not where it began.
    pub is_above_ground: bool,
    /// Wind as the autopilot estimated it: velocity of the air, m/s north and east.
    pub autopilot_wind: Series<Vector2<f64>>,
    /// Whether positions and velocities are the truth of a simulated flight, which comes without delay.
    pub are_true: bool,
    /// Findings on what was turned away, and why.
    pub findings: Vec<Finding>,
}

impl Readings {
    /// Reads and cleans the channels of a flight.
    pub fn of(flight: &Flight) -> Self {
        let mut refused = Vec::new();
        let mut clean = |name| {
            let channel = flight.channel(name)?;
            let (series, left_out) = cleaned(channel);
            refused.extend(left_out);
            Some(series)
        };
        let mut read = |name| clean(name).unwrap_or_default();
        let mut both = |north, east| paired(&read(north), &read(east));
        let positions = both(ChannelName::GpsNorth, ChannelName::GpsEast);
        let velocities = both(ChannelName::GpsVelocityNorth, ChannelName::GpsVelocityEast);
        let autopilot_wind = both(ChannelName::WindNorth, ChannelName::WindEast);
        let rates = [
            ChannelName::RollRate,
            ChannelName::PitchRate,
            ChannelName::YawRate,
        ];
        let mut readings = Self {
            airspeed: read(ChannelName::Airspeed),
            heading: read(ChannelName::Heading),
            roll: read(ChannelName::Roll),
            pitch: read(ChannelName::Pitch),
            rates: rates.map(&mut read),
            side_force: read(ChannelName::AccelerationRight),
            positions,
            velocities,
            height: Series::new(),
            is_above_ground: false,
            autopilot_wind,
            are_true: false,
            findings: Vec::new(),
        };
        readings.height = read(ChannelName::BarometricHeight);
        if readings.height.is_empty() {
            readings.height = read(ChannelName::HeightAboveGround);
            readings.is_above_ground = true;
        }
        readings.findings = left_out_findings(&refused);
        readings.stand_in(flight);
        readings
    }

    /// Lets the truth stand in for satellite navigation, five times a second, where there is none but the
    /// truth is known, as in a simulated flight. Where an autopilot estimated its place, that is what passes for the truth,
    /// and is none to cut or to compare with.
    fn stand_in(&mut self, flight: &Flight) {
        let is_estimated = flight.channel(ChannelName::AutopilotNorth).is_some();
        let stands_in = self.positions.is_empty() && !is_estimated;
        let Some(truth) = flight.truth.as_ref().filter(|_| stands_in) else {
            return;
        };
        let ends = truth.states.first().zip(truth.states.last());
        let Some((first, last)) = ends.filter(|(first, last)| last.time > first.time) else {
            return;
        };
        let count = (5.0 * (last.time - first.time)).floor() as usize;
        let mut earlier: Option<(f64, Vector2<f64>)> = None;
        for i in 0..=count {
            let time = first.time + 0.2 * i as f64;
            let Some(place) = truth.position(time).map(|p| Vector2::new(p.x, p.y)) else {
                continue;
            };
            self.positions.push(time, place);
            if let Some((before, there)) = earlier {
                let middle = 0.5 * (before + time);
                self.velocities
                    .push(middle, (place - there) / (time - before));
            }
            earlier = Some((time, place));
        }
        self.are_true = true;
        self.findings.push(Finding {
            severity: Severity::Note,
            title: "The truth stands in for GPS".to_owned(),
            text:
                "The flight has no satellite navigation, but its truth is known: it is cut instead."
                    .to_owned(),
            span: None,
        });
    }
}

/// Two series as the components of a vector, at the times of the first.
fn paired(north: &Series, east: &Series) -> Series<Vector2<f64>> {
    let mut both = Series::new();
    for (time, north) in north.iter() {
        if let Some(east) = east.at(time) {
            both.push(time, Vector2::new(north, east));
        }
    }
    both
}

/// Largest amount of a quantity that anything that flies could have, in SI.
fn plausible(quantity: Quantity) -> f64 {
    match quantity {
        Quantity::Length => 1e7,
        Quantity::Speed => 1000.0,
        Quantity::Angle => 1e4,
        Quantity::AngularRate => 100.0,
        Quantity::Acceleration => 2000.0,
    }
}

/// Samples of a channel that were left out.
struct LeftOut {
    name: ChannelName,
    samples: usize,
    no_number: usize,
    out_of_order: usize,
}

/// The samples of a channel that can be, angles unwrapped, and what was left out.
fn cleaned(channel: &Channel) -> (Series, Option<LeftOut>) {
    let limit = plausible(channel.name.quantity());
    let samples: Vec<(f64, f64)> = channel
        .times
        .iter()
        .copied()
        .zip(channel.values.iter().copied())
        .collect();
    let is_number =
        |(time, value): &(f64, f64)| time.is_finite() && value.is_finite() && value.abs() <= limit;
    let numbers: Vec<(f64, f64)> = samples.iter().copied().filter(is_number).collect();
    let mut series = Series::new();
    let mut last: Option<f64> = None;
    for (time, value) in in_order(&numbers) {
        let value = match last {
            Some(last) if channel.name.is_angle() => last + wrap_pi(value - last),
            _ => value,
        };
        last = Some(value);
        series.push(time, value);
    }
    let no_number = samples.len() - numbers.len();
    let out_of_order = numbers.len() - series.times().len();
    let left_out = LeftOut {
        name: channel.name,
        samples: samples.len(),
        no_number,
        out_of_order,
    };
    (series, (no_number + out_of_order > 0).then_some(left_out))
}

impl LeftOut {
    fn reasons(&self) -> String {
        let mut reasons = Vec::new();
        if self.out_of_order > 0 {
            reasons.push(format!(
                "the times of {} repeat or go back",
                self.out_of_order
            ));
        }
        if self.no_number > 0 {
            reasons.push(format!(
                "{} are no number or beyond anything that flies",
                self.no_number
            ));
        }
        format!("Of {} samples, {}.", self.samples, reasons.join(" and "))
    }

    fn label(&self) -> String {
        self.name.key().replace('_', " ")
    }
}

/// Note of all channels of which samples were left out.
fn left_out_findings(all: &[LeftOut]) -> Vec<Finding> {
    let share = |l: &LeftOut| (l.no_number + l.out_of_order) as f64 / l.samples.max(1) as f64;
    let severity = if all.iter().any(|l| share(l) > 0.01) {
        Severity::Warning
    } else {
        Severity::Note
    };
    let (title, text) = match all {
        [] => return Vec::new(),
        [one] => (
            format!("Samples of {} were left out", one.label()),
            one.reasons(),
        ),
        [first, others @ ..] => {
            let each = all
                .iter()
                .map(|l| format!("{}: {}", l.label(), l.reasons()));
            let each: Vec<String> = each.collect();
            (
                format!(
                    "Samples of {} and {} more were left out",
                    first.label(),
                    others.len()
                ),
                each.join(" "),
            )
        }
    };
    vec![Finding {
        severity,
        title,
        text,
        span: None,
    }]
}

/// The longest part of the samples whose times increase strictly.
///
/// A few samples with wrong times, however far ahead or back, cost themselves and nothing else, which
/// dropping whatever is not later than the last would not do. Patience sorting, n log n.
fn in_order(samples: &[(f64, f64)]) -> Vec<(f64, f64)> {
    if samples.windows(2).all(|w| w[1].0 > w[0].0) {
        return samples.to_vec();
    }
    // Index of the sample that ends the best part of each length, and what comes before each sample.
    let mut ends: Vec<usize> = Vec::new();
    let mut before: Vec<Option<usize>> = Vec::with_capacity(samples.len());
    for (index, (time, _)) in samples.iter().enumerate() {
        let length = ends.partition_point(|end| samples[*end].0 < *time);
        before.push(length.checked_sub(1).map(|i| ends[i]));
        if length == ends.len() {
            ends.push(index);
        } else if samples[ends[length]].0 > *time {
            ends[length] = index;
        }
    }
    let mut chosen = Vec::with_capacity(ends.len());
    let mut next = ends.last().copied();
    while let Some(index) = next {
        chosen.push(samples[index]);
        next = before[index];
    }
    chosen.reverse();
    chosen
}

#[cfg(test)]
mod tests {
    use super::*;

    fn channel(name: ChannelName, samples: &[(f64, f64)]) -> Channel {
        let (times, values) = samples.iter().copied().unzip();
        Channel {
            name,
            times,
            values,
        }
    }

    #[test]
    fn one_time_far_ahead_costs_one_sample() {
        let samples = [(0.0, 1.0), (1.0, 2.0), (900.0, 3.0), (2.0, 4.0), (3.0, 5.0)];
        let (series, finding) = cleaned(&channel(ChannelName::Airspeed, &samples));
        assert_eq!(series.times(), [0.0, 1.0, 2.0, 3.0]);
        assert_eq!(series.values(), [1.0, 2.0, 4.0, 5.0]);
        assert_eq!(
            finding.unwrap().reasons(),
            "Of 5 samples, the times of 1 repeat or go back."
        );
    }

    #[test]
    fn repeated_times_and_what_is_no_number_are_counted() {
        let samples = [
            (0.0, 1.0),
            (0.0, 1.0),
            (1.0, f64::NAN),
            (2.0, 1e9),
            (3.0, 2.0),
        ];
        let (series, finding) = cleaned(&channel(ChannelName::Airspeed, &samples));
        assert_eq!(series.times(), [0.0, 3.0]);
        let text = finding.unwrap().reasons();
        assert!(text.contains("the times of 1 repeat") && text.contains("2 are no number"));
    }

    #[test]
    fn a_heading_that_wraps_is_unwrapped() {
        let samples = [(0.0, 3.1), (1.0, -3.1), (2.0, -2.9)];
        let (series, finding) = cleaned(&channel(ChannelName::Heading, &samples));
        assert!(finding.is_none());
        let middle = series.at(0.5).unwrap();
        assert!((middle - std::f64::consts::PI).abs() < 1e-9);
    }

    #[test]
    fn a_log_whose_times_repeat_says_so_once() {
        let repeats = [(0.0, 1.0), (0.0, 1.0), (1.0, 1.0)];
        let names = [ChannelName::Airspeed, ChannelName::Roll, ChannelName::Pitch];
        let left_out = names.map(|name| cleaned(&channel(name, &repeats)).1.unwrap());
        let findings = left_out_findings(&left_out);
        assert_eq!(findings.len(), 1);
        assert_eq!(
            findings[0].title,
            "Samples of airspeed and 2 more were left out"
        );
        assert!(left_out_findings(&[]).is_empty());
    }
}
