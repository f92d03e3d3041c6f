//! Colours, sizes and spacing in one place, for dark and light.

use std::sync::LazyLock;

use egui::{Color32, FontId};

/// See [`Tokens::over_imagery`].
static OVER_IMAGERY: LazyLock<Tokens> = LazyLock::new(Tokens::dark);

/// The look: every colour and measure that views use.
#[derive(Clone, Debug, PartialEq)]
pub struct Tokens {
    /// Whether this is the dark set.
    pub dark: bool,
    /// Behind everything.
    pub background: Color32,
    /// Panels.
    pub surface: Color32,
    /// Raised parts of panels.
    pub raised: Color32,
    /// Thin lines between things.
    pub line: Color32,
    /// Text.
    pub text: Color32,
    /// Units, captions.
    pub muted: Color32,
    /// The one accent colour.
    pub accent: Color32,
    /// Something is wrong.
    pub warning: Color32,
    /// Advice of the program: violet.
    pub advice: Color32,
    /// Areas that must not be flown over, and what leads over them: red.
    pub no_fly: Color32,
    /// Truth: green.
    pub truth: Color32,
    /// The estimate when corrected: red.
    pub corrected: Color32,
    /// The estimate while dead reckoning: blue.
    pub dead_reckoning: Color32,
    /// Dead reckoning alone, without any landmark.
    pub unaided: Color32,
    /// Sigma points and possible landmarks: white (dark outline on light ground).
    pub sigma: Color32,
    /// Observed landmarks: buildings.
    pub observed: Color32,
    /// Refused matches.
    pub refused: Color32,
    /// The previous run, shown for comparison.
    pub ghost: Color32,
    /// Roads of the mission: sand.
    pub road: Color32,
    /// Whether fingers press what is on screen, and not a pointer.
    pub touch: bool,
    /// The spacing unit, points; everything is a multiple.
    pub space: f32,
    /// The scale of text, points: captions, running text, headings, titles, the large number.
    pub text_sizes: [f32; 5],
    /// Corner radius, points.
    pub radius: f32,
}

impl Tokens {
    /// The dark set, or the light one.
    pub fn of(dark: bool) -> Self {
        if dark { Self::dark() } else { Self::light() }
    }

    /// The dark set.
    pub fn dark() -> Self {
        Self {
            dark: true,
            background: Color32::from_rgb(12, 16, 20),
            surface: Color32::from_rgb(20, 26, 32),
            raised: Color32::from_rgb(30, 38, 46),
            line: Color32::from_rgb(46, 56, 66),
            text: Color32::from_rgb(226, 232, 238),
            muted: Color32::from_rgb(140, 152, 164),
            accent: Color32::from_rgb(240, 180, 41),
            warning: Color32::from_rgb(240, 120, 70),
            advice: Color32::from_rgb(190, 164, 255),
            no_fly: Color32::from_rgb(255, 76, 70),
            truth: Color32::from_rgb(60, 190, 130),
            corrected: Color32::from_rgb(232, 72, 85),
            dead_reckoning: Color32::from_rgb(86, 156, 255),
            unaided: Color32::from_rgb(170, 130, 220),
            sigma: Color32::from_rgb(250, 250, 250),
            observed: Color32::from_rgb(90, 200, 250),
            refused: Color32::from_rgb(240, 120, 70),
            ghost: Color32::from_rgb(120, 130, 140),
            road: Color32::from_rgb(246, 216, 158),
            touch: false,
            space: 8.0,
            text_sizes: [12.0, 14.0, 16.0, 20.0, 28.0],
            radius: 6.0,
        }
    }

    /// The light set.
    pub fn light() -> Self {
        Self {
            dark: false,
            background: Color32::from_rgb(236, 239, 242),
            surface: Color32::from_rgb(250, 251, 252),
            raised: Color32::from_rgb(255, 255, 255),
            line: Color32::from_rgb(208, 214, 220),
            text: Color32::from_rgb(24, 30, 36),
            muted: Color32::from_rgb(98, 108, 118),
            accent: Color32::from_rgb(140, 84, 0),
            warning: Color32::from_rgb(168, 56, 10),
            advice: Color32::from_rgb(104, 56, 190),
            no_fly: Color32::from_rgb(196, 24, 24),
            truth: Color32::from_rgb(0, 110, 66),
            corrected: Color32::from_rgb(200, 30, 50),
            dead_reckoning: Color32::from_rgb(20, 90, 210),
            unaided: Color32::from_rgb(110, 60, 170),
            observed: Color32::from_rgb(0, 116, 148),
            refused: Color32::from_rgb(168, 56, 10),
            ..Self::dark()
        }
    }

    /// The set for drawings on maps and pictures, which are as dark in light surroundings.
    pub fn over_imagery() -> &'static Self {
        &OVER_IMAGERY
    }

    /// Least side of what is pressed, points.
    pub fn target(&self) -> f32 {
        if self.touch { 44.0 } else { 4.0 * self.space }
    }

    /// Advice on what to do: for a keyboard with a mouse, or for fingers, which press no keys.
    pub fn advice<'a>(&self, with_keys: &'a str, with_fingers: &'a str) -> &'a str {
        if self.touch { with_fingers } else { with_keys }
    }

    /// Behind a widget under the pointer.
    pub fn hover(&self) -> Color32 {
        if self.dark {
            Color32::from_rgb(40, 50, 60)
        } else {
            Color32::from_rgb(228, 233, 238)
        }
    }

    /// Behind controls and labels that lie on the map.
    pub fn over_map(&self) -> Color32 {
        let [r, g, b, _] = self.surface.to_array();
        Color32::from_rgba_unmultiplied(r, g, b, 232)
    }

    /// Outline of light drawings on the map.
    pub fn outline(&self) -> Color32 {
        Color32::from_black_alpha(190)
    }

    /// Captions and units.
    pub fn small(&self) -> FontId {
        FontId::proportional(self.text_sizes[0])
    }

    /// Running text.
    pub fn normal(&self) -> FontId {
        FontId::proportional(self.text_sizes[1])
    }

    /// Headings inside of panels.
    pub fn heading(&self) -> FontId {
        strong(self.text_sizes[1])
    }

    /// Titles.
    pub fn large(&self) -> FontId {
        strong(self.text_sizes[3])
    }

    /// The large number.
    pub fn figure(&self) -> FontId {
        strong(self.text_sizes[4])
    }

    /// Captions that stand out.
    pub fn caption(&self) -> FontId {
        strong(self.text_sizes[0])
    }
}

/// The strong face: egui's second family, for figures of the usual face are as wide as one another.
fn strong(size: f32) -> FontId {
    FontId::monospace(size)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Contrast of two colours, as the Web Content Accessibility Guidelines define it.
    fn contrast(a: Color32, b: Color32) -> f32 {
        let luminance = |colour: Color32| {
            let [r, g, b, _] = egui::Rgba::from(colour).to_array();
            0.2126 * r + 0.7152 * g + 0.0722 * b + 0.05
        };
        let (a, b) = (luminance(a), luminance(b));
        a.max(b) / a.min(b)
    }

    #[test]
    fn words_in_the_colours_of_their_meaning_are_read_on_panels_of_both_themes() {
        for tokens in [Tokens::dark(), Tokens::light()] {
            for (name, colour) in [
                ("text", tokens.text),
                ("muted", tokens.muted),
                ("accent", tokens.accent),
                ("warning", tokens.warning),
                ("advice", tokens.advice),
                ("no_fly", tokens.no_fly),
                ("truth", tokens.truth),
                ("observed", tokens.observed),
                ("refused", tokens.refused),
            ] {
                let found = contrast(colour, tokens.surface);
                assert!(found >= 4.5, "{name}, dark {}: {found}", tokens.dark);
            }
        }
    }
}
