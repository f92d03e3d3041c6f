//! The reader of stamped `MAVLink` on files written here.

mod damage;
mod reading;
mod receiver;
mod written;
