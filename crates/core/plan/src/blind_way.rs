//! Distance that an aircraft has come without a fix, along a way over the field of localizability.
//!
//! The uncertainty of the position grows with the way since the last fix, and a fix takes it back. Let u
//! be the root mean square, over all ways in which detections may turn out, of the metres flown since
//! the last fix. Over ds metres without any it grows by ds; a pass of length L over ground where a fix
//! is had with probability P leaves √(1-P) of it, so that a piece of ds leaves (1-P)^(ds/2L). Every
//! piece maps u to an affine function of it, and so does every way: it is sampled once and then holds
//! for any u with which it is begun.
//!
//! Before the first fix nobody knows the wind, and the uncertainty grows faster by a ratio k. What is left
//! of that, 1 at the start, is taken back by a pass like u itself; u is linear in it, too.

use nalgebra::Vector2;

use super::field::Localizability;
use pilotage_base::frames::GroundPoint;

/// Probability at which a place no longer counts as blind.
const LIT: f64 = 0.02;
/// Greatest probability that is believed.
const SUREST: f64 = 0.99;

/// Uncertainty of the position and of what moves the aircraft.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Unsure {
    /// Metres without a fix.
    pub metres: f64,
    /// Share of the start's ignorance of the wind that is left, 0 to 1.
    pub wind: f64,
}

impl Unsure {
    /// At the start of a route.
    pub const START: Self = Self {
        metres: 0.0,
        wind: 1.0,
    };
}

/// An affine function of what one is unsure of at the beginning.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Affine {
    pub factor: f64,
    pub of_wind: f64,
    pub offset: f64,
}

impl Affine {
    pub fn of(&self, unsure: Unsure) -> f64 {
        self.factor * unsure.metres + self.of_wind * unsure.wind + self.offset
    }
}

/// Effect of a straight way on the metres without a fix.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct BlindWay {
    /// Its length, metres.
    pub length: f64,
    /// Duration of the way, seconds.
    pub time: f64,
    /// Metres without a fix at its end.
    pub end: Affine,
    /// Share of the ignorance of the wind that is left at its end.
    pub wind_kept: f64,
    /// Its values where it may be greatest.
    pub peaks: Vec<Affine>,
    /// Its integral over the way, m².
    pub integral: Affine,
}

impl BlindWay {
    /// Greatest metres without a fix on the way, begun with `unsure`.
    pub fn worst(&self, unsure: Unsure) -> f64 {
        let peaks = self.peaks.iter().map(|p| p.of(unsure));
        peaks.fold(unsure.metres, f64::max)
    }

    /// Uncertainty at the end of the way.
    pub fn after(&self, unsure: Unsure) -> Unsure {
        Unsure {
            metres: self.end.of(unsure),
            wind: self.wind_kept * unsure.wind,
        }
    }
}

/// Airspeed and wind, which give the speed over ground.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Pace {
    /// Airspeed, m/s.
    pub airspeed: f64,
    /// Velocity of the air (north, east), m/s.
    pub wind: Vector2<f64>,
}

impl Pace {
    /// Speed over the ground along `way`; `None` where the wind is too strong to keep to it.
    pub fn over_ground(&self, way: &Vector2<f64>) -> Option<f64> {
        let along = way.try_normalize(1e-9)?;
        let across = along.perp(&self.wind);
        let ahead = (self.airspeed.powi(2) - across.powi(2)).max(0.0).sqrt();
        let speed = ahead + along.dot(&self.wind);
        (speed > 0.5).then_some(speed)
    }
}

/// Inputs for following a way over the field.
#[derive(Clone, Copy)]
pub(super) struct BlindWayField<'a> {
    pub field: &'a Localizability,
    /// Length of a pass over a source: the shorter side of the picture on the ground, metres.
    pub pass: f64,
    pub pace: Pace,
    /// Factor by which the uncertainty grows faster before the first fix.
    pub before_first_fix: f64,
}

impl BlindWayField<'_> {
    /// Duration of the straight way from `a` to `b`, seconds; `None` where the wind does not allow it.
    pub fn time(&self, a: &GroundPoint, b: &GroundPoint) -> Option<f64> {
        let way = b.to_vector() - a.to_vector();
        let length = way.norm();
        if length < 1e-9 {
            return Some(0.0);
        }
        Some(length / self.pace.over_ground(&way)?)
    }

    /// Follows the straight way from `a` to `b`; `None` where the wind does not allow it.
    pub fn follow(&self, a: &GroundPoint, b: &GroundPoint) -> Option<BlindWay> {
        let way = b.to_vector() - a.to_vector();
        let length = way.norm();
        let mut end = Affine {
            factor: 1.0,
            ..Affine::default()
        };
        let mut integral = Affine::default();
        let mut wind_kept = 1.0;
        let mut peaks = Vec::new();
        if length < 1e-9 {
            return Some(BlindWay {
                length,
                time: 0.0,
                end,
                wind_kept,
                peaks,
                integral,
            });
        }
        let time = self.time(a, b)?;
        let pieces = (length / (0.25 * self.pass)).ceil().max(1.0);
        let ds = length / pieces;
        let mut lit = false;
        for piece in 0..pieces as usize {
            let place = GroundPoint::from(a.to_vector() + way * ((piece as f64 + 0.5) / pieces));
            let p = self.field.at(&place).unwrap_or(0.0).min(SUREST);
            if p >= LIT && !lit {
                peaks.push(end);
            }
            lit = p >= LIT;
            let grown = Affine {
                of_wind: end.of_wind + ds * (self.before_first_fix - 1.0) * wind_kept,
                offset: end.offset + ds,
                ..end
            };
            // Trapezoid of the growth.
            integral.factor += ds * end.factor;
            integral.of_wind += ds * 0.5 * (end.of_wind + grown.of_wind);
            integral.offset += ds * 0.5 * (end.offset + grown.offset);
            let kept = (1.0 - p).powf(0.5 * ds / self.pass);
            wind_kept *= kept;
            end = Affine {
                factor: grown.factor * kept,
                of_wind: grown.of_wind * kept,
                offset: grown.offset * kept,
            };
        }
        peaks.push(end);
        Some(BlindWay {
            length,
            time,
            end,
            wind_kept,
            peaks,
            integral,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use pilotage_base::frames::GroundRect;

    fn field(lit: impl Fn(&GroundPoint) -> f64) -> Localizability {
        let region = GroundRect::centered(GroundPoint::new(500.0, 0.0), 2000.0, 2000.0);
        let mut field = Localizability::unknown(&region, 20.0);
        for row in 0..field.rows {
            for column in 0..field.columns {
                let value = lit(&field.place(column, row)) as f32;
                field.values[row * field.columns + column] = value;
            }
        }
        field
    }

    fn ground(field: &Localizability) -> BlindWayField<'_> {
        BlindWayField {
            field,
            pass: 100.0,
            pace: Pace {
                airspeed: 20.0,
                wind: Vector2::zeros(),
            },
            before_first_fix: 5.0,
        }
    }

    /// So many metres in a wind that is known.
    fn metres(metres: f64) -> Unsure {
        Unsure { metres, wind: 0.0 }
    }

    #[test]
    fn before_the_first_fix_the_uncertainty_grows_faster_and_a_fix_ends_that() {
        let field = field(|p| f64::from(u8::from((400.0..600.0).contains(&p.north))) * 0.96);
        let follow = |from: f64, to: f64| {
            let (from, to) = (GroundPoint::new(from, 0.0), GroundPoint::new(to, 0.0));
            ground(&field).follow(&from, &to).unwrap()
        };
        let first = follow(0.0, 390.0);
        assert!((first.after(Unsure::START).metres - 5.0 * 390.0).abs() < 1e-6);
        assert_eq!(first.after(Unsure::START).wind, 1.0);
        // Two passes of 96 %: a 25th is left.
        let behind = follow(0.0, 620.0).after(Unsure::START);
        assert!((0.03..0.06).contains(&behind.wind), "{behind:?}");
        let later = follow(620.0, 1020.0).after(behind).metres - behind.metres;
        assert!((400.0..480.0).contains(&later), "{later}");
    }

    #[test]
    fn without_a_fix_the_blind_way_is_the_way() {
        let field = field(|_| 0.0);
        let way = ground(&field)
            .follow(&GroundPoint::new(0.0, 0.0), &GroundPoint::new(900.0, 0.0))
            .unwrap();
        assert!((way.end.of(metres(50.0)) - 950.0).abs() < 1e-9);
        assert!((way.worst(metres(50.0)) - 950.0).abs() < 1e-9);
        assert!((way.integral.of(metres(0.0)) - 0.5 * 900.0 * 900.0).abs() < 1e-6);
        assert_eq!((way.length, way.time), (900.0, 45.0));
    }

    #[test]
    fn a_pass_over_a_likely_fix_leaves_the_root_of_what_is_missed() {
        // Lit for a pass of 100 m.
        let field = field(|p| f64::from(u8::from((400.0..500.0).contains(&p.north))) * 0.75);
        let way = ground(&field)
            .follow(&GroundPoint::new(0.0, 0.0), &GroundPoint::new(500.0, 0.0))
            .unwrap();
        let end = way.end.of(metres(1600.0));
        // Half of the 2,000 m with which it comes to the fix, and some of the pass itself.
        assert!((1000.0..1090.0).contains(&end), "{end}");
        assert!((way.worst(metres(1600.0)) - 2000.0).abs() < 26.0, "{way:?}");
    }

    #[test]
    fn against_the_wind_a_way_takes_longer_and_too_much_wind_forbids_it() {
        let pace = Pace {
            airspeed: 20.0,
            wind: Vector2::new(-12.0, 0.0),
        };
        assert_eq!(pace.over_ground(&Vector2::new(1.0, 0.0)), Some(8.0));
        assert_eq!(pace.over_ground(&Vector2::new(-3.0, 0.0)), Some(32.0));
        assert_eq!(pace.over_ground(&Vector2::new(0.0, 1.0)), Some(16.0));
        let storm = Pace {
            wind: Vector2::new(-25.0, 0.0),
            ..pace
        };
        assert_eq!(storm.over_ground(&Vector2::new(1.0, 0.0)), None);
    }
}
