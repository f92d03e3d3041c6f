//! `pilotage inspect` beside the page: a log at a glance is one.

use pilotage_core::flight::in_log_time;
use pilotage_jobs::{InlineWorkers, Job, JobEvent, ProvideOrder, ReadLog, ReadLogOrder};
use pilotage_tests::logs::dataflash::Form;
use pilotage_tests::logs::made;

use super::folder::Folder;

/// The page's look at a log.
fn read_by_the_page(name: &str, log: &[u8]) -> ReadLog {
    let mut workers = InlineWorkers::new();
    let key = "drop".to_owned();
    workers.start(Job::Provide(ProvideOrder {
        key: key.clone(),
        files: vec![(name.to_owned(), log.to_vec().into())],
    }));
    let file = name.to_owned();
    workers.start(Job::ReadLog(ReadLogOrder { key, file }));
    workers.finish_jobs();
    let mut events = workers.events().into_iter();
    let read = events.find_map(|(_, event)| match event {
        JobEvent::LogRead(read) => Some(*read),
        _ => None,
    });
    read.expect("the log is read")
}

#[test]
fn a_log_has_the_same_findings_and_uses_on_page_and_terminal() {
    let log = made::modern(Form::Binary, 5, 700);
    let folder = Folder::new("inspect");
    folder.write("flight.bin", &log);
    let said = folder.run(&["inspect", "flight.bin"]).expect("it is read");
    let shown = read_by_the_page("flight.bin", &log).overview;
    assert!(!shown.findings.is_empty() && !shown.abilities.is_empty());
    for finding in &shown.findings {
        let line = format!(": {}. {}\n", finding.title, in_log_time(&finding.text));
        assert!(said.contains(&line), "{line}: {said}");
    }
    for ability in &shown.abilities {
        let line = match &ability.lacks {
            None => format!("can: {}\n", ability.what),
            Some(lacks) => format!("cannot: {}. {lacks}\n", ability.what),
        };
        assert!(said.contains(&line), "{line}: {said}");
    }
    let judged = |line: &&str| {
        let words = ["note: ", "warning: ", "trouble: ", "can: ", "cannot: "];
        words.iter().any(|word| line.starts_with(word))
    };
    let told = said.lines().filter(judged).count();
    assert_eq!(told, shown.findings.len() + shown.abilities.len(), "{said}");
}
