//! A drawing in SVG, with text for whoever does not see it.

use std::fmt::Write as _;

use nalgebra::{Matrix2, Vector2};
use pilotage_base::text::without_markup;

/// Side of its point on which a text stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TextAnchor {
    /// To the right of it.
    Start,
    /// Around it.
    Middle,
    /// To the left of it.
    End,
}

impl TextAnchor {
    fn word(self) -> &'static str {
        match self {
            Self::Start => "start",
            Self::Middle => "middle",
            Self::End => "end",
        }
    }
}

/// Colours and letters of figures, as a style sheet.
pub const STYLE: &str = include_str!("style.css");

/// Drawing of a size in its own units, x to the right and y down. A class is one of `style.css` beside this file, by
/// which page, print and stored file agree about colours.
#[derive(Clone, Debug, PartialEq)]
pub struct Svg {
    width: f64,
    height: f64,
    body: String,
}

impl Svg {
    /// Empty drawing.
    pub fn new(width: f64, height: f64) -> Self {
        Self {
            width,
            height,
            body: String::new(),
        }
    }

    /// Width.
    pub fn width(&self) -> f64 {
        self.width
    }

    /// Height.
    pub fn height(&self) -> f64 {
        self.height
    }

    /// Line between two points.
    pub fn line(&mut self, from: Vector2<f64>, to: Vector2<f64>, class: &str) {
        let [x1, y1, x2, y2] = [from.x, from.y, to.x, to.y].map(short);
        let _ = write!(
            self.body,
            r#"<line class="{class}" x1="{x1}" y1="{y1}" x2="{x2}" y2="{y2}"/>"#
        );
    }

    /// Line through several points, closed or not.
    pub fn path(&mut self, points: &[Vector2<f64>], closed: bool, class: &str) {
        let mut d = String::new();
        for (index, point) in points.iter().enumerate() {
            let letter = if index == 0 { 'M' } else { 'L' };
            let _ = write!(d, "{letter}{} {}", short(point.x), short(point.y));
        }
        if closed {
            d.push('Z');
        }
        let _ = write!(self.body, r#"<path class="{class}" d="{d}"/>"#);
    }

    /// Circle.
    pub fn circle(&mut self, center: Vector2<f64>, radius: f64, class: &str) {
        let [x, y, r] = [center.x, center.y, radius].map(short);
        let _ = write!(
            self.body,
            r#"<circle class="{class}" cx="{x}" cy="{y}" r="{r}"/>"#
        );
    }

    /// Rectangle between two corners.
    pub fn rect(&mut self, corner: Vector2<f64>, other: Vector2<f64>, class: &str) {
        let (low, size) = (corner.inf(&other), (corner - other).abs());
        let [x, y, w, h] = [low.x, low.y, size.x, size.y].map(short);
        let _ = write!(
            self.body,
            r#"<rect class="{class}" x="{x}" y="{y}" width="{w}" height="{h}"/>"#
        );
    }

    /// Square of one shade of grey from 0 to 1: a pixel of a picture.
    pub fn pixel(&mut self, corner: Vector2<f64>, size: f64, shade: f64) {
        let [x, y, s] = [corner.x, corner.y, size].map(short);
        let grey = (shade.clamp(0.0, 1.0) * 255.0).round();
        let _ = write!(
            self.body,
            r#"<rect x="{x}" y="{y}" width="{s}" height="{s}" fill="rgb({grey},{grey},{grey})"/>"#
        );
    }

    /// Ellipse of a covariance in the drawing's units, at so many deviations.
    pub fn ellipse(
        &mut self,
        center: Vector2<f64>,
        covariance: &Matrix2<f64>,
        deviations: f64,
        class: &str,
    ) {
        let eigen = covariance.symmetric_eigen();
        let axes = eigen
            .eigenvalues
            .map(|value| value.max(0.0).sqrt() * deviations);
        let along = eigen.eigenvectors.column(0);
        let turn = along.y.atan2(along.x).to_degrees();
        let [x, y, rx, ry, turn] = [center.x, center.y, axes.x, axes.y, turn].map(short);
        let _ = write!(
            self.body,
            r#"<ellipse class="{class}" cx="{x}" cy="{y}" rx="{rx}" ry="{ry}" transform="rotate({turn} {x} {y})"/>"#
        );
    }

    /// Whatever `draw` draws, cut off at a rectangle between its corners top left and bottom right.
    pub fn within(&mut self, low: Vector2<f64>, high: Vector2<f64>, draw: impl FnOnce(&mut Self)) {
        let size = high - low;
        let [x, y, w, h] = [low.x, low.y, size.x, size.y].map(short);
        let _ = write!(
            self.body,
            r#"<svg x="{x}" y="{y}" width="{w}" height="{h}" viewBox="{x} {y} {w} {h}" overflow="hidden">"#
        );
        draw(self);
        self.body.push_str("</svg>");
    }

    /// Words at a point, their base line there.
    pub fn text(&mut self, at: Vector2<f64>, anchor: TextAnchor, class: &str, words: &str) {
        let [x, y] = [at.x, at.y].map(short);
        let (anchor, words) = (anchor.word(), without_markup(words));
        let _ = write!(
            self.body,
            r#"<text class="{class}" x="{x}" y="{y}" text-anchor="{anchor}">{words}</text>"#
        );
    }

    /// Words that run upwards, around a point.
    pub fn upright(&mut self, at: Vector2<f64>, class: &str, words: &str) {
        let [x, y] = [at.x, at.y].map(short);
        let words = without_markup(words);
        let _ = write!(
            self.body,
            r#"<text class="{class}" transform="translate({x} {y}) rotate(-90)" text-anchor="middle">{words}</text>"#
        );
    }

    /// Whatever `draw` draws, as a part that symbols of the text light up.
    pub fn part(&mut self, name: &str, draw: impl FnOnce(&mut Self)) {
        let _ = write!(self.body, r#"<g data-part="{name}">"#);
        draw(self);
        self.body.push_str("</g>");
    }

    /// Whether it has a part of that name.
    pub fn has_part(&self, name: &str) -> bool {
        self.body.contains(&format!(r#"data-part="{name}""#))
    }

    /// The drawing as a document, told to whoever does not see it by `title` and `description`; `alone` with its colours,
    /// which a page has in a sheet of its own (`STYLE`).
    pub fn document(&self, title: &str, description: &str, alone: bool) -> String {
        let (title, description) = (without_markup(title), without_markup(description));
        let style = if alone {
            format!("<style>{STYLE}</style>")
        } else {
            String::new()
        };
        let (width, height) = (short(self.width), short(self.height));
        format!(
            r#"<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" role="img" aria-labelledby="figure-title figure-description"><title id="figure-title">{title}</title><desc id="figure-description">{description}</desc>{style}{}</svg>"#,
            self.body
        )
    }

    /// Its shapes, for tests.
    pub fn body(&self) -> &str {
        &self.body
    }
}

/// Number with as many decimals as a drawing shows.
fn short(number: f64) -> f64 {
    (number * 100.0).round() / 100.0
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{matrix, vector};

    #[test]
    fn an_ellipse_has_the_deviations_and_the_turn_of_its_covariance() {
        let mut svg = Svg::new(10.0, 10.0);
        // 3 along the diagonal, 1 across it.
        let covariance = matrix![5.0, 4.0; 4.0, 5.0];
        svg.ellipse(vector![5.0, 5.0], &covariance, 1.0, "belief");
        let long_first =
            svg.body().contains(r#"rx="3" ry="1""#) && svg.body().contains("rotate(45");
        let short_first = svg.body().contains(r#"rx="1" ry="3""#)
            && (svg.body().contains("rotate(-45") || svg.body().contains("rotate(135"));
        assert!(long_first || short_first, "{}", svg.body());
    }

    #[test]
    fn words_are_no_markup() {
        let mut svg = Svg::new(1.0, 1.0);
        svg.text(vector![0.0, 0.0], TextAnchor::Start, "", "a < b & c");
        assert!(svg.body().contains("a &lt; b &amp; c"));
    }
}
