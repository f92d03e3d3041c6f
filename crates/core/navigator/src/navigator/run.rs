//! The table of step reports; views only query it.

use serde::{Deserialize, Serialize};

use super::StepReport;
use pilotage_estimation::vehicle::StateComponent;
use pilotage_mission::settings::NavigatorSettings;
use pilotage_vision::landmark::Landmark;

/// Conclusions of the navigator over a flight, so far.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Run {
    /// Name of the run, as shown to people.
    pub name: String,
    /// The settings it was made with.
    pub settings: NavigatorSettings,
    /// The landmarks it was made with.
    pub landmarks: Vec<Landmark>,
    /// Names of the state's components with their units, e.g. ("wind north", "m/s").
    pub state_names: Vec<(String, String)>,
    /// Steps in time order.
    pub steps: Vec<StepReport>,
}

impl Run {
    /// Index of the last step at or before `time`.
    pub fn index_at(&self, time: f64) -> Option<usize> {
        self.steps
            .partition_point(|s| s.time <= time + 1e-9)
            .checked_sub(1)
    }

    /// The last step at or before `time`.
    pub fn step_at(&self, time: f64) -> Option<&StepReport> {
        self.steps.get(self.index_at(time)?)
    }

    /// The last step with a camera frame at or before `time`.
    pub fn frame_step_at(&self, time: f64) -> Option<&StepReport> {
        let last = self.index_at(time)?;
        self.steps[..=last].iter().rev().find(|s| s.frame.is_some())
    }

    /// First and last time, seconds, if there is any step.
    pub fn span(&self) -> Option<(f64, f64)> {
        Some((self.steps.first()?.time, self.steps.last()?.time))
    }

    /// Index of a component in the state; `None` where the run's vehicle has none.
    ///
    /// ```
    /// # use std::sync::Arc;
    /// # use pilotage_base::frames::GroundPoint;
    /// # use pilotage_flight::{Channel, ChannelName, Flight, StartFix};
    /// # use pilotage_raster::camera::CameraModel;
    /// # use pilotage_mission::settings::NavigatorSettings;
    /// # use pilotage_navigator::navigator::{KnownGround, Navigator};
    /// use pilotage_estimation::vehicle::StateComponent;
    /// # use pilotage_raster::imagery::Blank;
    /// # let channel = |name, mean: f64, by: f64| Channel {
    /// #     name,
    /// #     times: (0..=50).map(|i| 0.2 * f64::from(i)).collect(),
    /// #     values: (0..=50).map(|i| if i % 2 == 0 { mean + by } else { mean - by }).collect(),
    /// # };
    /// # let flight = Flight {
    /// #     name: "eastward".to_owned(),
    /// #     frame_on_globe: None,
    /// #     camera: CameraModel::pinhole(640, 480, 1.0),
    /// #     ground_down: 0.0,
    /// #     channels: vec![
    /// #         channel(ChannelName::Airspeed, 20.0, 0.1),
    /// #         channel(ChannelName::Heading, 90_f64.to_radians(), 0.001),
    /// #     ],
    /// #     frames: Vec::new(),
    /// #     start: StartFix { time: 0.0, position: GroundPoint::new(0.0, 0.0), standard_deviation: 3.0 },
    /// #     truth: None,
    /// # };
    /// # let settings = NavigatorSettings::default();
    /// # let navigator = Navigator::new(Arc::new(flight), &KnownGround::new(Arc::new(Blank)), &settings)?;
    ///
    /// // The first two are the position.
    /// let run = navigator.run_head();
    /// assert_eq!(run.state_index(StateComponent::PositionNorth), Some(0));
    /// assert_eq!(run.state_index(StateComponent::WindNorth), Some(2));
    /// assert_eq!(run.state_index(StateComponent::VelocityNorth), None);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn state_index(&self, component: StateComponent) -> Option<usize> {
        let key = component.key();
        self.state_names.iter().position(|(name, _)| name == key)
    }
}
