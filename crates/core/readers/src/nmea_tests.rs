//! Recordings made here, sentence by sentence.

use super::*;
use pilotage_flight::ChannelName;

fn sentence(body: &str) -> String {
    let sum = body.bytes().fold(0, |sum, byte| sum ^ byte);
    format!("${body}*{sum:02X}\r\n")
}

/// Southward and down at 36 km/h from 33° 30' S, 70° 30' W, over midnight.
fn recording() -> String {
    let mut text = sentence("GPTXT,01,01,02,u-blox");
    for i in 0..60_u32 {
        let clock = if i < 30 {
            format!("2359{:02}.00", 30 + i)
        } else {
            format!("0000{:02}.00", i - 30)
        };
        let date = if i < 30 { "311223" } else { "010124" };
        let minutes = 30.0 + 10.0 / 1848.0 * f64::from(i);
        let height = 900.0 - f64::from(i);
        let place = format!("33{minutes:07.4},S,07030.0000,W");
        text += &sentence(&format!(
            "GNGGA,{clock},{place},1,12,0.8,{height:.1},M,24.0,M,,"
        ));
        text += &sentence(&format!("GNRMC,{clock},A,{place},19.438,180.0,{date},,,A"));
        text += &sentence("GNVTG,180.0,T,,M,19.438,N,36.0,K,A");
    }
    text
}

#[test]
fn sentences_with_short_names_may_be_most() {
    let text: String = (recording().lines())
        .map(|line| line.to_owned() + "\r\n" + &sentence("D,11.25,97863.281,,,656.0").repeat(5))
        .collect();
    assert!(is_nmea(text.as_bytes()));
    assert!(read_nmea("a.nmea", text.as_bytes()).unwrap().is_some());
}

#[test]
fn sentences_are_a_flight_with_heights_and_speeds_over_midnight() {
    let text = recording();
    assert!(is_nmea(text.as_bytes()));
    let folder = read_nmea("flight.nmea", text.as_bytes()).unwrap().unwrap();
    let flight = &folder.flight;
    let (first, last) = flight.span();
    assert!((last - first - 59.0).abs() < 1e-9, "{first} {last}");
    // 31 December 2023, 23:59:30.
    let utc = folder.log().utc_at_zero.unwrap() + first;
    assert_eq!(utc, 1_704_067_170.0);
    let origin = flight.frame_on_globe.unwrap().origin;
    assert!((origin.latitude.to_degrees() + 33.5).abs() < 1e-9);
    assert!((origin.longitude.to_degrees() + 70.5).abs() < 1e-9);
    let last = |name| *flight.channel(name).unwrap().values.last().unwrap();
    assert!((last(ChannelName::GpsNorth) + 590.0).abs() < 1.0);
    assert!((last(ChannelName::GpsHeight) - 841.0).abs() < 1e-9);
    assert!((last(ChannelName::GpsVelocityNorth) + 10.0).abs() < 0.01);
}

#[test]
fn damaged_sentences_and_those_without_a_fix_are_left_out_and_told() {
    let text = recording().replacen("33.4", "33.5", 1) + &recording().replace("GNGGA", "GNGGB");
    let read = sentences(&text);
    assert_eq!(read.damaged, 60);
    let unfixed = recording().replace(",A,33", ",V,33");
    let unfixed: String = unfixed
        .lines()
        .filter(|line| line.contains("RMC"))
        .map(|line| sentence(&line[1..line.len() - 3]))
        .collect();
    assert!(read_nmea("a.nmea", unfixed.as_bytes()).unwrap().is_none());
}

#[test]
fn a_sentence_that_is_cut_off_is_left_out_and_told_where_others_have_sums() {
    let fix = |i: u32| {
        sentence(&format!(
            "GPGGA,1200{i:02}.00,4730.{i:02}0,N,00830.000,E,1,8,1,440.5,M,47.0,M,,"
        ))
    };
    let text: String = (0..10).map(fix).collect();
    let begin = text.rfind('$').unwrap();
    for cut in begin + 1..text.rfind('*').unwrap() + 3 {
        let read = sentences(&text[..cut]);
        assert_eq!(
            (read.epochs.len(), read.damaged),
            (9, 1),
            "{}",
            &text[begin..cut]
        );
    }
    let bare: String = text
        .lines()
        .map(|line| line[..line.len() - 3].to_owned() + "\n")
        .collect();
    assert_eq!(sentences(&bare).epochs.len(), 10);
}

#[test]
fn check_sums_of_some_kinds_of_sentences_do_not_condemn_the_others() {
    let bare = |line: &str| line.trim_end()[..line.trim_end().len() - 3].to_owned() + "\n";
    let epoch = |i: u32| {
        let place = format!("1200{i:02}.00");
        let fix = sentence(&format!(
            "GPGGA,{place},4730.0{i:02},N,00830.000,E,1,8,1,440.5,M,47.0,M,,"
        ));
        let others = ["GPRMC", "GPGSA", "GPGSV"].map(|kind| {
            sentence(&format!(
                "{kind},{place},A,4730.0{i:02},N,00830.000,E,1,2,130524,,"
            ))
        });
        bare(&fix) + &others.concat()
    };
    let text: String = (0..10).map(epoch).collect();
    let read = sentences(&text);
    assert_eq!((read.epochs.len(), read.damaged), (10, 0));
    assert!(
        read.epochs
            .iter()
            .all(|epoch| epoch.values[2] == Some(440.5))
    );
    let begin = text.rfind("$GPRMC").unwrap();
    assert_eq!(sentences(&text[..begin + 40]).damaged, 1);
}

#[test]
fn a_velocity_that_comes_before_the_place_of_its_moment_is_of_that_moment() {
    let places = |i: u32| {
        let place = format!("4730.{i:02}0,N,00830.000,E");
        sentence(&format!(
            "GPGGA,1200{i:02}.00,{place},1,8,1,440.5,M,47.0,M,,"
        ))
    };
    let velocity = |i: u32| sentence(&format!("GPVTG,0.0,T,,M,{i}.0,N,,K,A"));
    let speeds = |text: String| -> Vec<Option<f64>> {
        let epochs = sentences(&text).epochs;
        epochs.iter().map(|epoch| epoch.values[3]).collect()
    };
    let expected: Vec<_> = (0..9).map(|i| Some(f64::from(i) * MPS_PER_KNOT)).collect();
    let before = (0..9).map(|i| velocity(i) + &places(i)).collect();
    assert_eq!(speeds(before), expected);
    let behind = (0..9).map(|i| places(i) + &velocity(i)).collect();
    assert_eq!(speeds(behind), expected);
    // A recording that begins within a moment: the last of its sentences is behind a place, and later before one.
    let within = velocity(7) + &(0..9).map(|i| places(i) + &velocity(i)).collect::<String>();
    assert_eq!(speeds(within), expected);
}

#[test]
fn a_recording_that_begins_and_ends_within_a_moment_keeps_its_velocities_in_place() {
    // Northward from rest, faster by a knot every second.
    let place = |kind: &str, i: u32| {
        let metres = 0.5 * MPS_PER_KNOT * f64::from(i * i);
        let place = format!("47{:08.5},N,00830.00000,E", 30.0 + metres / 1853.25);
        sentence(&match kind {
            "GGA" => format!("GPGGA,1200{i:02}.00,{place},1,8,1,440.5,M,47.0,M,,"),
            _ => format!("GPRMC,1200{i:02}.00,A,{place},,,130524,,"),
        })
    };
    let velocity = |i: u32| sentence(&format!("GPVTG,0.0,T,,M,{i}.0,N,,K,A"));
    let all = |of: &dyn Fn(u32) -> String| (1..20).map(of).collect::<String>();
    let leading = all(&|i| velocity(i) + &place("GGA", i));
    let following =
        velocity(0) + &all(&|i| place("GGA", i) + &velocity(i)).replace(&velocity(19), "");
    let amid = velocity(0)
        + &all(&|i| place("GGA", i) + &velocity(i) + &place("RMC", i)).replace(&velocity(19), "");
    let behind_both = velocity(0)
        + &all(&|i| place("GGA", i) + &place("RMC", i) + &velocity(i)).replace(&velocity(19), "");
    for text in [leading, following, amid, behind_both] {
        let epochs = sentences(&text).epochs;
        for (i, epoch) in (1..20).zip(&epochs).take(18) {
            let said = epoch.values[3].unwrap();
            assert!(
                (said - MPS_PER_KNOT * f64::from(i)).abs() < 1e-9,
                "{i}: {text}"
            );
        }
    }
}

#[test]
fn two_receivers_with_some_times_in_common_and_over_days_are_told_apart() {
    let of = |talker: &str, clock: &str, minutes: f64| {
        sentence(&format!(
            "{talker}GGA,{clock},47{minutes:08.5},N,00830.00000,E,1,8,1,440.5,M,47.0,M,,"
        ))
    };
    for share in [0, 1, 3, 15, 30] {
        // Two days, at the same times of each.
        let mut text = String::new();
        for i in 0..60 {
            let minutes = 30.0 + 0.01 * f64::from(i);
            let clock = |part: u32| format!("{:02}{:02}00.{part}0", 24 * i / 60, 24 * i % 60);
            text += &of("GP", &clock(0), minutes);
            if i % 2 == 0 {
                text += &of(
                    "GN",
                    &clock(if i < 2 * share { 0 } else { 5 }),
                    minutes + 0.1,
                );
            }
        }
        let twice = text.clone() + &text;
        let once = sentences(&text).others;
        let [once, twice] = [once, sentences(&twice).others].map(|told| told.concat());
        if share == 30 {
            assert_eq!((once.as_str(), twice.as_str()), ("", ""));
        } else {
            assert!(
                once.contains("30 places of GN") && once.contains("60 of GP"),
                "{once}"
            );
            assert!(
                twice.contains("60 places of GN") && twice.contains("120 of GP"),
                "{twice}"
            );
        }
    }
}

#[test]
fn of_two_receivers_in_turn_the_one_with_most_places_counts() {
    let of = |talker: &str, tenth: u32, minutes: f64| {
        let clock = format!("1200{:02}.{}0", tenth / 10, tenth % 10);
        sentence(&format!(
            "{talker}GGA,{clock},47{minutes:08.5},N,00830.00000,E,1,8,1,440.5,M,47.0,M,,"
        ))
    };
    // 18.5 m/s northward, the second half a second later; it is lost from second 40 on.
    let read = |second: &str, apart: f64| {
        let mut text = String::new();
        for i in 0..60 {
            let minutes = 30.0 + 0.01 * f64::from(i);
            text += &of("GP", 10 * i, minutes);
            if i < 40 {
                text += &of(second, 10 * i + 5, minutes + 0.005 + apart);
            }
        }
        sentences(&text)
    };
    let two = read("GN", 0.1);
    assert_eq!(two.epochs.len(), 60);
    assert!(
        two.others[0].contains("40 places of GN are left out"),
        "{:?}",
        two.others
    );
    // One receiver that names itself after the satellites that it uses makes one track.
    let one = read("GN", 0.0);
    assert_eq!((one.epochs.len(), one.others.len()), (100, 0));
}

#[test]
fn heights_in_feet_and_dates_alone_are_read() {
    let text = sentence("GPZDA,120000.00,13,05,2024,00,00")
        + &sentence("GPGGA,120000.00,4730.000,N,00830.000,E,1,8,1,1000.0,F,47.0,M,,");
    let read = sentences(&text);
    assert_eq!(read.epochs.len(), 1);
    assert_eq!(read.epochs[0].day, Some(days_since_1970(2024, 5, 13)));
    assert!((read.epochs[0].values[2].unwrap() - 304.8).abs() < 1e-9);
}

#[test]
fn a_receiver_without_dates_goes_on_over_midnight() {
    let text = recording();
    let fixes = text.lines().filter(|line| line.contains("GGA"));
    let alone: Vec<String> = fixes.map(|line| format!("12:00:01 {line}")).collect();
    let alone = alone.join("\n");
    let folder = read_nmea("a.nmea", alone.as_bytes()).unwrap().unwrap();
    assert_eq!(folder.log().utc_at_zero, None);
    let (first, last) = folder.flight.span();
    assert!((last - first - 59.0).abs() < 1e-9, "{first} {last}");
}

#[test]
fn sentences_of_several_systems_and_of_places_alone_are_read() {
    let of = |kinds: &[&str]| {
        let mut text = String::new();
        for (i, kind) in (0..3).flat_map(|i| kinds.iter().map(move |kind| (i, *kind))) {
            let place = format!("4730.{i}00,N,00830.000,W");
            let own = match kind {
                "GNS" => format!("GNGNS,12000{i}.00,{place},AN,12,0.8,440.5,47.0,,"),
                "GLL" => format!("GPGLL,{place},12000{i}.00,A,A"),
                // Another receiver, a minute of arc beside.
                _ => {
                    format!("GLGGA,12000{i}.00,4731.{i}00,N,00830.000,W,1,8,1,99.0,M,47.0,M,,")
                }
            };
            for line in sentence(&own).lines() {
                text += "2024-05-13 12:00:00 ";
                text += line;
                text += "\n";
            }
        }
        assert!(is_nmea(text.as_bytes()), "{kinds:?}");
        read_nmea("a.nmea", text.as_bytes())
            .unwrap()
            .unwrap()
            .flight
    };
    for kinds in [&["GNS"][..], &["GLL"], &["GNS", "GGA"]] {
        let flight = of(kinds);
        let origin = flight.frame_on_globe.unwrap().origin;
        assert!(
            (origin.latitude.to_degrees() - 47.5).abs() < 1e-9,
            "{kinds:?}"
        );
        assert!((origin.longitude.to_degrees() + 8.5).abs() < 1e-9);
        let height = flight.channel(ChannelName::GpsHeight).map(|c| c.values[0]);
        assert_eq!(height, kinds.contains(&"GNS").then_some(440.5), "{kinds:?}");
    }
}

#[test]
fn tables_and_texts_are_no_sentences() {
    for text in ["time,lat\n0,47\n", "$5 for GGA,1\n", "$GPGSV,1\n", ""] {
        assert!(!is_nmea(text.as_bytes()), "{text}");
    }
}

#[test]
fn dates_of_a_receiver_whose_weeks_may_have_begun_again_are_told() {
    let text = |year: &str| {
        let row = |second: u32| {
            let place = format!("4807.{second:03},N,01131.000,E");
            sentence(&format!(
                "GPRMC,1235{second:02},A,{place},022.4,084.4,1705{year},,"
            ))
        };
        (0..20).map(row).collect::<String>()
    };
    let is_told = |year: &str| {
        let folder = read_nmea("a.nmea", text(year).as_bytes()).unwrap().unwrap();
        folder
            .notes
            .iter()
            .any(|note| note.contains("weeks that have begun again"))
    };
    // 1024 weeks before January 2024 is June 2004.
    assert!(is_told("04"));
    assert!(!is_told("24"));
}

#[test]
fn headings_and_attitudes_of_receivers_with_two_antennas_are_read() {
    // Southward with the nose 10° to the west of it, 5° to the right and 3° up.
    for has_attitude in [false, true] {
        let line = |line: &str| {
            let clock = line.split(',').nth(1).unwrap_or("");
            let told = if has_attitude {
                sentence(&format!(
                    "PASHR,{clock},190.00,T,5.00,3.00,0.00,0.1,0.1,0.2,2,1"
                ))
            } else {
                sentence("GNHDT,190.00,T")
            };
            let told = if line.contains("RMC") {
                told
            } else {
                String::new()
            };
            format!("{line}\r\n{told}")
        };
        let text: String = recording().lines().map(line).collect();
        assert!(is_nmea(text.as_bytes()));
        let folder = read_nmea("a.nmea", text.as_bytes()).unwrap().unwrap();
        let angle = |name, degrees: f64| {
            let channel = folder.flight.channel(name)?;
            assert_eq!(channel.values.len(), 60);
            let off = |value: &f64| (value.to_degrees() - degrees).rem_euclid(360.0);
            let is_it = |value| off(value) < 1e-6 || off(value) > 360.0 - 1e-6;
            Some(channel.values.iter().all(is_it))
        };
        assert_eq!(angle(ChannelName::Heading, 190.0), Some(true));
        let both = [(ChannelName::Roll, 5.0), (ChannelName::Pitch, 3.0)];
        for (name, degrees) in both {
            assert_eq!(angle(name, degrees), has_attitude.then_some(true));
        }
    }
}
