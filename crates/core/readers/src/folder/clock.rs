//! Times as files write them.

use serde::{Deserialize, Serialize};

/// How a time column is written.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum TimeFormat {
    /// Seconds in the flight's time base.
    #[default]
    #[serde(rename = "s")]
    Seconds,
    /// Milliseconds in the flight's time base.
    #[serde(rename = "ms")]
    Milliseconds,
    /// Microseconds in the flight's time base.
    #[serde(rename = "us")]
    Microseconds,
    /// Nanoseconds in the flight's time base.
    #[serde(rename = "ns")]
    Nanoseconds,
    /// Date and time as cameras write them, `2016:06:23 16:31:59`.
    #[serde(rename = "YYYY:MM:DD HH:MM:SS")]
    Camera,
    /// Date and time as in ISO 8601, `2016-06-23T16:31:59.5Z`.
    #[serde(rename = "iso")]
    Iso,
}

/// A moment: whole seconds and a fraction, so that differences lose nothing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Moment {
    /// Seconds in the flight's time base.
    Relative(f64),
    /// Seconds since 1970-01-01 and a fraction of a second.
    Absolute(i64, f64),
}

impl TimeFormat {
    /// Whether times carry a date.
    pub fn is_absolute(self) -> bool {
        matches!(self, Self::Camera | Self::Iso)
    }

    /// Reads a cell; the error says in words what is expected.
    pub fn parse(self, text: &str) -> Result<Moment, String> {
        let scaled = |scale: f64| {
            let value: f64 = text
                .parse()
                .map_err(|_| format!("\"{}\" is not a number", shortened(text)))?;
            if value.is_finite() {
                Ok(Moment::Relative(value * scale))
            } else {
                Err(format!("the time {value} is not finite"))
            }
        };
        match self {
            Self::Seconds => scaled(1.0),
            Self::Milliseconds => scaled(1e-3),
            Self::Microseconds => scaled(1e-6),
            Self::Nanoseconds => scaled(1e-9),
            Self::Camera | Self::Iso => date_and_time(text).ok_or_else(|| {
                format!(
                    "\"{}\" is not a date and time such as 2016:06:23 16:31:59 or \
                     2016-06-23T16:31:59Z",
                    shortened(text)
                )
            }),
        }
    }
}

impl Moment {
    /// Seconds since `origin`; relative times are counted from it already.
    pub fn since(self, origin: Option<(i64, f64)>) -> f64 {
        match (self, origin) {
            (Self::Relative(seconds), _) => seconds,
            (Self::Absolute(whole, fraction), Some((whole0, fraction0))) => {
                (whole.saturating_sub(whole0)) as f64 + (fraction - fraction0)
            }
            (Self::Absolute(whole, fraction), None) => whole as f64 + fraction,
        }
    }
}

/// At most forty characters, for messages.
pub(super) fn shortened(text: &str) -> String {
    text.chars().take(40).collect()
}

/// Reads `YYYY-MM-DD HH:MM:SS` with `:` or `-` in the date, `T` or a blank between, an optional
/// fraction and an optional zone; times without a zone are taken as they are.
pub(crate) fn date_and_time(text: &str) -> Option<Moment> {
    let text = text.trim();
    if !text.is_ascii() || text.len() < 19 {
        return None;
    }
    let (head, tail) = text.split_at(19);
    let digits = |range: std::ops::Range<usize>| -> Option<i64> {
        let part = &head[range];
        part.bytes()
            .all(|b| b.is_ascii_digit())
            .then(|| part.parse().ok())?
    };
    let is = |at: usize, allowed: &[u8]| allowed.contains(&head.as_bytes()[at]);
    let separated = is(4, b":-") && is(7, b":-") && is(10, b"T t") && is(13, b":") && is(16, b":");
    if !separated {
        return None;
    }
    let (year, month, day) = (digits(0..4)?, digits(5..7)?, digits(8..10)?);
    let (hour, minute, second) = (digits(11..13)?, digits(14..16)?, digits(17..19)?);
    if !(1..=12).contains(&month)
        || !(1..=31).contains(&day)
        || hour > 24
        || minute > 59
        || second > 60
    {
        return None;
    }
    let fraction_length = tail
        .bytes()
        .take_while(|b| b.is_ascii_digit() || *b == b'.')
        .count();
    let (fraction, zone) = tail.split_at(fraction_length);
    let fraction: f64 = if fraction.is_empty() {
        0.0
    } else {
        fraction
            .strip_prefix('.')
            .and_then(|f| format!("0.{f}").parse().ok())?
    };
    let offset = match zone.trim() {
        "" | "Z" | "z" => 0,
        zone => zone_offset(zone)?,
    };
    let seconds = days_since_1970(year, month, day) * 86_400 + hour * 3600 + minute * 60 + second;
    Some(Moment::Absolute(seconds - offset, fraction))
}

/// Seconds east of Greenwich from `+hh:mm`, `-hhmm` or `+hh`.
fn zone_offset(zone: &str) -> Option<i64> {
    let sign = match zone.as_bytes().first()? {
        b'+' => 1,
        b'-' => -1,
        _ => return None,
    };
    let digits: String = zone[1..].chars().filter(|c| *c != ':').collect();
    if !digits.bytes().all(|b| b.is_ascii_digit()) || !matches!(digits.len(), 2 | 4) {
        return None;
    }
    let hours: i64 = digits[..2].parse().ok()?;
    let minutes: i64 = digits.get(2..4).map_or(Some(0), |m| m.parse().ok())?;
    Some(sign * (hours * 3600 + minutes * 60))
}

/// Days since 1970-01-01 in the Gregorian calendar (years that begin in March make leap days last).
fn days_since_1970(year: i64, month: i64, day: i64) -> i64 {
    let year = if month <= 2 { year - 1 } else { year };
    let era = year.div_euclid(400);
    let year_of_era = year.rem_euclid(400);
    let month_from_march = (month + 9) % 12;
    let day_of_year = (153 * month_from_march + 2) / 5 + day - 1;
    let day_of_era = year_of_era * 365 + year_of_era / 4 - year_of_era / 100 + day_of_year;
    era * 146_097 + day_of_era - 719_468
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_camera_time_and_an_iso_time_mean_the_same_moment() {
        // date -u -d '2016-06-23 16:31:59' +%s
        let expected = Some(Moment::Absolute(1_466_699_519, 0.0));
        assert_eq!(date_and_time("2016:06:23 16:31:59"), expected);
        assert_eq!(date_and_time("2016-06-23T16:31:59Z"), expected);
        assert_eq!(date_and_time("2016-06-23T18:31:59+02:00"), expected);
        assert_eq!(
            date_and_time("2016-02-29 00:00:00.25"),
            Some(Moment::Absolute(1_456_704_000, 0.25))
        );
    }

    #[test]
    fn what_is_no_date_is_refused() {
        for text in [
            "",
            "2016:06:23",
            "2016:13:23 16:31:59",
            "2016:06:23 16:31:5x",
            "2016-06-23T16:31:59 Paris",
            "2016:06:23 16:31:59é",
            "2016-06-23T16:31:59+2",
        ] {
            assert_eq!(date_and_time(text), None, "{text}");
        }
    }
}
