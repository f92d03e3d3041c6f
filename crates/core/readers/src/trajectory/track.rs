//! A trajectory with its name, its clock and its place on the globe.

use nalgebra::Point3;
use serde::{Deserialize, Serialize};

use super::super::interpret::{Role, RoleSeries};
use super::super::overview::airborne;
use super::TimedPlace;
use pilotage_base::frames::LocalFrame;
use pilotage_flight::Flight;

/// Shortest time over which a speed is taken from places, seconds: shorter ones show their noise.
const SPEED_OVER: f64 = 1.0;

/// Places over time.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Trajectory {
    /// Name for people.
    pub name: String,
    /// The world frame on the globe, where known.
    pub frame: Option<LocalFrame>,
    /// Seconds since 1970 (UTC) at time zero, where known.
    pub utc_at_zero: Option<f64>,
    /// Whether the down coordinates mean anything; a filter of the ground plane has none.
    pub has_height: bool,
    /// Places in order of time.
    pub places: Vec<TimedPlace>,
}

impl Trajectory {
    /// True track of a flight, where that is known.
    pub fn of_truth(flight: &Flight) -> Option<Self> {
        let truth = flight.truth.as_ref().filter(|t| !t.states.is_empty())?;
        let places = truth.states.iter().map(|state| TimedPlace {
            time: state.time,
            place: state.position,
        });
        Some(Self {
            name: flight.name.clone(),
            frame: flight.frame_on_globe,
            utc_at_zero: None,
            has_height: true,
            places: places.collect(),
        })
    }

    /// Places on the ground: time (seconds), north and east (metres).
    pub fn on_the_ground(
        name: String,
        frame: Option<LocalFrame>,
        places: impl IntoIterator<Item = (f64, f64, f64)>,
    ) -> Self {
        let places = places.into_iter().map(|(time, north, east)| TimedPlace {
            time,
            place: Point3::new(north, east, 0.0),
        });
        Self {
            name,
            frame,
            utc_at_zero: None,
            has_height: false,
            places: places.collect(),
        }
    }

    /// First and last time, seconds.
    pub fn span(&self) -> Option<(f64, f64)> {
        Some((self.places.first()?.time, self.places.last()?.time))
    }

    /// The same places in the world frame `frame`; as they are where either frame is not on the globe.
    #[must_use]
    pub fn in_frame(&self, frame: Option<LocalFrame>) -> Self {
        let mut moved = self.clone();
        if let (Some(from), Some(to)) = (self.frame, frame)
            && from != to
        {
            let carry = to.world_from_other_world(&from);
            for place in &mut moved.places {
                place.place = carry * place.place;
            }
            moved.frame = frame;
        }
        moved
    }

    /// The same with every time later by `seconds`.
    #[must_use]
    pub fn later(&self, seconds: f64) -> Self {
        let mut moved = self.clone();
        for place in &mut moved.places {
            place.time += seconds;
        }
        moved.utc_at_zero = self.utc_at_zero.map(|utc| utc - seconds);
        moved
    }

    /// When it took off: the beginning of the first stretch in the air, seconds.
    pub fn take_off(&self) -> Option<f64> {
        let series = |role, times: &[f64], values: Vec<f64>| RoleSeries {
            role,
            source: String::new(),
            times: times.to_vec(),
            values,
            implausible: 0,
            out_of_order: 0,
            is_held: false,
        };
        let (mut times, mut norths, mut easts) = (Vec::new(), Vec::new(), Vec::new());
        let mut end = 0;
        for (i, begin) in self.places.iter().enumerate() {
            let reached = |p: &TimedPlace| p.time - begin.time >= SPEED_OVER;
            end = end.max(i);
            while self.places.get(end).is_some_and(|p| !reached(p)) {
                end += 1;
            }
            let Some(last) = self.places.get(end) else {
                break;
            };
            let velocity = (last.place - begin.place) / (last.time - begin.time);
            times.push(begin.time);
            norths.push(velocity.x);
            easts.push(velocity.y);
        }
        let mut found = vec![
            series(Role::GpsVelocityNorth, &times, norths),
            series(Role::GpsVelocityEast, &times, easts),
        ];
        if self.has_height && !self.places.is_empty() {
            let all: Vec<f64> = self.places.iter().map(|p| p.time).collect();
            let heights = self.places.iter().map(|p| -p.place.z).collect();
            found.push(series(Role::BarometricHeight, &all, heights));
        }
        airborne(&found).first().map(|stretch| stretch.0)
    }
}

#[cfg(test)]
mod tests {
    use super::super::place_at;
    use super::*;
    use pilotage_base::frames::Geodetic;

    /// Stands for 20 s, then runs north at 15 m/s.
    fn departing() -> Trajectory {
        let places = (0..600).map(|i| {
            let time = 0.1 * f64::from(i);
            (time, 15.0 * (time - 20.0).max(0.0), 0.0)
        });
        Trajectory::on_the_ground("departing".into(), None, places)
    }

    #[test]
    fn it_takes_off_when_it_begins_to_move() {
        let found = departing().take_off().unwrap();
        assert!((found - 20.0).abs() < 1.0, "{found}");
        let standing =
            Trajectory::on_the_ground("s".into(), None, (0..99).map(|i| (i.into(), 0.0, 0.0)));
        assert_eq!(standing.take_off(), None);
        assert_eq!(
            Trajectory::on_the_ground("none".into(), None, []).take_off(),
            None
        );
    }

    #[test]
    fn another_origin_moves_the_places_and_not_the_flight() {
        let frame = |longitude| LocalFrame::new(Geodetic::from_degrees(47.0, longitude, 400.0));
        let mut track = departing();
        track.frame = Some(frame(8.0));
        let there = track.in_frame(Some(frame(8.01)));
        let away = there.places[0].place.y;
        assert!((away + 760.6).abs() < 0.5, "{away}");
        for (before, after) in track.places.iter().zip(&there.places) {
            let through = frame(8.0).geodetic_from_world(&before.place);
            let through = frame(8.01).world_from_geodetic(&through);
            assert!((through - after.place).norm() < 1e-6);
        }
        let back = there.in_frame(track.frame);
        for (before, after) in track.places.iter().zip(&back.places) {
            assert!((before.place - after.place).norm() < 1e-6);
        }
    }

    #[test]
    fn between_two_places_it_is_between_them() {
        let track = departing();
        let at = |time| place_at(&track.places, time, f64::INFINITY);
        assert_eq!(at(30.05).unwrap().x.round(), 151.0);
        assert_eq!(at(-1.0), None);
        assert_eq!(at(99.0), None);
    }
}
