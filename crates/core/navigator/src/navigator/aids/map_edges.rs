//! Straight ends of roofs, roads and fields, put in the one place of the map where they fit together.

use std::sync::Arc;

use nalgebra::{Matrix2, SymmetricEigen, Vector2};

use super::super::observation::Observation;
use super::aid::{Aid, AidInfo, AidLook, AidMoment, AidNumber, BeginAid, NONE_PASSED_OVER};
use super::error::AidError;
use super::reading::Spacing;
use pilotage_base::frames::GroundPoint;
use pilotage_mission::settings::MAP_EDGES;
use pilotage_reference::ReferenceTable;
use pilotage_reference::edges::{
    EDGE, EDGE_GSD, EDGES, EdgePlace, EdgePrior, PhotoBelief, PhotoEdges, edges_of_tile,
};
use pilotage_reference::seeing::{LookAtTile, SeenTiles, ground_by_pose};

/// Least standard deviation per axis within which places are tried, metres: what the belief says is taken out of the
/// answer again, which is the more exact the less of it was in.
const LEAST_TRIED: f64 = 10.0;
/// Greatest, metres: the time that a look takes goes by its square.
const MOST_TRIED: f64 = 60.0;
/// Standard deviations of the heading within which it is tried.
const TURNED: f64 = 2.5;
/// Probability from which on a place is believed.
const BELIEVED: f64 = 0.9;
/// Greatest standard deviation of a place that tells anything, as a share of what was tried.
const TELLING: f64 = 0.7;

/// Description for people.
pub const INFO: AidInfo = AidInfo {
    key: MAP_EDGES.aid,
    label: "Edges of the map",
    description: "Straight ends of roofs, roads and fields in the picture, put in the place of the map where they fit \
                  together. They are the same on any day and for any camera, and no two are told apart: every place \
                  that the belief allows is weighed by what all of them say. Pictures are not looked at whose \
                  ground reaches farther than 2 km from its middle or has more than 30 million pixels of the size that is \
                  set here, nor where the heading is known so badly that too many places are to be compared.",
    channels: &[],
    components: &[("north", "m"), ("east", "m")],
    tells_place: true,
    passes_over: NONE_PASSED_OVER,
    numbers: &[
        AidNumber {
            key: MAP_EDGES.number,
            label: "Error of the map per axis",
            unit: "m",
            usual: MAP_EDGES.usual,
        },
        AidNumber {
            key: "apart",
            label: "Time between looks",
            unit: "s",
            usual: 0.5,
        },
        AidNumber {
            key: "pixel",
            label: "Ground in a pixel in which edges are sought",
            unit: "m",
            usual: EDGE_GSD,
        },
    ],
};

/// Makes the aid.
pub const BEGIN: BeginAid = |numbers, ground| {
    let ground = ground.ok_or_else(|| AidError::UnknownGround {
        key: INFO.key.to_owned(),
        what: "map".to_owned(),
        remedy: "open one, or switch the aid off".to_owned(),
    })?;
    let gsd = numbers[2];
    let look: LookAtTile = Arc::new(move |map, tile| edges_of_tile(map, tile, gsd, EDGES));
    Ok(Box::new(MapEdges {
        known: SeenTiles::by(Arc::clone(&ground.map), look),
        gsd,
        of_map: numbers[0],
        spacing: Spacing::of(numbers[1]),
    }))
};

/// The aid.
struct MapEdges {
    known: SeenTiles,
    /// Ground in a pixel in which edges are sought, metres: a flight below 100 m needs finer ones.
    gsd: f64,
    /// Standard deviation of the map per axis, metres.
    of_map: f64,
    spacing: Spacing,
}

impl Aid for MapEdges {
    fn info(&self) -> &'static AidInfo {
        &INFO
    }

    fn observe(&mut self, moment: &AidMoment<'_>) -> Vec<Observation<'static>> {
        let look = self.spacing.look(moment);
        look.and_then(|look| self.fix(look)).into_iter().collect()
    }
}

impl MapEdges {
    /// Place of the aircraft by the edges of a picture.
    fn fix(&mut self, look: &AidLook<'_>) -> Option<Observation<'static>> {
        let yaw = look.belief.covariance[(2, 2)].max(0.0).sqrt();
        let belief = PhotoBelief {
            pose: look.pose,
            ground_down: look.model.ground_down,
            deviation: look.deviation().clamp(LEAST_TRIED, MOST_TRIED),
            tilt: look.noise.roll.hypot(look.noise.pitch),
            turn: TURNED * yaw.hypot(look.noise.yaw),
            log_height: look.noise.height / look.height(),
            map_deviation: 0.0,
            gsd: self.gsd,
        };
        let edges = PhotoEdges::of(look.model.camera, look.picture, &belief).ok()?;
        let prior = *edges.prior();
        let around = self.known.near(prior.middle, edges.reach());
        let table = ReferenceTable::new(around, vec![EDGE.to_owned()]);
        let found = edges.place(&table)?;
        let (shift, own) = (found.probability >= BELIEVED)
            .then(|| without_belief(&prior, &found))
            .flatten()?;
        observation(look, prior.middle, shift, own, self.of_map)
    }
}

/// The place of the aircraft by the `shift` of the picture's middle from where it is believed, metres north and east, which
/// has the covariance `own` by the edges alone, on a map that is good to `of_map`, metres per axis. The bias of the heading
/// is left to the filter.
fn observation(
    look: &AidLook<'_>,
    middle: GroundPoint,
    shift: Vector2<f64>,
    own: Matrix2<f64>,
    of_map: f64,
) -> Option<Observation<'static>> {
    let own = own + Matrix2::identity() * look.beyond_state(of_map);
    let by_pose = ground_by_pose(
        middle,
        look.model.camera,
        &look.pose,
        look.model.ground_down,
    )?;
    let pose = look.noise.pose_covariance();
    let place = look.below().to_vector() + shift;
    Some(Observation::of_place(
        place,
        &own,
        (&by_pose, &pose),
        look.belief.mean.z,
    ))
}

/// Shift of the middle from the believed place, metres, and its covariance by the edges alone: the place that was found is
/// that of the belief and the edges together, of normal distributions. `None` where the edges tell next to nothing in
/// some direction.
fn without_belief(prior: &EdgePrior, found: &EdgePlace) -> Option<(Vector2<f64>, Matrix2<f64>)> {
    let shift = found.middle.to_vector() - prior.middle.to_vector();
    let variance = prior.deviation.powi(2);
    let most = SymmetricEigen::new(found.covariance).eigenvalues.max();
    if most > (TELLING * TELLING) * variance {
        return None;
    }
    let together = found.covariance.try_inverse()?;
    let covariance = (together - Matrix2::identity() / variance).try_inverse()?;
    Some((covariance * together * shift, covariance))
}

#[cfg(test)]
mod tests {
    use super::super::look_for_tests::TestLooks;
    use super::super::take;
    use super::*;
    use pilotage_estimation::filter::Gate;
    use pilotage_mission::settings::{ChosenAid, VehicleChoice};

    /// Variance of the place, metres² to the east, after so many looks that put the aircraft at the origin, by a picture
    /// whose middle lies `ahead` metres north of it.
    fn variance_after(looks: &TestLooks, (count, ahead): (usize, f64), of_map: f64) -> f64 {
        let mut engine = looks.engine(15.0);
        for _ in 0..count {
            let look = looks.look(engine.as_ref());
            let below = look.below();
            let middle = GroundPoint::new(below.north + ahead, below.east);
            // What a heading that is believed too small by a bias does to a place that far ahead.
            let turned = Vector2::new(0.0, ahead * look.belief.mean.z);
            let shift = turned - below.to_vector();
            let own = Matrix2::identity() * 0.01;
            let observed = observation(&look, middle, shift, own, of_map).unwrap();
            let gate = Gate { confidence: 0.999 };
            let taken = take(engine.as_mut(), &observed, gate).unwrap().unwrap();
            assert!(taken.verdict.accepted);
        }
        engine.state().position_covariance()[(1, 1)]
    }

    #[test]
    fn a_hundred_looks_are_no_surer_than_the_map() {
        let mut looks = TestLooks::default();
        let aid = ChosenAid::usual(INFO.key).with(MAP_EDGES.number, 3.0);
        looks.settings.aids = vec![aid];
        // 1 / (1 / 15² + 1 / 3²) = 8.65.
        let after = variance_after(&looks, (100, 0.0), 3.0);
        assert!((8.0..9.5).contains(&after), "{after}");
    }

    #[test]
    fn a_hundred_looks_leave_what_the_bias_of_the_heading_leaves_open() {
        let mut looks = TestLooks::default();
        looks.settings.vehicle = VehicleChoice::AirplaneFull;
        looks.settings.process.heading_bias = 0.02;
        // Of 300 m ahead, a bias of 0.02 makes 6 m: 1 / (1 / 15² + 1 / 6²) = 31.03.
        let after = variance_after(&looks, (100, 300.0), 0.0);
        assert!((30.5..32.0).contains(&after), "{after}");
    }

    #[test]
    fn the_belief_is_taken_out_of_what_it_and_the_edges_say_together() {
        let prior = EdgePrior {
            middle: GroundPoint::new(100.0, 200.0),
            deviation: 10.0,
            turn: 0.1,
            log_height: 0.0,
            map_deviation: 0.0,
        };
        // Edges that say 6 m north at 2 m, 3 m east at 5 m.
        let weight = |of_edges: f64| 100.0 / (100.0 + of_edges * of_edges);
        let found = EdgePlace {
            middle: GroundPoint::new(100.0 + 6.0 * weight(2.0), 200.0 + 3.0 * weight(5.0)),
            covariance: Matrix2::new(4.0 * weight(2.0), 0.0, 0.0, 25.0 * weight(5.0)),
            probability: 1.0,
        };
        let (shift, covariance) = without_belief(&prior, &found).unwrap();
        assert!((shift - Vector2::new(6.0, 3.0)).norm() < 1e-9, "{shift}");
        assert!(
            (covariance - Matrix2::new(4.0, 0.0, 0.0, 25.0)).norm() < 1e-9,
            "{covariance}"
        );
        let nothing = EdgePlace {
            covariance: Matrix2::new(4.0, 0.0, 0.0, 90.0),
            ..found
        };
        assert!(without_belief(&prior, &nothing).is_none());
    }
}
