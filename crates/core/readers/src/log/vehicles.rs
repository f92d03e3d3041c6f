//! Several vehicles in one log: which is the flight.

use super::Log;

/// Instances of topics above this are a component of a system: a thousand times the system plus the component.
const COMPONENTS: u32 = 1000;

/// Whether a topic of that instance is that of a component beside the system's own.
pub(crate) fn is_component(instance: u32) -> bool {
    instance >= COMPONENTS
}

/// The system that sends a topic of that instance.
pub(crate) fn system_of(instance: u32) -> u32 {
    if is_component(instance) {
        instance / COMPONENTS
    } else {
        instance
    }
}

/// Kinds of messages of receivers, and of what tells the attitude.
const OF_RECEIVERS: [&str; 3] = [
    "sensor_msgs/NavSatFix",
    "foxglove/LocationFix",
    "sensor_gps",
];
const OF_ATTITUDES: [&str; 3] = ["sensor_msgs/Imu", "vehicle_attitude", "nav_msgs/Odometry"];

/// The first word of a topic that has several, between slashes: `uav1` of `/uav1/gps/fix`; empty of others.
pub(crate) fn first_word(name: &str) -> &str {
    let words = name.trim_start_matches('/').split_once('/');
    words.map_or("", |(first, _)| first)
}

impl Log {
    /// First words of topics where several have a receiver and an attitude each, as recordings of several vehicles do, in the order
    /// of their receivers; the first is the flight. Empty where there are not several.
    pub(crate) fn vehicles_by_name(&self) -> Vec<&str> {
        let with = |kinds: [&str; 3]| {
            let mut words: Vec<&str> = Vec::new();
            for topic in self.topics.iter().filter(|topic| !topic.schema.is_empty()) {
                let word = first_word(&topic.name.name);
                if !word.is_empty()
                    && !words.contains(&word)
                    && kinds.contains(&topic.kind().as_str())
                {
                    words.push(word);
                }
            }
            words
        };
        let attitudes = with(OF_ATTITUDES);
        let mut found = with(OF_RECEIVERS);
        found.retain(|word| attitudes.contains(word));
        if found.len() < 2 { Vec::new() } else { found }
    }

    /// Says that topics are those of several vehicles, if so.
    pub(super) fn tell_vehicles_by_name(&mut self) {
        let found = self.vehicles_by_name();
        if let [first, others @ ..] = found.as_slice()
            && !others.is_empty()
        {
            let remark = format!(
                "several vehicles, or sets of instruments: /{first}, /{}. The flight is that of /{first}",
                others.join(", /")
            );
            self.report.remark(remark);
        }
    }

    /// Notes a vehicle that is heard for the first time; the first of all is the flight.
    pub(super) fn hear(&mut self, system: u32) {
        if !self.vehicles.contains(&system) {
            self.vehicles.push(system);
        }
    }

    /// The system whose flight the log is; `None` where it does not tell vehicles apart.
    pub fn chosen_vehicle(&self) -> Option<u32> {
        self.chosen.or_else(|| self.vehicles.first().copied())
    }

    /// Takes the flight of another vehicle. Modes, parameters and the name are known of the first only, and go.
    ///
    /// # Errors
    /// In words, where no such system flies in the log.
    pub fn choose_vehicle(&mut self, system: u32) -> Result<(), String> {
        if !self.vehicles.contains(&system) {
            let known = match self.vehicles.as_slice() {
                [] => "the log names none".to_owned(),
                known => format!("there are {}", systems(known)),
            };
            return Err(format!(
                "{}: no vehicle is system {system}; {known}",
                self.name
            ));
        }
        if self.chosen_vehicle() != Some(system) {
            self.modes.clear();
            self.parameters.clear();
            self.vehicle = format!("system {system}");
        }
        self.chosen = Some(system);
        Ok(())
    }

    /// Asks something of the log as if the vehicle `system` were the chosen one.
    pub(crate) fn with_vehicle<T>(&mut self, system: u32, ask: impl FnOnce(&Self) -> T) -> T {
        let chosen = self.chosen.replace(system);
        let answer = ask(self);
        self.chosen = chosen;
        answer
    }

    /// Says that there are several vehicles, if so.
    pub(super) fn tell_vehicles(&mut self) {
        let [first, _, ..] = self.vehicles.as_slice() else {
            return;
        };
        let remark = format!(
            "several vehicles: {}. The flight is that of system {first} unless another is chosen (on the page in the \
             overview of the log, on the terminal by --vehicle); modes, parameters and the name are known of system \
             {first} only",
            systems(&self.vehicles)
        );
        self.report.remark(remark);
    }
}

fn systems(systems: &[u32]) -> String {
    let names: Vec<String> = systems
        .iter()
        .map(|system| format!("system {system}"))
        .collect();
    names.join(", ")
}

#[cfg(test)]
mod tests {
    use super::super::LogFormat;
    use super::*;

    #[test]
    fn the_first_vehicle_is_the_flight_unless_another_is_chosen() {
        let mut log = Log::new("a.tlog", LogFormat::Tlog);
        assert_eq!(log.chosen_vehicle(), None);
        for system in [7, 9, 7] {
            log.hear(system);
        }
        log.tell_vehicles();
        assert_eq!(log.chosen_vehicle(), Some(7));
        assert!(log.report.remarks[0].contains("system 9"));
        assert!(
            log.choose_vehicle(8)
                .unwrap_err()
                .contains("system 7, system 9")
        );
        log.choose_vehicle(9).unwrap();
        assert_eq!(log.chosen_vehicle(), Some(9));
    }
}
