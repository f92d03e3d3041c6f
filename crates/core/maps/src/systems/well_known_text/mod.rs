//! Reference systems as well-known text: the first version as GDAL and ESRI write it, and the second.

mod read;
mod tree;
mod write;

pub(super) use read::read;
pub(super) use write::write;
