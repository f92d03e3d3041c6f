//! Numbers of options: each read by a parser that knows its range, and several in one option.

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

/// A number of which `is_one` says whether it may be; `words` are behind "give a number".
fn number(text: &str, is_one: impl Fn(f64) -> bool, words: &str) -> Result<f64, String> {
    let number = text.trim().parse().ok();
    number
        .filter(|number: &f64| number.is_finite() && is_one(*number))
        .ok_or_else(|| format!("give a number{words}"))
}

/// Any number that is one.
pub fn any_number(text: &str) -> Result<f64, String> {
    number(text, |_| true, "")
}

/// A number above zero.
pub fn above_zero(text: &str) -> Result<f64, String> {
    number(text, |number| number > 0.0, " above zero")
}

/// A number that is not below zero.
pub fn zero_or_more(text: &str) -> Result<f64, String> {
    number(text, |number| number >= 0.0, ", zero or more")
}

/// A number of at least one.
pub fn one_or_more(text: &str) -> Result<f64, String> {
    number(text, |number| number >= 1.0, ", one or more")
}

/// An angle from the vertical: degrees from zero to below 90.
pub fn below_right_angle(text: &str) -> Result<f64, String> {
    let is_one = |number: f64| (0.0..90.0).contains(&number);
    number(text, is_one, " of degrees, zero or more and below 90")
}

/// A count of at least one.
pub fn count(text: &str) -> Result<usize, String> {
    let count = text.trim().parse().ok();
    count
        .filter(|count| *count > 0)
        .ok_or_else(|| "give a whole number above zero".to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_out_of_their_range_are_refused_and_so_is_what_is_none() {
        for text in ["nan", "inf", "-inf", "", "five", "1,5"] {
            for parser in [
                any_number,
                above_zero,
                zero_or_more,
                one_or_more,
                below_right_angle,
            ] {
                assert!(parser(text).is_err(), "{text}");
            }
        }
        assert_eq!(any_number("-5"), Ok(-5.0));
        let taken = |parser: fn(&str) -> Result<f64, String>| {
            ["-5", "0", "0.5", "1", "89", "90"].map(|text| parser(text).is_ok())
        };
        assert_eq!(taken(above_zero), [false, false, true, true, true, true]);
        assert_eq!(taken(zero_or_more), [false, true, true, true, true, true]);
        assert_eq!(taken(one_or_more), [false, false, false, true, true, true]);
        assert_eq!(
            taken(below_right_angle),
            [false, true, true, true, true, false]
        );
        assert_eq!(
            ["0", "-1", "1.5", "3"].map(|text| count(text).ok()),
            [None, None, None, Some(3)]
        );
    }
}
