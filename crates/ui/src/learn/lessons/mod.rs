//! All stops of the tour, in its order: another one is a file of this folder, and a line in the list below with the
//! lesson of the page of lessons that tells more.

use super::lesson::Lesson;

/// Declares the files of the stops, and makes their list.
macro_rules! lessons {
    ($($file:ident::$lesson:ident: $more:literal,)*) => {
        $(mod $file;)*

        /// Every stop, as it is when the tour begins.
        pub(super) fn all() -> Vec<Box<dyn Lesson>> {
            vec![$(Box::<$file::$lesson>::default()),*]
        }

        /// Name of each stop in links, as its file has it, and the lesson that tells more.
        pub(super) const LINKS: &[(&str, &str)] = &[$((stringify!($file), $more)),*];
    };
}

/// Number of the stop that a link names: `your-turn`.
pub(super) fn linked(name: &str) -> Option<usize> {
    let file = name.replace('-', "_");
    LINKS.iter().position(|(own, _)| *own == file)
}

lessons! {
    first_landmark::FirstLandmark: "look-corrects-wind",
    shrinking::Shrinking: "landmark-corrects",
    gate::Gate: "gate-and-nis",
    refused::Refused: "twin-landmark",
    wind::Wind: "wind-on-turns",
    dead_reckoning::DeadReckoning: "dead-reckoning-drifts",
    growing::Growing: "cloud-grows",
    reacquired::Reacquired: "how-often-to-look",
    alpha::Alpha: "alpha-beta-kappa",
    consistency::Consistency: "nees-honest",
    your_turn::YourTurn: "tuning-noise",
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::units::Units;
    use crate::views::fixture::Fixture;

    #[test]
    fn stops_and_lessons_lead_to_each_other() {
        use pilotage_lessons::text::{Directive, LessonText};

        for (stop, more) in LINKS {
            assert!(
                pilotage_lessons::all().find(more).is_some(),
                "{stop}: {more}"
            );
        }
        for lesson in pilotage_lessons::all().lessons() {
            let text = LessonText::read(lesson.text).unwrap();
            for (_, directive) in text.directives().unwrap() {
                if let Directive::Flight(stop, _) = directive {
                    assert!(linked(stop).is_some(), "{}: {stop}", lesson.name);
                }
            }
        }
    }

    #[test]
    fn every_lesson_finds_its_moment_in_a_whole_flight() {
        let fixture = Fixture::new();
        let run = &fixture.run;
        for lesson in all() {
            let moment = lesson.find(run, Some(&fixture.flight), Units::Metric);
            let moment = moment.unwrap();
            assert!((run.steps[moment.index].time - moment.time).abs() < 1e-9);
            assert!(
                moment.text.matches(['.', '?']).count() >= 2,
                "{}",
                moment.text
            );
        }
    }
}
