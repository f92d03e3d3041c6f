//! The reader of stamped `MAVLink` on files written here.

mod airspeed;
mod damage;
mod reading;
mod receiver;
mod written;
