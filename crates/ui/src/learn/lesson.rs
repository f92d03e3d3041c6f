//! Lessons: stops of the tour, each a file of `lessons/`.

use egui::Ui;
use pilotage_core::flight::Flight;
use pilotage_core::navigator::{NavigatorSettings, Run};

use super::figure::{Figure, FigureNumbers};
use super::moment::TourMoment;
use super::trial::TourTrial;
use crate::units::Units;

/// Stop of the tour: a telling moment of the run, a figure of it, something to try.
pub(super) trait TourStop {
    /// Heading.
    fn title(&self) -> &'static str;

    /// Moment of the run that it tells of, with the words on it; `None` while the run has not got there.
    fn find(&self, run: &Run, flight: Option<&Flight>, units: Units) -> Option<TourMoment>;

    /// Words in the place of the usual ones where a run has no such moment.
    fn missing(&self, _run: &Run) -> Option<&'static str> {
        None
    }

    /// Numbers of the whole run of which its figure is drawn: gathered once while the run stays the same, not for every
    /// frame of the screen.
    fn gather(&self, _run: &Run) -> FigureNumbers {
        FigureNumbers::default()
    }

    /// Draws its figure.
    fn draw(&self, figure: &Figure<'_>);

    /// Height of its control, in spaces of the look.
    fn control_height(&self) -> f32 {
        0.0
    }

    /// Its control below the figure.
    fn control(&mut self, _ui: &mut Ui) {}

    /// Trial for people, flown with `settings` until then.
    fn trial(&self, moment: &TourMoment, settings: &NavigatorSettings) -> TourTrial;
}
