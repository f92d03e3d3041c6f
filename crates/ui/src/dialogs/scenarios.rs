//! What people read about the built-in scenarios.

/// A built-in scenario as the dialog shows it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scenario {
    /// Its name.
    pub name: &'static str,
    /// What happens in it.
    pub description: &'static str,
    /// Direction its wind comes from, degrees, and speed, knots.
    pub wind: (f64, f64),
    /// Height above ground, feet.
    pub height: f64,
}

/// The built-in scenarios.
pub const SCENARIOS: [Scenario; 3] = [
    Scenario {
        name: "distinct-400ft-wind",
        description: "Two legs at 400 ft over nine buildings and a pool. The wind blows with 10 kt \
                      from the north-west; the navigator does not know it at the start and has to learn it.",
        wind: (307.0, 10.0),
        height: 400.0,
    },
    Scenario {
        name: "distinct-400ft-calm",
        description: "The same two legs without wind: how well position alone is held.",
        wind: (307.0, 0.0),
        height: 400.0,
    },
    Scenario {
        name: "distinct-1000ft-extended",
        description: "S-turns at 1000 ft: more landmarks at once, each smaller, and more of the \
                      camera's vibration in every one.",
        wind: (307.0, 0.0),
        height: 1000.0,
    },
];
