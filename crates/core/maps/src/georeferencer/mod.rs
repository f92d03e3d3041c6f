//! Putting a picture on the ground by points that are known in both.
//!
//! The plane is east and north in metres, or the coordinates of a reference system; a pixel is
//! counted with centres at half integers. All fits minimize the squared distances in the plane.

mod fit;
mod kind;
mod plane;
mod points_file;
#[cfg(test)]
mod points_file_tests;
mod solve;
#[cfg(test)]
mod tests;

pub use fit::{ControlPoint, FitError, Residual, TransformFit, fit};
pub use kind::TransformKind;
pub use plane::{in_metres, in_utm_zone, metres_per_unit};
pub use points_file::{PointsFileError, read_points, read_points_in, write_points};
