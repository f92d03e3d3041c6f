//! Why a reference system cannot be used.

/// Reason why a reference system cannot be used.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum SystemError {
    /// It is not among those that are known.
    #[error(
        "the reference system {name} is not known; warp the map to EPSG:4326, EPSG:3857 or a UTM zone of WGS 84"
    )]
    Unknown {
        /// Its name in the file.
        name: String,
    },
    /// The shift of its datum to WGS 84 is not known.
    #[error(
        "the reference system {name} is on the datum \"{datum}\", whose shift to WGS 84 is not known; warp the map to EPSG:4326, EPSG:3857 or a UTM zone of WGS 84"
    )]
    Datum {
        /// Name of the system in the file.
        name: String,
        /// Name of the datum in the file.
        datum: String,
    },
    /// Its projection is not known.
    #[error(
        "the projection \"{method}\" of the reference system {name} is not known; warp the map to EPSG:4326, EPSG:3857 or a UTM zone of WGS 84"
    )]
    Method {
        /// Name of the system in the file.
        name: String,
        /// Name of the projection in the file.
        method: String,
    },
    /// A number of its description is missing or impossible.
    #[error("the reference system {name}: {cause}")]
    Number {
        /// Its name in the file.
        name: String,
        /// The fault.
        cause: String,
    },
}

impl SystemError {
    pub(super) fn unknown(name: impl Into<String>) -> Self {
        Self::Unknown { name: name.into() }
    }
}
