//! Dates and times as programs, cameras and loggers write them.

use super::date_spellings::in_iso;
use super::moment::Moment;
use super::since_1970::is_since_1970;

/// Length of the shortest time of day, `1:02:03`.
const LEAST: usize = 7;

/// Second zero of 1970 in the counts of Windows of a ten-millionth of a second, since the years 1 (.NET) and 1601 (its
/// files).
const TICKS_TO_1970: [i64; 2] = [621_355_968_000_000_000, 116_444_736_000_000_000];
const TICKS_A_SECOND: i64 = 10_000_000;
/// Digits of these counts in 1990 to 2040.
const TICK_DIGITS: usize = 18;

/// Reads a date and time, or a time of day alone (of 1970-01-01): `2016-06-23T16:31:59.5+02:00`, `2016:06:23 16:31:59`,
/// `2024/05/01 10:00:00`, `01.05.2024 10:00:00`, `5/1/2024 10:00:00 AM`, `5/1/24 10:00:00 AM`, `01.05.24 10:00:00`, `10:00:00.250`,
/// `10:00:00,250`, `10:00:00:250`, minutes and seconds alone (`59:12.5`), `0 days 00:01:12.5`, `1h02m12.5s`, ticks of Windows
/// (`638501544000000000`), and those of [`in_iso`]. Times without a zone are taken as they are.
///
/// Of days and months that stand before the year and could be either, the first is the month where a slash stands between
/// them or a half of the day is told, else the day. Nothing but the date rests on it.
pub(crate) fn date_and_time(text: &str) -> Option<Moment> {
    let text = text.trim();
    if !text.is_ascii() {
        return None;
    }
    if text.len() < LEAST {
        return duration(text);
    }
    if let Some(moment) = of_ticks(text) {
        return Some(moment);
    }
    let halves = text.replace("a.m.", "AM").replace("p.m.", "PM");
    plain(&halves)
        .or_else(|| plain(&in_iso(&halves)?))
        .or_else(|| duration(text))
}

/// Whether a number is a count of ticks of Windows in 1990 to 2040.
pub(crate) fn is_of_ticks(number: f64) -> bool {
    let second = TICKS_A_SECOND as f64;
    let since_1970 = |zero: i64| (number - zero as f64) / second;
    (TICKS_TO_1970.into_iter()).any(|zero| is_since_1970(since_1970(zero)))
}

/// The moment of such a count.
fn of_ticks(text: &str) -> Option<Moment> {
    let whole = text
        .split('.')
        .next()
        .filter(|it| it.len() == TICK_DIGITS)?;
    let ticks: i64 = whole.parse().ok()?;
    let moments = TICKS_TO_1970.into_iter().map(|zero| ticks - zero);
    let second = TICKS_A_SECOND as f64;
    let mut moments = moments.filter(|since| is_since_1970(*since as f64 / second));
    let since = moments.next()?;
    let part = since.rem_euclid(TICKS_A_SECOND) as f64 / second;
    Some(Moment::Absolute(since.div_euclid(TICKS_A_SECOND), part))
}

fn plain(text: &str) -> Option<Moment> {
    let (date, time) = match text.split_once(['T', 't', ' ']) {
        Some((date, time)) if !is_half(time.trim()) => (Some(date), time.trim()),
        _ => (None, text),
    };
    let (seconds, has_half) = time_of_day(time)?;
    let day = match date {
        Some(date) => day(date, has_half)?,
        None => 0,
    };
    let (whole, fraction) = seconds;
    Some(Moment::Absolute(day * 86_400 + whole, fraction))
}

/// Time since a beginning: `59:12.5`, `0 days 00:01:12.5`, `0h 1m 12.5s`, `2m5s`.
fn duration(text: &str) -> Option<Moment> {
    let moment = |seconds: f64| Moment::Absolute(seconds.floor() as i64, seconds.fract());
    if let Some((days, rest)) = text.split_once(" day") {
        let days = digits(days, 1, 5)?;
        let rest = rest.trim_start_matches(['s', ',', ' ', '+']);
        let ((whole, fraction), _) = time_of_day(rest)?;
        return Some(Moment::Absolute(days * 86_400 + whole, fraction));
    }
    if let Some((minute, second)) = text.split_once(':') {
        let (whole, part) = second.split_once('.')?;
        let whole = digits(whole, 2, 2).filter(|second| *second < 60)?;
        let part = digits(part, 1, 9).map(|_| format!("0.{part}"))?;
        let minutes = digits(minute, 1, 2).filter(|minute| *minute < 60)?;
        return Some(Moment::Absolute(minutes * 60 + whole, part.parse().ok()?));
    }
    let (mut seconds, mut count) = (0.0, 0);
    let (mut rest, mut units) = (text, "hms");
    while !rest.is_empty() {
        let end = rest.find(|c: char| !(c.is_ascii_digit() || c == '.'))?;
        let (value, after) = rest.split_at(end);
        let unit = after.chars().next()?;
        let at = units.find(unit)?;
        let factor = [3600.0, 60.0, 1.0][3 - units.len() + at];
        seconds += factor * value.parse::<f64>().ok()?;
        units = &units[at + 1..];
        rest = after[1..].trim_start();
        count += 1;
    }
    // A single number with a unit is no clock.
    (units.is_empty() && count > 1 && seconds.is_finite()).then(|| moment(seconds))
}

/// Seconds of the day of hours, minutes and seconds that stand in one number, as receivers write them: 100059.5 is
/// 10:00:59.5. `None` where they are none.
pub(crate) fn of_clock_number(number: f64) -> Option<f64> {
    let whole = number.floor();
    let (hours, minutes, seconds) = (
        (whole / 10_000.0).floor(),
        (whole / 100.0).floor() % 100.0,
        whole % 100.0,
    );
    let is_clock = (0.0..24.0).contains(&hours) && minutes < 60.0 && seconds < 60.0;
    is_clock.then(|| hours * 3600.0 + minutes * 60.0 + seconds + number.fract())
}

/// Whether a date and time tells its zone: `Z`, `UTC`, `GMT` or hours from Greenwich.
pub(crate) fn has_zone(text: &str) -> bool {
    let zone = |time: &str| {
        let letters = time.trim_end().to_ascii_uppercase();
        ["Z", "UTC", "GMT"]
            .iter()
            .any(|zone| letters.ends_with(zone))
            || time.contains(['+', '-'])
    };
    let iso = in_iso(text.trim());
    let text = iso.as_deref().unwrap_or(text);
    date_and_time(text).is_some() && text.split_once(':').is_some_and(|(_, time)| zone(time))
}

fn is_half(text: &str) -> bool {
    text.eq_ignore_ascii_case("am") || text.eq_ignore_ascii_case("pm")
}

/// So many digits as a number.
fn digits(text: &str, least: usize, most: usize) -> Option<i64> {
    let is_number =
        (least..=most).contains(&text.len()) && text.bytes().all(|b| b.is_ascii_digit());
    is_number.then(|| text.parse().ok())?
}

/// Seconds since midnight in Greenwich and their fraction, and whether a half of the day is told.
fn time_of_day(text: &str) -> Option<((i64, f64), bool)> {
    let (hour, rest) = text.split_once(':')?;
    let (minute, rest) = rest.split_once(':')?;
    let end = rest
        .bytes()
        .take_while(|b| b.is_ascii_digit() || matches!(b, b'.' | b','))
        .count();
    let (second, zone) = rest.split_at(end);
    // Some programs write a colon before the parts of a second.
    let parts = zone
        .strip_prefix(':')
        .filter(|parts| digits(parts, 3, 9).is_some());
    let joined = parts.map(|parts| format!("{second}.{parts}"));
    let (second, zone) = match &joined {
        Some(joined) => (joined.as_str(), ""),
        None => (second, zone),
    };
    let (second, fraction) = match second.split_once(['.', ',']) {
        Some((second, fraction)) => (second, format!("0.{fraction}").parse::<f64>().ok()?),
        None => (second, 0.0),
    };
    let (mut hour, minute, second) = (
        digits(hour, 1, 2)?,
        digits(minute, 2, 2)?,
        digits(second, 2, 2)?,
    );
    let zone = zone.trim();
    let has_half = is_half(zone);
    if has_half {
        if !(1..=12).contains(&hour) {
            return None;
        }
        hour = hour % 12
            + if zone.eq_ignore_ascii_case("pm") {
                12
            } else {
                0
            };
    }
    if hour > 24 || minute > 59 || second > 60 {
        return None;
    }
    let offset = match zone {
        "" | "Z" | "z" | "UTC" | "GMT" => 0,
        _ if has_half => 0,
        zone => zone_offset(zone)?,
    };
    Some((
        (hour * 3600 + minute * 60 + second - offset, fraction),
        has_half,
    ))
}

/// Days from 1970-01-01 to a date of three numbers, or to a day of the year (`2024-122`).
fn day(text: &str, has_half: bool) -> Option<i64> {
    let separator = text.chars().find(|letter| "-/.:".contains(*letter))?;
    let parts: Vec<&str> = text.split(separator).collect();
    if let [year, day] = parts.as_slice() {
        let (year, day) = (digits(year, 4, 4)?, digits(day, 3, 3)?);
        let days = days_since_1970(year + 1, 1, 1) - days_since_1970(year, 1, 1);
        let is_day = (1..=days).contains(&day) && separator != '.';
        return is_day.then(|| days_since_1970(year, 1, day));
    }
    let [first, second, third] = parts.as_slice() else {
        return None;
    };
    let (year, month, day) = if first.len() == 4 {
        (
            digits(first, 4, 4)?,
            digits(second, 1, 2)?,
            digits(third, 1, 2)?,
        )
    } else {
        let (a, b) = (digits(first, 1, 2)?, digits(second, 1, 2)?);
        let is_month_first = b > 12 || a <= 12 && (separator == '/' || has_half);
        let (month, day) = if is_month_first { (a, b) } else { (b, a) };
        (year_of(third, separator, has_half)?, month, day)
    };
    let is_day = (1..=12).contains(&month) && (1..=31).contains(&day);
    is_day.then(|| days_since_1970(year, month, day))
}

/// A year of four digits, or of the last two of this century behind a point, and behind a slash where a half of the day is
/// told, as in America: elsewhere two digits may be the day.
fn year_of(text: &str, separator: char, has_half: bool) -> Option<i64> {
    let is_last = separator == '.' || separator == '/' && has_half;
    let last_two = || digits(text, 2, 2).filter(|_| is_last);
    digits(text, 4, 4).or_else(|| Some(2000 + last_two()?))
}

/// Both readings of a date and time whose day and month could be either, the one that is taken first; `None` where only one
/// is a date, or both are the same.
pub(crate) fn readings(text: &str) -> Option<[String; 2]> {
    let (date, time) = text.trim().split_once([' ', 'T'])?;
    let separator = date.chars().find(|letter| "-/.:".contains(*letter))?;
    let parts: Vec<&str> = date.split(separator).collect();
    let [first, second, year] = parts.as_slice() else {
        return None;
    };
    let (a, b) = (digits(first, 1, 2)?, digits(second, 1, 2)?);
    let end = time.to_lowercase();
    let is_half = end.ends_with('m') || end.ends_with("m.");
    let year = year_of(year, separator, is_half)?;
    let is_either = a != b && (1..=12).contains(&a) && (1..=12).contains(&b);
    date_and_time(text).filter(|_| is_either)?;
    let written = |month: i64, day: i64| format!("{year}-{month:02}-{day:02}");
    let both = [written(a, b), written(b, a)];
    let is_month_first = separator == '/' || is_half;
    let [month_first, day_first] = both;
    Some(if is_month_first {
        [month_first, day_first]
    } else {
        [day_first, month_first]
    })
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
pub(crate) fn days_since_1970(year: i64, month: i64, day: i64) -> i64 {
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
        for text in [
            "2016:06:23 16:31:59",
            "2016-06-23T16:31:59Z",
            "2016-06-23T18:31:59+02:00",
            "2016-06-23 16:31:59 UTC",
            "2016/06/23 16:31:59",
            "2016/6/23 16:31:59",
            "23.06.2016 16:31:59",
            "6/23/2016 4:31:59 PM",
            "23/06/2016 16:31:59",
            "23.06.16 16:31:59",
            "6/23/2016 4:31:59 p.m.",
            "20160623T163159Z",
            "20160623 16:31:59",
            "2016-175T16:31:59Z",
            "2016/175 16:31:59",
            "2016:175:16:31:59",
            "2016-06-23-16-31-59",
            "2016-06-23_16:31:59",
            "23 Jun 2016 16:31:59",
            "Thu Jun 23 16:31:59 2016",
            "June 23, 2016 4:31:59 PM",
            "6/23/16 4:31:59 PM",
            "23/06/16 4:31:59 p.m.",
        ] {
            assert_eq!(date_and_time(text), expected, "{text}");
        }
        assert_eq!(
            date_and_time("2016-02-29 00:00:00.25"),
            Some(Moment::Absolute(1_456_704_000, 0.25))
        );
        for text in [
            "10:00:00.5",
            "10:00:00,5",
            "10:00:00:500",
            "10h0m0.5s",
            "0 days 10:00:00.5",
        ] {
            assert_eq!(date_and_time(text), Some(Moment::Absolute(36_000, 0.5)));
        }
        assert_eq!(date_and_time("12:00:01 AM"), Some(Moment::Absolute(1, 0.0)));
        assert_eq!(
            date_and_time("59:12.25"),
            Some(Moment::Absolute(3552, 0.25))
        );
        assert_eq!(
            date_and_time("9:12.5"),
            Some(Moment::Absolute(552, 0.5)),
            "before ten minutes"
        );
        for (text, seconds) in [("2m5s", 125), ("1h2m5s", 3725)] {
            assert_eq!(date_and_time(text), Some(Moment::Absolute(seconds, 0.0)));
        }
        // Years of two digits may be days; a number with a unit is a value.
        for text in [
            "24-05-13 10:00:00",
            "24/05/13 10:00:00",
            "5/13/24 10:00:00",
            "5-13-24 10:00:00 AM",
            "12345.5s",
            "2024-367 10:00:00",
            "2023-366 10:00:00",
            "1900-366 10:00:00",
            "2024.122 10:00:00",
            "10:20:30 10:20:31",
        ] {
            assert_eq!(date_and_time(text), None, "{text}");
        }
        assert_eq!(
            date_and_time("2024-366 10:00:00"),
            date_and_time("2024-12-31 10:00:00")
        );
        assert_eq!(of_clock_number(100_059.5), Some(36_059.5));
        assert_eq!(of_clock_number(100_060.0), None);
    }

    #[test]
    fn a_day_that_could_be_a_month_has_two_readings() {
        let both = |text| readings(text).map(|both| both.join(" or "));
        let found = both("5/1/2024 10:00:00 AM");
        assert_eq!(found.as_deref(), Some("2024-05-01 or 2024-01-05"));
        let found = both("5/1/24 10:00:00 AM");
        assert_eq!(found.as_deref(), Some("2024-05-01 or 2024-01-05"));
        let found = both("05.01.2024 10:00:00");
        assert_eq!(found.as_deref(), Some("2024-01-05 or 2024-05-01"));
        for text in [
            "13/1/2024 10:00:00",
            "5/5/2024 10:00:00",
            "2024-05-01 10:00:00",
            "10:00:00",
        ] {
            assert_eq!(both(text), None, "{text}");
        }
    }

    #[test]
    fn a_zone_is_told_by_letters_or_by_hours_from_greenwich() {
        for text in [
            "2016-06-23T16:31:59Z",
            "2016-06-23 16:31:59 UTC",
            "2016-06-23T16:31:59.5+02:00",
            "2016-06-23T16:31:59-0330",
            "20160623T163159Z",
        ] {
            assert!(has_zone(text), "{text}");
        }
        for text in [
            "2016-06-23T16:31:59",
            "2016:06:23 16:31:59",
            "5/1/2024 10:00:00 PM",
            "13-May-2024 10:00:00",
            "2016-06-23-16-31-59",
            "Z",
        ] {
            assert!(!has_zone(text), "{text}");
        }
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
            "13:00:00 PM",
            "47.5 8.25",
            "a:bb:cc d",
            "10:00:00,5,5",
        ] {
            assert_eq!(date_and_time(text), None, "{text}");
        }
    }
}
