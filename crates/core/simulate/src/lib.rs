//! Worlds to fly in: generated countryside and a hall, an aircraft with its sensors and its camera, and
//! the same ground on another day.

pub mod other_days;
pub mod simulate;
