//! `pilotage rehearse` over a small map, as a user calls it.

use pilotage_core::frames::{GroundPoint, GroundRect};
use pilotage_core::mission::{Mission, Route};
use serde_json::Value;

use super::folder::Folder;
use super::plan::{mission, placed, saved};

const FILE: &str = "small.pilotage.zip";

impl Folder {
    /// A folder with a mission of two routes: a line over two landmarks, and half of it.
    fn with_routes(name: &str) -> Self {
        let mut two = mission();
        let mut half = Route {
            id: 2,
            name: "Half".to_owned(),
            ..two.routes[0].clone()
        };
        half.way_points[1].position.east = 0.0;
        two.routes.push(half);
        Self::with_mission(name, two)
    }

    fn with_mission(name: &str, mission: Mission) -> Self {
        let folder = Self::new(&format!("rehearse-{name}"));
        folder.write(FILE, saved(mission, placed()));
        folder
    }

    fn rehearse(&self, words: &[&str]) -> Result<String, String> {
        self.run(&[&["rehearse", "--mission", FILE], words].concat())
    }

    fn rehearsed(&self, words: &[&str]) -> Value {
        let said = self.rehearse(&[&["--json"], words].concat());
        let said = said.expect("a rehearsal");
        serde_json::from_str(&said).expect("nothing but JSON")
    }
}

fn number(of: &Value, name: &str) -> f64 {
    let value = of[name].as_f64();
    value.unwrap_or_else(|| panic!("{name} in {of}"))
}

#[test]
fn flights_are_told_by_seed_and_sum_up_to_all_of_them_and_a_word_on_the_prediction() {
    let folder = Folder::with_routes("sums");
    let told = folder.rehearsed(&["--no-pictures", "--seeds", "3..9"]);
    assert_eq!(told["pictures"], false);
    let (all, flights) = (&told["together"], told["flights"].as_array().unwrap());
    let seeds: Vec<f64> = flights.iter().map(|it| number(it, "seed")).collect();
    assert_eq!(seeds, [3.0, 4.0, 5.0, 6.0, 7.0, 8.0]);
    assert_eq!(number(all, "flights"), 6.0);
    for name in ["frames", "corrected"] {
        let sum: f64 = flights.iter().map(|it| number(it, name)).sum();
        assert!(sum > 0.0 && number(all, name) == sum, "{name}: {told}");
    }
    let weighted = |name: &str, power: i32| {
        let of = |it: &Value| number(it, "frames") * number(it, name).powi(power);
        flights.iter().map(of).sum::<f64>() / number(all, "frames")
    };
    let share = number(all, "inside_corridor");
    assert!(
        (share - weighted("inside_corridor", 1)).abs() < 1e-9,
        "{told}"
    );
    let rms = number(all, "rms_m");
    assert!((rms - weighted("rms_m", 2).sqrt()).abs() < 1e-9, "{told}");
    // Six flights differ, but by little.
    let error = |it: &&Value| number(it, "largest_m");
    let worst = flights.iter().max_by(|a, b| error(a).total_cmp(&error(b)));
    let worst = worst.unwrap();
    assert_eq!(all["largest_seed"], worst["seed"]);
    for name in ["largest_m", "largest_at_m"] {
        assert_eq!(all[name], worst[name], "{name}");
    }
    assert!(
        (0.0..=260.0).contains(&number(all, "largest_at_m")),
        "{told}"
    );
    // The word is that of the share and its scatter.
    let margin = number(all, "inside_corridor_margin").max(2.0 * 0.05 / 6.0);
    let word = match share - 0.95 {
        off if off < -margin => "too_good",
        off if off > margin => "too_bad",
        _ => "holds",
    };
    assert_eq!(all["prediction"], word, "{told}");
}

#[test]
fn a_route_is_chosen_by_name_and_one_that_is_not_there_is_refused_with_those_that_are() {
    let folder = Folder::with_routes("names");
    let frames = |route: &[&str]| {
        let words = [&["--no-pictures", "--seeds", "1..2"], route].concat();
        number(&folder.rehearsed(&words)["together"], "frames")
    };
    let (line, half) = (frames(&[]), frames(&["--route", "Half"]));
    assert_eq!(line, frames(&["--route", "Line"]));
    assert!(half < 0.7 * line, "{half} of {line}");
    let refused = folder.rehearse(&["--route", "Back"]).unwrap_err();
    assert!(refused.contains("\"Line\", \"Half\""), "{refused}");
    let refused = folder.rehearse(&["--seeds", "5..5"]).unwrap_err();
    assert!(refused.contains("--seeds"), "{refused}");
}

#[test]
fn with_pictures_landmarks_of_the_map_in_the_file_are_found_on_another_day() {
    let mut calm = mission();
    calm.navigator.start.wind = 0.5;
    let starts = GroundPoint::new(0.0, -90.0);
    calm.landmarks[0].bounds = GroundRect::centered(starts, 24.0, 24.0);
    let folder = Folder::with_mission("pictures", calm);
    let said = folder.rehearse(&["--seeds", "1..4"]).unwrap();
    let lines: Vec<&str> = said.lines().collect();
    let [first, _, _, all, word] = lines[..] else {
        panic!("{said}");
    };
    assert!(
        first.starts_with("seed 1: ") && all.starts_with("3 flights: "),
        "{said}"
    );
    assert_eq!(word, "Too few flights to say whether the prediction holds.");
    let corrected = all
        .split(", ")
        .find_map(|part| part.strip_suffix(" corrected"));
    assert_ne!(corrected, Some("0"), "{said}");
    assert!(!all.contains('±'), "{said}");
}
