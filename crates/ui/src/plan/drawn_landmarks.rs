//! Landmarks that people draw or change are measured by themselves.

use std::collections::HashMap;

use pilotage_core::landmark::Landmark;

use super::assessments::same;

/// Time for which a landmark must rest before it is measured, milliseconds.
const REST: f64 = 600.0;

/// Landmarks as they were last, and the one that was drawn or changed since.
#[derive(Debug, Default)]
pub struct DrawnLandmarks {
    known: Option<Vec<Landmark>>,
    changed: Option<(Landmark, f64)>,
}

impl DrawnLandmarks {
    /// Landmark that was drawn or changed and has rested since, once; and whether one is yet to rest.
    ///
    /// Where several are others at once, they were opened, imported or proposed, and people say which are measured.
    pub fn rested(&mut self, landmarks: &[Landmark], now: f64) -> (Option<u32>, bool) {
        let known = self.known.get_or_insert_with(|| landmarks.to_vec());
        match others(known, landmarks) {
            (Some(one), None) => match &self.changed {
                Some((before, since)) if before.id == one.id && same(before, one) => {
                    if now - since < REST {
                        return (None, true);
                    }
                    let id = one.id;
                    self.adopt(landmarks);
                    (Some(id), false)
                }
                _ => {
                    self.changed = Some((one.clone(), now));
                    (None, true)
                }
            },
            (None, _) if known.len() == landmarks.len() => (None, false),
            _ => {
                self.adopt(landmarks);
                (None, false)
            }
        }
    }

    fn adopt(&mut self, landmarks: &[Landmark]) {
        self.known = Some(landmarks.to_vec());
        self.changed = None;
    }
}

/// The first two of `landmarks` that are not `known` as they are.
fn others<'a>(
    known: &[Landmark],
    landmarks: &'a [Landmark],
) -> (Option<&'a Landmark>, Option<&'a Landmark>) {
    let is_same = |k: &Landmark, it: &Landmark| k.id == it.id && same(k, it);
    let mut by_id: Option<HashMap<u32, &Landmark>> = None;
    let mut others = landmarks.iter().enumerate().filter_map(|(index, it)| {
        // Nearly always each stands where it stood.
        if known.get(index).is_some_and(|k| is_same(k, it)) {
            return None;
        }
        let by_id = by_id.get_or_insert_with(|| known.iter().map(|k| (k.id, k)).collect());
        let is_known = by_id.get(&it.id).is_some_and(|k| is_same(k, it));
        (!is_known).then_some(it)
    });
    (others.next(), others.next())
}

#[cfg(test)]
mod tests {
    use super::*;
    use pilotage_core::frames::{GroundPoint, GroundRect};

    fn landmark(id: u32, east: f64) -> Landmark {
        let bounds = GroundRect::centered(GroundPoint::new(0.0, east), 30.0, 30.0);
        Landmark::new(id, "barn", bounds)
    }

    #[test]
    fn one_that_is_drawn_or_dragged_is_measured_once_when_it_rests() {
        let mut drawn = DrawnLandmarks::default();
        let mut all = vec![landmark(1, 0.0), landmark(2, 90.0)];
        assert_eq!(drawn.rested(&all, 0.0), (None, false), "all were there");
        all.push(landmark(3, 200.0));
        assert_eq!(drawn.rested(&all, 10.0), (None, true));
        all[2] = landmark(3, 210.0);
        assert_eq!(drawn.rested(&all, 500.0), (None, true), "it is dragged");
        assert_eq!(drawn.rested(&all, 1000.0), (None, true));
        assert_eq!(drawn.rested(&all, 1100.0), (Some(3), false));
        assert_eq!(drawn.rested(&all, 9000.0), (None, false));
        all[0].name = "church".to_owned();
        assert_eq!(
            drawn.rested(&all, 9100.0),
            (None, false),
            "a name is not seen"
        );
        all.remove(0);
        assert_eq!(drawn.rested(&all, 9200.0), (None, false));
    }

    #[test]
    fn of_several_that_come_at_once_none_is_measured_unasked() {
        let mut drawn = DrawnLandmarks::default();
        drawn.rested(&[landmark(1, 0.0)], 0.0);
        let opened = [landmark(1, 50.0), landmark(2, 90.0)];
        assert_eq!(drawn.rested(&opened, 10.0), (None, false));
        assert_eq!(drawn.rested(&opened, 5000.0), (None, false));
    }
}
