//! Simulated flights in the worlds that are built in.

use std::sync::Arc;

use pilotage_core::frames::{Altitude, AltitudeFrame};
use pilotage_core::imagery::CachedImagery;
use pilotage_core::simulate::{LaidWorld, SimulationChoice, Wind};

use super::flights::{KeptFrames, OpenFlight};
use super::{FlightSource, SimulationOptions};

/// The flight of these options.
pub fn choice(options: &SimulationOptions) -> Result<SimulationChoice, String> {
    SimulationChoice::named(&options.scenario).ok_or_else(|| {
        let known: Vec<_> = SimulationChoice::all().iter().map(|c| c.name).collect();
        format!(
            "there is no scenario “{}”; there are {}",
            options.scenario,
            known.join(", ")
        )
    })
}

/// The mean wind of a simulated flight.
pub fn scenario_wind(options: &SimulationOptions) -> Wind {
    let stated = options.overrides().wind;
    stated
        .or_else(|| Some(SimulationChoice::named(&options.scenario)?.wind))
        .unwrap_or_default()
}

impl FlightSource {
    /// Height at which a first way-point is planned where no flight says another, metres above ground.
    pub const USUAL_HEIGHT: f64 = 120.0;

    /// Mean wind of the flight, as far as it is known before it is flown; `None` of a recorded flight.
    pub fn wind(&self) -> Option<Wind> {
        match self {
            Self::Simulated(options) => Some(scenario_wind(options)),
            Self::Rehearsed(flight) => Some(flight.path.wind),
            Self::Studied(studied) => Some(studied.flight.wind()),
            Self::Files(_) | Self::Nothing => None,
        }
    }

    /// Altitude at which a first way-point is planned over the ground of the flight.
    pub fn usual_altitude(&self) -> Altitude {
        let flown = match self {
            Self::Simulated(options) => options
                .height
                .or_else(|| Some(SimulationChoice::named(&options.scenario)?.height)),
            Self::Rehearsed(flight) => Some(flight.path.height),
            Self::Studied(studied) => studied.flight.height(),
            Self::Files(_) | Self::Nothing => None,
        };
        Altitude::new(
            flown.unwrap_or(Self::USUAL_HEIGHT),
            AltitudeFrame::AboveGround,
        )
    }
}

/// Flies in `world`; pictures are taken when they are asked for, over ground that is `shown` where the host shares some.
pub fn open(
    options: &SimulationOptions,
    world: &dyn LaidWorld,
    shown: Option<Arc<CachedImagery>>,
) -> Result<OpenFlight, String> {
    let overrides = options.overrides();
    let simulated = world.fly(&options.scenario, options.seed, &overrides);
    let mut simulated = simulated.ok_or("the flight is one of another world")?;
    if let Some(shown) = shown.filter(|_| world.scenery().is_some()) {
        simulated.frames = simulated.frames.over(shown);
    }
    let missions = world.missions(&options.scenario, &overrides).into_iter();
    Ok(OpenFlight {
        utc_at_zero: None,
        frames: KeptFrames::rendered(&simulated.flight, Box::new(simulated.frames)),
        flight: Arc::new(simulated.flight),
        mission: missions.map(|(_, mission)| mission).next(),
    })
}
