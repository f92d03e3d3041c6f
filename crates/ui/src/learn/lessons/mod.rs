//! All stops of the tour, in its order: another one is a file of this folder, and a line in the list below with the
//! lesson of the page of lessons that tells more.

use super::lesson::TourStop;

/// Declares the files of the stops, and makes their list.
macro_rules! lessons {
    ($($file:ident::$lesson:ident: $more:literal,)*) => {
        $(mod $file;)*

        /// Every stop, as it is when the tour begins.
        pub(super) fn all() -> Vec<Box<dyn TourStop>> {
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
    first_landmark::FirstLandmarkStop: "look-corrects-wind",
    shrinking::ShrinkingStop: "landmark-corrects",
    gate::GateStop: "gate-and-nis",
    refused::RefusedStop: "twin-landmark",
    wind::WindStop: "wind-on-turns",
    dead_reckoning::DeadReckoningStop: "dead-reckoning-drifts",
    growing::GrowingStop: "cloud-grows",
    reacquired::ReacquiredStop: "how-often-to-look",
    alpha::AlphaStop: "alpha-beta-kappa",
    consistency::ConsistencyStop: "nees-honest",
    your_turn::YourTurnStop: "tuning-noise",
}

#[cfg(test)]
mod tests {
    use nalgebra::DMatrix;
    use pilotage_core::navigator::{NavigatorSettings, UpdateReport, visit_model};
    use pilotage_core::simulate::Scenario;
    use pilotage_core::vehicle::{StateComponent, VehicleModel, VehicleVisitor};
    use pilotage_jobs::SimulationOptions;

    use super::*;
    use crate::units::Units;
    use crate::views::fixture::{Fixture, reading_of_gps};

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

    /// Words of a lesson.
    fn words(lesson: &str) -> &'static str {
        let found = pilotage_lessons::all().find(lesson);
        found.expect("the lesson is there").2.text
    }

    /// Settings of the filter of the flight that lessons lead to.
    fn of_the_flight() -> NavigatorSettings {
        let demo = SimulationOptions::demo();
        let scenario = Scenario::named(&demo.scenario).expect("the demo is a scenario");
        scenario.mission().navigator
    }

    #[test]
    fn lessons_on_wind_say_which_errors_of_instruments_the_filter_of_the_flight_knows() {
        let settings = of_the_flight();
        let layout = visit_model(&settings, Layout);
        for bias in [StateComponent::AirspeedBias, StateComponent::HeadingBias] {
            assert!(layout.contains(&bias), "{layout:?}");
        }
        let airspeed = settings.process.airspeed_bias;
        let heading = settings.process.heading_bias.to_degrees();
        let said = format!(
            "among the states of that filter, known beforehand to {airspeed:.1} m/s and {heading:.1}°"
        );
        assert!(words("wind-on-turns").contains(&said), "{said}");
        let said = "right to half a degree or so, which its filter knows";
        assert!(words("compass-off").contains(said) && (0.3..0.7).contains(&heading));
    }

    #[test]
    fn the_lesson_on_alpha_says_how_many_numbers_the_filter_of_the_flight_has() {
        let settings = of_the_flight();
        let layout = visit_model(&settings, Layout);
        assert_eq!((layout.len(), settings.alpha), (10, 1.0));
        let eta = (layout.len() as f64).sqrt();
        let said =
            format!("has ten numbers: with α = 1 its points stand √10 = {eta:.2} deviations out");
        assert!(words("alpha-beta-kappa").contains(&said), "{said}");
    }

    /// Components of the state of a filter.
    struct Layout;

    impl VehicleVisitor for Layout {
        type Output = Vec<StateComponent>;

        fn visit<const N: usize, V: VehicleModel<N>>(self, model: V) -> Self::Output {
            model.layout().to_vec()
        }
    }

    /// Titles of the stops that find nothing in a run, none without words on why.
    fn missing(fixture: &Fixture) -> Vec<&'static str> {
        let run = &fixture.run;
        let lessons = all();
        let empty = lessons.iter().filter(|lesson| {
            let moment = lesson.find(run, Some(&fixture.flight), Units::Metric);
            moment.is_none()
        });
        let named = empty.map(|lesson| {
            assert!(lesson.missing(run).is_some(), "{}", lesson.title());
            lesson.title()
        });
        named.collect()
    }

    #[test]
    fn a_run_that_an_aid_places_all_the_time_has_no_dead_reckoning() {
        let mut fixture = Fixture::new();
        for step in &mut fixture.run.steps {
            let gain = DMatrix::zeros(4, 2);
            step.updates = vec![reading_of_gps(1.0, Some(gain))];
        }
        let expected = [
            "Nothing in view: dead reckoning",
            "The sigma points spread",
            "Found again",
        ];
        assert_eq!(missing(&fixture), expected);
    }

    #[test]
    fn nothing_is_said_of_landmarks_where_whole_pictures_correct() {
        let mut fixture = Fixture::new();
        for step in &mut fixture.run.steps {
            if let Some(frame) = &mut step.frame {
                frame.candidates.clear();
            }
        }
        let expected = [
            "A landmark is found",
            "The sigma points draw together",
            "The gate: how far off is too far",
            "A match is refused",
            "Found again",
            "Does the filter know how wrong it is?",
        ];
        assert_eq!(missing(&fixture), expected);
    }

    #[test]
    fn a_stretch_with_readings_that_do_not_tell_the_place_does_not_go_by_the_wind_alone() {
        let mut fixture = Fixture::new();
        let told = |fixture: &Fixture| {
            let lesson = dead_reckoning::DeadReckoningStop;
            let moment = lesson.find(&fixture.run, None, Units::Metric);
            moment.unwrap().text
        };
        assert!(told(&fixture).contains("and nothing else"));
        for step in &mut fixture.run.steps {
            let reading = reading_of_gps(1.0, Some(DMatrix::zeros(4, 2)));
            step.updates = vec![UpdateReport {
                aid: "gps-velocity".to_owned(),
                ..reading
            }];
        }
        let text = told(&fixture);
        assert!(!text.contains("nothing else"), "{text}");
    }

    #[test]
    fn nothing_is_said_of_a_wind_that_the_filter_does_not_estimate() {
        let mut fixture = Fixture::new();
        let told = |fixture: &Fixture| {
            let lessons = all().into_iter();
            let found = lessons.filter_map(|lesson| lesson.find(&fixture.run, None, Units::Metric));
            let told = found.filter(|moment| moment.text.contains(" wind"));
            told.count()
        };
        // Learned, reckoned with, guessed, corrected.
        assert_eq!(told(&fixture), 4);
        fixture.run.state_names.clear();
        assert_eq!(told(&fixture), 0);
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
