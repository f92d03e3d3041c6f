//! Plots as pictures that need nothing else.

use std::fmt::Write;

use quick_xml::escape::escape;

use super::plot::{Plot, PlotPoint, PlotSeries, SeriesStyle};

/// Width and height of the picture.
const SIZE: (f64, f64) = (600.0, 400.0);
/// Room at the left, top, right and bottom.
const ROOM: [f64; 4] = [66.0, 58.0, 18.0, 56.0];
/// Words and axes, and the two series: each readable on white and on near black.
const INK: &str = "#787878";
const TONES: [&str; 2] = ["#2b83d4", "#c9661a"];

impl Plot {
    /// The plot as SVG, 600 by 400, without a ground of its own: its colours are for light and for dark.
    pub fn svg(&self) -> String {
        let mut text = String::new();
        self.write(&mut text).ok();
        text
    }

    fn write(&self, out: &mut String) -> std::fmt::Result {
        let (width, height) = SIZE;
        writeln!(
            out,
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" \
             viewBox=\"0 0 {width} {height}\" font-family=\"sans-serif\" font-size=\"14\" fill=\"{INK}\">\n\
             <title>{0}</title>\n<text x=\"{1}\" y=\"22\" font-size=\"16\">{0}</text>",
            escape(self.title.as_str()),
            ROOM[0]
        )?;
        self.write_axes(out)?;
        let (left, right, top, bottom) = frame();
        if self.diagonal {
            writeln!(
                out,
                "<path d=\"M{left} {bottom}L{right} {top}\" stroke=\"{INK}\" stroke-dasharray=\"5 4\"/>"
            )?;
        }
        if let Some((at, words)) = &self.limit {
            let x = self.place(*at, self.y.low).0;
            let beside = x - 6.0;
            writeln!(
                out,
                "<path d=\"M{x:.1} {bottom}V{top}\" stroke=\"{INK}\" stroke-dasharray=\"5 4\"/>\
                 <text x=\"{beside:.1}\" y=\"{:.1}\" text-anchor=\"end\" font-size=\"13\">{}</text>",
                if self.limit_below() {
                    bottom - 8.0
                } else {
                    top + 16.0
                },
                escape(words.as_str())
            )?;
        }
        let mut legend = left;
        for (series, tone) in self.series.iter().zip(TONES) {
            match series.style {
                SeriesStyle::Line | SeriesStyle::Steps => self.write_line(out, series, tone)?,
                SeriesStyle::Dots => self.write_dots(out, series, tone)?,
            }
            writeln!(
                out,
                "<path d=\"M{legend:.1} 42h18\" stroke=\"{tone}\" stroke-width=\"3\"/>\
                 <text x=\"{:.1}\" y=\"47\" font-size=\"13\">{}</text>",
                legend + 24.0,
                escape(series.name.as_str())
            )?;
            legend += 44.0 + 6.6 * series.name.chars().count() as f64;
        }
        writeln!(out, "</svg>")
    }

    fn write_axes(&self, out: &mut String) -> std::fmt::Result {
        let (left, right, top, bottom) = frame();
        for (value, label) in self.x.ticks(8) {
            let x = self.place(value, self.y.low).0;
            writeln!(
                out,
                "<path d=\"M{x:.1} {bottom}V{top}\" stroke=\"{INK}\" stroke-opacity=\".25\"/>\
                 <text x=\"{x:.1}\" y=\"{:.1}\" text-anchor=\"middle\">{}</text>",
                bottom + 19.0,
                escape(label.as_str())
            )?;
        }
        for (value, label) in self.y.ticks(5) {
            let y = self.place(self.x.low, value).1;
            writeln!(
                out,
                "<path d=\"M{left} {y:.1}H{right}\" stroke=\"{INK}\" stroke-opacity=\".25\"/>\
                 <text x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"end\">{}</text>",
                left - 8.0,
                y + 5.0,
                escape(label.as_str())
            )?;
        }
        let (middle, across) = (0.5 * (left + right), 0.5 * (top + bottom));
        writeln!(
            out,
            "<path d=\"M{left} {top}V{bottom}H{right}\" fill=\"none\" stroke=\"{INK}\"/>\n\
             <text x=\"{middle:.1}\" y=\"{:.1}\" text-anchor=\"middle\">{}</text>\n\
             <text transform=\"translate(18 {across:.1}) rotate(-90)\" text-anchor=\"middle\">{}</text>",
            bottom + 44.0,
            escape(self.x.label.as_str()),
            escape(self.y.label.as_str())
        )
    }

    fn write_line(&self, out: &mut String, series: &PlotSeries, tone: &str) -> std::fmt::Result {
        let along = |of: &dyn Fn(&PlotPoint) -> f64| -> Vec<String> {
            let place = |p: &PlotPoint| {
                let (x, y) = self.place(p.x, of(p));
                format!("{x:.1} {y:.1}")
            };
            series.corners().iter().map(place).collect()
        };
        if series.points.is_empty() {
            return Ok(());
        }
        let (low, high) = (along(&|p| p.low), along(&|p| p.high));
        if low != high {
            let back: Vec<_> = high.into_iter().rev().collect();
            let (there, back) = (low.join("L"), back.join("L"));
            writeln!(
                out,
                "<path d=\"M{there}L{back}Z\" fill=\"{tone}\" fill-opacity=\".2\"/>"
            )?;
        }
        writeln!(
            out,
            "<path d=\"M{}\" fill=\"none\" stroke=\"{tone}\" stroke-width=\"2\"/>",
            along(&|p| p.y).join("L")
        )
    }

    fn write_dots(&self, out: &mut String, series: &PlotSeries, tone: &str) -> std::fmt::Result {
        for point in &series.points {
            let (x, y) = self.place(point.x, point.y);
            let [low, high] = [point.low, point.high].map(|v| self.place(point.x, v).1);
            writeln!(
                out,
                "<path d=\"M{x:.1} {low:.1}V{high:.1}\" stroke=\"{tone}\" stroke-width=\"2\"/>\
                 <circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"4\" fill=\"{tone}\"/>"
            )?;
        }
        Ok(())
    }

    fn place(&self, x: f64, y: f64) -> (f64, f64) {
        let (left, right, top, bottom) = frame();
        (
            left + self.x.fraction(x) * (right - left),
            bottom - self.y.fraction(y) * (bottom - top),
        )
    }
}

/// Left, right, upper and lower edge of what is drawn in.
fn frame() -> (f64, f64, f64, f64) {
    let [left, top, right, bottom] = ROOM;
    (left, SIZE.0 - right, top, SIZE.1 - bottom)
}

#[cfg(test)]
mod tests {
    use quick_xml::events::Event;

    use super::super::sample::SyntheticDetector;
    use super::super::{Evaluation, EvaluationSettings};
    use super::*;

    fn plots() -> Vec<Plot> {
        let looks = SyntheticDetector::USUAL.looks(8, 40, 2);
        let settings = EvaluationSettings {
            replicates: 50,
            ..EvaluationSettings::default()
        };
        Evaluation::of(&looks, &settings).unwrap().plots()
    }

    /// Names of all elements, and all words, of well-formed XML.
    fn parsed(svg: &str) -> (Vec<String>, Vec<String>) {
        let mut reader = quick_xml::Reader::from_str(svg);
        let (mut names, mut words) = (Vec::new(), Vec::new());
        let mut depth = 0;
        loop {
            match reader.read_event().unwrap() {
                Event::Start(e) => {
                    depth += 1;
                    names.push(e.name().as_ref().to_owned());
                }
                Event::Empty(e) => {
                    names.push(e.name().as_ref().to_owned());
                }
                Event::Text(text) => words.push(text.as_ref().to_owned()),
                Event::End(_) => depth -= 1,
                Event::Eof => break,
                _ => {}
            }
        }
        assert_eq!(depth, 0);
        (names, words)
    }

    #[test]
    fn pictures_are_well_formed_and_say_what_their_axes_are() {
        for plot in plots() {
            let svg = plot.svg();
            let (names, words) = parsed(&svg);
            for expected in [&plot.title, &plot.x.label, &plot.y.label] {
                assert!(words.contains(expected), "{expected} not in {words:?}");
            }
            let dots = plot.series.iter().filter(|s| s.style == SeriesStyle::Dots);
            let dots: usize = dots.map(|s| s.points.len()).sum();
            let circles = names.iter().filter(|n| *n == "circle").count();
            assert_eq!(circles, dots, "{}", plot.key);
            assert!(!svg.contains("NaN") && !svg.contains("inf"), "{}", plot.key);
        }
    }

    #[test]
    fn words_with_signs_of_xml_in_them_are_escaped() {
        let mut plot = plots().swap_remove(0);
        plot.title = "Pool <A> & \"B\"".to_owned();
        let svg = plot.svg();
        parsed(&svg);
        assert!(svg.contains("Pool &lt;A&gt; &amp;"));
    }

    #[test]
    fn colours_stand_out_from_white_and_from_near_black() {
        let linear = |byte: u8| {
            let v = f64::from(byte) / 255.0;
            if v <= 0.04045 {
                v / 12.92
            } else {
                ((v + 0.055) / 1.055).powf(2.4)
            }
        };
        // Relative luminance and contrast of WCAG 2.
        let luminance = |hex: &str| {
            let byte = |i: usize| linear(u8::from_str_radix(&hex[i..i + 2], 16).unwrap());
            0.2126 * byte(1) + 0.7152 * byte(3) + 0.0722 * byte(5)
        };
        for (colour, least) in [(INK, 4.0), (TONES[0], 3.5), (TONES[1], 3.5)] {
            let on_white = 1.05 / (luminance(colour) + 0.05);
            let on_dark = (luminance(colour) + 0.05) / (luminance("#101418") + 0.05);
            assert!(on_white > least && on_dark > least, "{on_white} {on_dark}");
        }
    }

    #[test]
    fn pictures_can_be_written_for_people_to_look_at() {
        let Some(folder) = std::env::var_os("PILOTAGE_PICTURES") else {
            return;
        };
        for plot in plots() {
            let path = std::path::Path::new(&folder).join(format!("{}.svg", plot.key));
            std::fs::write(path, plot.svg()).unwrap();
        }
    }
}
