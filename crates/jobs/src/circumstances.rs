//! Circumstances of a plan, of which its orders are made alike wherever people plan.

use pilotage_core::camera::CameraModel;
use pilotage_core::frames::{GroundPoint, GroundRect};
use pilotage_core::landmark::Landmark;
use pilotage_core::mission::{Route, WayPoint};
use pilotage_core::navigator::NavigatorSettings;
use pilotage_core::plan::{FieldView, FixSource, PlannedLandmark, cruise};
use pilotage_core::training::TrainingPlan;

use super::{
    AssessmentOrder, FieldFrom, FieldOrder, FixesFrom, LabelledFrames, MapSource, SuggestOrder,
    TrainOrder,
};

/// Map of a plan, and how it is flown over.
#[derive(Clone, Debug, PartialEq)]
pub struct PlanCircumstances {
    /// The map.
    pub map: MapSource,
    /// The camera.
    pub camera: CameraModel,
    /// Mean height above ground, metres.
    pub height: f64,
    /// Down coordinate of the ground plane, metres.
    pub ground_down: f64,
    /// Settings of the navigator.
    pub navigator: NavigatorSettings,
    /// Standard deviation of the position per axis with which landmarks are looked for, metres.
    pub position: f64,
}

/// Mean airspeed over the legs of a route, m/s: its length over its time. `None` without a leg.
fn mean_speed(route: &Route) -> Option<f64> {
    let legs = route.way_points.windows(2);
    let time = |leg: &[WayPoint]| {
        let [from, to] = leg else { return 0.0 };
        let length = from.position.distance(&to.position);
        length / to.speed.unwrap_or_else(cruise)
    };
    let time: f64 = legs.map(time).sum();
    (time > 0.0).then(|| route.length() / time)
}

impl PlanCircumstances {
    /// View of the ground.
    pub fn view(&self) -> FieldView {
        let camera = self.camera.clone();
        FieldView::of_flight(camera, self.height, self.position, &self.navigator.sensors)
    }

    /// Distance around a box within which a landmark is looked for, metres.
    pub fn searched(&self, bounds: &GroundRect) -> f64 {
        let side = bounds.width().max(bounds.height());
        let sigmas = self.navigator.detector.search_sigmas;
        self.view().searched(sigmas, side)
    }

    /// Order to measure a landmark, on the days that everybody takes.
    pub fn assessment(&self, landmark: &Landmark) -> AssessmentOrder {
        AssessmentOrder {
            map: self.map.clone(),
            landmark: landmark.clone(),
            camera: self.camera.clone(),
            height: self.height,
            navigator: self.navigator.clone(),
            ground_down: self.ground_down,
            seed: AssessmentOrder::SEED,
        }
    }

    /// Order to train a detector for a landmark, without the one that it has.
    pub fn training(
        &self,
        landmark: &Landmark,
        plan: TrainingPlan,
        labelled: Option<LabelledFrames>,
    ) -> TrainOrder {
        TrainOrder {
            map: self.map.clone(),
            landmark: landmark.untrained(),
            camera: self.camera.clone(),
            height: self.height,
            sensors: self.navigator.sensors,
            ground_down: self.ground_down,
            plan,
            look_alikes_within: self.searched(&landmark.bounds),
            labelled,
            left: None,
        }
    }

    /// Field of the probability of a fix over `region`, from landmarks and what is expected of them, or from whatever the map
    /// offers.
    pub fn field(
        &self,
        of: FixesFrom,
        region: GroundRect,
        landmarks: impl Iterator<Item = PlannedLandmark>,
    ) -> FieldOrder {
        FieldOrder {
            map: self.map.clone(),
            region,
            view: self.view(),
            from: match of {
                FixesFrom::Landmarks => {
                    let source = |planned| FixSource::of(&planned, self.height);
                    FieldFrom::Landmarks(landmarks.filter_map(source).collect())
                }
                FixesFrom::Map => FieldFrom::Map {
                    search_sigmas: self.navigator.detector.search_sigmas,
                    days: FieldFrom::FEW_DAYS,
                },
            },
        }
    }

    /// Order to propose up to `count` landmarks beside those that are there, along the places of a way, which is that of
    /// `route` where it was drawn, or all over the map without a place.
    pub fn proposal(
        &self,
        landmarks: &[Landmark],
        route: Option<&Route>,
        way_points: Vec<GroundPoint>,
        count: usize,
    ) -> SuggestOrder {
        SuggestOrder {
            map: self.map.clone(),
            view: self.view(),
            speed: route.and_then(mean_speed).unwrap_or_else(cruise),
            way_points,
            ground_down: self.ground_down,
            navigator: self.navigator.clone(),
            taken: landmarks.iter().map(|landmark| landmark.bounds).collect(),
            count,
            side: None,
            seed: SuggestOrder::SEED,
        }
    }
}

#[cfg(test)]
mod tests {
    use pilotage_core::frames::{Altitude, AltitudeFrame};
    use pilotage_core::plan::Proposal;

    use super::*;

    #[test]
    fn orders_of_one_plan_agree_in_what_it_is_flown_with() {
        let with = PlanCircumstances {
            map: MapSource::world("countryside"),
            camera: CameraModel::pinhole(640, 480, 1.0),
            height: 130.0,
            ground_down: -5.0,
            navigator: NavigatorSettings::default(),
            position: Proposal::POSITION,
        };
        let bounds = GroundRect::centered(GroundPoint::new(10.0, 20.0), 30.0, 40.0);
        let landmark = Landmark::new(3, "barn", bounds);
        let measured = with.assessment(&landmark);
        let trained = with.training(&landmark, TrainingPlan::default(), None);
        let altitude = Altitude::new(130.0, AltitudeFrame::AboveGround);
        // A speed is that of the leg which leads to a way-point: 60 s for 600 m, and 30 s for 600 m.
        let at = |north, speed| WayPoint {
            speed,
            ..WayPoint::new(GroundPoint::new(north, 0.0), altitude)
        };
        let route = Route {
            way_points: vec![at(0.0, None), at(600.0, Some(10.0)), at(0.0, Some(20.0))],
            ..Route::default()
        };
        let beside = std::slice::from_ref(&landmark);
        let proposed = with.proposal(beside, Some(&route), vec![GroundPoint::default()], 4);
        assert_eq!(
            (measured.height, trained.height, proposed.view.height),
            (130.0, 130.0, 130.0)
        );
        assert_eq!(
            (measured.ground_down, trained.ground_down),
            (-5.0, proposed.ground_down)
        );
        assert_eq!(
            (proposed.speed, proposed.taken.as_slice()),
            (1200.0 / 90.0, &[bounds][..])
        );
        assert!(trained.look_alikes_within >= 40.0, "a box at least");
        let anywhere = with.proposal(&[], None, Vec::new(), 4);
        assert!(anywhere.way_points.is_empty() && (anywhere.speed - cruise()).abs() < 1e-9);
    }
}
