//! Undo and redo by snapshots of the mission; a drag is one step.

use pilotage_core::mission::Mission;

/// Most snapshots kept.
const DEPTH: usize = 100;
/// Most steps of what is given up again.
const GIVEN_UP: usize = 3;

/// Snapshots of the mission before and after each edit.
#[derive(Clone, Debug, Default)]
pub struct History {
    past: Vec<Mission>,
    future: Vec<Mission>,
    dragging: Option<Mission>,
    /// Edits since the document was opened, of either direction.
    edits: u64,
    /// Edits when it was saved last.
    saved: Option<u64>,
}

impl History {
    /// Remembers `mission` as it is before an edit that is about to be made.
    pub fn remember(&mut self, mission: &Mission) {
        self.finish_drag(mission);
        self.push(mission.clone());
    }

    /// Remembers `mission` as it is before a drag; only the first call of a drag counts.
    pub fn begin_drag(&mut self, mission: &Mission) {
        if self.dragging.is_none() {
            self.dragging = Some(mission.clone());
        }
    }

    /// The mission as it was before the drag that is under way.
    pub fn before_drag(&self) -> Option<&Mission> {
        self.dragging.as_ref()
    }

    /// Ends a drag: one step, unless nothing changed; whether it is one. `mission` is as the drag left it.
    pub fn finish_drag(&mut self, mission: &Mission) -> bool {
        let before = self.dragging.take().filter(|before| before != mission);
        let is_step = before.is_some();
        if let Some(before) = before {
            self.push(before);
        }
        is_step
    }

    fn push(&mut self, mission: Mission) {
        if self.past.len() >= DEPTH {
            self.past.remove(0);
        }
        self.past.push(mission);
        self.future.clear();
        self.edits += 1;
    }

    /// Forgets the last few steps if they did nothing but what `without` leaves out of a mission, and gives the mission as
    /// it was before them: what was begun and given up again is no edit.
    pub fn give_up(
        &mut self,
        mission: &Mission,
        without: impl Fn(&Mission) -> Mission,
    ) -> Option<Mission> {
        let wanted = without(mission);
        let from = self.past.len().saturating_sub(GIVEN_UP);
        let same = from + self.past[from..].iter().rposition(|it| *it == wanted)?;
        if self.past[same + 1..].iter().any(|it| without(it) != wanted) {
            return None;
        }
        self.edits -= (self.past.len() - same) as u64;
        // What was saved meanwhile is what was given up.
        self.saved = self.saved.filter(|saved| *saved <= self.edits);
        self.past.truncate(same);
        Some(wanted)
    }

    /// Edits since the document was opened, of either direction.
    pub fn edits(&self) -> u64 {
        self.edits
    }

    /// Notes that the mission was saved as it was after so many edits.
    pub fn mark_saved(&mut self, edits: u64) {
        self.saved = Some(edits);
    }

    /// Whether nothing was edited since the mission was saved.
    pub fn is_saved(&self) -> bool {
        self.saved == Some(self.edits)
    }

    /// The mission before the last edit; `mission` is kept for redo.
    pub fn undo(&mut self, mission: &Mission) -> Option<Mission> {
        self.finish_drag(mission);
        let before = self.past.pop()?;
        self.future.push(mission.clone());
        self.edits += 1;
        Some(before)
    }

    /// The mission after the edit that was undone last.
    pub fn redo(&mut self, mission: &Mission) -> Option<Mission> {
        let after = self.future.pop()?;
        self.past.push(mission.clone());
        self.edits += 1;
        Some(after)
    }

    /// Steps that can be undone and redone.
    pub fn depth(&self) -> (usize, usize) {
        (self.past.len(), self.future.len())
    }

    /// Forgets everything: another document was opened.
    pub fn clear(&mut self) {
        *self = Self::default();
    }
}

#[cfg(test)]
mod tests {
    use pilotage_core::roads::RoadLine;

    use super::*;
    use crate::documents::empty_mission;

    fn named(name: &str) -> Mission {
        Mission {
            name: name.into(),
            ..empty_mission()
        }
    }

    #[test]
    fn an_edit_undone_and_redone_is_the_edit() {
        let mut history = History::default();
        history.remember(&named("before"));
        let before = history.undo(&named("after")).expect("one step");
        assert_eq!(before.name, "before");
        let after = history.redo(&before).expect("one step");
        assert_eq!(after.name, "after");
    }

    #[test]
    fn a_drag_is_one_step() {
        let mut history = History::default();
        for _ in 0..20 {
            history.begin_drag(&named("before"));
        }
        history.finish_drag(&named("after"));
        assert_eq!(history.depth(), (1, 0));
    }

    #[test]
    fn a_drag_that_changes_nothing_is_no_step() {
        let mut history = History::default();
        history.begin_drag(&named("same"));
        history.finish_drag(&named("same"));
        assert_eq!(history.depth(), (0, 0));
    }

    #[test]
    fn what_is_given_up_again_is_no_step_and_leaves_the_mission_saved() {
        let mut history = History::default();
        history.remember(&named("empty"));
        history.mark_saved(history.edits());
        history.remember(&named("saved"));
        history.remember(&named("saved+"));
        let without = |mission: &Mission| named(mission.name.trim_end_matches('+'));
        assert_eq!(
            history.give_up(&named("saved++"), without),
            Some(named("saved"))
        );
        assert_eq!(history.depth(), (1, 0));
        assert!(history.is_saved());
        // What is as long ago was another edit that was made and taken back.
        history.remember(&named("saved"));
        history.remember(&named("another"));
        assert_eq!(history.give_up(&named("saved+"), without), None);
        assert_eq!(history.depth(), (3, 0));
    }

    #[test]
    fn all_steps_share_the_roads_that_none_of_them_changed() {
        let mut mission = named("0");
        mission.roads = vec![RoadLine::default(); 50_000].into();
        let mut history = History::default();
        for index in 1..=DEPTH {
            history.remember(&mission);
            mission.name = index.to_string();
        }
        let is_shared = |it: &Mission| it.roads.is_shared_with(&mission.roads);
        assert!(history.past.len() == DEPTH && history.past.iter().all(is_shared));
    }

    #[test]
    fn a_hundred_steps_are_kept() {
        let mut history = History::default();
        for index in 0..150 {
            history.remember(&named(&index.to_string()));
        }
        assert_eq!(history.depth(), (100, 0));
    }

    #[test]
    fn what_was_saved_counts_as_saved_until_the_next_edit_in_either_direction() {
        let mut history = History::default();
        history.remember(&named("a"));
        assert!(!history.is_saved());
        history.mark_saved(history.edits());
        assert!(history.is_saved());
        history.undo(&named("b"));
        assert!(!history.is_saved());
        history.mark_saved(history.edits());
        history.redo(&named("a"));
        assert!(!history.is_saved());
    }
}
