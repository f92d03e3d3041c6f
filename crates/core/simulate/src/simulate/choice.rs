//! Choices that people have when they simulate a flight.

use super::{IndoorHall, Scenario, Wind};
use pilotage_mission::settings::{NavigatorSettings, VehicleChoice};

/// A flight to be chosen by its name: a scenario over the scenery, or that of the hall.
#[derive(Clone, Debug, PartialEq)]
pub struct SimulationChoice {
    /// Name on the command line and in files.
    pub name: &'static str,
    /// Title for people.
    pub title: &'static str,
    /// Description of what happens in the flight.
    pub description: &'static str,
    /// Height above ground, metres.
    pub height: f64,
    /// Mean wind, or the draught.
    pub wind: Wind,
    /// Whether it is that of the hall, which has no other day, wind or height.
    pub is_indoors: bool,
}

impl SimulationChoice {
    /// All of them, the hall last.
    pub fn all() -> Vec<Self> {
        let outdoors = Scenario::all().into_iter().map(|scenario| Self {
            name: scenario.name,
            title: scenario.title,
            description: scenario.description,
            height: scenario.height,
            wind: scenario.wind,
            is_indoors: false,
        });
        let hall = IndoorHall::default();
        let indoors = Self {
            name: IndoorHall::NAME,
            title: IndoorHall::TITLE,
            description: IndoorHall::DESCRIPTION,
            height: hall.height,
            wind: Wind::of_velocity(&hall.draught),
            is_indoors: true,
        };
        outdoors.chain([indoors]).collect()
    }

    /// The one of that name.
    ///
    /// ```
    /// use pilotage_simulate::simulate::SimulationChoice;
    ///
    /// let hall = SimulationChoice::named("indoor-hall").ok_or("no such flight")?;
    /// assert!(hall.is_indoors);
    /// assert!(SimulationChoice::named("the-moon").is_none());
    /// # Ok::<(), &str>(())
    /// ```
    pub fn named(name: &str) -> Option<Self> {
        Self::all().into_iter().find(|choice| choice.name == name)
    }

    /// Settings of the navigation unless people want otherwise.
    pub fn navigator(&self) -> NavigatorSettings {
        match Scenario::named(self.name) {
            Some(scenario) => scenario.navigator(),
            None => IndoorHall::default().navigator(VehicleChoice::Multirotor),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_is_found_by_its_name_and_the_hall_has_its_draught() {
        let all = SimulationChoice::all();
        for choice in &all {
            assert_eq!(SimulationChoice::named(choice.name).as_ref(), Some(choice));
        }
        let hall = all.last().unwrap();
        assert!(hall.is_indoors);
        let off = hall.wind.velocity() - IndoorHall::default().draught;
        assert!(off.norm() < 1e-12, "{off}");
        let vehicle = hall.navigator().vehicle;
        assert_eq!(vehicle, VehicleChoice::Multirotor);
    }
}
