//! Outcome of a study as a table for people.

use super::digits::digits;
use super::measured::{IntervalBy, MeanSummary};
use super::summary::{MeasureSummary, StudySummary, cell_words};

/// Quantiles of the table, with their names.
const SHOWN: [(f64, &str); 2] = [(0.5, "median"), (0.95, "95 % quantile")];

fn with_interval(mean: &MeanSummary) -> String {
    let interval = mean.interval.map_or(String::new(), |[low, high]| {
        format!(" [{}, {}]", digits(low), digits(high))
    });
    format!("{}{interval}", digits(mean.mean))
}

impl StudySummary {
    /// Table for people.
    pub fn table(&self) -> String {
        let mut rows: Vec<[String; 7]> = vec![
            [
                "cell",
                "measure",
                "flights",
                "mean [95 %]",
                "median",
                "95 %",
                "more than the first",
            ]
            .map(str::to_owned),
        ];
        for cell in &self.cells {
            let settings = cell_words(cell.settings.iter());
            for measure in &cell.measures {
                let at = |share: f64| {
                    let found = measure.quantiles.iter().find(|q| q.share == share);
                    found.map_or(String::new(), |q| digits(q.value))
                };
                let unit = if measure.unit.is_empty() {
                    String::new()
                } else {
                    format!(", {}", measure.unit)
                };
                let mean = measure.mean.as_ref();
                rows.push([
                    settings.clone(),
                    format!("{}{unit}", measure.name),
                    mean.map_or("0".to_owned(), |mean| mean.count.to_string()),
                    mean.map_or("-".to_owned(), with_interval),
                    at(SHOWN[0].0),
                    at(SHOWN[1].0),
                    measure
                        .minus_first
                        .as_ref()
                        .map_or(String::new(), with_interval),
                ]);
            }
        }
        let widths: Vec<usize> = (0..7)
            .map(|column| {
                rows.iter()
                    .map(|row| row[column].chars().count())
                    .max()
                    .unwrap_or(0)
            })
            .collect();
        let measures = || self.cells.iter().flat_map(|cell| &cell.measures);
        let is_by = |by: IntervalBy| {
            let mut means = measures().filter_map(|measure| measure.mean.as_ref());
            means.any(|mean| mean.interval_by == by)
        };
        let mut text = format!(
            "{}: {}\n{} draws, {} flights{}. Intervals of 95 %: {}.\n",
            self.name,
            self.question,
            self.draws,
            self.flights,
            if self.is_stopped {
                ", then it was enough"
            } else {
                ""
            },
            match (is_by(IntervalBy::Scrambles), is_by(IntervalBy::Wilson)) {
                (true, false) => "Student's, of the means of scrambles",
                (true, true) =>
                    "Student's, of the means of scrambles; Wilson's of shares that are the same in all",
                _ => "Wilson's of shares, the bootstrap's of means",
            },
        );
        for row in &rows {
            let cells = row
                .iter()
                .zip(&widths)
                .map(|(cell, width)| format!("{cell:<width$}"));
            text += cells.collect::<Vec<_>>().join("  ").trim_end();
            text.push('\n');
        }
        let unbounded = SHOWN.into_iter().filter_map(|shown| self.unbounded(shown));
        text.extend(unbounded);
        text.extend(self.without());
        let not_enough = self.not_enough.iter();
        text.extend(not_enough.map(|why| format!("The rule to stop did not end it: {why}.\n")));
        text
    }

    /// Sentence for each measure of which flights have no number, with how many of which cells.
    fn without(&self) -> Vec<String> {
        let Some(first) = self.cells.first() else {
            return Vec::new();
        };
        let of = |index: usize, name: &str| {
            let cells = self.cells.iter().filter_map(|cell| {
                let missing = cell.measures[index].missing(self.draws);
                let words = cell_words(cell.settings.iter());
                let place = if words.is_empty() {
                    String::new()
                } else {
                    format!(" of {words}")
                };
                (missing > 0).then(|| format!("{missing} of {}{place}", self.draws))
            });
            let cells: Vec<String> = cells.collect();
            (!cells.is_empty()).then(|| {
                format!(
                    "Flights without a number of {name}: {}.\n",
                    cells.join("; ")
                )
            })
        };
        let names = first.measures.iter().enumerate();
        names
            .filter_map(|(index, measure)| of(index, &measure.name))
            .collect()
    }

    /// Sentence on the measures that have too few flights for an interval of a quantile.
    fn unbounded(&self, (share, name): (f64, &str)) -> Option<String> {
        let is_unbounded = |measure: &&MeasureSummary| {
            let is_drawn = measure.mean.as_ref();
            let is_drawn = is_drawn.is_some_and(|it| it.interval_by == IntervalBy::Bootstrap);
            let mut quantiles = measure.quantiles.iter();
            is_drawn && quantiles.any(|q| q.share == share && q.interval.is_none())
        };
        let measures = self.cells.iter().flat_map(|cell| &cell.measures);
        let mut names: Vec<&str> = Vec::new();
        for measure in measures.filter(is_unbounded) {
            if !names.contains(&measure.name.as_str()) {
                names.push(&measure.name);
            }
        }
        let names = Some(names.join(", ")).filter(|names| !names.is_empty());
        names.map(|names| format!("Not enough flights for an interval of the {name} of {names}.\n"))
    }
}
