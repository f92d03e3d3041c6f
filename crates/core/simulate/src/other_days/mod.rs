//! The same ground on another day: other sun, season and weather, drawn from a seed.

mod changed_picture;
pub mod day_ground;
mod days;

pub use changed_picture::PictureDays;
pub use days::{OtherDays, SceneryDays, any_day};
