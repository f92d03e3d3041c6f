//! Controls of a lesson, and the numbers to which its reader set them.

/// Control of a lesson: a slider, steps of it, or a choice.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LessonControl {
    /// Name in the text, whose labels have its words.
    pub name: &'static str,
    /// Least number.
    pub least: f64,
    /// Greatest number.
    pub most: f64,
    /// From one to the next.
    pub step: f64,
    /// Number at the start.
    pub usual: f64,
    /// Unit as people read it.
    pub unit: &'static str,
    /// Whether its numbers stand for choices, whose words are the labels `NAME.0`, `NAME.1` and so on.
    pub choice: bool,
}

impl LessonControl {
    /// Slider over a range.
    pub const fn slider(
        name: &'static str,
        [least, most]: [f64; 2],
        step: f64,
        usual: f64,
        unit: &'static str,
    ) -> Self {
        Self {
            name,
            least,
            most,
            step,
            usual,
            unit,
            choice: false,
        }
    }

    /// Choice among so many, the first at the start.
    pub const fn choice(name: &'static str, count: u8) -> Self {
        Self {
            name,
            least: 0.0,
            most: count as f64 - 1.0,
            step: 1.0,
            usual: 0.0,
            unit: "",
            choice: true,
        }
    }

    /// The nearest number that it can be set to.
    pub fn nearest(&self, number: f64) -> f64 {
        if !number.is_finite() {
            return self.usual;
        }
        let steps = ((number - self.least) / self.step).round();
        (self.least + steps * self.step).clamp(self.least, self.most)
    }
}

/// Numbers to which the controls of a lesson are set.
#[derive(Clone, Debug, PartialEq)]
pub struct Setting {
    controls: &'static [LessonControl],
    numbers: Vec<f64>,
}

impl Setting {
    /// Every control as it is at the start.
    pub fn usual(controls: &'static [LessonControl]) -> Self {
        let numbers = controls.iter().map(|control| control.usual).collect();
        Self { controls, numbers }
    }

    /// Number of a control of the lesson.
    ///
    /// # Panics
    /// Where the lesson has no such control; tests compute every lesson.
    pub fn get(&self, name: &str) -> f64 {
        let index = self.controls.iter().position(|own| own.name == name);
        self.numbers[index.unwrap_or_else(|| panic!("the lesson has no control `{name}`"))]
    }

    /// Choice of a control, as an index.
    pub fn chosen(&self, name: &str) -> usize {
        self.get(name).round() as usize
    }

    /// Sets a control to the nearest number that it has; `false` where there is no such control.
    ///
    /// ```
    /// use pilotage_lessons::{LessonControl, Setting};
    ///
    /// const CONTROLS: &[LessonControl] = &[LessonControl::slider("wind", [0.0, 12.0], 0.5, 4.0, "m/s")];
    /// let mut setting = Setting::usual(CONTROLS);
    /// assert!(setting.set("wind", 3.3) && !setting.set("rain", 1.0));
    /// assert_eq!(setting.get("wind"), 3.5); // the nearest step
    /// setting.set("wind", 99.0);
    /// assert_eq!(setting.get("wind"), 12.0);
    /// ```
    pub fn set(&mut self, name: &str, number: f64) -> bool {
        let index = self.controls.iter().position(|own| own.name == name);
        if let Some(index) = index {
            self.numbers[index] = self.controls[index].nearest(number);
        }
        index.is_some()
    }

    /// Controls with their numbers.
    pub fn iter(&self) -> impl Iterator<Item = (&'static LessonControl, f64)> + '_ {
        self.controls.iter().zip(self.numbers.iter().copied())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const CONTROLS: &[LessonControl] = &[
        LessonControl::slider("wind", [0.0, 12.0], 0.5, 4.0, "m/s"),
        LessonControl::choice("filter", 3),
    ];

    #[test]
    fn a_number_goes_to_the_nearest_step_within_the_range() {
        let mut setting = Setting::usual(CONTROLS);
        assert_eq!(setting.get("wind"), 4.0);
        for (asked, got) in [(3.3, 3.5), (99.0, 12.0), (-1.0, 0.0), (f64::NAN, 4.0)] {
            assert!(setting.set("wind", asked));
            assert_eq!(setting.get("wind"), got);
        }
        assert!(!setting.set("rain", 1.0));
    }

    #[test]
    fn a_choice_is_an_index() {
        let mut setting = Setting::usual(CONTROLS);
        assert_eq!(setting.chosen("filter"), 0);
        setting.set("filter", 7.0);
        assert_eq!(setting.chosen("filter"), 2);
    }
}
