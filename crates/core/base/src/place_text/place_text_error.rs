//! Reasons why a text names no place.

/// Error of a text that should name a place.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum PlaceTextError {
    /// It has no known form.
    #[error(
        "No place is read in that. Write degrees like 46.8571, -92.0765 or 46°51.4' N 92°4.6' W, UTM like 32T 448251 \
         5211932, MGRS like 32TMT4825111932, or a plus code like 8FVC9G8F+6X, or paste the address of a map."
    )]
    Unread,
    /// Degrees beyond the globe.
    #[error(
        "A latitude goes up to 90 degrees and a longitude up to 180; {latitude} and {longitude} are none."
    )]
    Degrees {
        /// Number in the place of the latitude, degrees.
        latitude: f64,
        /// Number in the place of the longitude, degrees.
        longitude: f64,
    },
    /// An address without a place, or with one in another reference system.
    #[error(
        "No latitude and longitude on WGS 84 are read in that address: short ones do not have them. Open it, and copy the \
         long one."
    )]
    Address,
    /// Two latitudes, or two longitudes.
    #[error("Write one number with N or S, and one with E or W.")]
    Hemispheres,
    /// Metres without a zone.
    #[error("These are metres: write the UTM zone before them, like 32T 448251 5211932.")]
    Metres,
    /// A zone that does not exist.
    #[error("UTM zones go from 1 to 60; {zone} is none.")]
    Zone {
        /// Number in the place of a zone.
        zone: u8,
    },
    /// A letter of no latitude band.
    #[error("{letter} is no latitude band: those go from C to X, without I and O.")]
    Band {
        /// The letter.
        letter: char,
    },
    /// The grid of the poles.
    #[error("The grid of the poles (UPS, letters A, B, Y and Z) is not read: write degrees.")]
    Polar,
    /// The letter S, which means two things.
    #[error(
        "{zone}S may be band S, 32° to 40° north, or the southern half of the zone: write {zone} north or {zone} south."
    )]
    BandOrSouth {
        /// The zone.
        zone: u8,
    },
    /// A latitude outside of the band that is written.
    #[error(
        "That lies at a latitude of {latitude:.2}°, outside of band {band}, {from}° to {to}°: one of them is wrong."
    )]
    OutsideBand {
        /// Latitude of the coordinates, degrees.
        latitude: f64,
        /// Letter of the band.
        band: char,
        /// Southern edge of the band, degrees.
        from: f64,
        /// Northern edge of the band, degrees.
        to: f64,
    },
    /// Metres that no zone has.
    #[error(
        "{east} m east and {north} m north lie in no UTM zone: eastings go from 100000 to 900000, and zones from 80° \
         south to 84° north."
    )]
    OutsideZone {
        /// Easting, metres.
        east: f64,
        /// Northing, metres.
        north: f64,
    },
    /// A column of squares that the zone has not.
    #[error("{letter} is no column of zone {zone}, whose squares have the letters {letters}.")]
    Column {
        /// The letter.
        letter: char,
        /// The zone.
        zone: u8,
        /// Letters of its columns.
        letters: &'static str,
    },
    /// A row of squares that does not exist.
    #[error("{letter} is no row of squares: those go from A to V, without I and O.")]
    Row {
        /// The letter.
        letter: char,
    },
    /// Digits that cannot be halved, or too many.
    #[error(
        "An MGRS reference has as many digits for east as for north, at most five each; this has {count} in all."
    )]
    DigitCount {
        /// Number of digits.
        count: usize,
    },
    /// A plus code that needs a town.
    #[error(
        "That plus code is short, and means a place near some town. Write the whole one, with eight letters and digits \
         before the +, like 8FVC9G8F+6X."
    )]
    ShortCode,
    /// A letter that no plus code has.
    #[error("{letter} stands in no plus code: those are made of 23456789CFGHJMPQRVWX.")]
    CodeLetter {
        /// The letter.
        letter: char,
    },
    /// Too few or too many letters, or a code beyond the pole.
    #[error(
        "That is no plus code: it has eight letters and digits before the +, and two to seven behind it, like \
         8FVC9G8F+6X, and the first two of a place on Earth are at most C and V."
    )]
    Code,
}
