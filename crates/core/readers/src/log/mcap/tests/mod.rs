//! Sound files and damaged ones.

mod damage;
mod reading;
mod written;
