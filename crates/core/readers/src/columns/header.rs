//! Names of columns taken apart: words and unit.

use crate::cells::Dimension;
use crate::cells::spellings::{LONG_TIMES, SPELLINGS, TIMES, find_in, is_unit, per_time, unit_in};

/// A name taken apart.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct NameParts {
    /// Its words in small letters, without what stands in brackets.
    pub words: Vec<String>,
    /// Text in brackets, or in the line of units, in small letters.
    pub unit: String,
}

/// Takes a name apart: `GyrX [rad/s]` is `gyr`, `x` in `rad/s`.
pub(super) fn parts(name: &str, unit: &str) -> NameParts {
    let (plain, in_name) = brackets(name);
    let beside = brackets(unit).1.unwrap_or_else(|| unit.to_owned());
    // A second line of names below the first is none of units: what the name states goes before it.
    let is_stated = |text: &str| is_unit(without_datum(&text.to_lowercase()));
    let is_told_by_name = in_name.as_deref().is_some_and(is_stated) && !is_unit(&beside);
    let unit = if beside.trim().is_empty() || is_told_by_name {
        in_name.unwrap_or_default()
    } else {
        beside
    };
    // What stands in brackets may count, as in `q[0]`.
    let is_count = |text: &str| text.len() == 1 && text.bytes().all(|b| b.is_ascii_digit());
    let (plain, unit) = if is_count(unit.trim()) {
        (format!("{plain} {unit}"), String::new())
    } else {
        (plain, unit)
    };
    let bare = unit
        .trim()
        .to_lowercase()
        .trim_matches(|c: char| "[](){} -".contains(c))
        .to_owned();
    let mut parts = NameParts {
        words: words(&plain),
        unit: without_datum(&bare).to_owned(),
    };
    parts.take_datum_of_unit();
    parts.name_velocity();
    parts
}

/// Directions of velocities over ground.
const DIRECTIONS: [&str; 4] = ["north", "east", "down", "up"];

/// A unit without what it counts from: `wgs84 ft`, `deg true`.
fn without_datum(unit: &str) -> &str {
    let unit = unit.strip_prefix("wgs84 ").unwrap_or(unit);
    unit.strip_suffix(" true").unwrap_or(unit)
}

/// A text without what stands in brackets, and that.
fn brackets(text: &str) -> (String, Option<String>) {
    for (open, close) in [('[', ']'), ('(', ')'), ('{', '}')] {
        if let Some((before, rest)) = text.split_once(open) {
            let (inside, after) = rest.split_once(close).unwrap_or((rest, ""));
            return (format!("{before} {after}"), Some(inside.to_owned()));
        }
    }
    (text.to_owned(), None)
}

/// Words of a name in small letters: `GPSAlt_m` is `gps`, `alt`, `m`.
fn words(name: &str) -> Vec<String> {
    let mut words: Vec<String> = vec![String::new()];
    let letters: Vec<char> = name.chars().collect();
    for (i, letter) in letters.iter().enumerate() {
        if !letter.is_alphanumeric() && *letter != '°' && *letter != 'µ' {
            words.push(String::new());
            continue;
        }
        let before = i.checked_sub(1).and_then(|i| letters.get(i));
        let after = letters.get(i + 1);
        let rises = before.is_some_and(|b| b.is_lowercase()) && letter.is_uppercase();
        let ends_run = before.is_some_and(|b| b.is_uppercase())
            && letter.is_uppercase()
            && after.is_some_and(|a| a.is_lowercase());
        if rises || ends_run {
            words.push(String::new());
        }
        if let Some(word) = words.last_mut() {
            word.extend(letter.to_lowercase());
        }
    }
    words.retain(|word| !word.is_empty());
    // One word for satellite navigation.
    for word in words.iter_mut().filter(|word| *word == "gnss") {
        "gps".clone_into(word);
    }
    // A message of MAVLink, and no place or height of its own: `GLOBAL_POSITION_INT.vz` is `vz`.
    if words.len() > 3 && words[..3] == ["global", "position", "int"] {
        words.drain(..3);
    }
    words
}

/// Zeros of heights, as their units say them.
const DATUMS: [&str; 4] = ["amsl", "msl", "agl", "hae"];

impl NameParts {
    /// Puts what a unit says that heights count from among the words of the name: `__alt,ftagl` of X-Plane is `alt`, `agl` in
    /// feet.
    fn take_datum_of_unit(&mut self) {
        let parted = |text: &str| {
            let datum = DATUMS.into_iter().find(|end| text.ends_with(end))?;
            let unit = text.strip_suffix(datum)?.trim_end();
            matches!(unit, "ft" | "m" | "feet").then(|| (unit.to_owned(), datum.to_owned()))
        };
        // `Alt (MSL)` has no unit at all.
        let alone = DATUMS.into_iter().find(|datum| self.unit == *datum);
        let alone = alone.map(|datum| (String::new(), datum.to_owned()));
        let found = alone.or_else(|| parted(&self.unit)).map(|(unit, datum)| {
            self.unit = unit;
            datum
        });
        let at_end = self.words.last().and_then(|last| parted(last));
        let found = found.or_else(|| {
            let (unit, datum) = at_end?;
            self.words.pop();
            self.unit = if self.unit.is_empty() {
                unit
            } else {
                std::mem::take(&mut self.unit)
            };
            Some(datum)
        });
        if let Some(datum) = found.filter(|datum| !self.words.contains(datum)) {
            self.words.push(datum);
        }
    }

    /// Calls a velocity so whose name has its unit before its direction: `gps_kph_east`.
    fn name_velocity(&mut self) {
        let [.., unit, direction] = self.words.as_mut_slice() else {
            return;
        };
        let known = unit_in(unit, Dimension::Speed).filter(|_| unit.len() > 2);
        if let Some(known) = known.filter(|_| DIRECTIONS.contains(&direction.as_str())) {
            "velocity".clone_into(unit);
            if self.unit.is_empty() {
                known.clone_into(&mut self.unit);
            }
        }
    }

    /// Words of the name besides the letter or number of an axis, and that letter: `GyrX` is `gyr` and `x`,
    /// `gyro_rad[0]` is `gyro` and `0`, `q1` is `q` and `1`.
    pub fn component(&self) -> Option<(Vec<String>, char)> {
        let is_axis =
            |word: &str| matches!(word, "x" | "y" | "z" | "w" | "0" | "1" | "2" | "3" | "4");
        let first = |word: &str| word.chars().next();
        let words = self.plain_words();
        let (last, before) = words.split_last()?;
        if is_axis(last) && words.len() > 1 || is_axis(last) && first(last)?.is_alphabetic() {
            let stem = Self {
                words: before.to_vec(),
                unit: String::new(),
            };
            return Some((stem.plain_words().to_vec(), first(last)?));
        }
        if is_axis(&words[0]) {
            return Some((words[1..].to_vec(), first(&words[0])?));
        }
        // `OSD.xSpeed` of DJI.
        let within = words
            .iter()
            .position(|word| matches!(word.as_str(), "x" | "y" | "z"));
        if let Some(at) = within.filter(|_| words.len() == 3) {
            let stem = [&words[..at], &words[at + 1..]].concat();
            return Some((stem, first(&words[at])?));
        }
        let letter = last.chars().next_back()?;
        let stem = &last[..last.len() - letter.len_utf8()];
        let mut axis = [0; 4];
        if !is_axis(letter.encode_utf8(&mut axis)) || stem.is_empty() {
            return None;
        }
        let mut stem_words = before.to_vec();
        stem_words.push(stem.to_owned());
        Some((stem_words, letter))
    }

    /// Unit that the name itself states, and the number of its last words that state it.
    fn suffix(&self, find: impl Fn(&str) -> Option<&'static str>) -> Option<(&'static str, usize)> {
        (1..=2).rev().find_map(|count| {
            let start = self
                .words
                .len()
                .checked_sub(count)
                .filter(|start| *start > 0)?;
            let last = &self.words[start..];
            find(&last.join("/"))
                .or_else(|| find(&last.join(" ")))
                .map(|unit| (unit, count))
        })
    }

    /// The unit that is stated for a column of that dimension; `None` if none is, or none that is known.
    pub fn unit(&self, dimension: Dimension) -> Option<&'static str> {
        let find = |text: &str| unit_in(text, dimension);
        let before_axis = || {
            let (last, words) = self.words.split_last()?;
            let is_axis = last.len() == 1 && "xyzw0123".contains(last.as_str());
            let words = words.to_vec();
            let parts = Self {
                words,
                unit: String::new(),
            };
            let found = parts.suffix(find).filter(|_| is_axis);
            found.map(|(unit, _)| unit).filter(|unit| unit.len() > 1)
        };
        find(&self.unit)
            .or_else(|| self.suffix(find).map(|(unit, _)| unit))
            .or_else(before_axis)
    }

    /// The unit of time that is stated.
    pub fn time_unit(&self) -> Option<&'static str> {
        find_in(&TIMES, &self.unit)
            .or_else(|| find_in(&LONG_TIMES, &self.unit))
            .or_else(|| {
                self.suffix(|text| find_in(&TIMES, text))
                    .map(|(unit, _)| unit)
            })
    }

    /// Words without those that say a unit.
    pub fn plain_words(&self) -> &[String] {
        let known = |text: &str| {
            let of_any = SPELLINGS.iter().chain(&TIMES).find(|(name, others)| {
                *name == text && name.len() > 1 || others.contains(&text) && text.len() > 1
            });
            let of_any = of_any.map(|(name, _)| *name).or_else(|| per_time(text));
            of_any.or(match text {
                "m" => Some("m"),
                _ => None,
            })
        };
        let count = self.suffix(known).map_or(0, |(_, count)| count);
        &self.words[..self.words.len() - count]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn words_of(name: &str) -> String {
        parts(name, "").words.join(" ")
    }

    #[test]
    fn names_are_taken_apart_at_every_seam() {
        assert_eq!(words_of("GPSAlt_m"), "gps alt m");
        assert_eq!(words_of("TimeUS"), "time us");
        assert_eq!(words_of("rel_alt (m)"), "rel alt");
        assert_eq!(words_of("GNSS_Lat"), "gps lat");
        assert_eq!(words_of("rollRate"), "roll rate");
        assert_eq!(
            words_of("/imu/angular_velocity.x"),
            "imu angular velocity x"
        );
        assert_eq!(words_of("GLOBAL_POSITION_INT.vz"), "vz");
    }

    #[test]
    fn a_unit_before_the_direction_of_a_velocity_is_its_unit() {
        let east = parts("gps_kph_east", "");
        assert_eq!(east.plain_words().join(" "), "gps velocity east");
        assert_eq!(east.unit(Dimension::Speed), Some("km/h"));
        assert_eq!(words_of("gps_pos_east"), "gps pos east");
    }

    #[test]
    fn an_axis_may_stand_within_a_name() {
        let component = |name| parts(name, "").component();
        let words = |words: [&str; 2]| words.map(str::to_owned).to_vec();
        assert_eq!(
            component("OSD.xSpeed [m/s]"),
            Some((words(["osd", "speed"]), 'x'))
        );
        assert_eq!(component("imu gyro x"), Some((words(["imu", "gyro"]), 'x')));
        assert_eq!(component("OSD.hSpeed [m/s]"), None);
    }

    #[test]
    fn units_stand_in_brackets_below_or_at_the_end_of_the_name() {
        let unit = |name, beside, dimension| parts(name, beside).unit(dimension);
        assert_eq!(unit("speed [km/h]", "", Dimension::Speed), Some("km/h"));
        assert_eq!(unit("Speed(KTS)", "", Dimension::Speed), Some("kt"));
        assert_eq!(unit("speed_m_s", "", Dimension::Speed), Some("m/s"));
        assert_eq!(unit("speed_ms", "", Dimension::Speed), Some("m/s"));
        assert_eq!(unit("roll", "[deg]", Dimension::Angle), Some("deg"));
        assert_eq!(unit("Yaw (°)", "", Dimension::Angle), Some("deg"));
        assert_eq!(unit("lat_degE7", "", Dimension::Angle), Some("deg1e7"));
        assert_eq!(
            unit("gyro_x (dps)", "", Dimension::AngularRate),
            Some("deg/s")
        );
        assert_eq!(unit("alt_ft", "", Dimension::Angle), None);
        assert_eq!(unit("m", "", Dimension::Length), None);
        assert_eq!(
            unit("GPS Altitude (ft)", "AltGPS", Dimension::Length),
            Some("ft")
        );
        assert_eq!(unit("AltMSL", "ft msl", Dimension::Length), Some("ft"));
        for beside in ["", "AltGPS"] {
            let altitude = unit("GPS Altitude (WGS84 ft)", beside, Dimension::Length);
            assert_eq!(altitude, Some("ft"));
        }
        assert_eq!(unit("Track (deg true)", "", Dimension::Angle), Some("deg"));
        assert_eq!(unit("VSpd", "fpm", Dimension::Speed), Some("ft/min"));
        assert_eq!(parts("TimeUS", "").time_unit(), Some("us"));
        assert_eq!(parts("time [s]", "").time_unit(), Some("s"));
        assert_eq!(parts("t", "ms").time_unit(), Some("ms"));
        assert_eq!(parts("time [min]", "").time_unit(), Some("min"));
        assert_eq!(parts("Time", "hours").time_unit(), Some("h"));
        assert_eq!(parts("Time_cs", "").time_unit(), Some("cs"));
        assert_eq!(parts("time_100us", "").time_unit(), Some("100us"));
        assert_eq!(parts("t [0.1 ms]", "").time_unit(), Some("100us"));
        assert_eq!(parts("lat_min", "").time_unit(), None);
    }

    #[test]
    fn words_of_a_unit_are_no_words_of_the_name() {
        let plain = |name: &str| parts(name, "").plain_words().join(" ");
        assert_eq!(plain("alt_agl_ft"), "alt agl");
        assert_eq!(plain("true_airspeed_m_s"), "true airspeed");
        assert_eq!(plain("velocity_n"), "velocity n");
        assert_eq!(plain("GyrX"), "gyr x");
    }
}
