//! Direction of north in the picture, and bank of the aircraft, in a corner.

use egui::{Align2, Painter, Rect, Stroke, Vec2, pos2, vec2};
use pilotage_core::camera::CameraModel;
use pilotage_core::navigator::FrameReport;

use super::super::parts;
use crate::tokens::Tokens;

/// Draws a north arrow, the heading, and the horizon of the assumed attitude.
pub(super) fn draw(
    painter: &Painter,
    tokens: &Tokens,
    outer: Rect,
    camera: &CameraModel,
    report: &FrameReport,
) {
    let attitude = report.assumed_pose.attitude;
    let radius = 2.5 * tokens.space;
    let center = outer.right_top() + vec2(-radius - tokens.space, radius + tokens.space);
    painter.circle_filled(center, radius, parts::shade(tokens));
    painter.circle_stroke(center, radius, Stroke::new(1.0, tokens.line));

    // The horizon: right wing down tilts it the other way; nose up lowers the ground.
    let tilt = Vec2::angled(-attitude.roll as f32);
    let drop = (attitude.pitch as f32 * radius).clamp(-0.8 * radius, 0.8 * radius);
    let normal = tilt.rot90();
    let half = (radius * radius - drop * drop).sqrt();
    let middle = center + normal * drop;
    painter.line_segment(
        [middle - tilt * half, middle + tilt * half],
        Stroke::new(1.0, tokens.muted),
    );

    if let Some(north) = north_in_picture(camera, report) {
        let tip = center + north * (radius - 3.0);
        painter.line_segment(
            [center - north * (radius - 6.0), tip],
            Stroke::new(1.5, tokens.accent),
        );
        let side = north.rot90() * 3.5;
        painter.add(egui::Shape::convex_polygon(
            vec![
                tip + north * 2.0,
                tip - north * 5.0 + side,
                tip - north * 5.0 - side,
            ],
            tokens.accent,
            Stroke::NONE,
        ));
    }
    let text = format!(
        "heading {:03.0}°  bank {:+.0}°  pitch {:+.0}°",
        attitude.yaw.to_degrees().rem_euclid(360.0).round() % 360.0,
        attitude.roll.to_degrees(),
        attitude.pitch.to_degrees()
    )
    .replace("+0°", "0°")
    .replace("-0°", "0°")
    .replace('-', "−");
    let galley = painter.layout_no_wrap(text, parts::small(tokens), tokens.text);
    let pad = vec2(0.75 * tokens.space, 0.25 * tokens.space);
    let right = center.x - radius - 0.5 * tokens.space;
    let rect = Rect::from_min_size(
        pos2(
            right - galley.size().x - 2.0 * pad.x,
            center.y - 0.5 * galley.size().y - pad.y,
        ),
        galley.size() + 2.0 * pad,
    );
    if rect.left() > outer.left() {
        painter.rect_filled(rect, tokens.radius, parts::shade(tokens));
        painter.galley(rect.min + pad, galley, tokens.text);
    } else {
        painter.text(
            center,
            Align2::CENTER_CENTER,
            "N",
            parts::small(tokens),
            tokens.text,
        );
    }
}

/// Unit vector in the picture that points north on the ground below its centre.
fn north_in_picture(camera: &CameraModel, report: &FrameReport) -> Option<Vec2> {
    let pose = &report.assumed_pose;
    let ground = pose.position_in_world.z + 100.0;
    let below = camera.ground_at(pose, &camera.principal, ground)?;
    let north = nalgebra::Point3::new(below.north + 1.0, below.east, ground);
    let pixel = camera.project(pose, &north)?;
    let offset = pixel - camera.principal;
    let vector = vec2(offset.x as f32, offset.y as f32);
    (vector.length() > 1e-6).then(|| vector.normalized())
}
