//! Tables as home-made recorders and small autopilots write them: zones of UTM, dates of a receiver beside another clock,
//! degrees a hundred million times, kinematics.

use pilotage_flight::ChannelName;

use super::ColumnRole::{Channel, Latitude, Longitude};
use super::tests::files;
use super::{ColumnRole, flight_of_tables, guess_table};
use crate::folder::FlightFolder;

fn flown(table: &str) -> FlightFolder {
    let files = files(&[("a.csv", table)]);
    let maps = [guess_table("a.csv", table.as_bytes()).unwrap()];
    flight_of_tables(&files, &maps).unwrap()
}

/// A table of those names whose rows `row` makes of tenths of seconds.
fn table(names: &str, row: impl Fn(f64) -> String) -> String {
    let rows = (0..100).map(|i| row(0.1 * f64::from(i)));
    format!("{names}\n{}\n", rows.collect::<Vec<_>>().join("\n"))
}

#[test]
fn a_flight_in_a_zone_of_utm_is_where_it_was() {
    let text = table("time,utm_e,utm_n,utm_zone,heading", |t| {
        format!(
            "{t:.1},{:.3},{:.3},19H,{:.1}",
            360_505.620 + 12.0 * t,
            6_303_362.288 + 3.0 * t,
            76.0 + t
        )
    });
    let folder = flown(&text);
    let origin = folder.flight.frame_on_globe.unwrap().origin;
    assert!((origin.latitude.to_degrees() + 33.4).abs() < 3e-7);
    assert!((origin.longitude.to_degrees() + 70.5).abs() < 3e-7);
    let truth = folder.flight.truth.unwrap();
    let way = (truth.states[99].position - truth.states[0].position)
        .xy()
        .norm();
    // The zone's scale is 0.9996 and 240e-6 there.
    assert!((way - 9.9 * 12.369).abs() < 0.1, "{way}");
}

#[test]
fn a_date_of_the_receiver_beside_another_clock_is_told_as_supposed() {
    for (names, date) in [
        (
            "GPS_year,GPS_month,GPS_day,GPS_hour,GPS_minute,GPS_second",
            "2024,5,1,10,0,",
        ),
        ("gps_date,gps_time", "2024-05-01,10:00:0"),
    ] {
        let text = table(&format!("time [s],lat,lon,heading,{names}"), |t| {
            format!(
                "{:.1},{:.6},8.0,{:.1},{date}{}",
                200.0 + t,
                47.0 + 1e-4 * t,
                5.0 * t,
                t as u32
            )
        });
        let folder = flown(&text);
        assert!(
            folder
                .notes
                .iter()
                .any(|n| n.contains("supposed to be universal time")),
            "{:?}",
            folder.notes
        );
        let (first, last) = folder.flight.span();
        assert!(
            (last - first - 9.9).abs() < 1e-6,
            "{names}: {first} to {last}"
        );
        let utc = folder.utc_at_zero().unwrap() + first;
        assert!((utc - 1_714_557_600.0).abs() < 1.0, "{names}: {utc}");
    }
}

#[test]
fn degrees_a_hundred_million_times_are_places() {
    let text = table(
        "timestamp,latitude_deg_1e8,longitude_deg_1e8,heading",
        |t| {
            format!(
                "{t:.1},{:.0},{:.0},{:.1}",
                -33.85e8 + 1e4 * t,
                18.42e8,
                5.0 * t
            )
        },
    );
    let map = guess_table("a.csv", text.as_bytes()).unwrap();
    for role in [Latitude, Longitude] {
        assert_eq!(map.column(role).unwrap().unit, "deg1e8");
    }
    let origin = flown(&text).flight.frame_on_globe.unwrap().origin;
    assert!((origin.latitude.to_degrees() + 33.85).abs() < 1e-8);
    assert!((origin.longitude.to_degrees() - 18.42).abs() < 1e-8);
}

#[test]
fn kinematics_of_configurators_are_roll_pitch_and_heading() {
    let text = table(
        "timestamp,gyroscopeX,kinematicsX,kinematicsY,kinematicsZ",
        |t| {
            format!(
                "{:.0},0.1,{:.1},{:.1},{:.0}",
                1000.0 * t,
                20.0 * t.sin(),
                5.0 * t.cos(),
                10.0 * t
            )
        },
    );
    let map = guess_table("a.csv", text.as_bytes()).unwrap();
    for (role, name) in [
        (ChannelName::Roll, "kinematicsX"),
        (ChannelName::Pitch, "kinematicsY"),
        (ChannelName::Heading, "kinematicsZ"),
    ] {
        let column = map.column(Channel(role)).unwrap();
        assert_eq!((column.name.as_str(), column.unit.as_str()), (name, "deg"));
    }
}

#[test]
fn a_receiver_that_says_no_yaw_tells_no_heading() {
    let text = table("GPS.TimeUS,GPS.Lat,GPS.Lng,GPS.Yaw", |t| {
        format!("{:.0},{:.7},8.0,0", 1e6 * t, 47.0 + 1e-5 * t)
    });
    let map = guess_table("a.csv", text.as_bytes()).unwrap();
    assert!(
        map.column(ColumnRole::Channel(ChannelName::Heading))
            .is_none()
    );
}
