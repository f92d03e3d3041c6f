//! The time of satellite receivers and that of the day.

/// Seconds from 1970-01-01 to 1980-01-06, when the weeks of GPS begin.
const FIRST_WEEK: f64 = 315_964_800.0;
const WEEK: f64 = 604_800.0;

/// Seconds since 1970 (UTC) at which GPS ran ahead of UTC by one second more: the leap seconds since 1980
/// (IERS Bulletin C).
const LEAPS: [u32; 18] = [
    362_793_600,   // 1981-07-01
    394_329_600,   // 1982-07-01
    425_865_600,   // 1983-07-01
    489_024_000,   // 1985-07-01
    567_993_600,   // 1988-01-01
    631_152_000,   // 1990-01-01
    662_688_000,   // 1991-01-01
    709_948_800,   // 1992-07-01
    741_484_800,   // 1993-07-01
    773_020_800,   // 1994-07-01
    820_454_400,   // 1996-01-01
    867_715_200,   // 1997-07-01
    915_148_800,   // 1999-01-01
    1_136_073_600, // 2006-01-01
    1_230_768_000, // 2009-01-01
    1_341_100_800, // 2012-07-01
    1_435_708_800, // 2015-07-01
    1_483_228_800, // 2017-01-01
];

/// Seconds since 1970 (UTC) of a week of GPS and the milliseconds since it began.
pub fn utc_of_gps(week: f64, milliseconds: f64) -> f64 {
    let ahead = FIRST_WEEK + WEEK * week + milliseconds / 1e3;
    let leaps = LEAPS.iter().zip(1_u8..);
    let passed =
        leaps.take_while(|(begins, count)| ahead >= f64::from(**begins) + f64::from(*count));
    ahead - passed.count() as f64
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn weeks_of_gps_are_dates_less_the_leap_seconds_so_far() {
        assert_eq!(utc_of_gps(0.0, 0.0), 315_964_800.0);
        // 2013-11-29 21:59:44 UTC, 16 leap seconds.
        assert_eq!(utc_of_gps(1768.0, 511_200_000.0), 1_385_762_384.0);
        // 2021-01-03 00:00:00 GPS, 18 leap seconds.
        assert_eq!(utc_of_gps(2139.0, 250.0), 1_609_631_982.25);
    }

    #[test]
    fn time_stands_still_for_the_leap_second_itself() {
        let new_year = (1_483_228_800.0 - FIRST_WEEK) / WEEK;
        let week = new_year.floor();
        let milliseconds = (new_year - week) * WEEK * 1e3;
        let at = |seconds: f64| utc_of_gps(week, (milliseconds + 1e3 * seconds).round());
        assert_eq!(at(16.0), 1_483_228_799.0);
        assert_eq!(at(17.5), 1_483_228_800.5);
        assert_eq!(at(18.0), 1_483_228_800.0);
        assert_eq!(at(19.0), 1_483_228_801.0);
    }
}
