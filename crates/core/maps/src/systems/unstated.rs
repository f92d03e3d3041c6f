//! Systems that state an ellipsoid and no datum: of which datum they are, where their numbers are those of one grid.

use pilotage_base::frames::{Datum, SystemNumbers};

use super::code_table;
use super::datums::{GREEK_OR_BALTIC, NEAR, UNSTATED_ON_GRS80};

/// The datum of a projected system that may state none: where a grid alone has these numbers it is that of the grid.
pub(super) fn of_grid(numbers: &SystemNumbers) -> Datum {
    let is_near = |a: f64, b: f64| (a - b).abs() < 1e-9 * b.abs().max(1.0);
    let is_grid = |code: u32| {
        code_table::numbers(code).filter(|grid| {
            numbers.method == grid.method
                && is_near(numbers.latitude_0, grid.latitude_0)
                && is_near(numbers.longitude_0, grid.longitude_0)
                && is_near(numbers.scale, grid.scale)
                && is_near(numbers.offset[0], grid.offset[0])
                && is_near(numbers.offset[1], grid.offset[1])
        })
    };
    if numbers.datum.name != UNSTATED_ON_GRS80 {
        return numbers.datum;
    }
    if is_grid(2100).is_some() {
        return Datum {
            name: GREEK_OR_BALTIC,
            accuracy: NEAR,
            ..numbers.datum
        };
    }
    // Israel's later grids are the same to a metre or two.
    is_grid(2039).map_or(numbers.datum, |grid| grid.datum)
}
