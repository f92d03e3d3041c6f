//! The first landmark that is found: what the filter learns from the camera.

use pilotage_core::flight::Flight;
use pilotage_core::navigator::{NavigatorSettings, Run};

use super::super::candidates::{best_accepted, no_landmark};
use super::super::figure::Figure;
use super::super::found;
use super::super::lesson::TourStop;
use super::super::moment::TourMoment;
use super::super::trial::TourTrial;
use crate::units::Units;
use crate::views::parts::figures;
use crate::views::picking;

/// The first landmark that is found.
#[derive(Default)]
pub(super) struct FirstLandmarkStop;

impl TourStop for FirstLandmarkStop {
    fn title(&self) -> &'static str {
        "A landmark is found"
    }

    fn find(&self, run: &Run, _flight: Option<&Flight>, _units: Units) -> Option<TourMoment> {
        let mut steps = run.steps.iter().enumerate();
        let (index, candidate) =
            steps.find_map(|(index, step)| Some((index, best_accepted(step)?)))?;
        let name = picking::landmark_name(run, candidate.landmark);
        let distance = candidate.innovation.map_or(0.0, |v| v.norm());
        let text = format!(
            "The navigator expected “{name}” at the white ring and searched only around it; it found it {} pixels away. \
             That difference, the innovation, with how far the landmark is turned and how large it is, is what it learns \
             from this landmark.",
            figures(distance)
        );
        Some(TourMoment::new(run, index, text).landmark(Some(candidate.landmark)))
    }

    fn missing(&self, run: &Run) -> Option<&'static str> {
        no_landmark(run)
    }

    fn draw(&self, figure: &Figure<'_>) {
        found::draw(figure);
    }

    fn trial(&self, moment: &TourMoment, _settings: &NavigatorSettings) -> TourTrial {
        TourTrial::play("Watch it happen from two seconds before", moment.time - 2.0)
    }
}

#[cfg(test)]
mod tests {
    use pilotage_core::navigator::StepReport;

    use super::*;
    use crate::views::fixture::Fixture;

    #[test]
    fn the_first_landmark_is_at_the_first_correction() {
        let fixture = Fixture::new();
        let moment = FirstLandmarkStop
            .find(&fixture.run, Some(&fixture.flight), Units::Metric)
            .unwrap();
        assert!(fixture.run.steps[moment.index].corrected());
        assert!(
            !fixture.run.steps[..moment.index]
                .iter()
                .any(StepReport::corrected)
        );
    }
}
