//! Reference systems out of well-known text: the first version as GDAL and ESRI write it, and the second.

mod read;
mod tree;

pub(super) use read::read;
