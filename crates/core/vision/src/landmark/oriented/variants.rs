//! Turns and sizes in which a patch is looked for.

/// Shift at the rim of the patch from one turn, or size, to the next, pixels; it is about as wide as edges are
/// spread.
const RIM_SHIFT: f64 = 1.5;
/// Standard deviations that are tried.
const REACH: f64 = 2.5;
/// Most steps to each side.
const MOST: i32 = 12;

/// A turn and a size of a patch, in steps.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) struct PatchVariant {
    /// In half steps, so that what lies between two has a number of its own.
    pub turn: i32,
    pub size: i32,
}

/// The grid of turns and sizes of a patch.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct PatchVariants {
    /// From one turn to the next, radians; from one size to the next, as a logarithm.
    pub step: f64,
    turns: i32,
    sizes: i32,
}

impl PatchVariants {
    /// For a patch of which the middle of the sides is `half` pixels off its middle, and deviations of turn
    /// (radians) and of the logarithm of the size.
    pub fn new(half: f64, turn_deviation: f64, log_scale_deviation: f64) -> Self {
        let step = RIM_SHIFT / half;
        let count = |deviation: f64| ((REACH * deviation / step).round() as i32).clamp(0, MOST);
        Self {
            step,
            turns: count(turn_deviation),
            sizes: count(log_scale_deviation),
        }
    }

    /// All of them.
    pub fn all(self) -> impl Iterator<Item = PatchVariant> {
        let sizes = -self.sizes..=self.sizes;
        sizes.flat_map(move |size| {
            (-self.turns..=self.turns).map(move |turn| PatchVariant {
                turn: 2 * turn,
                size: 2 * size,
            })
        })
    }

    /// Those between `variant` and its neighbours.
    pub fn beside(variant: PatchVariant) -> impl Iterator<Item = PatchVariant> {
        let off = |turn: i32, size: i32| PatchVariant {
            turn: variant.turn + turn,
            size: variant.size + size,
        };
        [off(-1, 0), off(1, 0), off(0, -1), off(0, 1)].into_iter()
    }

    /// Radians clockwise.
    pub fn turn(&self, variant: PatchVariant) -> f64 {
        0.5 * self.step * f64::from(variant.turn)
    }

    /// Natural logarithm.
    pub fn log_scale(&self, variant: PatchVariant) -> f64 {
        0.5 * self.step * f64::from(variant.size)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_known_exactly_is_tried_once_and_what_is_not_as_far_as_it_may_be() {
        assert_eq!(PatchVariants::new(16.0, 0.0, 0.0).all().count(), 1);
        let wide = PatchVariants::new(16.0, 0.1, 0.02);
        let furthest = wide.all().map(|v| wide.turn(v)).fold(0.0, f64::max);
        assert!((0.2..0.3).contains(&furthest), "{furthest}");
        let largest = wide.all().map(|v| wide.log_scale(v)).fold(0.0, f64::max);
        assert!(largest < 0.1, "{largest}");
    }
}
