//! Trajectories that were kept.

use egui::Color32;
use pilotage_core::flight::trajectory::Trajectory;

use crate::tokens::Tokens;

/// A trajectory that was kept.
#[derive(Clone, Debug, PartialEq)]
pub struct KeptTrack {
    /// Its number, never used again.
    pub number: u32,
    /// The trajectory.
    pub track: Trajectory,
    /// Whether the map shows it.
    pub is_shown: bool,
}

impl KeptTrack {
    /// Colour and dash (points) in which it is drawn: neighbours differ in both.
    pub fn look(&self, tokens: &Tokens) -> (Color32, Option<(f32, f32)>) {
        let looks = [
            (tokens.accent, None),
            (tokens.observed, Some((7.0, 3.0))),
            (tokens.unaided, Some((2.0, 3.0))),
            (tokens.warning, Some((10.0, 4.0))),
            (tokens.text, Some((4.0, 4.0))),
        ];
        looks[self.number as usize % looks.len()]
    }
}

/// All of them.
#[derive(Clone, Debug, Default)]
pub struct Shelf {
    kept: Vec<KeptTrack>,
    next: u32,
}

impl Shelf {
    /// Those there are, the oldest first.
    pub fn kept(&self) -> &[KeptTrack] {
        &self.kept
    }

    /// The one of that number.
    pub fn get(&self, number: u32) -> Option<&KeptTrack> {
        self.kept.iter().find(|k| k.number == number)
    }

    /// Keeps one, under a name that no other has; what it is called now.
    pub fn keep(&mut self, mut track: Trajectory) -> &str {
        let is_taken = |name: &str| self.kept.iter().any(|k| k.track.name == name);
        let wanted = track.name.clone();
        let mut copy = 2;
        while is_taken(&track.name) {
            track.name = format!("{wanted} ({copy})");
            copy += 1;
        }
        self.kept.push(KeptTrack {
            number: self.next,
            track,
            is_shown: true,
        });
        self.next += 1;
        self.kept.last().map_or("", |k| k.track.name.as_str())
    }

    /// Lets go of one.
    pub fn discard(&mut self, number: u32) {
        self.kept.retain(|k| k.number != number);
    }

    /// Draws one on the map, or not.
    pub fn toggle_shown(&mut self, number: u32) {
        if let Some(kept) = self.kept.iter_mut().find(|k| k.number == number) {
            kept.is_shown = !kept.is_shown;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_two_have_one_name_or_number() {
        let track = || Trajectory::on_the_ground("demo".into(), None, [(0.0, 0.0, 0.0)]);
        let mut shelf = Shelf::default();
        assert_eq!(shelf.keep(track()), "demo");
        assert_eq!(shelf.keep(track()), "demo (2)");
        assert_eq!(shelf.keep(track()), "demo (3)");
        shelf.discard(2);
        assert_eq!(shelf.keep(track()), "demo (3)");
        let numbers: Vec<u32> = shelf.kept().iter().map(|k| k.number).collect();
        assert_eq!(numbers, [0, 1, 3]);
    }
}
