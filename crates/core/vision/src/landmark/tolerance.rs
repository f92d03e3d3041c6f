//! Tolerance of a place that counts as right.

/// A place this far off is wrong if it is off by as many pixels, too: metres and pixels.
const WRONG: (f64, f64) = (2.0, 5.0);

/// Largest error of a right place where a pixel of the camera covers `pixel` metres, metres.
pub fn tolerance(pixel: f64) -> f64 {
    WRONG.0.max(WRONG.1 * pixel)
}
