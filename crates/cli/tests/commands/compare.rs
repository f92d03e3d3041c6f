//! `pilotage compare` as a user calls it.

use super::folder::Folder;

#[test]
fn a_flight_of_any_world_is_compared_with_the_estimates_after_it_as_in_the_page() {
    let folder = Folder::new("compare");
    let text = folder
        .run(&["compare", "indoor-hall", "--estimators", "ekf"])
        .unwrap();
    let rows = text.lines().skip(1).map(|line| line[..30].trim());
    let rows: Vec<&str> = rows.collect();
    assert_eq!(rows, ["ekf multirotor", "ekf multirotor, smoothed"]);
}
