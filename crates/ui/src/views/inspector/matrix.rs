//! Tables of numbers: a covariance with its correlations as heat, and a gain.

use egui::{Align2, Color32, Rect, Sense, Ui, vec2};
use nalgebra::DMatrix;

use super::super::parts::{self, figures};
use crate::tokens::Tokens;

/// Draws a covariance: numbers in the cells, the correlation as their background.
///
/// A cell is the warmer the nearer its correlation is to 1, and the colder the nearer to -1. Cells
/// hold the covariance, or where they are too narrow for it, the correlation; returns whether they
/// hold the covariance.
pub(super) fn covariance(
    ui: &mut Ui,
    tokens: &Tokens,
    matrix: &DMatrix<f64>,
    names: &[String],
) -> bool {
    let correlation = |r: usize, c: usize| {
        let scale = (matrix[(r, r)] * matrix[(c, c)]).max(0.0).sqrt();
        if scale > 0.0 {
            matrix[(r, c)] / scale
        } else {
            0.0
        }
    };
    let roomy = is_roomy(ui.available_width(), names.len(), tokens);
    let cell = cell_width(ui.available_width(), names.len(), tokens) - pad(roomy, tokens);
    // Where there is no room for two decimals, the sign would be cut off.
    let longest = correlation_text(-0.88, 2);
    let needed = ui
        .painter()
        .layout_no_wrap(longest, parts::small(tokens), tokens.text);
    let decimals = if needed.size().x <= cell { 2 } else { 1 };
    let response = cells(
        ui,
        tokens,
        names,
        names,
        |r, c| {
            if roomy {
                si_figures(matrix[(r, c)])
            } else if r == c {
                "1".to_owned()
            } else {
                correlation_text(correlation(r, c), decimals)
            }
        },
        |r, c| {
            let value = correlation(r, c);
            let color = if value >= 0.0 {
                tokens.corrected
            } else {
                tokens.dead_reckoning
            };
            color.gamma_multiply(if r == c {
                0.1
            } else {
                0.75 * value.abs() as f32
            })
        },
    );
    parts::name(&response, "Covariance of the state");
    if let Some(pointer) = response.hover_pos() {
        let (row, column) = place(response.rect, pointer, names.len(), names.len(), tokens);
        if row < names.len() && column < names.len() {
            response.on_hover_text_at_pointer(format!(
                "{} with {}\ncovariance {}, correlation {:.2}",
                names[row],
                names[column],
                si_figures(matrix[(row, column)]),
                correlation(row, column)
            ));
        }
    }
    roomy
}

/// A number in SI units, which may be small: of angles and their rates, a power of ten below a thousandth.
fn si_figures(value: f64) -> String {
    let size = value.abs();
    if size >= 1e-3 || value == 0.0 || !value.is_finite() {
        return figures(value);
    }
    // An exponent of two digits leaves room for one before it.
    let decimals = usize::from(size >= 1e-9);
    format!("{value:.decimals$e}").replace('-', "−")
}

/// A correlation without its leading zero. One of less than 1 is not rounded to it.
fn correlation_text(value: f64, decimals: usize) -> String {
    let most = if decimals == 1 { 0.9 } else { 0.99 };
    format!("{:.decimals$}", value.clamp(-most, most))
        .replacen("0.", ".", 1)
        .replace("-.00", ".00")
        .replace("-.0", if decimals == 1 { ".0" } else { "-.0" })
        .replace('-', "−")
}

/// Width of a column, points.
fn cell_width(width: f32, columns: usize, tokens: &Tokens) -> f32 {
    (width - name_width(tokens)) / columns.max(1) as f32
}

/// Distance of a number from the right edge of its cell, points.
fn pad(roomy: bool, tokens: &Tokens) -> f32 {
    let part = if roomy { 0.5 } else { 0.25 };
    part * tokens.space
}

/// Whether columns are wide enough for numbers of three figures.
fn is_roomy(width: f32, columns: usize, tokens: &Tokens) -> bool {
    cell_width(width, columns, tokens) >= 4.2 * tokens.text_sizes[0]
}

/// Draws a Kalman gain: what one pixel of innovation moves each component by.
pub(super) fn gain(
    ui: &mut Ui,
    tokens: &Tokens,
    matrix: &DMatrix<f64>,
    rows: &[String],
    columns: &[String],
    landmark: &str,
) {
    let most: Vec<f64> = (0..matrix.nrows())
        .map(|r| matrix.row(r).amax().max(1e-12))
        .collect();
    let response = cells(
        ui,
        tokens,
        rows,
        columns,
        |r, c| si_figures(matrix[(r, c)]),
        |r, c| {
            let part = matrix[(r, c)] / most[r];
            let color = if part >= 0.0 {
                tokens.corrected
            } else {
                tokens.dead_reckoning
            };
            color.gamma_multiply(0.45 * part.abs() as f32)
        },
    );
    parts::name(&response, format!("Kalman gain of {landmark}"));
}

/// Width of the row names, points.
fn name_width(tokens: &Tokens) -> f32 {
    7.5 * tokens.text_sizes[0]
}

fn row_height(tokens: &Tokens) -> f32 {
    2.0 * tokens.text_sizes[0]
}

/// Row and column under the pointer; may lie outside.
fn place(
    area: Rect,
    pointer: egui::Pos2,
    rows: usize,
    columns: usize,
    tokens: &Tokens,
) -> (usize, usize) {
    let width = (area.width() - name_width(tokens)) / columns.max(1) as f32;
    let x = (pointer.x - area.left() - name_width(tokens)) / width;
    let y = (pointer.y - area.top()) / row_height(tokens) - 1.0;
    let index = |v: f32, most: usize| if v < 0.0 { most } else { v as usize };
    (index(y, rows), index(x, columns))
}

fn cells(
    ui: &mut Ui,
    tokens: &Tokens,
    rows: &[String],
    columns: &[String],
    text: impl Fn(usize, usize) -> String,
    color: impl Fn(usize, usize) -> Color32,
) -> egui::Response {
    let height = row_height(tokens);
    let size = vec2(ui.available_width(), height * (rows.len() + 1) as f32);
    let (area, response) = ui.allocate_exact_size(size, Sense::hover());
    let left = area.left() + name_width(tokens);
    let width = (area.right() - left) / columns.len().max(1) as f32;
    let roomy = is_roomy(area.width(), columns.len(), tokens);
    let pad = pad(roomy, tokens);
    let painter = ui.painter_at(area);
    let font = parts::small(tokens);
    for (c, name) in columns.iter().enumerate() {
        let rect = Rect::from_min_size(
            egui::pos2(left + c as f32 * width, area.top()),
            vec2(width, height),
        );
        painter.with_clip_rect(rect).text(
            rect.right_center() - vec2(pad, 0.0),
            Align2::RIGHT_CENTER,
            if roomy { short(name) } else { initials(name) },
            font.clone(),
            tokens.muted,
        );
    }
    for (r, name) in rows.iter().enumerate() {
        let top = area.top() + (r + 1) as f32 * height;
        painter.text(
            egui::pos2(area.left(), top + 0.5 * height),
            Align2::LEFT_CENTER,
            name,
            font.clone(),
            tokens.muted,
        );
        for c in 0..columns.len() {
            let rect = Rect::from_min_size(
                egui::pos2(left + c as f32 * width, top),
                vec2(width, height),
            );
            painter.rect_filled(rect.shrink(0.5), 2.0, color(r, c));
            painter.with_clip_rect(rect).text(
                rect.right_center() - vec2(pad, 0.0),
                Align2::RIGHT_CENTER,
                text(r, c),
                font.clone(),
                tokens.text,
            );
        }
    }
    response
}

/// A component's name short enough for a column's head: "wind north" becomes "w north".
fn short(name: &str) -> String {
    match name.rsplit_once(' ') {
        Some((first, last)) => format!("{}. {last}", first.chars().next().unwrap_or(' ')),
        None => name.to_owned(),
    }
}

/// The same for narrow columns: "north" becomes "N", "wind north" becomes "wN".
fn initials(name: &str) -> String {
    let (first, last) = name.rsplit_once(' ').unwrap_or(("", name));
    let upper = last.chars().next().into_iter().flat_map(char::to_uppercase);
    first.chars().next().into_iter().chain(upper).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn correlations_have_as_many_decimals_as_there_is_room_for_and_keep_their_sign() {
        let two = [-0.854, -0.001, 0.294, 0.9999].map(|value| correlation_text(value, 2));
        assert_eq!(two, ["−.85", ".00", ".29", ".99"]);
        let one = [-0.854, -0.001, -0.06, 0.294, -0.98].map(|value| correlation_text(value, 1));
        assert_eq!(one, ["−.9", ".0", "−.1", ".3", "−.9"]);
    }

    #[test]
    fn small_covariances_are_powers_of_ten_and_not_nothing() {
        // Variances of a heading bias of 0.4° and 0.5° in square radians, and what is nothing.
        let told = [4.87e-5, 7.6e-5, -0.000_999, 3e-12, 0.0, 0.0049, 12.34].map(si_figures);
        let wanted = [
            "4.9e−5",
            "7.6e−5",
            "−1.0e−3",
            "3e−12",
            "0",
            "0.0049",
            "12.3",
        ];
        assert_eq!(told, wanted);
    }

    #[test]
    fn column_heads_keep_the_direction() {
        assert_eq!(short("wind north"), "w. north");
        assert_eq!(short("east"), "east");
        assert_eq!(initials("wind north"), "wN");
        assert_eq!(initials("east"), "E");
    }
}
