//! Times, sizes and names of a log in words.

use pilotage_jobs::SeriesName;

/// A length of time: `12 s`, `5 min 20 s`.
pub fn duration(seconds: f64) -> String {
    let whole = seconds.round().max(0.0);
    let (minutes, rest) = ((whole / 60.0).floor(), whole % 60.0);
    if minutes == 0.0 {
        format!("{rest:.0} s")
    } else {
        format!("{minutes:.0} min {rest:.0} s")
    }
}

/// A number of bytes: `4.1 MB`.
pub fn size(bytes: u64) -> String {
    let bytes = bytes as f64;
    if bytes < 1e6 {
        format!("{:.0} kB", bytes / 1e3)
    } else {
        format!("{:.1} MB", bytes / 1e6)
    }
}

/// A number with six significant digits, in powers of ten where it is very large or small.
pub fn figure(value: f64) -> String {
    let size = value.abs();
    let text = if !value.is_finite() {
        "–".to_owned()
    } else if value == 0.0 {
        "0".to_owned()
    } else if !(1e-4..1e7).contains(&size) {
        format!("{value:.4e}")
    } else {
        let decimals = (5 - size.log10().floor() as i32).clamp(0, 7) as usize;
        let text = format!("{value:.decimals$}");
        if text.contains('.') {
            text.trim_end_matches('0').trim_end_matches('.').to_owned()
        } else {
            text
        }
    };
    text.replace('-', "−")
}

/// A field as people write it: `ATT.Roll`; a role by its name, an expression as it was written.
pub fn series_name(series: &SeriesName) -> String {
    if series.topic == SeriesName::role_topic() || series.is_expression() {
        return series.field.clone();
    }
    format!("{}.{}", series.topic, series.field)
}

/// Date and time (UTC) of seconds since 1970: `2014-05-18 10:20:31 UTC`.
pub fn date(utc: f64) -> String {
    let days = (utc / 86_400.0).floor();
    let second = utc - 86_400.0 * days;
    let (year, month, day) = pilotage_core::text::civil_date(days as i64);
    let (hours, rest) = ((second / 3600.0).floor(), second % 3600.0);
    let (minutes, seconds) = ((rest / 60.0).floor(), (rest % 60.0).floor());
    format!("{year}-{month:02}-{day:02} {hours:02.0}:{minutes:02.0}:{seconds:02.0} UTC")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn dates_are_those_of_the_calendar() {
        assert_eq!(date(0.0), "1970-01-01 00:00:00 UTC");
        assert_eq!(date(951_782_400.0), "2000-02-29 00:00:00 UTC");
        assert_eq!(date(1_400_408_431.9), "2014-05-18 10:20:31 UTC");
    }

    #[test]
    fn lengths_and_sizes_read_as_people_say_them() {
        assert_eq!(duration(59.6), "1 min 0 s");
        assert_eq!(duration(12.2), "12 s");
        assert_eq!(size(4_050_000), "4.0 MB");
    }

    #[test]
    fn figures_have_six_digits_and_no_idle_zeros() {
        for (value, text) in [
            (0.0, "0"),
            (2.0, "2"),
            (-0.123_456_789, "−0.123457"),
            (1_234.567_89, "1234.57"),
            (123_456_789.0, "1.2346e8"),
            (0.000_012, "1.2000e−5"),
            (359.5, "359.5"),
            (47.397_742, "47.3977"),
            (f64::NAN, "–"),
        ] {
            assert_eq!(figure(value), text);
        }
    }
}
