//! Missions that people author: landmarks, routes, camera, aircraft and the settings of the navigator, as a
//! value that files hold, and the files of other programs that hold parts of it.

pub mod exchange;
pub mod mission;
pub mod settings;
