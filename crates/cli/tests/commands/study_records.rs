//! Records of studies: what the measured results quote is what was flown, and what the program still flies.

use std::path::PathBuf;

use pilotage_study::{StudyPlan, StudyRecord};
use pilotage_tests::data::repository;

use super::folder::Folder;

/// Studies whose figures the documents quote.
const RECORDED: [&str; 5] = [
    "hostile",
    "hundred-thousand",
    "scenarios",
    "sensitivity",
    "vehicles",
];

fn record(name: &str) -> StudyRecord {
    let path = repository().join(format!("studies/records/{name}.json"));
    let text =
        std::fs::read_to_string(&path).unwrap_or_else(|why| panic!("{}: {why}", path.display()));
    serde_json::from_str(&text).unwrap_or_else(|why| panic!("{}: {why}", path.display()))
}

#[test]
fn the_first_flights_of_each_recorded_study_are_flown_today_as_they_were() {
    for name in RECORDED {
        let plan = repository().join(format!("studies/{name}.toml"));
        let plan = StudyPlan::read(&std::fs::read_to_string(plan).unwrap()).unwrap();
        let record = record(name);
        assert!(record.first.len() as u64 >= plan.cells() && record.summary.name == name);
        let differences = record.out_of_date(&plan).unwrap();
        assert!(
            differences.is_empty(),
            "fly it again: pilotage study studies/{name}.toml --record studies/records --made \
             \"DATE, STATE\", then the command in docs/results.md\n{}",
            differences.join("\n")
        );
    }
}

#[test]
fn a_record_is_out_of_date_once_a_number_or_the_plan_is_another() {
    let record = record("vehicles");
    let mut other = record.clone();
    other.first[1].measured[1] = Some(1e3);
    let told = other.out_of_date(&record.plan).unwrap();
    assert!(
        told.len() == 1 && told[0].contains("vehicles, run 1, error-rms"),
        "{told:?}"
    );
    let mut plan = record.plan.clone();
    plan.seed += 1;
    assert_eq!(
        record.out_of_date(&plan).unwrap(),
        ["the plan of vehicles is another"]
    );
}

#[test]
fn the_measured_results_say_what_the_records_say() {
    let folder = Folder::new("study-results");
    let results = std::fs::read_to_string(repository().join("docs/results.md")).unwrap();
    let records = repository().join("studies/records");
    let records: &str = records.to_str().unwrap();
    // A number that somebody changed by hand is put right.
    let flights = "| `vehicles`, airplane-full | 200 |";
    assert!(results.contains(flights));
    folder.write(
        "results.md",
        results.replace(flights, "| `vehicles`, airplane-full | 201 |"),
    );
    folder
        .run(&["study", "results", records, "--write", "results.md"])
        .unwrap();
    let written = std::fs::read_to_string(folder.0.join("results.md")).unwrap();
    assert!(
        written == results,
        "pilotage study results studies/records --write docs/results.md"
    );
}

#[test]
fn a_study_is_recorded_with_the_day_on_which_it_was_flown() {
    let folder = Folder::new("study-recorded");
    let plan = "name = \"two\"\nquestion = \"?\"\ndraws = 2\nfixed = { seconds = 5, step = 0.5 }\n\
                measure = [{ of = \"error-rms\" }]\n";
    folder.write("two.toml", plan);
    std::fs::create_dir_all(folder.0.join("records")).unwrap();
    let words = ["study", "two.toml", "--record", "records"];
    assert!(folder.run(&words).unwrap_err().contains("--made"));
    let made = [&words[..], &["--made", "today"]].concat();
    folder.run(&made).unwrap();
    let path: PathBuf = folder.0.join("records/two.json");
    let record: StudyRecord =
        serde_json::from_str(&std::fs::read_to_string(path).unwrap()).unwrap();
    assert_eq!((record.made.as_str(), record.first.len()), ("today", 2));
    let told = folder.run(&["study", "results", "records"]).unwrap();
    assert!(
        told.contains("\n| `two` | 2 | today | error-rms "),
        "{told}"
    );
}
