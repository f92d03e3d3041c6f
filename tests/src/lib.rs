//! Shared helpers of the end-to-end checks.
//!
//! - [`data`] finds the recorded flights and other people's test vectors, which lie beside the
//!   repository and are never part of it;
//! - [`damage`] are faults in the channels of a flight, and [`flown`] are built-in flights after it;
//! - [`oracle`] asks another program (FilterPy, OpenCV) for its answer to the same question;
//! - [`logs`] are flight logs, made and damaged, and what must hold of their readers;
//! - [`pmtiles`] is a small archive of tiles, for the tests of the other crates, too;
//! - [`pyproj`] asks that program for the places of coordinates;
//! - [`recorded`] reads the recorded flights that have a column map here;
//! - [`routes`] flies found routes beside straight lines over generated counties;
//! - [`studies`] says whether questions over many seeds are asked in full;
//! - [`threads`] shares work out among the processors;
//! - [`whole_frames`] navigates recorded flights by laying whole frames on the map.

pub mod damage;
pub mod data;
pub mod flown;
pub mod logs;
pub mod oracle;
pub mod pmtiles;
pub mod pyproj;
pub mod recorded;
pub mod routes;
pub mod studies;
pub mod threads;
pub mod whole_frames;
