//! Numbers that options do not take.

use super::folder::Folder;

#[test]
fn a_number_that_an_option_cannot_take_is_refused_by_its_name() {
    let folder = Folder::with_map("numbers");
    let scenario = "plan --scenario distinct-400ft-calm";
    let cases = [
        ("replay flight.csv --outage=-5".to_owned(), "--outage"),
        ("replay flight.csv --outage=nan".to_owned(), "--outage"),
        (format!("{scenario} --suggest 2 --side=-5"), "--side"),
        (format!("{scenario} --suggest 2 --side=nan"), "--side"),
        (format!("{scenario} --suggest 0"), "--suggest"),
        (
            format!("{scenario} --suggest 2 --position=nan"),
            "--position",
        ),
        (
            format!("{scenario} --find 0,0 400,300 --budget 0.5"),
            "--budget",
        ),
        (format!("{scenario} --find nan,0 400,300"), "--find"),
        (
            format!("{scenario} --predict --route nan,nan;1,1"),
            "--route",
        ),
        (format!("{scenario} --predict --limit 0"), "--limit"),
        (
            "reference-map map.png --out t.table --edges --gsd 0".to_owned(),
            "--gsd",
        ),
        (
            "reference-map map.png --out t.table --edges --gsd=-1".to_owned(),
            "--gsd",
        ),
        (
            "reference-map map.png --out t.table --edges --gsd 0.0001".to_owned(),
            "--gsd",
        ),
        ("roads apls a.osm b.osm --spacing 0".to_owned(), "--spacing"),
        ("roads apls a.osm b.osm --snap nan".to_owned(), "--snap"),
        (
            "roads lost a.osm b.jpg --heading inf".to_owned(),
            "--heading",
        ),
        (
            "detect --cascade c.xml a.png --scale-step 1.0000000001".to_owned(),
            "--scale-step",
        ),
        ("evaluate --days 4000000000".to_owned(), "--days"),
        (
            "train --scenario distinct-400ft-calm --tilt=nan".to_owned(),
            "--tilt",
        ),
        (
            "train --scenario distinct-400ft-calm --positives 0".to_owned(),
            "--positives",
        ),
        ("classes judge --countries 0".to_owned(), "--countries"),
        (
            "simulate --map map.png --out flown --wind 0,500".to_owned(),
            "--wind",
        ),
        ("align --flight flown --clock=-1".to_owned(), "--clock"),
    ];
    for (words, option) in cases {
        let words: Vec<&str> = words.split(' ').collect();
        let why = folder.run(&words).expect_err(option);
        assert!(why.contains(option), "{words:?}: {why}");
        assert!(!why.contains("panicked"), "{words:?}: {why}");
    }
}
