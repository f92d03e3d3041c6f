//! All aids beside pictures, in the order in which they are asked: another one is a file of this folder, and a line in
//! the list below.

mod aid;
mod assumed_air;
mod choice;
mod direct;
mod error;
mod generic_sighting;
#[cfg(test)]
mod look_for_tests;
mod reading;
mod road_sighting;
mod take;
#[cfg(test)]
mod tests;

use aid::BeginAid;
pub(super) use aid::{Aid, AidLook, AidMoment};
pub use aid::{AidInfo, AidNumber};
pub(super) use assumed_air::AssumedAir;
pub(super) use choice::chosen;
pub use error::AidError;
pub(super) use take::{Taken, take};

/// Declares the files of the aids, and makes their list.
macro_rules! aids {
    ($($file:ident,)*) => {
        $(mod $file;)*

        impl AidInfo {
            /// Every aid.
            pub const ALL: &[&Self] = &[$(&$file::INFO),*];

            /// The makers of all, in the same order: a program that only describes aids links none of them.
            const MAKERS: &[BeginAid] = &[$($file::BEGIN),*];
        }
    };
}

aids! {
    gps_position,
    gps_velocity,
    magnetic_heading,
    barometric_height,
    ground_range,
    roads,
    generic_landmarks,
    map_edges,
}
