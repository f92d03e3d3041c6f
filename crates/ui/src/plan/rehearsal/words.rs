//! Result of a rehearsal in sentences.

use pilotage_core::plan::PredictionAgreement;

use super::flights::RouteRehearsal;
use crate::plan::words::distance_text;
use crate::units::Units;

impl RouteRehearsal {
    /// Agreement of the prediction with what was flown.
    pub fn agreement(&self) -> PredictionAgreement {
        self.summary().agreement()
    }

    /// Result in sentences.
    pub fn sentences(&self, units: Units) -> Vec<String> {
        let (Some(worst), Some(preferences)) = (self.worst(), self.preferences()) else {
            return Vec::new();
        };
        let all = self.summary();
        let count = match all.flights {
            1 => "1 flight".to_owned(),
            count => format!("{count} flights"),
        };
        let how = if preferences.pictures {
            "with pictures of other days"
        } else {
            "without pictures, landmarks found as predicted"
        };
        let range = match all.corridor_margin() {
            Some(margin) => format!(" ± {:.0}", 100.0 * margin),
            None => String::new(),
        };
        let share = 100.0 * all.inside_corridor;
        let mut sentences = vec![
            format!("{count}, {how}: {share:.0}{range} % of positions inside the 95 % corridor."),
            format!(
                "True error {} RMS where {} are predicted; at most {}, {} along.",
                units.short(all.rms_m),
                units.short(all.predicted_rms_m),
                units.short(worst.worst.0),
                distance_text(worst.worst.1, units),
            ),
        ];
        let agreement = self.agreement();
        if let PredictionAgreement::TooGood | PredictionAgreement::TooBad = agreement {
            sentences.push(agreement.sentence().to_owned());
        }
        sentences
    }
}
