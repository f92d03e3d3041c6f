//! All lessons, in the order of the tour: another one is a file of this folder, and a line in the list below.

use super::lesson::Lesson;

/// Declares the files of the lessons, and makes their list.
macro_rules! lessons {
    ($($file:ident::$lesson:ident,)*) => {
        $(mod $file;)*

        /// Every lesson, as it is when the tour begins.
        pub(super) fn all() -> Vec<Box<dyn Lesson>> {
            vec![$(Box::<$file::$lesson>::default()),*]
        }
    };
}

lessons! {
    first_landmark::FirstLandmark,
    shrinking::Shrinking,
    gate::Gate,
    refused::Refused,
    wind::Wind,
    dead_reckoning::DeadReckoning,
    growing::Growing,
    reacquired::Reacquired,
    alpha::Alpha,
    consistency::Consistency,
    your_turn::YourTurn,
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::units::Units;
    use crate::views::fixture::Fixture;

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
