//! Logs of several vehicles, one of which flies.

use pilotage_tests::logs::tlog::of_systems_7_and_9;

use super::folder::Folder;

#[test]
fn the_vehicle_that_is_asked_for_flies_in_each_command_and_another_is_refused_with_those_there_are()
{
    let folder = Folder::new("vehicles");
    folder.write("two.tlog", of_systems_7_and_9(200));
    for (vehicle, longitude) in [("7", 8.0), ("9", 9.0)] {
        let table = folder.run(&["export", "two.tlog", "--track", "ekf", "--vehicle", vehicle]);
        let table = table.expect("the track is written");
        let mut lines = table.lines();
        let head: Vec<&str> = lines.next().unwrap_or_default().split(',').collect();
        let column = head
            .iter()
            .position(|name| name.starts_with("lon"))
            .expect("longitudes");
        let row: Vec<&str> = lines.next_back().unwrap_or_default().split(',').collect();
        let last: f64 = row[column].parse().expect("a number");
        assert!((last - longitude).abs() < 1e-6, "{table}");
        let told = folder.run(&["inspect", "two.tlog", "--vehicle", vehicle]);
        let told = told.expect("it is looked into");
        assert!(told.contains(&format!("system {vehicle}")), "{told}");
    }
    for command in ["inspect", "export", "replay"] {
        let refused = folder.run(&[command, "two.tlog", "--vehicle", "8"]);
        let refused = refused.expect_err("there is none");
        assert!(
            refused.contains("system 7, system 9"),
            "{command}: {refused}"
        );
    }
}
