//! Two heights above different zeros in one table, whose names do not say which is which: told apart by the start.

use pilotage_flight::ChannelName;

use super::header::parts;
use super::{ColumnRole, ColumnSample, MappedColumn};

const GPS: ColumnRole = ColumnRole::Channel(ChannelName::GpsHeight);
const ABOVE_START: ColumnRole = ColumnRole::Channel(ChannelName::HeightAboveGround);

/// Words of heights, and those that say from where they count.
const HEIGHTS: [&str; 5] = ["alt", "altitude", "height", "hgt", "elevation"];
const ZEROS: [&str; 18] = [
    "msl",
    "amsl",
    "sl",
    "sea",
    "gps",
    "geo",
    "geom",
    "geometric",
    "abs",
    "absolute",
    "ell",
    "ellipsoid",
    "ellipsoidal",
    "hae",
    "wgs84",
    "baro",
    "agl",
    "rel",
];
/// A flight begins within this of the height that counts from its start, metres.
const START: f64 = 5.0;
/// Heights that differ by less have one zero, metres: those of two sensors differ as well.
const APART: f64 = 20.0;

/// A height whose name does not say its zero.
struct BareHeight {
    column: usize,
    /// First value and what lies between the least and the greatest, metres.
    first: f64,
    reach: f64,
}

/// Gives the height that begins at zero, beside another that goes as it does, the role of that above the start; where both begin
/// elsewhere, the first stays. Returns a sentence with both readings.
pub(super) fn judge(samples: &[ColumnSample], columns: &mut [MappedColumn]) -> Option<String> {
    let has = |role| columns.iter().any(|column| column.role == role);
    let bare = |(column, sample): (usize, &ColumnSample)| {
        let words = parts(&sample.name, &sample.unit).words;
        let is_height = words.iter().any(|word| HEIGHTS.contains(&word.as_str()));
        let has_zero = words.iter().any(|word| ZEROS.contains(&word.as_str()));
        let of = &columns[column];
        let factor = of.role.factor(&of.unit)? * of.scale;
        let first = sample.numbers.iter().find(|value| value.is_finite())?;
        let (low, high) = sample.range()?;
        (of.role == GPS && is_height && !has_zero).then_some(BareHeight {
            column,
            first: first * factor,
            reach: (high - low) * factor.abs(),
        })
    };
    let found: Vec<BareHeight> = samples.iter().enumerate().filter_map(bare).collect();
    let is_said = columns.iter().enumerate().any(|(index, column)| {
        column.role == GPS && !found.iter().any(|height| height.column == index)
    });
    let [one, other] = &found[..] else {
        return None;
    };
    if is_said || (one.first - other.first).abs() < APART {
        return None;
    }
    let name = |height: &BareHeight| columns[height.column].name.clone();
    let readings = |taken: &str| {
        format!(
            "{} (begins at {:.0} m) and {} (begins at {:.0} m) count from different zeros, and their names do not say from which: {taken}",
            name(one),
            one.first,
            name(other),
            other.first
        )
    };
    let goes_alike = (one.reach - other.reach).abs() <= START + 0.2 * one.reach.max(other.reach);
    let low = [one, other]
        .into_iter()
        .find(|height| height.first.abs() <= START);
    match low.filter(|_| goes_alike && !has(ABOVE_START)) {
        Some(low) => {
            let told = readings(&format!("{} is taken for that above the start", name(low)));
            columns[low.column].role = ABOVE_START;
            Some(told)
        }
        None => Some(readings(&format!(
            "{} is taken for that of the receiver; if the other is meant, say so in the table of columns",
            name(one)
        ))),
    }
}

#[cfg(test)]
mod tests {
    use super::super::tests::files;
    use super::super::{flight_of_tables, guess_table};
    use pilotage_flight::ChannelName;

    /// A table of those two heights, which begin at `starts`.
    fn read(
        names: [&str; 2],
        starts: [f64; 2],
    ) -> (super::super::ColumnMap, pilotage_flight::Flight) {
        let row = |i: u32| {
            let (t, up) = (0.1 * f64::from(i), 0.2 * f64::from(i.min(100)));
            format!(
                "{t:.1},{:.6},8.5,{:.2},{:.2},{:.1}",
                47.0 + 1e-5 * t,
                starts[0] + up,
                starts[1] + up,
                3.0 * t
            )
        };
        let rows: Vec<String> = (0..200).map(row).collect();
        let text = format!(
            "time,lat,lon,{},{},heading\n{}\n",
            names[0],
            names[1],
            rows.join("\n")
        );
        let map = guess_table("a.csv", text.as_bytes()).unwrap();
        let files = files(&[("a.csv", &text)]);
        let flight = flight_of_tables(&files, std::slice::from_ref(&map))
            .unwrap()
            .flight;
        (map, flight)
    }

    #[test]
    fn of_two_heights_that_which_begins_at_zero_is_above_the_start() {
        for (names, starts) in [
            (["altitude_m", "alt_m"], [0.4, 512.0]),
            (["altitude_m", "alt_m"], [512.0, 0.4]),
            (["alt [ft]", "altitude"], [512.0 / 0.3048, 0.0]),
        ] {
            let (map, flight) = read(names, starts);
            let first = |name| flight.channel(name).unwrap().values[0];
            assert!(
                (first(ChannelName::GpsHeight) - 512.0).abs() < 1.0,
                "{names:?}"
            );
            assert!(
                first(ChannelName::HeightAboveGround).abs() < 1.0,
                "{names:?}"
            );
            let told = map.findings.join("; ");
            assert!(
                told.contains("512 m") && told.contains("different zeros"),
                "{told}"
            );
        }
    }

    #[test]
    fn two_heights_of_which_none_begins_at_zero_are_told_with_both_readings() {
        let (map, _) = read(["altitude_m", "alt_m"], [512.0, 640.0]);
        let told = map.findings.join("; ");
        assert!(told.contains("512 m") && told.contains("640 m"), "{told}");
        let (map, _) = read(["altitude_m", "alt_m"], [512.0, 514.0]);
        assert!(!map.findings.join("; ").contains("different zeros"));
        let (map, flight) = read(["alt_msl", "altitude"], [512.0, 0.0]);
        assert!(!map.findings.join("; ").contains("different zeros"));
        assert!((flight.channel(ChannelName::GpsHeight).unwrap().values[0] - 512.0).abs() < 1e-6);
    }
}
