//! The scoreboard of DeAngelo 2016, chapter 3: each observed landmark takes the possible one of its class with the highest
//! score, by the road, by the directions of what surrounds the two, and by nearness.

use nalgebra::Vector2;

use super::{ObservedLandmark, PossibleLandmark};
use crate::GenericClass;

/// A straight road through two points, metres north and east.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NearestRoad {
    /// A point of it.
    pub from: Vector2<f64>,
    /// Another one.
    pub to: Vector2<f64>,
}

impl NearestRoad {
    /// Distance of a place from it, metres, positive on the right of whoever goes from `from` to `to` (eqs 5-8, with
    /// the side by the cross product: the sign of one component fails where the road runs along the other).
    fn distance(&self, place: Vector2<f64>) -> f64 {
        let along = (self.to - self.from).normalize();
        let away = place - self.from;
        along.x * away.y - along.y * away.x
    }
}

/// Numbers of the scoreboard, for pixels of a picture 1280 wide.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ScoreboardSettings {
    /// Ground in a pixel, metres.
    pub pixel: f64,
    /// Distance below which a possible landmark counts as near, pixels.
    pub near: f64,
    /// Distance beyond which a pair is refused, pixels.
    pub furthest: f64,
    /// Square of the difference of two unit vectors up to which they match: 15 % of its largest, 4.
    pub vectors: f64,
    /// Number of fields and of trees whose directions count.
    pub neighbours: usize,
}

impl ScoreboardSettings {
    /// The thesis' numbers for a picture of which a pixel shows `pixel` metres.
    pub fn of_thesis(pixel: f64) -> Self {
        Self {
            pixel,
            near: 175.0,
            furthest: 125.0,
            vectors: 0.6,
            neighbours: 8,
        }
    }
}

/// Terms of one score.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ScoreboardTerms {
    /// Index of the possible landmark.
    pub possible: usize,
    /// 1 if its distance from the road is the most similar on that side; 0 where no road is known.
    pub road: f64,
    /// Share of its directions to buildings, fields and trees that match.
    pub vectors: [f64; 3],
    /// 1 if it is near, else -1.
    pub near: f64,
}

impl ScoreboardTerms {
    /// The score.
    pub fn total(&self) -> f64 {
        self.road + self.vectors.iter().sum::<f64>() + self.near
    }
}

/// Scores of one observed landmark.
#[derive(Clone, Debug, PartialEq)]
pub struct ScoreboardRow {
    /// Terms for each possible landmark of its class.
    pub terms: Vec<ScoreboardTerms>,
    /// Index of the possible landmark that it takes, unless that is too far away.
    pub chosen: Option<usize>,
}

/// Scores of all observed landmarks.
#[derive(Clone, Debug, PartialEq)]
pub struct Scoreboard {
    /// A row for each observed landmark.
    pub rows: Vec<ScoreboardRow>,
}

/// Classes whose directions count.
const AROUND: [GenericClass; 3] = [
    GenericClass::Building,
    GenericClass::Field,
    GenericClass::Tree,
];

impl Scoreboard {
    /// Scores of `observed` against `possible`, with the road as observed and as the map has it, if both are known.
    ///
    /// ```
    /// use nalgebra::{Matrix2, Matrix2x4, Vector2};
    /// use pilotage_reference::GenericClass::{Building, Tree};
    /// use pilotage_reference::association::*;
    ///
    /// let (covariance, size, by_pose) = (Matrix2::identity(), 9.0, Matrix2x4::zeros());
    /// let at = |north| Vector2::new(north, 0.0);
    /// let known = |class, north| PossibleLandmark { class, place: at(north), covariance, size, detection: 0.9 };
    /// let seen = |class, north| ObservedLandmark { class, place: at(north), covariance, size, by_pose };
    /// let known = [known(Tree, 20.0), known(Building, 0.0), known(Building, 40.0)];
    /// let seen = [seen(Building, 1.0), seen(Tree, 21.0)];
    /// let board = Scoreboard::of(&seen, &known, None, &ScoreboardSettings::of_thesis(0.3));
    /// // Both houses are near (1 each); only the first has the tree to its north, as it is seen (1 more).
    /// assert_eq!(board.rows[0].terms.iter().map(ScoreboardTerms::total).collect::<Vec<_>>(), [2.0, 1.0]);
    /// assert_eq!(board.rows[0].chosen, Some(1));
    /// ```
    pub fn of(
        observed: &[ObservedLandmark],
        possible: &[PossibleLandmark],
        roads: Option<(NearestRoad, NearestRoad)>,
        settings: &ScoreboardSettings,
    ) -> Self {
        let seen: Vec<_> = observed.iter().map(|o| (o.class, o.place)).collect();
        let mapped: Vec<_> = possible.iter().map(|p| (p.class, p.place)).collect();
        let seen_around: Vec<_> = (0..seen.len())
            .map(|i| directions(&seen, i, settings.neighbours))
            .collect();
        let mapped_around: Vec<_> = (0..mapped.len())
            .map(|i| directions(&mapped, i, settings.neighbours))
            .collect();
        let rows = seen.iter().zip(&seen_around).map(|((class, place), own)| {
            let same = (0..mapped.len()).filter(|j| mapped[*j].0 == *class);
            let mut terms: Vec<ScoreboardTerms> = same
                .map(|j| ScoreboardTerms {
                    possible: j,
                    road: 0.0,
                    vectors: std::array::from_fn(|k| {
                        matching(&own[k], &mapped_around[j][k], settings.vectors)
                    }),
                    near: if (mapped[j].1 - place).norm() < settings.near * settings.pixel {
                        1.0
                    } else {
                        -1.0
                    },
                })
                .collect();
            if let Some((seen_road, mapped_road)) = &roads {
                let distance = seen_road.distance(*place);
                let differs = |term: &ScoreboardTerms| {
                    let other = mapped_road.distance(mapped[term.possible].1);
                    (other * distance > 0.0).then(|| (other - distance).abs())
                };
                let most_similar = (0..terms.len())
                    .filter_map(|k| Some((k, differs(&terms[k])?)))
                    .min_by(|a, b| a.1.total_cmp(&b.1));
                if let Some((k, _)) = most_similar {
                    terms[k].road = 1.0;
                }
            }
            let best = terms
                .iter()
                .max_by(|a, b| a.total().total_cmp(&b.total()))
                .map(|term| term.possible);
            let reach = settings.furthest * settings.pixel;
            let chosen = best.filter(|j| (mapped[*j].1 - place).norm() <= reach);
            ScoreboardRow { terms, chosen }
        });
        Self {
            rows: rows.collect(),
        }
    }
}

/// Unit vectors from landmark `own` to the nearest ones of each class: all buildings, `most` fields, `most` trees.
fn directions(
    all: &[(GenericClass, Vector2<f64>)],
    own: usize,
    most: usize,
) -> [Vec<Vector2<f64>>; 3] {
    AROUND.map(|class| {
        let others = (0..all.len()).filter(|j| *j != own && all[*j].0 == class);
        let mut away: Vec<Vector2<f64>> = others.map(|j| all[j].1 - all[own].1).collect();
        away.sort_by(|a, b| a.norm_squared().total_cmp(&b.norm_squared()));
        if class != GenericClass::Building {
            away.truncate(most);
        }
        away.retain(|vector| vector.norm() > 0.0);
        away.iter().map(Vector2::normalize).collect()
    })
}

/// Share of `possible` vectors that match one of `observed`; 0 where there are none.
fn matching(observed: &[Vector2<f64>], possible: &[Vector2<f64>], most: f64) -> f64 {
    if possible.is_empty() {
        return 0.0;
    }
    let is_met = |p: &&Vector2<f64>| observed.iter().any(|o| (*o - **p).norm_squared() <= most);
    possible.iter().filter(is_met).count() as f64 / possible.len() as f64
}
