//! Several views on one way, weighed together.

use nalgebra::Vector2;
use pilotage_base::frames::{GroundPoint, wrap_pi};

use super::evidence::RoadEvidence;
use super::index::RoadIndex;
use super::locate::{LostBelief, LostShare, Weighed, distinct};
use super::prepared::PreparedView;
use super::reach::{FITTED, RoadViewError, SLACK, way_at_most};
use super::refine::{fix, misfit, settle};
use super::settings::LostSettings;
use super::view::{RoadView, ViewMotion, ViewPose};
use super::weights::{prior, told};

/// Places of each view that may be those of all.
const OF_EACH: usize = 24;

/// A view with its own places.
struct Look<'v> {
    view: &'v RoadView,
    prepared: PreparedView,
    /// Its own places, with what their evidence adds to the logarithm of the odds.
    places: Vec<Weighed>,
}

impl Look<'_> {
    fn weigh(&self, pose: ViewPose, index: &RoadIndex) -> Weighed {
        let evidence = RoadEvidence::of(&pose, self.view, &self.prepared, index);
        (told(&evidence), pose, evidence)
    }

    /// The pose that fits best near `believed`, which is off by the standard deviations `off` (m, rad), with what it adds
    /// to the logarithm of the odds less what its distance takes.
    fn near(&self, believed: &ViewPose, off: (f64, f64), index: &RoadIndex, scale: f64) -> Weighed {
        let off = (off.0.hypot(FITTED.0), off.1.hypot(FITTED.1));
        let looked = self.prepared.second_look();
        let starts = [(0.0, 0.0), (1.5, 0.0), (-1.5, 0.0), (0.0, 1.5), (0.0, -1.5)];
        let settled = starts.map(|(north, east)| {
            let moved = believed.place.to_vector() + off.0 * Vector2::new(north, east);
            let place = GroundPoint::from(moved);
            let pose = settle(ViewPose { place, ..*believed }, looked, index, scale);
            (misfit(&pose, looked, index), pose)
        });
        let best = settled.into_iter().min_by(|a, b| a.0.total_cmp(&b.0));
        let fixed = best.map(|(_, pose)| fix(pose, &self.prepared, index, scale));
        let fitted = fixed.map(|pose| self.weigh(pose, index));
        let all = self.places.iter().copied().chain(fitted);
        let less = all.filter_map(|(told, pose, evidence)| {
            let away = pose.place.distance(&believed.place) / off.0;
            let turned = wrap_pi(pose.turn - believed.turn).abs() / off.1;
            let is_near = away <= SLACK && turned <= SLACK;
            is_near.then(|| (told - 0.5 * (away.powi(2) + turned.powi(2)), pose, evidence))
        });
        let likeliest = less.max_by(|a, b| a.0.total_cmp(&b.0));
        likeliest.unwrap_or_else(|| self.weigh(*believed, index))
    }
}

impl RoadIndex {
    /// The places of the map that the last of several views may show: that of `first`, and those after each motion.
    ///
    /// The evidence of a view counts as far as the later ones show other ground: by the way from it to the next over the
    /// extent of what it shows, at most wholly.
    pub fn locate_along(
        &self,
        first: &RoadView,
        then: &[(ViewMotion, RoadView)],
        settings: &LostSettings,
    ) -> Result<LostBelief, RoadViewError> {
        let share = self.places_along(first, then, settings)?;
        Ok(LostBelief::of_parts(vec![share]))
    }

    /// The places of this part of a map that the last of several views may show, as [`RoadIndex::locate_along`] finds them,
    /// to be weighed with those of the other parts.
    pub fn places_along(
        &self,
        first: &RoadView,
        then: &[(ViewMotion, RoadView)],
        settings: &LostSettings,
    ) -> Result<LostShare, RoadViewError> {
        let (mut tried, mut left) = (0, 0);
        // Views before the last lie beside what is sought as far as the ways lead.
        let mut margin: f64 = then.iter().map(|(motion, _)| way_at_most(motion)).sum();
        let mut believed = *settings;
        let mut looks: Vec<Look<'_>> = Vec::new();
        for (number, view) in std::iter::once(first)
            .chain(then.iter().map(|t| &t.1))
            .enumerate()
        {
            if let Some((motion, _)) = number.checked_sub(1).map(|before| &then[before]) {
                believed.turn += motion.turn;
                believed.within_turn += SLACK * motion.turn_deviation;
                margin -= way_at_most(motion);
            }
            let prepared = PreparedView::new(view.checked()?);
            let found = self.candidates(&prepared, &believed, margin.max(0.0));
            tried += found.tried;
            left += found.left;
            let mut look = Look {
                view,
                prepared,
                places: Vec::new(),
            };
            look.places = found
                .poses
                .into_iter()
                .map(|pose| look.weigh(pose, self))
                .collect();
            look.places.sort_by(|a, b| b.0.total_cmp(&a.0));
            looks.push(look);
        }
        let mut weighed: Vec<Weighed> = Vec::new();
        for (number, look) in looks.iter().enumerate() {
            for own in look.places.iter().take(OF_EACH) {
                weighed.push(self.weigh_along(number, *own, &looks, then, settings));
            }
        }
        weighed.retain(|own| self.is_sought(&own.1.place, 0.0));
        Ok(LostShare {
            places: distinct(weighed, usize::MAX),
            tried,
            left,
        })
    }

    /// The last view's pose where the view of that number has its pose as in `own`, and the logarithm of its odds by all
    /// views.
    fn weigh_along(
        &self,
        number: usize,
        own: Weighed,
        looks: &[Look<'_>],
        then: &[(ViewMotion, RoadView)],
        settings: &LostSettings,
    ) -> Weighed {
        // Later ground counts first, so that the views before the last are worth their new ground.
        let worth = |view: usize| {
            let way = then
                .get(view)
                .map_or(f64::INFINITY, |(motion, _)| motion.way.norm());
            (way / looks[view].view.area().sqrt().max(1.0)).min(1.0)
        };
        let mut odds = prior(self.area, settings) + worth(number) * own.0;
        let mut last = own;
        for (view, (motion, _)) in then.iter().enumerate().skip(number) {
            let off = (motion.way_deviation, motion.turn_deviation);
            last = looks[view + 1].near(&last.1.after(motion), off, self, settings.scale);
            odds += worth(view + 1) * last.0;
        }
        let mut before = own.1;
        for view in (0..number).rev() {
            let motion = &then[view].0;
            let off = (motion.way_deviation, motion.turn_deviation);
            let found = looks[view].near(&before.before(motion), off, self, settings.scale);
            odds += worth(view) * found.0;
            before = found.1;
        }
        (odds, last.1, last.2)
    }
}
