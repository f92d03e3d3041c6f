//! Contents of the panels of a plot, and arrangements that make sense for every log.

use pilotage_core::flight::interpret::Role;
use serde::{Deserialize, Serialize};

use super::OpenLog;
use pilotage_jobs::SeriesName;

/// Content of a panel.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default)]
pub struct PanelContent {
    /// Its fields.
    pub fields: Vec<SeriesName>,
    /// The field that they are plotted against; time if `None`.
    pub against: Option<SeriesName>,
    /// Whether points that are plotted against a field are joined.
    pub joined: bool,
}

impl PanelContent {
    /// Fields over time.
    pub fn over_time(fields: Vec<SeriesName>) -> Self {
        Self {
            fields,
            ..Self::default()
        }
    }
}

/// An arrangement that makes sense for every log that has what it shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Preset {
    /// Roll, pitch, heading.
    Attitude,
    /// Airspeed and ground speed, wind as the autopilot has it.
    SpeedsAndWind,
    /// Every height.
    Height,
    /// Satellite navigation: place, velocity, fix and satellites.
    Navigation,
    /// Specific forces and turn rates.
    Vibration,
}

impl Preset {
    /// Every one, in reading order.
    pub const ALL: [Self; 5] = [
        Self::Attitude,
        Self::SpeedsAndWind,
        Self::Height,
        Self::Navigation,
        Self::Vibration,
    ];

    /// Name for people.
    pub fn label(self) -> &'static str {
        match self {
            Self::Attitude => "Attitude",
            Self::SpeedsAndWind => "Speeds and wind",
            Self::Height => "Height",
            Self::Navigation => "Navigation",
            Self::Vibration => "Vibration",
        }
    }

    /// Its panels, with all that they could show: each row's first is what the others are plotted against, if
    /// it is so marked.
    fn roles(self) -> &'static [(Option<Role>, &'static [Role])] {
        match self {
            Self::Attitude => &[
                (None, &[Role::Roll]),
                (None, &[Role::Pitch]),
                (None, &[Role::Heading]),
            ],
            Self::SpeedsAndWind => &[
                (None, &[Role::Airspeed, Role::GroundSpeed]),
                (None, &[Role::WindNorth, Role::WindEast]),
            ],
            Self::Height => &[(
                None,
                &[
                    Role::BarometricHeight,
                    Role::HeightAboveGround,
                    Role::GpsHeight,
                ],
            )],
            Self::Navigation => &[
                (Some(Role::Longitude), &[Role::Latitude]),
                (
                    None,
                    &[
                        Role::GpsVelocityNorth,
                        Role::GpsVelocityEast,
                        Role::GpsVelocityDown,
                    ],
                ),
                (None, &[Role::GpsFix, Role::GpsSatellites]),
            ],
            Self::Vibration => &[
                (
                    None,
                    &[
                        Role::AccelerationForward,
                        Role::AccelerationRight,
                        Role::AccelerationDown,
                    ],
                ),
                (None, &[Role::RollRate, Role::PitchRate, Role::YawRate]),
            ],
        }
    }

    /// Its panels, as far as `log` has what they show; empty if it has nothing of it.
    pub fn panels(self, log: &OpenLog) -> Vec<PanelContent> {
        let known = |role: &Role| {
            let mut sensors = log.overview.iter().flat_map(|overview| &overview.sensors);
            sensors.any(|sensor| sensor.role == *role)
        };
        let panel = |(against, roles): &(Option<Role>, &[Role])| {
            if against.is_some_and(|role| !known(&role)) {
                return None;
            }
            let fields = roles.iter().filter(|role| known(role));
            let fields: Vec<SeriesName> = fields.map(|role| SeriesName::role(*role)).collect();
            (!fields.is_empty()).then_some(PanelContent {
                fields,
                against: against.map(SeriesName::role),
                joined: true,
            })
        };
        self.roles().iter().filter_map(panel).collect()
    }
}
