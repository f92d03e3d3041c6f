//! Drawings as SVG: lines, boxes and texts, with nothing but attributes, so that any program reads them.

use std::fmt::Write as _;

use egui::{Color32, Pos2, Rect, Stroke};
use pilotage_core::text::without_markup;

/// Position of a text relative to its place.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum PlotTextAnchor {
    /// To the right of it.
    Start,
    /// Around it.
    Middle,
    /// To the left of it.
    End,
}

/// A drawing.
#[derive(Clone, Debug)]
pub(super) struct PlotSvg {
    body: String,
    size: (f32, f32),
    text_size: f32,
    clips: usize,
}

impl PlotSvg {
    /// An empty drawing of a size in points.
    pub fn new(size: (f32, f32), text_size: f32) -> Self {
        Self {
            body: String::new(),
            size,
            text_size,
            clips: 0,
        }
    }

    /// A filled box.
    pub fn fill(&mut self, rect: Rect, colour: Color32) {
        let (x, y) = (number(rect.left()), number(rect.top()));
        let (width, height) = (number(rect.width()), number(rect.height()));
        let _ = writeln!(
            self.body,
            "<rect x=\"{x}\" y=\"{y}\" width=\"{width}\" height=\"{height}\" {}/>",
            paint("fill", colour)
        );
    }

    /// A straight line.
    pub fn segment(&mut self, from: Pos2, to: Pos2, stroke: Stroke) {
        self.line(&[from, to], stroke);
    }

    /// A line through points.
    pub fn line(&mut self, points: &[Pos2], stroke: Stroke) {
        let mut path = String::new();
        for (i, point) in points.iter().enumerate() {
            let letter = if i == 0 { 'M' } else { 'L' };
            let _ = write!(path, "{letter}{} {}", number(point.x), number(point.y));
        }
        self.path(&path, stroke);
    }

    /// Dots of a radius.
    pub fn dots(&mut self, places: &[Pos2], radius: f32, colour: Color32) {
        // Lines of no length with round ends: the shortest way to say many dots.
        let mut path = String::new();
        for at in places {
            let _ = write!(path, "M{} {}h0", number(at.x), number(at.y));
        }
        let _ = writeln!(
            self.body,
            "<path d=\"{path}\" fill=\"none\" stroke-linecap=\"round\" stroke-width=\"{}\" {}/>",
            number(2.0 * radius),
            paint("stroke", colour)
        );
    }

    /// Rows of pixels: left top corner and length of each, one point high.
    pub fn runs(&mut self, runs: &[(Pos2, f32)], colour: Color32) {
        let mut path = String::new();
        for (at, length) in runs {
            let _ = write!(
                path,
                "M{} {}h{}",
                number(at.x),
                number(at.y + 0.5),
                number(*length)
            );
        }
        self.path(&path, Stroke::new(1.0, colour));
    }

    fn path(&mut self, path: &str, stroke: Stroke) {
        if path.is_empty() {
            return;
        }
        let _ = writeln!(
            self.body,
            "<path d=\"{path}\" fill=\"none\" stroke-linejoin=\"round\" stroke-width=\"{}\" {}/>",
            number(stroke.width),
            paint("stroke", stroke.color)
        );
    }

    /// A text on a line; its width on screen is not known here.
    pub fn text(&mut self, at: Pos2, anchor: PlotTextAnchor, text: &str, colour: Color32) {
        let anchor = match anchor {
            PlotTextAnchor::Start => "start",
            PlotTextAnchor::Middle => "middle",
            PlotTextAnchor::End => "end",
        };
        let _ = writeln!(
            self.body,
            "<text x=\"{}\" y=\"{}\" text-anchor=\"{anchor}\" {}>{}</text>",
            number(at.x),
            number(at.y),
            paint("fill", colour),
            without_markup(text)
        );
    }

    /// Adds the drawing of `draw`, as far as it lies in `rect`.
    pub fn clipped(&mut self, rect: Rect, draw: impl FnOnce(&mut Self)) {
        self.clips += 1;
        let id = self.clips;
        let (x, y) = (number(rect.left()), number(rect.top()));
        let (width, height) = (number(rect.width()), number(rect.height()));
        let _ = writeln!(
            self.body,
            "<clipPath id=\"c{id}\"><rect x=\"{x}\" y=\"{y}\" width=\"{width}\" height=\"{height}\"/></clipPath>\n\
             <g clip-path=\"url(#c{id})\">"
        );
        draw(self);
        self.body.push_str("</g>\n");
    }

    /// The file.
    pub fn finish(self, title: &str) -> String {
        let (width, height) = (number(self.size.0), number(self.size.1));
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" \
             viewBox=\"0 0 {width} {height}\" font-family=\"system-ui, sans-serif\" \
             font-size=\"{}\">\n<title>{}</title>\n{}</svg>\n",
            number(self.text_size),
            without_markup(title),
            self.body
        )
    }
}

/// A length with two decimals at most.
fn number(value: f32) -> String {
    let text = format!("{value:.2}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text == "-0" {
        "0".to_owned()
    } else {
        text.to_owned()
    }
}

/// A colour as an attribute, with its opacity where it is not whole.
fn paint(attribute: &str, colour: Color32) -> String {
    let [red, green, blue, opacity] = colour.to_srgba_unmultiplied();
    let mut text = format!("{attribute}=\"#{red:02x}{green:02x}{blue:02x}\"");
    if opacity < 255 {
        let _ = write!(
            text,
            " {attribute}-opacity=\"{:.3}\"",
            f32::from(opacity) / 255.0
        );
    }
    text
}

#[cfg(test)]
mod tests {
    use egui::pos2;

    use super::*;

    #[test]
    fn a_drawing_is_well_formed_whatever_its_texts_are() {
        let mut svg = PlotSvg::new((100.0, 50.0), 11.0);
        let rect = Rect::from_min_max(pos2(1.0, 2.0), pos2(30.25, 40.0));
        svg.fill(rect, Color32::from_rgb(1, 2, 255));
        svg.clipped(rect, |svg| {
            let points = [pos2(0.0, 0.0), pos2(1.333_33, -0.001)];
            svg.line(&points, Stroke::new(1.5, Color32::RED));
            svg.dots(&points, 1.5, Color32::WHITE);
        });
        svg.text(
            pos2(3.0, 4.0),
            PlotTextAnchor::End,
            "a < b & \"c\"\u{0}",
            Color32::GRAY,
        );
        let file = svg.finish("<log>");
        let mut reader = quick_xml::Reader::from_str(&file);
        let mut depth = 0;
        loop {
            match reader.read_event().expect("XML") {
                quick_xml::events::Event::Start(_) => depth += 1,
                quick_xml::events::Event::End(_) => depth -= 1,
                quick_xml::events::Event::Eof => break,
                _ => {}
            }
        }
        assert_eq!(depth, 0);
        assert!(file.contains("d=\"M0 0L1.33 0\""), "{file}");
        assert!(file.contains("a &lt; b &amp; &quot;c&quot;<"), "{file}");
        assert!(file.contains("fill=\"#0102ff\""), "{file}");
    }
}
