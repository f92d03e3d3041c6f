//! A row for each column of a table: its first values, what it means, and why.

use egui::{ComboBox, Grid, Label, RichText, Ui};
use pilotage_core::flight::Quantity;
use pilotage_core::flight::columns::{ColumnRole, GuessedTable, MappedColumn};
use pilotage_core::text::capitalised;

use crate::shell::{caption, muted};
use crate::tokens::Tokens;
use crate::units::Units;

/// Widths of name, first values, meaning, unit and range, points.
const WIDTHS: [f32; 5] = [112.0, 148.0, 172.0, 88.0, 148.0];
/// Least width of the reason, points.
const LEAST_REASON: f32 = 140.0;
/// Confidence from which on a guess is sure, and from which on it is likely.
const SURE: f64 = 0.75;
const LIKELY: f64 = 0.5;

/// Draws the columns of a table, at least `width` points wide; what people choose is put into its map.
pub(super) fn rows(
    ui: &mut Ui,
    tokens: &Tokens,
    units: Units,
    width: f32,
    table: &mut GuessedTable,
) {
    let gap = tokens.space;
    let fixed: f32 = WIDTHS.iter().sum::<f32>() + 6.0 * gap;
    let reason = (width - fixed - gap).max(LEAST_REASON);
    Grid::new(("columns of", &table.map.file))
        .num_columns(6)
        .spacing([gap, 0.75 * gap])
        .striped(true)
        .show(ui, |ui| {
            let names = ["Column", "First values", "Means", "Unit", "Reads as", "Why"];
            for (name, width) in names.iter().zip(WIDTHS.into_iter().chain([reason])) {
                ui.scope(|ui| {
                    ui.set_width(width);
                    caption(ui, tokens, name);
                });
            }
            ui.end_row();
            for index in 0..table.map.columns.len() {
                let first = table.preview.rows.iter().filter_map(|row| row.get(index));
                let first: Vec<&str> = first.map(String::as_str).take(3).collect();
                let first = first.join("  ");
                let range = table.ranges.get(index).copied().flatten();
                let column = &mut table.map.columns[index];
                cell(
                    ui,
                    WIDTHS[0],
                    RichText::new(&column.name).color(tokens.text),
                );
                cell(ui, WIDTHS[1], RichText::new(first).font(tokens.small()));
                choose_role(ui, column, index);
                choose_unit(ui, column, index);
                let reads = reads_as(column, range, units);
                cell(ui, WIDTHS[4], RichText::new(reads).font(tokens.small()));
                ui.scope(|ui| {
                    ui.set_width(reason);
                    ui.add(Label::new(why(tokens, column)).wrap());
                });
                ui.end_row();
            }
        });
}

/// Text in a cell of a width, cut off with the whole on hover.
fn cell(ui: &mut Ui, width: f32, text: RichText) {
    ui.scope(|ui| {
        ui.set_width(width);
        ui.add(Label::new(text).truncate());
    });
}

fn choose_role(ui: &mut Ui, column: &mut MappedColumn, index: usize) {
    let mut chosen = column.role;
    ui.scope(|ui| {
        ui.set_width(WIDTHS[2]);
        ComboBox::from_id_salt(("role", index))
            .width(WIDTHS[2] - 8.0)
            .height(420.0)
            .selected_text(column.role.label())
            .show_ui(ui, |ui| {
                for role in ColumnRole::all() {
                    ui.selectable_value(&mut chosen, role, role.label());
                }
            })
            .response
            .accessible_name(format!("Meaning of {}", column.name));
    });
    if chosen != column.role {
        take_role(column, chosen);
    }
}

/// Gives a column the role that people chose, in the likeliest of its units.
fn take_role(column: &mut MappedColumn, role: ColumnRole) {
    let known = column.alternatives.iter().find(|other| other.role == role);
    let units = role.units();
    let usual = || {
        let is_usual = |unit: &&&str| ["deg", "m/s", "m", "rad/s", "m/s2", "s"].contains(*unit);
        let usual = units.iter().find(is_usual).or(units.first());
        usual.map_or_else(String::new, |unit| (*unit).to_owned())
    };
    let kept = Some(column.unit.clone()).filter(|unit| units.contains(&unit.as_str()));
    column.unit = kept
        .or_else(|| known.map(|other| other.unit.clone()))
        .unwrap_or_else(usual);
    column.role = role;
    column.scale = 1.0;
    column.offset = 0.0;
    column.confidence = 1.0;
    "you chose it".clone_into(&mut column.reason);
}

fn choose_unit(ui: &mut Ui, column: &mut MappedColumn, index: usize) {
    let units = column.role.units();
    ui.scope(|ui| {
        ui.set_width(WIDTHS[3]);
        if units.is_empty() {
            return;
        }
        let before = column.unit.clone();
        ComboBox::from_id_salt(("unit", index))
            .width(WIDTHS[3] - 8.0)
            .selected_text(unit_label(&column.unit))
            .show_ui(ui, |ui| {
                for unit in units {
                    let value = unit.to_owned();
                    ui.selectable_value(&mut column.unit, value, unit_label(unit));
                }
            })
            .response
            .accessible_name(format!("Unit of {}", column.name));
        if column.unit != before {
            column.confidence = 1.0;
            "you chose the unit".clone_into(&mut column.reason);
        }
    });
}

/// A unit for people.
fn unit_label(unit: &str) -> &str {
    match unit {
        "deg" => "°",
        "deg1e7" => "1e-7 °",
        "cdeg" => "0.01 °",
        "deg/s" => "°/s",
        "m/s2" => "m/s²",
        "us" => "µs",
        "date and time" => "date",
        other => other,
    }
}

/// Smallest and largest value of the column, read with that meaning and unit, in words.
fn reads_as(column: &MappedColumn, range: Option<(f64, f64)>, units: Units) -> String {
    let Some((low, high)) = range else {
        return String::new();
    };
    if column.role == ColumnRole::Time {
        let seconds = match column.unit.as_str() {
            "ms" => 1e-3,
            "us" => 1e-6,
            "ns" => 1e-9,
            _ => 1.0,
        };
        return format!("{} s in all", figure((high - low) * seconds));
    }
    let known = column.role.factor(&column.unit);
    let Some((factor, quantity)) = known.zip(column.role.quantity()) else {
        return String::new();
    };
    let value = |cell: f64| (cell * column.scale + column.offset) * factor;
    let (one, other) = (value(low), value(high));
    let (low, high) = (one.min(other), one.max(other));
    let (shown, unit) = match quantity {
        Quantity::Length => units.length(),
        Quantity::Speed => units.speed(),
        Quantity::Angle => (1_f64.to_degrees(), "°"),
        Quantity::AngularRate => (1_f64.to_degrees(), "°/s"),
        Quantity::Acceleration => (1.0, "m/s²"),
    };
    let is_place = matches!(column.role, ColumnRole::Latitude | ColumnRole::Longitude);
    let figure = |value: f64| {
        if is_place {
            format!("{:.4}", value * shown)
        } else {
            figure(value * shown)
        }
    };
    if low == high {
        format!("{} {unit}", figure(low))
    } else {
        format!("{} to {} {unit}", figure(low), figure(high))
    }
}

/// A number with as many digits as say something.
fn figure(value: f64) -> String {
    let decimals = match value.abs() {
        size if size >= 100.0 => 0,
        size if size >= 10.0 => 1,
        _ => 2,
    };
    format!("{value:.decimals$}")
}

/// Confidence of the guess in a word, and its reason.
fn why(tokens: &Tokens, column: &MappedColumn) -> RichText {
    let reason = column.reason.as_str();
    if column.role == ColumnRole::Nothing || reason.starts_with("you ") {
        return muted(tokens, capitalised(reason));
    }
    let (word, colour) = match column.confidence {
        sure if sure >= SURE => ("Sure", tokens.muted),
        likely if likely >= LIKELY => ("Likely", tokens.muted),
        _ => ("Perhaps", tokens.warning),
    };
    let turned = if column.scale < 0.0 {
        "; counted the other way"
    } else {
        ""
    };
    muted(tokens, format!("{word}: {reason}{turned}")).color(colour)
}

#[cfg(test)]
mod tests {
    use pilotage_core::flight::ChannelName;
    use pilotage_core::flight::columns::guess_table;

    use super::*;

    fn roll() -> MappedColumn {
        let map = guess_table("a.csv", b"t,roll_deg\n0,-10\n1,20\n2,5\n3,4\n");
        map.map(|map| map.columns[1].clone()).unwrap()
    }

    #[test]
    fn a_column_reads_as_its_unit_says() {
        let mut column = roll();
        let range = Some((-10.0, 20.0));
        assert_eq!(reads_as(&column, range, Units::Metric), "-10.0 to 20.0 °");
        column.unit = "rad".to_owned();
        assert_eq!(reads_as(&column, range, Units::Metric), "-573 to 1146 °");
        take_role(&mut column, ColumnRole::SpeedOverGround);
        assert_eq!((column.unit.as_str(), column.confidence), ("m/s", 1.0));
        assert_eq!(
            reads_as(&column, range, Units::Aviation),
            "-19.4 to 38.9 kt"
        );
    }

    #[test]
    fn a_role_that_is_taken_keeps_the_unit_where_it_can() {
        let mut column = roll();
        take_role(&mut column, ColumnRole::Channel(ChannelName::Pitch));
        assert_eq!(column.unit, "deg");
        take_role(&mut column, ColumnRole::Nothing);
        assert_eq!(column.unit, "");
        assert_eq!(reads_as(&column, Some((0.0, 1.0)), Units::Metric), "");
    }
}
