//! Panels of the window, of each kind of work its own.

use super::ViewState;
use super::panel_layout::PanelLayout;

impl ViewState {
    fn panels(&self) -> PanelLayout {
        PanelLayout {
            side_open: self.side_open,
            plots_open: self.plots_open,
            side_width: self.side_width,
            plots_height: self.plots_height,
            strip_height: self.strip_height,
        }
    }

    fn lay_out(&mut self, panels: PanelLayout) {
        self.side_open = panels.side_open;
        self.plots_open = panels.plots_open;
        self.side_width = panels.side_width;
        self.plots_height = panels.plots_height;
        self.strip_height = panels.strip_height;
    }

    /// Turns to the panels of a kind of work, and keeps those of the one before as they are.
    pub fn turn_to_panels(&mut self, work: &str) {
        if self.panels_of == work {
            return;
        }
        let before = std::mem::replace(&mut self.panels_of, work.to_owned());
        // Sessions that know one layout alone have it for whatever they were left in.
        if before.is_empty() {
            return;
        }
        let panels = self.panels();
        self.other_panels.push((before, panels));
        let known = self.other_panels.iter().position(|(of, _)| of == work);
        let next = known.map(|index| self.other_panels.swap_remove(index).1);
        self.lay_out(next.unwrap_or_default());
    }

    /// Has the panels of the present kind of work as they were at first.
    pub fn reset_panels(&mut self) {
        self.lay_out(PanelLayout::default());
        self.resets += 1;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_kind_of_work_has_panels_of_its_own_that_survive_the_storage() {
        let mut view = ViewState::decode(br#"{"side_width":399.5,"side_open":true}"#);
        view.turn_to_panels("Replay");
        assert_eq!(view.side_width, Some(399.5), "one layout for all was known");
        view.turn_to_panels("Log");
        assert_eq!(view.side_width, None);
        view.side_width = Some(600.0);
        view.side_open = Some(false);
        let mut view = ViewState::decode(&view.encode());
        view.turn_to_panels("Replay");
        assert_eq!((view.side_width, view.side_open), (Some(399.5), Some(true)));
        view.turn_to_panels("Log");
        assert_eq!(
            (view.side_width, view.side_open),
            (Some(600.0), Some(false))
        );
        view.reset_panels();
        assert_eq!((view.side_width, view.side_open), (None, None));
        view.turn_to_panels("Replay");
        assert_eq!(view.side_width, Some(399.5));
    }
}
