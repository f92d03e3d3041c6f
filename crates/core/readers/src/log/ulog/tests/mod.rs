//! The reader of `ULog` files on files written here.

mod damage;
mod reading;
mod written;
