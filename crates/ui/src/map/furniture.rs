//! Scale bar, north arrow, cursor coordinates, and the lens that magnifies the uncertainty.

use egui::{
    Align2, Color32, Painter, Pos2, Rect, Role, Sense, Shape, Stroke, Ui, WidgetInfo, pos2, vec2,
};
use pilotage_core::frames::{GroundPoint, LocalFrame};

use crate::documents::OpenedTerrain;
use pilotage_core::imagery::terrain::Terrain as _;

use super::correction::ShownBelief;
use super::symbols::{paint_ellipses, paint_sigma};
use super::transform::ScreenFromWorld;
use crate::tokens::Tokens;
use crate::units::{Units, with_minus};

/// Distance of the belief below the middle of the lens, points.
const BELOW_NAME: f32 = 8.0;

/// The largest of 1, 2, 5 × 10ⁿ that is not above `most`.
pub fn round_length(most: f64) -> f64 {
    let power = 10.0_f64.powf(most.max(1e-9).log10().floor());
    [5.0, 2.0, 1.0]
        .into_iter()
        .map(|d| d * power)
        .find(|v| *v <= most * (1.0 + 1e-9))
        .unwrap_or(power)
}

/// A length with its unit, short.
pub fn length_text(metres: f64, units: Units) -> String {
    let (factor, unit) = units.length();
    let value = metres * factor;
    if units == Units::Metric && value >= 1000.0 {
        format!("{} km", value / 1000.0)
    } else if value >= 1.0 {
        format!("{value:.0} {unit}")
    } else {
        format!("{value:.1} {unit}")
    }
}

/// Draws the scale bar with its right end at `right_bottom`; the part of the screen that it takes.
pub fn paint_scale_bar(
    painter: &Painter,
    view: &ScreenFromWorld,
    right_bottom: Pos2,
    units: Units,
    tokens: &Tokens,
) -> Rect {
    let (factor, _) = units.length();
    let length = round_length(120.0 * view.metres_per_point * factor) / factor;
    let width = view.points(length);
    let left = right_bottom - vec2(width, 0.0);
    let bar = vec![
        left - vec2(0.0, 6.0),
        left,
        right_bottom,
        right_bottom - vec2(0.0, 6.0),
    ];
    painter.add(Shape::line(bar.clone(), Stroke::new(4.0, tokens.outline())));
    painter.add(Shape::line(bar, Stroke::new(1.5, tokens.sigma)));
    let words = super::symbols::paint_halo_text(
        painter,
        pos2(left.x + 0.5 * width, left.y - 8.0),
        Align2::CENTER_BOTTOM,
        &length_text(length, units),
        tokens.small(),
        tokens.sigma,
    );
    words.union(Rect::from_two_pos(left, right_bottom))
}

/// Coordinates of the pointer, in words.
pub fn coordinates_text(p: &GroundPoint, frame: Option<&LocalFrame>, units: Units) -> String {
    let (factor, unit) = units.length();
    let side = |v: f64, positive: char, negative: char| {
        let letter = if v < 0.0 { negative } else { positive };
        format!("{letter} {:.0} {unit}", v.abs() * factor)
    };
    let local = format!("{}   {}", side(p.north, 'N', 'S'), side(p.east, 'E', 'W'));
    match frame {
        Some(frame) => {
            let place = frame.geodetic_from_ground(p);
            with_minus(&format!(
                "{local}   {:.6}°, {:.6}°",
                place.latitude.to_degrees(),
                place.longitude.to_degrees()
            ))
        }
        None => local,
    }
}

/// Writes whom to thank for the map at the middle of its lower edge.
pub fn paint_attribution(ui: &Ui, rect: Rect, attribution: &str, tokens: &Tokens) {
    let galley = ui.painter().layout(
        attribution.to_owned(),
        tokens.small(),
        tokens.text,
        0.4 * rect.width(),
    );
    let size = galley.size() + vec2(12.0, 4.0);
    let middle = pos2(rect.center().x, rect.bottom() - 0.5 * size.y - 2.0);
    let at = Rect::from_center_size(middle, size);
    let response = ui.interact(at, ui.scope_id().with("attribution"), Sense::hover());
    response.widget_info(|| WidgetInfo::labeled(Role::Label, true, attribution));
    let painter = ui.painter_at(rect);
    painter.rect_filled(at, 2.0, tokens.over_map());
    painter.galley(at.min + vec2(6.0, 2.0), galley, tokens.text);
}

/// Height of the ground at a place with what it counts from, where it is known.
pub fn height_text(p: &GroundPoint, ground: &OpenedTerrain, units: Units) -> Option<String> {
    let (factor, unit) = units.length();
    let height = factor * ground.height_at(p)?;
    let above = ground.heights()?.datum().frame();
    let height = with_minus(&format!("{height:.0}"));
    Some(format!("ground {height} {unit} {above}"))
}

/// Content of the lens.
#[derive(Clone, Copy, Debug)]
pub struct LensScene<'a> {
    /// The belief as it is drawn.
    pub belief: &'a ShownBelief,
    /// True position, where it is to be shown.
    pub truth: Option<GroundPoint>,
    /// Colour of the estimate.
    pub color: Color32,
}

/// Draws a lens at `rect` that magnifies the surroundings of the estimate, so that the sigma points
/// are seen to breathe whatever the map's scale.
pub fn paint_lens(
    painter: &Painter,
    map: &ScreenFromWorld,
    rect: Rect,
    scene: &LensScene<'_>,
    units: Units,
    tokens: &Tokens,
) {
    let LensScene {
        belief,
        truth,
        color,
    } = *scene;
    let covariance = belief.covariance;
    let largest = covariance.diagonal().max().max(1e-6).sqrt();
    // Steps of a factor two, so that growth is seen as growth.
    let reach = 2.0_f64.powf((3.6 * largest).log2().ceil());
    // The outermost sigma points stay clear of the name above them.
    let middle = rect.center() + vec2(0.0, BELOW_NAME);
    let view = ScreenFromWorld {
        center: belief.position,
        metres_per_point: 2.0 * reach / f64::from(rect.width()),
        up: map.up,
        middle,
    };
    painter.rect_filled(rect, tokens.radius, tokens.over_map());
    let inside = painter.with_clip_rect(rect.intersect(painter.clip_rect()));
    let line = Stroke::new(1.0, tokens.line);
    inside.hline(rect.x_range(), middle.y, line);
    inside.vline(rect.center().x, rect.y_range(), line);
    paint_ellipses(&inside, &view, &belief.position, &covariance, color, tokens);
    if let Some(truth) = truth {
        let at = view.apply(&truth);
        let arm = 5.0;
        let stroke = Stroke::new(2.0, tokens.truth);
        inside.line_segment([at - vec2(arm, arm), at + vec2(arm, arm)], stroke);
        inside.line_segment([at - vec2(arm, -arm), at + vec2(arm, -arm)], stroke);
    }
    paint_sigma(&inside, &view, &belief.sigma, tokens, 3.0);
    // Its frame lights up as a correction arrives.
    let edge = if belief.share < 1.0 {
        Stroke::new(1.0 + 2.0 * (1.0 - belief.share), tokens.corrected)
    } else {
        Stroke::new(1.0, tokens.line)
    };
    painter.rect_stroke(rect, tokens.radius, edge, egui::StrokeKind::Inside);
    let (factor, _) = units.length();
    let bar = round_length(0.45 * reach * factor) / factor;
    let width = view.points(bar);
    let end = rect.right_bottom() - vec2(8.0, 8.0);
    inside.line_segment([end, end - vec2(width, 0.0)], Stroke::new(1.5, tokens.text));
    inside.text(
        end - vec2(0.5 * width, 3.0),
        Align2::CENTER_BOTTOM,
        length_text(bar, units),
        tokens.small(),
        tokens.text,
    );
    inside.text(
        rect.left_top() + vec2(8.0, 6.0),
        Align2::LEFT_TOP,
        "Uncertainty, magnified",
        tokens.small(),
        tokens.muted,
    );
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn scale_bars_have_round_lengths() {
        assert_eq!(round_length(137.0), 100.0);
        assert_eq!(round_length(51.0), 50.0);
        assert_eq!(round_length(0.3), 0.2);
    }

    #[test]
    fn aviators_read_feet() {
        assert_eq!(length_text(30.48, Units::Aviation), "100 ft");
        assert_eq!(length_text(2000.0, Units::Metric), "2 km");
    }
}
