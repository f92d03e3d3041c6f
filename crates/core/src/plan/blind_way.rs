//! How far an aircraft has come without a fix, along a way over the field of localizability.
//!
//! The uncertainty of the position grows with the way since the last fix, and a fix takes it back. Let u
//! be the root mean square, over all ways in which detections may turn out, of the metres flown since
//! the last fix. Over ds metres without any it grows by ds; a pass of length L over ground where a fix
//! is had with probability P leaves √(1-P) of it, so that a piece of ds leaves (1-P)^(ds/2L). Every
//! piece maps u to an affine function of it, and so does every way: it is sampled once and then holds
//! for any u with which it is begun.

use nalgebra::Vector2;

use super::field::Localizability;
use crate::frames::GroundPoint;

/// Probability at which a place no longer counts as blind.
const LIT: f64 = 0.02;
/// Greatest probability that is believed.
const SUREST: f64 = 0.99;

/// An affine function of the metres without a fix at the beginning.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Affine {
    pub factor: f64,
    pub offset: f64,
}

impl Affine {
    pub fn of(&self, u: f64) -> f64 {
        self.factor * u + self.offset
    }
}

/// What a straight way does to the metres without a fix.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct BlindWay {
    /// Its length, metres.
    pub length: f64,
    /// How long it takes, seconds.
    pub time: f64,
    /// What is left at its end.
    pub end: Affine,
    /// Its values where it may be greatest.
    pub peaks: Vec<Affine>,
    /// Its integral over the way, m².
    pub integral: Affine,
}

impl BlindWay {
    /// Greatest metres without a fix on the way, begun with `u`.
    pub fn worst(&self, u: f64) -> f64 {
        self.peaks.iter().map(|p| p.of(u)).fold(u, f64::max)
    }
}

/// How fast one gets on in the wind.
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

/// What is needed to follow a way over the field.
#[derive(Clone, Copy)]
pub(super) struct Ground<'a> {
    pub field: &'a Localizability,
    /// Length of a pass over a source: the shorter side of the picture on the ground, metres.
    pub pass: f64,
    pub pace: Pace,
}

impl Ground<'_> {
    /// Follows the straight way from `a` to `b`; `None` where the wind does not allow it.
    pub fn follow(&self, a: &GroundPoint, b: &GroundPoint) -> Option<BlindWay> {
        let way = b.to_vector() - a.to_vector();
        let length = way.norm();
        let mut end = Affine {
            factor: 1.0,
            offset: 0.0,
        };
        let mut integral = Affine {
            factor: 0.0,
            offset: 0.0,
        };
        let mut peaks = Vec::new();
        if length < 1e-9 {
            return Some(BlindWay {
                length,
                time: 0.0,
                end,
                peaks,
                integral,
            });
        }
        let time = length / self.pace.over_ground(&way)?;
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
                factor: end.factor,
                offset: end.offset + ds,
            };
            // Trapezoid of the growth.
            integral.factor += ds * end.factor;
            integral.offset += ds * 0.5 * (end.offset + grown.offset);
            let kept = (1.0 - p).powf(0.5 * ds / self.pass);
            end = Affine {
                factor: grown.factor * kept,
                offset: grown.offset * kept,
            };
        }
        peaks.push(end);
        Some(BlindWay {
            length,
            time,
            end,
            peaks,
            integral,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::frames::GroundRect;

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

    fn ground(field: &Localizability) -> Ground<'_> {
        Ground {
            field,
            pass: 100.0,
            pace: Pace {
                airspeed: 20.0,
                wind: Vector2::zeros(),
            },
        }
    }

    #[test]
    fn without_a_fix_the_blind_way_is_the_way() {
        let field = field(|_| 0.0);
        let way = ground(&field)
            .follow(&GroundPoint::new(0.0, 0.0), &GroundPoint::new(900.0, 0.0))
            .unwrap();
        assert!((way.end.of(50.0) - 950.0).abs() < 1e-9);
        assert!((way.worst(50.0) - 950.0).abs() < 1e-9);
        assert!((way.integral.of(0.0) - 0.5 * 900.0 * 900.0).abs() < 1e-6);
        assert_eq!((way.length, way.time), (900.0, 45.0));
    }

    #[test]
    fn a_pass_over_a_likely_fix_leaves_the_root_of_what_is_missed() {
        // Lit for a pass of 100 m.
        let field = field(|p| f64::from(u8::from((400.0..500.0).contains(&p.north))) * 0.75);
        let way = ground(&field)
            .follow(&GroundPoint::new(0.0, 0.0), &GroundPoint::new(500.0, 0.0))
            .unwrap();
        let end = way.end.of(1600.0);
        // Half of the 2,000 m with which it comes to the fix, and some of the pass itself.
        assert!((1000.0..1090.0).contains(&end), "{end}");
        assert!((way.worst(1600.0) - 2000.0).abs() < 26.0, "{way:?}");
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
