//! Content of a link: the built-in demo's state and the view of it, as the address' fragment.

use std::fmt::Write as _;

use pilotage_core::frames::GroundPoint;
use pilotage_core::simulate::SimulationChoice;

use crate::command::Workspace;
use pilotage_jobs::SimulationOptions;

/// Key under which the storage keeps what was open before a link was followed.
pub const BEFORE_LINK_KEY: &str = "session before the link";

/// View that a link shows.
#[derive(Clone, Debug, PartialEq)]
pub struct Link {
    /// The flight.
    pub simulation: SimulationOptions,
    /// The workspace.
    pub workspace: Workspace,
    /// Middle of the map.
    pub center: GroundPoint,
    /// Scale of the map, metres per point.
    pub scale: f64,
    /// Direction at the top of the map, radians clockwise from north.
    pub up: f64,
    /// The time cursor, seconds in the flight's time base.
    pub time: f64,
}

impl Link {
    /// As a fragment, without the hash.
    pub fn encode(&self) -> String {
        let s = &self.simulation;
        let mut text = format!(
            "scenario={}&seed={}&day={}",
            s.scenario,
            s.seed,
            if s.other_day { "other" } else { "same" }
        );
        // Writing into a string cannot fail.
        if let Some((from, speed)) = s.wind {
            let _ = write!(text, "&wind={},{speed}", from.to_degrees());
        }
        if let Some(height) = s.height {
            let _ = write!(text, "&height={height}");
        }
        let _ = write!(
            text,
            "&view={}&north={:.2}&east={:.2}&scale={:.4}&up={:.2}&time={:.2}",
            self.workspace.label().to_lowercase(),
            self.center.north,
            self.center.east,
            self.scale,
            self.up.to_degrees(),
            self.time
        );
        text
    }

    /// Decodes a fragment; `None` if it is none of ours or makes no sense.
    ///
    /// ```
    /// use pilotage_ui::link::Link;
    ///
    /// let link = Link::decode("scenario=indoor-hall&seed=7&north=12.5&east=-3&scale=99999&up=180").ok_or("no link")?;
    /// assert_eq!((link.simulation.seed, link.center.north, link.center.east), (7, 12.5, -3.0));
    /// assert_eq!((link.scale, link.up), (1000.0, std::f64::consts::PI));
    /// assert!(Link::decode("scenario=moon&seed=7&north=0&east=0&scale=1").is_none());
    /// # Ok::<(), &str>(())
    /// ```
    pub fn decode(fragment: &str) -> Option<Self> {
        let part = |name: &str| {
            let mut parts = fragment.split('&').filter_map(|part| part.split_once('='));
            parts.find(|(own, _)| *own == name).map(|(_, value)| value)
        };
        let number = |name: &str| -> Option<f64> {
            let value: f64 = part(name)?.parse().ok()?;
            value.is_finite().then_some(value)
        };
        let scenario = part("scenario")?;
        SimulationChoice::named(scenario)?;
        let wind = part("wind").and_then(|value| {
            let (from, speed) = value.split_once(',')?;
            let (from, speed): (f64, f64) = (from.parse().ok()?, speed.parse().ok()?);
            let usual = from.is_finite() && (0.0..=60.0).contains(&speed);
            usual.then_some((from.to_radians(), speed))
        });
        let view = part("view").unwrap_or_default();
        let label = |w: &Workspace| w.label().eq_ignore_ascii_case(view);
        Some(Self {
            simulation: SimulationOptions {
                scenario: scenario.to_owned(),
                seed: part("seed")?.parse().ok()?,
                other_day: part("day") != Some("same"),
                wind,
                height: number("height").filter(|h| (10.0..=5000.0).contains(h)),
            },
            workspace: Workspace::ALL.into_iter().find(label).unwrap_or_default(),
            center: GroundPoint::new(number("north")?, number("east")?),
            scale: number("scale")?.clamp(0.01, 1000.0),
            up: number("up").unwrap_or(0.0).to_radians(),
            time: number("time").unwrap_or(0.0),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn link() -> Link {
        Link {
            simulation: SimulationOptions {
                scenario: SimulationChoice::all()[0].name.to_owned(),
                seed: 7,
                other_day: false,
                wind: Some((0.5, 4.0)),
                height: Some(150.0),
            },
            workspace: Workspace::Plan,
            center: GroundPoint::new(12.5, -340.25),
            scale: 0.75,
            up: 0.0,
            time: 31.4,
        }
    }

    #[test]
    fn a_link_says_what_it_was_made_of() {
        let back = Link::decode(&link().encode()).unwrap();
        let wind = back.simulation.wind.unwrap();
        assert!((wind.0 - 0.5).abs() < 1e-12 && wind.1 == 4.0, "{wind:?}");
        let mut same = back;
        same.simulation.wind = link().simulation.wind;
        assert_eq!(same, link());
    }

    #[test]
    fn what_is_no_link_of_ours_is_left_alone() {
        for fragment in [
            "",
            "top",
            "scenario=moon&seed=1&north=0&east=0&scale=1",
            "scenario=&seed=x",
        ] {
            assert_eq!(Link::decode(fragment), None, "{fragment}");
        }
        let odd = link().encode().replace("scale=0.7500", "scale=NaN");
        assert_eq!(Link::decode(&odd), None);
    }
}
