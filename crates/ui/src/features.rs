//! All features of the app, in the order of their tabs: a new one is a folder, and a line here.

use crate::compare::Compare;
use crate::feature::Feature;
use crate::outage::Outages;

/// Every feature, as it is when the app starts.
pub fn all() -> Vec<Box<dyn Feature>> {
    vec![Box::new(Compare::default()), Box::new(Outages::default())]
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::*;
    use crate::command::Command;

    #[test]
    fn no_two_features_share_an_identity_and_each_lists_commands_for_itself_alone() {
        let features = all();
        let names: BTreeSet<_> = features.iter().map(|it| it.info().id).collect();
        assert_eq!(names.len(), features.len());
        for info in features.iter().map(|it| it.info()) {
            for entry in (info.commands)() {
                let Command::Feature(command) = &entry.command else {
                    panic!("{} is no command of a feature", entry.label);
                };
                assert_eq!(command.to(), info.id, "{}", entry.label);
            }
        }
    }
}
