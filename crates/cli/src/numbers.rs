//! Several numbers in one option.

use pilotage_core::frames::Geodetic;

/// The numbers of `text`, with commas between; the error names the option.
pub fn numbers<const N: usize>(text: &str, option: &str) -> Result<[f64; N], String> {
    let parts: Result<Vec<f64>, _> = text.split(',').map(|part| part.trim().parse()).collect();
    parts
        .ok()
        .and_then(|parts| parts.try_into().ok())
        .filter(|parts: &[f64; N]| parts.iter().all(|v| v.is_finite()))
        .ok_or_else(|| format!("{option}: \"{text}\" is not {N} numbers with commas between"))
}

/// The place of `text`, latitude and longitude in degrees with a comma between; the error names the option.
pub fn lat_lon(text: &str, option: &str) -> Result<Geodetic, String> {
    let [latitude, longitude] = numbers(text, option)?;
    if latitude.abs() > 90.0 || longitude.abs() > 180.0 {
        return Err(format!(
            "{option}: \"{text}\" is not a latitude and a longitude in degrees"
        ));
    }
    Ok(Geodetic::from_degrees(latitude, longitude, 0.0))
}
