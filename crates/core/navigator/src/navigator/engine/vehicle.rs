//! The vehicle model that the settings ask for.

use pilotage_estimation::vehicle::{
    AirData, AirDataBiases, AirplaneFull, AirplaneWind, AirplaneWindGust, ConstantVelocity, Gusts,
    HeightModel, MapError, Multirotor, RandomWalk, StateComponent, ThesisNoise, TiltBias,
    UnmodelledAir, VehicleModel, VehicleSettings, VehicleVisitor, VelocityDriven,
};
use pilotage_mission::settings::{MAP_ERRORS, NavigatorSettings, SensorNoise, VehicleChoice};

/// Works with the model that the filter of a run has: that of the vehicle, with its height where that is asked for, with the
/// error of the map where that is known to be off, and with the biases of a tilt that is where the height is none. The
/// largest model has a pair of these at most: the first of them.
pub fn visit_model<V: VehicleVisitor>(settings: &NavigatorSettings, visitor: V) -> V::Output {
    let vehicle = vehicle(settings);
    let error = stated_map_error(settings);
    if settings.estimates_height {
        let height = HeightModel::default();
        return match error {
            Some(error) => vehicle.visit_at_height_over_map(height, error, visitor),
            None => vehicle.visit_at_height(height, visitor),
        };
    }
    match (error, tilt_bias(settings, error.is_some())) {
        (Some(error), Some(bias)) => vehicle.visit_tilted_over_map(bias, error, visitor),
        (Some(error), None) => vehicle.visit_over_map(error, visitor),
        (None, Some(bias)) => vehicle.visit_tilted(bias, visitor),
        (None, None) => vehicle.visit(visitor),
    }
}

/// Model of the biases of roll and pitch, if they are states of the filter, over a map that is off or not.
fn tilt_bias(settings: &NavigatorSettings, is_over_map: bool) -> Option<TiltBias> {
    let deviation = settings.sensors.tilt_bias;
    // A bias that is within what frames are taken to be tilted by anyway is noise where the map's error is a state.
    let frames = settings.whole_frames.as_ref();
    let counts = !is_over_map || frames.is_some_and(|frames| deviation > frames.tilt_deviation);
    (deviation > 0.0 && counts).then_some(TiltBias { deviation })
}

/// Index of a component in the state of the filter; `None` where it is no state.
pub fn place_in_state(settings: &NavigatorSettings, component: StateComponent) -> Option<usize> {
    struct PlaceInState(StateComponent);
    impl VehicleVisitor for PlaceInState {
        type Output = Option<usize>;

        fn visit<const N: usize, V: VehicleModel<N>>(self, model: V) -> Self::Output {
            model.index_of(self.0)
        }
    }
    visit_model(settings, PlaceInState(component))
}

/// Noise of what the camera's pose is computed from that is new to the filter in each frame: without what is a state of it.
pub fn frame_noise(settings: &NavigatorSettings) -> SensorNoise {
    let knows = |component| place_in_state(settings, component).is_some();
    let (tilt, heading) = (StateComponent::RollBias, StateComponent::HeadingBias);
    settings.sensors.without_biases(knows(tilt), knows(heading))
}

/// Model of the map's error, if that error is a state of the filter.
pub fn map_error(settings: &NavigatorSettings) -> Option<MapError> {
    let is_state = place_in_state(settings, StateComponent::MapErrorNorth).is_some();
    stated_map_error(settings).filter(|_| is_state)
}

/// Model of the error of a map that is known to be off.
fn stated_map_error(settings: &NavigatorSettings) -> Option<MapError> {
    let of_frames = settings.whole_frames.map(|frames| frames.map_deviation);
    let of_aids = MAP_ERRORS
        .iter()
        .filter_map(|error| error.of(&settings.aids));
    // That of landmarks is told with their detector.
    let of_looks = of_aids.chain(of_frames);
    let deviation = of_looks.fold(settings.detector.map_deviation, f64::max);
    (deviation > 0.0).then(|| MapError {
        speed: settings.process.cruise.airspeed,
        ..MapError::of(deviation)
    })
}

/// The vehicle model that the settings ask for.
pub fn vehicle(settings: &NavigatorSettings) -> VehicleSettings {
    let p = &settings.process;
    let air_data = AirData {
        airspeed_noise_density: p.airspeed,
        heading_noise_density: p.heading,
        position_noise_density: p.position,
        ..AirData::default()
    }
    .cruising(p.cruise.airspeed, p.cruise.deviation);
    let gusts = Gusts {
        deviation: p.gust,
        per_wind: p.gust_per_wind,
        correlation_time: p.gust_time,
    };
    let start_wind_deviation = settings.start.wind;
    let of_biases = UnmodelledAir {
        gusts: None,
        airspeed_bias: p.airspeed_bias,
        heading_bias: p.heading_bias,
    };
    let of_all = UnmodelledAir {
        gusts: Some(gusts),
        ..of_biases
    };
    match settings.vehicle {
        VehicleChoice::AirplaneWind => VehicleSettings::AirplaneWind(AirplaneWind {
            air_data,
            wind_noise_density: p.wind,
            start_wind_deviation,
            unmodelled: of_all,
            thesis_noise: p.thesis_per_step.then_some(ThesisNoise::DistinctLandmarks),
        }),
        VehicleChoice::AirplaneGust => VehicleSettings::AirplaneWindGust(AirplaneWindGust {
            air_data,
            wind_noise_density: p.wind,
            start_wind_deviation,
            gusts,
            unmodelled: of_biases,
        }),
        VehicleChoice::AirplaneFull => VehicleSettings::AirplaneFull(AirplaneFull {
            air_data,
            wind_noise_density: p.wind,
            start_wind_deviation,
            gusts,
            biases: AirDataBiases {
                start_airspeed_bias_deviation: p.airspeed_bias,
                start_heading_bias_deviation: p.heading_bias,
                airspeed_bias_noise_density: 0.0,
                heading_bias_noise_density: 0.0,
            },
        }),
        VehicleChoice::RandomWalk => VehicleSettings::RandomWalk(RandomWalk {
            position_noise_density: p.position_alone(),
        }),
        VehicleChoice::ConstantVelocity => VehicleSettings::ConstantVelocity(ConstantVelocity {
            velocity_noise_density: p.acceleration,
            start_velocity_deviation: start_wind_deviation,
        }),
        VehicleChoice::Multirotor => VehicleSettings::Multirotor(Multirotor {
            drag: p.drag,
            acceleration_noise_density: p.acceleration,
            position_noise_density: p.position,
            wind_noise_density: p.wind,
            start_wind_deviation,
            ..Multirotor::default()
        }),
        VehicleChoice::VelocityDriven => VehicleSettings::VelocityDriven(VelocityDriven {
            velocity_noise_density: p.velocity,
            bias_noise_density: p.wind,
            start_bias_deviation: start_wind_deviation,
            ..VelocityDriven::default()
        }),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use pilotage_vision::registration::FollowSettings;

    fn of(vehicle: VehicleChoice) -> NavigatorSettings {
        NavigatorSettings {
            vehicle,
            ..NavigatorSettings::default()
        }
    }

    #[test]
    fn a_heading_bias_is_noise_of_each_frame_where_it_is_no_state() {
        for choice in VehicleChoice::ALL {
            let mut settings = of(choice);
            settings.sensors.yaw_bias = 0.9 * settings.sensors.yaw;
            let is_noise = frame_noise(&settings).yaw >= settings.sensors.yaw;
            let bias = place_in_state(&settings, StateComponent::HeadingBias);
            assert_eq!(is_noise, bias.is_none(), "{choice:?}");
        }
    }

    #[test]
    fn the_largest_model_goes_without_the_biases_of_roll_and_pitch_over_a_map_that_is_off() {
        for (choice, knows) in [
            (VehicleChoice::AirplaneGust, true),
            (VehicleChoice::AirplaneFull, false),
        ] {
            let mut settings = of(choice);
            settings.sensors.tilt_bias = 0.17;
            let bias = place_in_state(&settings, StateComponent::RollBias);
            assert!(bias.is_some(), "{choice:?} over a map that is right");
            settings.whole_frames = Some(FollowSettings {
                map_deviation: 3.0,
                ..FollowSettings::default()
            });
            let bias = place_in_state(&settings, StateComponent::RollBias);
            assert_eq!(bias.is_some(), knows, "{choice:?}");
        }
    }
}
