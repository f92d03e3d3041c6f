//! Rows of a receiver without a fix, which says 0° north, 0° east, no height and no speed.

use crate::folder::FlightFolder;
use pilotage_base::text::by_count;
use pilotage_flight::ChannelName;

/// Places further than this from the first are none, metres: a receiver without a fix says 0° north, 0° east.
pub(super) const FARTHEST: f64 = 1e6;

/// Leaves out the places that lie too far from the first, with the heights and velocities of the receiver at their times.
pub(super) fn leave_out_strays(folder: &mut FlightFolder, notes: &mut Vec<String>) {
    if folder.flight.frame_on_globe.is_none() {
        return;
    }
    let channels = &mut folder.flight.channels;
    let find = |name| channels.iter().position(|channel| channel.name == name);
    let pair = find(ChannelName::GpsNorth).zip(find(ChannelName::GpsEast));
    let Some((north, east)) = pair else { return };
    let places = channels[north].values.iter().zip(&channels[east].values);
    let strays: Vec<f64> = channels[north]
        .times
        .iter()
        .zip(places)
        .filter(|(_, (north, east))| north.hypot(**east) > FARTHEST)
        .map(|(time, _)| *time)
        .collect();
    if strays.is_empty() {
        return;
    }
    let of_receiver = [
        ChannelName::GpsNorth,
        ChannelName::GpsEast,
        ChannelName::GpsHeight,
        ChannelName::GpsVelocityNorth,
        ChannelName::GpsVelocityEast,
        ChannelName::GpsVelocityDown,
    ];
    let is_kept = |time: &f64| {
        strays
            .binary_search_by(|stray| stray.total_cmp(time))
            .is_err()
    };
    for channel in channels
        .iter_mut()
        .filter(|channel| of_receiver.contains(&channel.name))
    {
        let kept: Vec<bool> = channel.times.iter().map(is_kept).collect();
        // A flight needs something to begin with.
        if !kept.contains(&true) {
            continue;
        }
        for series in [&mut channel.times, &mut channel.values] {
            let mut kept = kept.iter().copied();
            series.retain(|_| kept.next().unwrap_or(true));
        }
    }
    notes.push(format!(
        "{} {} over {:.0} km from the first",
        strays.len(),
        by_count(
            strays.len(),
            "place was left out, with what the receiver told beside it, as it lies",
            "places were left out, with what the receiver told beside them, as they lie"
        ),
        1e-3 * FARTHEST
    ));
}

#[cfg(test)]
mod tests {
    use super::super::tests::files;
    use super::super::{flight_of_tables, guess_table};
    use super::*;

    #[test]
    fn before_its_first_fix_a_receiver_has_no_height_and_no_velocity() {
        let row = |i: u32| {
            let t = 0.1 * f64::from(i);
            if i < 40 {
                return format!("{t:.1},0.000000,0.000000,0.0,0.0,0.0,{:.1}", 3.0 * t);
            }
            let (north, climb) = (12.0 * (t - 4.0), 0.5 * (t - 4.0));
            format!(
                "{t:.1},{:.7},8.5,{:.2},12.0,0.0,{:.1}",
                47.0 + north / 111_195.0,
                600.0 + climb,
                3.0 * t
            )
        };
        let rows: Vec<String> = (0..200).map(row).collect();
        let names = "time,lat,lon,gps_alt [m],ground_speed [m/s],course [deg],roll [deg]";
        let text = format!("{names}\n{}\n", rows.join("\n"));
        let map = guess_table("a.csv", text.as_bytes()).unwrap();
        let folder = flight_of_tables(&files(&[("a.csv", &text)]), &[map]).unwrap();
        for name in [
            ChannelName::GpsNorth,
            ChannelName::GpsHeight,
            ChannelName::GpsVelocityNorth,
        ] {
            let channel = folder.flight.channel(name).unwrap();
            assert_eq!(channel.times.len(), 160, "{name:?}");
            assert!((channel.times[0] - 4.0).abs() < 1e-9, "{name:?}");
        }
        let heights = &folder
            .flight
            .channel(ChannelName::GpsHeight)
            .unwrap()
            .values;
        assert!(heights.iter().all(|height| *height >= 600.0));
        let roll = folder.flight.channel(ChannelName::Roll).unwrap();
        assert_eq!(roll.times.len(), 200);
        assert!(
            folder
                .notes
                .iter()
                .any(|note| note.starts_with("40 places")),
            "{:?}",
            folder.notes
        );
    }
}
