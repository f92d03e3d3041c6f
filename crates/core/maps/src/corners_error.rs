//! Why a table of corners of pictures is none.

/// Why a table of corners is none.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum CornersError {
    /// Its columns do not say it.
    #[error(
        "a table of corners has a column of files and latitude and longitude of two opposite corners at least, e.g. \
         \"file,top_left_lat,top_left_lon,bottom_right_lat,bottom_right_lon\" or \"file,north,west,south,east\"; {cause}"
    )]
    Columns {
        /// The missing columns.
        cause: String,
    },
    /// A row cannot be used.
    #[error("line {line}: {cause}")]
    Row {
        /// Line, counted from one.
        line: usize,
        /// The fault of the row.
        cause: String,
    },
    /// Coordinates of no stated system.
    #[error(
        "its corners are no degrees of latitude and longitude; name their reference system, e.g. --system EPSG:32617"
    )]
    NoSystem,
}
