//! Places on the globe as people write them: in degrees, in UTM, as MGRS references, as plus codes, as
//! addresses of maps.

mod address;
mod degrees;
mod mgrs;
mod place_text_error;
mod plus_code;
mod short_link;
#[cfg(test)]
mod tests;
mod utm;

pub use address::is_map_address;
pub use degrees::two_numbers;
pub use place_text_error::PlaceTextError;
pub use plus_code::town_of_short_code;

use crate::frames::Geodetic;

/// The place that a text names, at height zero: the middle of the square that an MGRS reference or a plus code means.
///
/// ```
/// use pilotage_base::place_text::place_of_text;
///
/// let place = place_of_text("46°51.6' N, 92°4.5' W")?;
/// assert!((place.latitude.to_degrees() - 46.86).abs() < 1e-12);
/// for text in ["32T 448251 5211932", "32TMT4825111932"] {
///     let longitude = place_of_text(text)?.longitude.to_degrees();
///     assert!((longitude - 8.318_57).abs() < 1e-5);
/// }
/// // A short code needs a place near which it lies.
/// assert!(place_of_text("9G8F+6X").is_err());
/// # Ok::<(), pilotage_base::place_text::PlaceTextError>(())
/// ```
pub fn place_of_text(text: &str) -> Result<Geodetic, PlaceTextError> {
    read(text, None)
}

/// The place that a text names, as [`place_of_text`] reads it; a short plus code means its square nearest to `near`.
///
/// ```
/// use pilotage_base::frames::Geodetic;
/// use pilotage_base::place_text::place_of_text_near;
///
/// let zurich = Geodetic::from_degrees(47.37, 8.54, 0.0);
/// let place = place_of_text_near("9G8F+6X", &zurich)?;
/// assert!((place.latitude.to_degrees() - 47.365_562_5).abs() < 1e-9);
/// # Ok::<(), pilotage_base::place_text::PlaceTextError>(())
/// ```
pub fn place_of_text_near(text: &str, near: &Geodetic) -> Result<Geodetic, PlaceTextError> {
    read(text, Some(near))
}

fn read(text: &str, near: Option<&Geodetic>) -> Result<Geodetic, PlaceTextError> {
    // Letters of these are big or small.
    if let Some(found) = short_link::read(text.trim()) {
        return found;
    }
    let text = text.trim().to_uppercase();
    // "31NEM12" is a reference, though N, E and M could be the marks of an angle.
    address::read(&text)
        .or_else(|| plus_code::read(&text, near))
        .or_else(|| mgrs::read(&text))
        .or_else(|| utm::read(&text))
        .unwrap_or_else(|| degrees::read(&text))
}
