//! By which detector a landmark is looked for, and what was trained for it.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};
use serde_json::Value;

use super::Landmark;
use super::trained::TrainedDetector;
use pilotage_base::frames::GroundRect;

/// Property that names the detector.
pub const DETECTOR: &str = "detector";
/// Property with the trained detector.
pub const TRAINED: &str = "trained_detector";

/// By which detector a landmark is looked for.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum DetectorChoice {
    /// By its map patch.
    #[default]
    Template,
    /// By a cascade that was trained for it.
    Cascade,
    /// By both, what they say weighed together.
    Both,
}

impl DetectorChoice {
    /// Every choice, in the order in which people read them.
    pub const ALL: [Self; 3] = [Self::Template, Self::Cascade, Self::Both];

    /// Name in files and on the command line.
    pub fn key(self) -> &'static str {
        match self {
            Self::Template => "template",
            Self::Cascade => "cascade",
            Self::Both => "both",
        }
    }

    /// The choice of that name.
    ///
    /// ```
    /// use pilotage_vision::landmark::DetectorChoice;
    ///
    /// assert_eq!(DetectorChoice::named("cascade"), Some(DetectorChoice::Cascade));
    /// assert_eq!(DetectorChoice::named("oracle"), None);
    /// assert_eq!(DetectorChoice::Both.key(), "both");
    /// ```
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|choice| choice.key() == name)
    }
}

impl Landmark {
    /// By which detector it shall be looked for.
    pub fn detector_choice(&self) -> DetectorChoice {
        let name: Option<String> = self.noted(DETECTOR);
        name.and_then(|n| DetectorChoice::named(&n))
            .unwrap_or_default()
    }

    /// Says by which detector it shall be looked for.
    pub fn choose_detector(&mut self, choice: DetectorChoice) {
        let is_usual = choice == DetectorChoice::default();
        self.note(DETECTOR, (!is_usual).then(|| Value::from(choice.key())));
    }

    /// The detector that was trained for it; none if it was trained for another box.
    pub fn trained_detector(&self) -> Option<TrainedDetector> {
        let trained: TrainedDetector = self.noted(TRAINED)?;
        is_same(&trained.bounds, &self.bounds).then_some(trained)
    }

    /// Whether a detector was trained for it as it is.
    pub fn is_trained(&self) -> bool {
        #[derive(Deserialize)]
        struct TrainedFor {
            bounds: GroundRect,
        }
        let trained: Option<TrainedFor> = self.noted(TRAINED);
        trained.is_some_and(|t| is_same(&t.bounds, &self.bounds))
    }

    /// Keeps what was trained for it, or throws it away.
    pub fn keep_trained(&mut self, trained: Option<&TrainedDetector>) {
        let value = trained.and_then(|t| serde_json::to_value(t).ok());
        self.note(TRAINED, value);
    }

    /// Detector that was trained for the landmark, for whichever box, as files have it: JSON.
    pub fn trained_text(&self) -> Option<&str> {
        self.properties.get(TRAINED).map(String::as_str)
    }

    /// The same without what was trained for it.
    #[must_use]
    pub fn untrained(&self) -> Self {
        let mut landmark = self.clone();
        landmark.keep_trained_text(None);
        landmark
    }

    /// The landmark as it is looked for: box, reference point, height and the detectors that are in use, without its name
    /// and what people noted of it. Landmarks of which this is equal are found alike.
    ///
    /// ```
    /// use pilotage_base::frames::{GroundPoint, GroundRect};
    /// use pilotage_vision::landmark::Landmark;
    ///
    /// let bounds = GroundRect::centered(GroundPoint::default(), 20.0, 20.0);
    /// let barn = Landmark::new(1, "Barn", bounds);
    /// let mut old_barn = Landmark::new(1, "Old barn", bounds);
    /// old_barn.set_notes("red roof");
    /// assert_eq!(barn.looked_for(), old_barn.looked_for());
    /// ```
    #[must_use]
    pub fn looked_for(&self) -> Self {
        let mut landmark = Self {
            name: String::new(),
            properties: BTreeMap::new(),
            ..self.clone()
        };
        if let Some((choice, trained)) = self.detector_in_use() {
            landmark.choose_detector(choice);
            landmark.keep_trained_text(Some(trained));
        }
        landmark
    }

    /// Keeps what was trained for it as [`Self::trained_text`] says it, or throws it away.
    pub fn keep_trained_text(&mut self, text: Option<&str>) {
        match text {
            Some(text) => self.properties.insert(TRAINED.to_owned(), text.to_owned()),
            None => self.properties.remove(TRAINED),
        };
    }

    /// The choice and what was trained, if more than its map patch is looked for: landmarks with the same
    /// box of which this is equal are found alike.
    pub fn detector_in_use(&self) -> Option<(DetectorChoice, &str)> {
        let text = self.trained_text()?;
        let choice = self.detector_choice();
        (choice != DetectorChoice::Template).then_some((choice, text))
    }
}

/// Whether two boxes are one but for what is lost when numbers are written down.
fn is_same(a: &GroundRect, b: &GroundRect) -> bool {
    let near = |a: f64, b: f64| (a - b).abs() < 0.01;
    near(a.north, b.north) && near(a.south, b.south) && near(a.west, b.west) && near(a.east, b.east)
}
