//! All worlds, and what is asked of the table of them in `mod.rs`.

use super::{Overrides, SimulationChoice, WORLDS, lay_out_world};
use pilotage_mission::mission::Mission;

/// Declares the files or folders of the worlds, makes their table, and lays them out: those under `small` in every
/// program that flies.
macro_rules! worlds {
    (
        small { $($small_file:ident::$small:ident,)* }
        whole { $($whole_file:ident::$whole:ident,)* }
    ) => {
        $(mod $small_file;)*
        $(mod $whole_file;)*

        /// Every world, in the order in which people read their flights.
        pub static WORLDS: &[&dyn World] = &[
            $(&$small_file::$small,)*
            $(&$whole_file::$whole,)*
        ];

        /// Whether the small program flies in the world of that key.
        pub fn is_small_world(key: &str) -> bool {
            [$($small_file::$small.key(),)*].contains(&key)
        }

        /// The world of that key, laid out by the small program, which links no other.
        pub fn lay_out_small_world(key: &str) -> Option<std::sync::Arc<dyn LaidWorld>> {
            $(if $small_file::$small.key() == key {
                return Some(world::LayOut::lay_out(&$small_file::$small));
            })*
            None
        }

        /// The world of that key, laid out.
        pub fn lay_out_world(key: &str) -> Option<std::sync::Arc<dyn LaidWorld>> {
            $(if $whole_file::$whole.key() == key {
                return Some(world::LayOut::lay_out(&$whole_file::$whole));
            })*
            lay_out_small_world(key)
        }
    };
}

impl SimulationChoice {
    /// All of them, world by world.
    pub fn all() -> Vec<Self> {
        WORLDS.iter().flat_map(|world| world.flights()).collect()
    }

    /// The one of that name.
    ///
    /// ```
    /// use pilotage_simulate::simulate::SimulationChoice;
    ///
    /// let hall = SimulationChoice::named("indoor-hall").ok_or("no such flight")?;
    /// assert!(hall.world.is_shown_whole());
    /// assert!(SimulationChoice::named("the-moon").is_none());
    /// # Ok::<(), &str>(())
    /// ```
    pub fn named(name: &str) -> Option<Self> {
        Self::all().into_iter().find(|choice| choice.name == name)
    }

    /// The mission with which it comes in its world, that of the first vehicle; `None` if the world has none for it.
    pub fn mission(&self) -> Option<Mission> {
        let missions = lay_out_world(self.world.key())?.missions(self.name, &Overrides::default());
        missions.into_iter().next().map(|(_, mission)| mission)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use pilotage_mission::settings::VehicleChoice;

    #[test]
    fn names_and_keys_are_given_once() {
        let mut names: Vec<_> = SimulationChoice::all().iter().map(|c| c.name).collect();
        let mut keys: Vec<_> = WORLDS.iter().map(|world| world.key()).collect();
        for list in [&mut names, &mut keys] {
            list.sort_unstable();
            assert!(list.windows(2).all(|pair| pair[0] != pair[1]), "{list:?}");
        }
    }

    #[test]
    fn every_flight_comes_with_a_mission() {
        for choice in SimulationChoice::all() {
            let mission = choice.mission().expect(choice.name);
            assert_eq!(mission.navigator, choice.navigator(), "{}", choice.name);
        }
    }

    #[test]
    fn every_world_flies_its_own_flights_over_its_map_and_nobody_elses() {
        for world in WORLDS {
            let laid = lay_out_world(world.key()).unwrap();
            let map = laid.map().bounds();
            for choice in SimulationChoice::all() {
                let overrides = Overrides::default();
                let flown = laid.fly(choice.name, 1, &overrides);
                let missions = laid.missions(choice.name, &overrides);
                if choice.world.key() != world.key() {
                    assert!(flown.is_none() && missions.is_empty(), "{}", choice.name);
                    continue;
                }
                let flight = flown.unwrap().flight;
                assert_eq!(flight.name, choice.name);
                for state in flight.truth.unwrap().states {
                    assert!(
                        map.contains(&state.position.coords.xy().into()),
                        "{state:?}"
                    );
                }
                let (_, usual) = &missions[0];
                let is_aided = !usual.navigator.aids.is_empty();
                assert!(is_aided || !usual.landmarks.is_empty());
                assert_eq!(usual.navigator, choice.navigator());
                let route = choice.route(None).map(|route| route.way_points);
                assert_eq!(usual.routes.first().map(|r| r.way_points.clone()), route);
            }
        }
    }

    #[test]
    fn the_hall_has_its_draught_and_a_multirotor() {
        let hall = SimulationChoice::named("indoor-hall").unwrap();
        let off = hall.wind.velocity() - super::super::IndoorHall::default().draught;
        assert!(off.norm() < 1e-12, "{off}");
        assert_eq!(hall.navigator().vehicle, VehicleChoice::Multirotor);
        assert!(hall.route(None).is_none());
    }
}
