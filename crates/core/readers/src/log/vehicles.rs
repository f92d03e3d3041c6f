//! Several vehicles in one log: which is the flight.

use super::Log;
use super::topic_words::{TopicSubject, first_word, is_of_autopilot, names_vehicle, subject};

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
const OF_ATTITUDES: [&str; 3] = [IMU, "vehicle_attitude", "nav_msgs/Odometry"];
const IMU: &str = "sensor_msgs/Imu";

/// Several sets of a receiver and an attitude in one recording, by the first words of their topics.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct SetsByName<'a> {
    /// The first, which is the flight.
    pub first: &'a str,
    /// Other vehicles.
    pub vehicles: Vec<&'a str>,
    /// Other instruments of the same vehicle.
    pub instruments: Vec<&'a str>,
}

/// Whether two words differ in a number alone: `uav1` and `uav2`.
fn differ_in_number(one: &str, other: &str) -> bool {
    let without = |word: &str| word.replace(|letter: char| letter.is_ascii_digit(), "");
    without(one) == without(other)
}

impl Log {
    /// Sets by the first words of topics where several have a receiver and an attitude each, as recordings of several vehicles
    /// do, or of one with several instruments, in the order of their receivers. `None` where there are not several.
    pub(crate) fn sets_by_name(&self) -> Option<SetsByName<'_>> {
        let with = |kinds: [&str; 3]| {
            let mut words: Vec<&str> = Vec::new();
            for topic in self.topics.iter().filter(|topic| !topic.schema.is_empty()) {
                let word = first_word(&topic.name.name);
                if !word.is_empty()
                    && !words.contains(&word)
                    && kinds.contains(&topic.kind().as_str())
                    && subject(&topic.name.name) == TopicSubject::Vehicle
                {
                    words.push(word);
                }
            }
            words
        };
        let attitudes = with(OF_ATTITUDES);
        let found = with(OF_RECEIVERS).into_iter();
        let mut found = found.filter(|word| attitudes.contains(word));
        let first = found.next()?;
        let has_autopilot = |word: &str| {
            let mut topics = self.topics.iter().map(|topic| topic.name.name.as_str());
            topics.any(|name| first_word(name) == word && is_of_autopilot(name))
        };
        let is_vehicle = |word: &&str| {
            differ_in_number(first, word)
                || (names_vehicle(first) && names_vehicle(word))
                || (has_autopilot(first) && has_autopilot(word))
        };
        let (vehicles, instruments): (Vec<&str>, Vec<&str>) = found.partition(is_vehicle);
        (!vehicles.is_empty() || !instruments.is_empty()).then_some(SetsByName {
            first,
            vehicles,
            instruments,
        })
    }

    /// Says that topics are those of several vehicles or sets of instruments, if so.
    pub(super) fn tell_sets_by_name(&mut self) {
        let Some(sets) = self.sets_by_name() else {
            return;
        };
        let (first, mut remarks) = (sets.first, Vec::new());
        if !sets.vehicles.is_empty() {
            remarks.push(format!(
                "several vehicles: /{first}, /{}. The flight is that of /{first}",
                sets.vehicles.join(", /")
            ));
        }
        if !sets.instruments.is_empty() {
            remarks.push(format!(
                "several sets of instruments: /{first}, /{}. Those of /{first} count, and of others what it has not",
                sets.instruments.join(", /")
            ));
        }
        for remark in remarks {
            self.report.remark(remark);
        }
    }

    /// Says that a camera has the only IMU, if so.
    pub(super) fn tell_camera_imu(&mut self) {
        let imus = self.topics.iter().filter(|topic| topic.kind() == IMU);
        let (mut cameras, mut others) = (Vec::new(), 0);
        for topic in imus.filter(|topic| !topic.is_empty()) {
            match subject(&topic.name.name) {
                TopicSubject::Camera => cameras.push(topic.name.to_string()),
                TopicSubject::Vehicle => others += 1,
                TopicSubject::Other => {}
            }
        }
        if others == 0 && !cameras.is_empty() {
            let remark = format!(
                "the only IMU is a camera's ({}): it is taken for the aircraft's, whose axes it need not have",
                cameras.join(", ")
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
    use super::super::{LogFormat, TopicName};
    use super::*;

    #[test]
    fn a_camera_whose_imu_is_the_only_one_is_told() {
        let mut log = Log::new("a.mcap", LogFormat::Mcap);
        for (name, is_told) in [("/camera/imu", true), ("/mavros/imu/data", false)] {
            let place = log.topic_or_new(&TopicName::single(name), Vec::new);
            "sensor_msgs/msg/Imu".clone_into(&mut log.topics[place].schema);
            log.topics[place].push(0.0, &[]);
            log.report.remarks.clear();
            log.tell_camera_imu();
            let remarks = &log.report.remarks;
            let has = remarks.iter().any(|remark| remark.contains("/camera/imu"));
            assert_eq!(has, is_told, "{name}: {remarks:?}");
        }
    }

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
