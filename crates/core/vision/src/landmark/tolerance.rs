//! Which places count as right.

/// A place this far off is wrong if it is off by as many pixels, too: metres and pixels.
const WRONG: (f64, f64) = (2.0, 5.0);

/// How far off a right place may be where a pixel of the camera covers that many metres, metres.
pub fn tolerance(pixel: f64) -> f64 {
    WRONG.0.max(WRONG.1 * pixel)
}
