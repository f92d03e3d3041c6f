//! Components of which states are made.

macro_rules! components {
    ($($(#[$doc:meta])* $variant:ident = $key:literal, $unit:literal;)+) => {
        /// A component of the state of a vehicle.
        ///
        /// Of a quantity with two axes, east follows north in every layout.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub enum StateComponent {
            $($(#[$doc])* $variant,)+
            /// A component that nobody but its model knows.
            Own {
                /// Name in files and on screen.
                key: &'static str,
                /// SI unit; empty for a ratio.
                unit: &'static str,
            },
        }

        impl StateComponent {
            /// Every component that has a meaning for others than its model.
            pub const ALL: [Self; [$($key),+].len()] = [$(Self::$variant),+];

            /// Name in files and on screen.
            pub fn key(self) -> &'static str {
                match self {
                    $(Self::$variant => $key,)+
                    Self::Own { key, .. } => key,
                }
            }

            /// SI unit; empty for a ratio.
            pub fn unit(self) -> &'static str {
                match self {
                    $(Self::$variant => $unit,)+
                    Self::Own { unit, .. } => unit,
                }
            }
        }
    };
}

components! {
    /// Position, metres north of the world's origin.
    PositionNorth = "north", "m";
    /// Position, metres east of the world's origin.
    PositionEast = "east", "m";
    /// Velocity over ground, m/s north.
    VelocityNorth = "velocity north", "m/s";
    /// Velocity over ground, m/s east.
    VelocityEast = "velocity east", "m/s";
    /// Velocity through the air along the heading, level, m/s.
    VelocityForward = "velocity forward", "m/s";
    /// Velocity through the air to the right of the heading, level, m/s.
    VelocityRight = "velocity right", "m/s";
    /// Steady wind: velocity of the air, m/s north.
    WindNorth = "wind north", "m/s";
    /// Steady wind: velocity of the air, m/s east.
    WindEast = "wind east", "m/s";
    /// Motion of the air beside the steady wind, m/s north.
    GustNorth = "gust north", "m/s";
    /// Motion of the air beside the steady wind, m/s east.
    GustEast = "gust east", "m/s";
    /// Airspeed, reading minus truth, m/s.
    AirspeedBias = "airspeed bias", "m/s";
    /// Airspeed, truth over reading.
    AirspeedScale = "airspeed scale", "";
    /// Heading, reading minus truth, radians.
    HeadingBias = "heading bias", "rad";
    /// Roll of the camera, reading minus truth, radians.
    RollBias = "roll bias", "rad";
    /// Pitch of the camera, reading minus truth, radians.
    PitchBias = "pitch bias", "rad";
    /// Measured velocity over ground, reading minus truth, m/s north.
    VelocityBiasNorth = "velocity bias north", "m/s";
    /// Measured velocity over ground, reading minus truth, m/s east.
    VelocityBiasEast = "velocity bias east", "m/s";
    /// Height above the ground plane, metres.
    Height = "height", "m";
    /// Height by air pressure, reading minus truth, metres: whatever the barometer was set to.
    BarometerBias = "barometer bias", "m";
    /// Metres by which the map shows things too far north.
    MapErrorNorth = "map error north", "m";
    /// Metres by which the map shows things too far east.
    MapErrorEast = "map error east", "m";
}

impl StateComponent {
    /// The component with this key.
    ///
    /// ```
    /// use pilotage_estimation::vehicle::StateComponent;
    ///
    /// let wind = StateComponent::from_key("wind north").ok_or("no such component")?;
    /// assert_eq!((wind, wind.unit()), (StateComponent::WindNorth, "m/s"));
    /// assert_eq!(StateComponent::from_key("colour"), None);
    /// # Ok::<(), &str>(())
    /// ```
    pub fn from_key(key: &str) -> Option<Self> {
        Self::ALL
            .into_iter()
            .find(|component| component.key() == key)
    }

    /// Index of this component in a layout.
    pub fn index_in(self, layout: &[Self]) -> Option<usize> {
        layout.iter().position(|component| *component == self)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::vehicle::{VehicleModel, VehicleVisitor, all_vehicles};

    struct Layout;

    impl VehicleVisitor for Layout {
        type Output = Vec<StateComponent>;

        fn visit<const N: usize, V: VehicleModel<N>>(self, model: V) -> Self::Output {
            model.layout().to_vec()
        }
    }

    #[test]
    fn every_layout_begins_with_the_position_and_has_east_after_north() {
        for vehicle in all_vehicles() {
            let layout = vehicle.visit(Layout);
            let position = [StateComponent::PositionNorth, StateComponent::PositionEast];
            assert_eq!(layout[..2], position, "{}", vehicle.key());
            for (i, component) in layout.iter().enumerate() {
                assert_eq!(component.index_in(&layout), Some(i), "{}", vehicle.key());
                if let Some(axis) = component.key().strip_suffix("north") {
                    assert_eq!(layout[i + 1].key(), format!("{axis}east"));
                }
            }
        }
    }

    #[test]
    fn no_two_components_share_a_key() {
        for component in StateComponent::ALL {
            assert_eq!(StateComponent::from_key(component.key()), Some(component));
        }
    }
}
