//! The vehicle models that there are.

use std::sync::Arc;

use serde::{Deserialize, Serialize};

use pilotage_base::frames::{Attitude, GroundPoint};

use super::{
    AirplaneFull, AirplaneScaled, AirplaneWind, AirplaneWindBias, AirplaneWindGust, AnyVehicle,
    AtHeight, ConstantVelocity, ControlInput, HeightModel, MapError, Multirotor, OverMap,
    RandomWalk, ThesisNoise, TiltBias, Tilted, VehicleModel, VelocityDriven,
};

/// Something that wants to work with a vehicle model of any state size.
///
/// The filter's size is fixed at compile time, and this is the door from [`VehicleSettings`], which
/// is known only at run time, to code that is generic over it.
pub trait VehicleVisitor {
    /// Result that it makes of the model.
    type Output;

    /// Works with the model.
    fn visit<const N: usize, V>(self, model: V) -> Self::Output
    where
        V: VehicleModel<N> + Clone + Send + Sync + 'static;
}

/// A filter of twelve states would be code of its own, as much as all that a page's program may still grow by.
macro_rules! tilted_over_map {
    (8, $model:expr, $bias:ident, $error:ident, $visitor:ident) => {
        $visitor.visit::<10, _>(OverMap::<8>::new($model, $error))
    };
    ($size:tt, $model:expr, $bias:ident, $error:ident, $visitor:ident) => {{
        let tilted = Tilted::<$size>::new($model, $bias);
        let over_map = OverMap::<{ $size + 2 }>::new(Arc::new(tilted), $error);
        $visitor.visit::<{ $size + 4 }, _>(over_map)
    }};
}

/// The same of a height and the error of a map: the largest models have the height alone.
macro_rules! at_height_over_map {
    (8, $model:expr, $height:ident, $error:ident, $visitor:ident) => {
        $visitor.visit::<10, _>(AtHeight::<8>::new($model, $height))
    };
    ($size:tt, $model:expr, $height:ident, $error:ident, $visitor:ident) => {{
        let high = AtHeight::<$size>::new($model, $height);
        let over_map = OverMap::<{ $size + 2 }>::new(Arc::new(high), $error);
        $visitor.visit::<{ $size + 4 }, _>(over_map)
    }};
}

macro_rules! registry {
    ($($(#[$doc:meta])* $variant:ident = $key:literal, $label:literal, $size:tt, $kept:literal;)+) => {
        /// A vehicle model with its settings, by name in files and messages.
        #[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
        #[serde(tag = "model", rename_all = "kebab-case")]
        pub enum VehicleSettings {
            $($(#[$doc])* $variant($variant),)+
        }

        /// Every model with its default settings, in the order of a menu.
        pub fn all_vehicles() -> Vec<VehicleSettings> {
            vec![$(VehicleSettings::$variant($variant::default()),)+]
        }

        impl VehicleSettings {
            /// Name in files and on the command line.
            pub fn key(&self) -> &'static str {
                match self { $(Self::$variant(_) => $key,)+ }
            }

            /// Name on screen.
            pub fn label(&self) -> &'static str {
                match self { $(Self::$variant(_) => $label,)+ }
            }

            /// Description of the model's assumptions, in a sentence.
            pub fn description(&self) -> &'static str {
                match self { $(Self::$variant(_) => $kept,)+ }
            }

            /// Opens the door to code that is generic over the state size.
            pub fn visit<V: VehicleVisitor>(&self, visitor: V) -> V::Output {
                match self { $(Self::$variant(model) => visitor.visit::<$size, _>(*model),)+ }
            }

            /// The same with the height of the vehicle as a state, two states larger.
            pub fn visit_at_height<V: VehicleVisitor>(
                &self,
                height: HeightModel,
                visitor: V,
            ) -> V::Output {
                match self {
                    $(Self::$variant(model) => {
                        visitor.visit::<{ $size + 2 }, _>(AtHeight::<$size>::new(Arc::new(*model), height))
                    })+
                }
            }

            /// The same with the height as a state over a map that is off, four states larger; the largest models go without
            /// the error of the map.
            pub fn visit_at_height_over_map<V: VehicleVisitor>(
                &self,
                height: HeightModel,
                error: MapError,
                visitor: V,
            ) -> V::Output {
                match self {
                    $(Self::$variant(model) => {
                        at_height_over_map!($size, Arc::new(*model), height, error, visitor)
                    })+
                }
            }

            /// The same with biases of the camera's roll and pitch, two states larger.
            pub fn visit_tilted<V: VehicleVisitor>(&self, bias: TiltBias, visitor: V) -> V::Output {
                match self {
                    $(Self::$variant(model) => {
                        visitor.visit::<{ $size + 2 }, _>(Tilted::<$size>::new(Arc::new(*model), bias))
                    })+
                }
            }

            /// The same with biases of the camera's roll and pitch over a map that is off, four states larger; the largest
            /// models go without these biases.
            pub fn visit_tilted_over_map<V: VehicleVisitor>(
                &self,
                bias: TiltBias,
                error: MapError,
                visitor: V,
            ) -> V::Output {
                match self {
                    $(Self::$variant(model) => {
                        tilted_over_map!($size, Arc::new(*model), bias, error, visitor)
                    })+
                }
            }

            /// The same with the model over a map that is off, two states larger.
            pub fn visit_over_map<V: VehicleVisitor>(&self, error: MapError, visitor: V) -> V::Output {
                match self {
                    $(Self::$variant(model) => {
                        visitor.visit::<{ $size + 2 }, _>(OverMap::<$size>::new(Arc::new(*model), error))
                    })+
                }
            }
        }
    };
}

registry! {
    /// Steady wind.
    AirplaneWind = "airplane-wind", "Airplane, wind", 4,
        "Flies its airspeed along its heading in a slowly changing wind.";
    /// Steady wind and gusts.
    AirplaneWindGust = "airplane-wind-gust", "Airplane, wind and gusts", 6,
        "As airplane in wind, with gusts that come and go in seconds.";
    /// Steady wind and biased air data.
    AirplaneWindBias = "airplane-wind-bias", "Airplane, wind and biases", 6,
        "As airplane in wind, with airspeed and heading that read slowly wrong.";
    /// Steady wind, gusts and biased air data.
    AirplaneFull = "airplane-full", "Airplane, wind, gusts and biases", 8,
        "As airplane in wind, with gusts and with air data that read slowly wrong.";
    /// Steady wind, gusts, an airspeed that reads by a factor wrong, a biased heading.
    AirplaneScaled = "airplane-scaled", "Airplane, wind, gusts, airspeed scale", 8,
        "As airplane in wind and gusts, with an airspeed that reads by a factor wrong and a biased heading.";
    /// Position only.
    RandomWalk = "random-walk", "Random walk", 2,
        "Nothing is known but that the position changes slowly.";
    /// Position and velocity over ground.
    ConstantVelocity = "constant-velocity", "Nearly constant velocity", 4,
        "Keeps its velocity over ground but for small accelerations.";
    /// Multirotor in wind.
    Multirotor = "multirotor", "Multirotor, wind", 6,
        "Is pushed where it tilts and slowed down by the air, which moves with the wind.";
    /// Measured velocity over ground.
    VelocityDriven = "velocity-driven", "Measured velocity", 4,
        "Moves with a measured velocity over ground that reads slowly wrong.";
}

impl Default for VehicleSettings {
    fn default() -> Self {
        Self::AirplaneWind(AirplaneWind::default())
    }
}

impl VehicleSettings {
    /// The airplane of DeAngelo 2016, with the process noise of Table 4.
    pub fn thesis(noise: ThesisNoise) -> Self {
        Self::AirplaneWind(AirplaneWind::with_thesis_noise(noise))
    }

    /// The model with this key and its default settings.
    ///
    /// ```
    /// use pilotage_estimation::vehicle::VehicleSettings;
    ///
    /// let vehicle = VehicleSettings::from_key("random-walk").ok_or("no such model")?;
    /// assert_eq!(vehicle.state_components(), [("north", "m"), ("east", "m")]);
    /// assert!(VehicleSettings::from_key("balloon").is_none());
    /// # Ok::<(), &str>(())
    /// ```
    pub fn from_key(key: &str) -> Option<Self> {
        all_vehicles().into_iter().find(|v| v.key() == key)
    }

    /// Names and SI units of the state components.
    pub fn state_components(&self) -> Vec<(&'static str, &'static str)> {
        struct Components;
        impl VehicleVisitor for Components {
            type Output = Vec<(&'static str, &'static str)>;
            fn visit<const N: usize, V: VehicleModel<N>>(self, model: V) -> Self::Output {
                let layout = model.layout().into_iter();
                layout
                    .map(|component| (component.key(), component.unit()))
                    .collect()
            }
        }
        self.visit(Components)
    }

    /// Whether the model flies by an airspeed: where it is after a second depends on what the airspeed reads.
    ///
    /// ```
    /// use pilotage_estimation::vehicle::VehicleSettings;
    ///
    /// let flies_by_air = |key| VehicleSettings::from_key(key).is_some_and(|v| v.uses_airspeed());
    /// assert!(flies_by_air("airplane-wind") && !flies_by_air("velocity-driven"));
    /// ```
    pub fn uses_airspeed(&self) -> bool {
        struct MovedByAirspeed;
        impl VehicleVisitor for MovedByAirspeed {
            type Output = bool;
            fn visit<const N: usize, V>(self, model: V) -> bool
            where
                V: VehicleModel<N> + Clone + Send + Sync + 'static,
            {
                // By its table of functions: in the page's programs each model would stand here once more.
                let model: AnyVehicle<N> = Arc::new(model);
                let start = model.prior(GroundPoint::default(), 1.0).mean;
                let after = |airspeed| {
                    let input = ControlInput::new(airspeed, Attitude::level(0.0));
                    model.propagate(&start, &input, 1.0)
                };
                after(10.0) != after(20.0)
            }
        }
        self.visit(MovedByAirspeed)
    }
}
