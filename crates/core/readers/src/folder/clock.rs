//! Times as files write them.

use serde::{Deserialize, Serialize};

use crate::cells::Moment;
use crate::cells::number;
use crate::cells::{date_and_time, median, of_clock_number, shortened};

/// Format of a time column.
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
    /// Hundredths of seconds in the flight's time base.
    #[serde(rename = "cs")]
    Centiseconds,
    /// Hundreds of microseconds in the flight's time base.
    #[serde(rename = "100us")]
    HundredMicroseconds,
    /// Date and time as cameras write them, `2016:06:23 16:31:59`.
    #[serde(rename = "YYYY:MM:DD HH:MM:SS")]
    Camera,
    /// Date and time as in ISO 8601, `2016-06-23T16:31:59.5Z`.
    #[serde(rename = "iso")]
    Iso,
    /// Hours, minutes and seconds of the day in one number, `100059.5`.
    #[serde(rename = "hhmmss")]
    Clock,
    /// Days, as spreadsheets and MATLAB count dates.
    #[serde(rename = "d")]
    Days,
    /// Minutes with decimals in the flight's time base.
    #[serde(rename = "min")]
    Minutes,
    /// Hours with decimals in the flight's time base.
    #[serde(rename = "h")]
    Hours,
}

impl TimeFormat {
    /// Whether times are moments of a date or of a day, and count from no beginning of their own.
    pub fn is_absolute(self) -> bool {
        matches!(self, Self::Camera | Self::Iso | Self::Clock)
    }

    /// Reads a cell; the error says in words what is expected.
    pub fn parse(self, text: &str) -> Result<Moment, String> {
        let scaled = |scale: f64| {
            // A unit may stand behind it.
            let value = number(text, false)
                .ok_or_else(|| format!("\"{}\" is not a number", shortened(text)))?;
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
            Self::Centiseconds => scaled(1e-2),
            Self::HundredMicroseconds => scaled(1e-4),
            Self::Days => scaled(86_400.0),
            Self::Minutes => scaled(60.0),
            Self::Hours => scaled(3600.0),
            Self::Clock => number(text, false)
                .and_then(of_clock_number)
                .map(|seconds| Moment::Absolute(seconds.floor() as i64, seconds.fract()))
                .ok_or_else(|| {
                    let text = shortened(text);
                    format!("\"{text}\" is not hours, minutes and seconds such as 100059.5")
                }),
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

/// Counts on over midnight where times have no date: one that goes back from the last hour of a day to the first belongs
/// to the next day, and so do those behind it.
pub(super) fn count_midnights<'a>(moments: impl Iterator<Item = &'a mut Moment>) {
    const DAY: i64 = 86_400;
    const HOUR: i64 = 3600;
    let (mut days, mut before) = (0, None);
    for moment in moments {
        let Moment::Absolute(whole, _) = moment else {
            return;
        };
        // With a date times are far from 1970.
        if !(0..=DAY).contains(whole) {
            return;
        }
        if before.is_some_and(|before| before >= DAY - HOUR) && *whole < HOUR {
            days += 1;
        }
        before = Some(*whole);
        *whole += days * DAY;
    }
}

/// Counts on where a counter of 16 to 32 bits begins anew, as those of microseconds do after 72 minutes: it goes back from
/// less than three usual steps before its end to as little behind its beginning, which a restart does not.
pub(super) fn count_on<'a>(moments: impl Iterator<Item = &'a mut Moment>, format: TimeFormat) {
    let unit = match format {
        TimeFormat::Milliseconds => 1e-3,
        TimeFormat::Microseconds => 1e-6,
        TimeFormat::Centiseconds => 1e-2,
        TimeFormat::HundredMicroseconds => 1e-4,
        _ => return,
    };
    let mut times: Vec<&mut f64> = moments
        .filter_map(|moment| match moment {
            Moment::Relative(seconds) => Some(seconds),
            Moment::Absolute(..) => None,
        })
        .collect();
    let back: Vec<usize> = (1..times.len())
        .filter(|i| *times[*i] < *times[*i - 1])
        .collect();
    if back.is_empty() {
        return;
    }
    let most = times.iter().map(|time| **time).fold(0.0, f64::max);
    let Some(length) = [16, 24, 32]
        .into_iter()
        .map(|bits| unit * 2_f64.powi(bits))
        .find(|length| most < *length)
    else {
        return;
    };
    let steps = times.windows(2).map(|w| *w[1] - *w[0]);
    let usual = median(steps.filter(|step| *step > 0.0).collect()).unwrap_or(0.0);
    let near = 3.0 * usual;
    let is_begun = |i: &usize| {
        let (before, after) = (*times[*i - 1], *times[*i]);
        after >= 0.0 && before > length - near && after < near && near < 0.1 * length
    };
    let begun: Vec<usize> = back.into_iter().filter(is_begun).collect();
    for begin in begun {
        for time in &mut times[begin..] {
            **time += length;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn over_midnight(seconds: &[i64]) -> Vec<i64> {
        let mut moments: Vec<_> = seconds.iter().map(|s| Moment::Absolute(*s, 0.5)).collect();
        count_midnights(moments.iter_mut());
        let whole = moments.iter().map(|moment| match moment {
            Moment::Absolute(whole, _) => *whole,
            Moment::Relative(_) => -1,
        });
        whole.collect()
    }

    fn counted_on(times: &[f64], format: TimeFormat) -> Vec<f64> {
        let mut moments: Vec<_> = times.iter().map(|s| Moment::Relative(*s)).collect();
        count_on(moments.iter_mut(), format);
        moments.iter().map(|moment| moment.since(None)).collect()
    }

    #[test]
    fn a_counter_that_is_full_goes_on_from_there_and_a_restart_does_not() {
        for (format, length) in [
            (TimeFormat::Microseconds, 4_294.967_296),
            (TimeFormat::Milliseconds, 65.536),
            (TimeFormat::Milliseconds, 4_294_967.296),
        ] {
            let times: Vec<f64> = (0..40)
                .map(|i| (length - 2.0 + 0.1 * f64::from(i)) % length)
                .collect();
            let found = counted_on(&times, format);
            let is_even = found.windows(2).all(|w| (w[1] - w[0] - 0.1).abs() < 1e-6);
            assert!(is_even, "{length}: {found:?}");
        }
        let restart: Vec<f64> = (0..40).map(|i| 0.1 * f64::from(i % 20)).collect();
        assert_eq!(counted_on(&restart, TimeFormat::Milliseconds), restart);
        let seconds = [4294.9, 0.1];
        assert_eq!(counted_on(&seconds, TimeFormat::Seconds), seconds);
    }

    #[test]
    fn times_of_day_go_on_over_midnight_and_a_wrong_one_makes_no_day() {
        assert_eq!(
            over_midnight(&[86_398, 86_399, 0, 1]),
            [86_398, 86_399, 86_400, 86_401]
        );
        assert_eq!(
            over_midnight(&[36_000, 86_000, 36_001]),
            [36_000, 86_000, 36_001]
        );
        assert_eq!(over_midnight(&[36_000, 5, 36_001]), [36_000, 5, 36_001]);
        let dated = [1_700_000_000, 1_700_000_001];
        assert_eq!(over_midnight(&dated), dated);
    }
}
