//! Drawing of tracks: triangles are kept from frame to frame, and only moved and turned.

use std::sync::Arc;

use egui::epaint::Mesh;
use egui::{Color32, Painter, Pos2, Rect, Shape, Stroke};
use pilotage_core::flight::Truth;
use pilotage_core::frames::{GroundPoint, GroundRect};
use pilotage_core::navigator::{Run, StepReport};

use super::thin_track::{PointGroup, ThinTrack, ThinnedPoint};
use super::transform::{MapCamera, ScreenFromWorld};
use crate::kept_mesh::{MeshPart, PlacedMesh};
use crate::still::triangles;

/// Seconds around the time cursor in which a track has its dashes and its outline. Further off it is a
/// plain line: the rounds of a long flight lie over each other, where dashes tell nothing any more, and
/// each of them would cost ten corners in every frame.
const NEAR: f64 = 120.0;

/// Style in which a track is drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TrackStyle {
    /// Colour where corrected.
    pub corrected: Color32,
    /// Colour elsewhere.
    pub other: Color32,
    /// Width, points.
    pub width: f32,
    /// Dash and gap where corrected, points.
    pub dash: Option<(f32, f32)>,
    /// Dash and gap elsewhere, points.
    pub other_dash: Option<(f32, f32)>,
    /// Colour of a line below it, to lift it off the ground.
    pub outline: Color32,
}

impl TrackStyle {
    /// Without dashes and outline, and fainter for it.
    fn plain(self) -> Self {
        Self {
            corrected: self.corrected.gamma_multiply(0.6),
            other: self.other.gamma_multiply(0.6),
            width: 0.75 * self.width,
            dash: None,
            other_dash: None,
            outline: Color32::TRANSPARENT,
        }
    }
}

/// Opacity of the part of a track that is still to come.
const FUTURE: f32 = 0.42;

/// Key of the triangles of a track: everything that they depend on.
#[derive(Clone, Copy, Debug, PartialEq)]
struct TrackMeshKey {
    version: (u64, i32),
    metres_per_point: f64,
    pixels_per_point: f32,
    style: TrackStyle,
}

/// Triangles of a group as if north were up and the group's first point at the origin of the screen,
/// and whether they show it as past.
type DrawnGroup = Option<(bool, Arc<Mesh>)>;

/// The triangles of all complete groups of the rough track in one mesh, as if they were past.
#[derive(Clone, Debug, Default)]
struct FarDrawn {
    mesh: Arc<Mesh>,
    /// Of each group.
    parts: Vec<MeshPart>,
    origin: GroundPoint,
}

impl FarDrawn {
    /// Takes up groups that have become complete; false if there were any.
    fn follow(
        &mut self,
        far: &ThinTrack,
        painter: &Painter,
        view: &ScreenFromWorld,
        style: &TrackStyle,
    ) -> bool {
        let mut lasting = true;
        for group in far.groups(&everywhere()).skip(self.parts.len()) {
            if !group.is_complete() {
                break;
            }
            if self.parts.is_empty() {
                self.origin = group.first().place;
            }
            let north_up = MapCamera {
                center: self.origin,
                metres_per_point: view.metres_per_point,
                up: 0.0,
            }
            .screen_from_world(Rect::ZERO);
            let place = |p: &ThinnedPoint| north_up.apply(&p.place);
            let shapes = shapes(group.points(), f64::INFINITY, style, place);
            let mesh = Arc::make_mut(&mut self.mesh);
            let (vertices, indices) = (mesh.vertices.len(), mesh.indices.len());
            mesh.append(triangles(painter, Rect::EVERYTHING, shapes));
            self.parts.push(MeshPart {
                vertices: vertices..mesh.vertices.len(),
                indices: indices..mesh.indices.len(),
                strength: 1.0,
            });
            lasting = false;
        }
        lasting
    }
}

/// Adds a part to those drawn: one that follows the last of them makes it longer.
fn add_part(parts: &mut Vec<MeshPart>, part: &MeshPart, strength: f32) {
    match parts.last_mut() {
        Some(last) if last.indices.end == part.indices.start && last.strength == strength => {
            last.indices.end = part.indices.end;
            last.vertices.end = part.vertices.end;
        }
        _ => parts.push(MeshPart {
            strength,
            ..part.clone()
        }),
    }
}

fn everywhere() -> GroundRect {
    GroundRect::centered(GroundPoint::default(), f64::MAX, f64::MAX)
}

/// A track and the triangles of its groups: in detail around the time cursor, roughly elsewhere.
#[derive(Clone, Debug)]
pub struct DrawnTrack {
    near: ThinTrack,
    far: ThinTrack,
    look: Option<TrackMeshKey>,
    near_drawn: Vec<DrawnGroup>,
    far_drawn: FarDrawn,
}

impl Default for DrawnTrack {
    fn default() -> Self {
        Self {
            near: ThinTrack::default(),
            far: ThinTrack::rough(),
            look: None,
            near_drawn: Vec::new(),
            far_drawn: FarDrawn::default(),
        }
    }
}

impl DrawnTrack {
    /// Follows a run; `place` picks the track.
    pub fn follow_run(
        &mut self,
        run: &Run,
        generation: u64,
        metres_per_point: f64,
        place: impl Fn(&StepReport) -> GroundPoint + Copy,
    ) {
        for track in [&mut self.near, &mut self.far] {
            track.follow_run(run, generation, metres_per_point, place);
        }
    }

    /// Follows the truth of a flight.
    pub fn follow_truth(&mut self, truth: &Truth, generation: u64, metres_per_point: f64) {
        for track in [&mut self.near, &mut self.far] {
            track.follow_truth(truth, generation, metres_per_point);
        }
    }

    /// Draws a track: what lies before `now` in full, what lies after it fainter.
    pub fn paint(
        &mut self,
        painter: &Painter,
        view: &ScreenFromWorld,
        screen: Rect,
        now: f64,
        style: TrackStyle,
    ) {
        let look = TrackMeshKey {
            version: self.near.version(),
            metres_per_point: view.metres_per_point,
            pixels_per_point: painter.pixels_per_point(),
            style,
        };
        if self.look != Some(look) {
            self.look = Some(look);
            self.near_drawn.clear();
            self.far_drawn = FarDrawn::default();
        }
        let ground = view.visible(screen.expand(8.0));
        // Rough groups that come near the cursor are drawn in detail from end to end.
        let touches = |(begin, end): (f64, f64), from: f64, to: f64| begin <= to && end >= from;
        let is_near = |times| touches(times, now - NEAR, now + NEAR);
        let (from, to) = self
            .far
            .groups(&everywhere())
            .map(|group| group.times())
            .filter(|times| is_near(*times))
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(from, to), times| {
                (from.min(times.0), to.max(times.1))
            });
        let plain = style.plain();
        let lasting = self.far_drawn.follow(&self.far, painter, view, &plain);
        let mut parts = Vec::new();
        let mut mesh = Mesh::default();
        for group in self.far.groups(&ground) {
            if is_near(group.times()) {
                continue;
            }
            let past = group.times().1 <= now;
            if let Some(part) = self.far_drawn.parts.get(group.index) {
                add_part(&mut parts, part, if past { 1.0 } else { FUTURE });
            } else {
                let place = |p: &ThinnedPoint| view.apply(&p.place);
                let shapes = shapes(&group.split_at(now), now, &plain, place);
                mesh.append(triangles(painter, screen, shapes));
            }
        }
        let far = PlacedMesh {
            mesh: Arc::clone(&self.far_drawn.mesh),
            origin: view.apply(&self.far_drawn.origin),
            turned: view.up as f32,
            parts,
        };
        far.paint(painter, lasting);
        let mut add = |group: &PointGroup<'_>, drawn: &mut Vec<DrawnGroup>, style: &TrackStyle| {
            let points = || group.split_at(now);
            let Some(past) = group.side(now) else {
                let shapes = shapes(&points(), now, style, |p| view.apply(&p.place));
                mesh.append(triangles(painter, screen, shapes));
                return;
            };
            if drawn.len() <= group.index {
                drawn.resize(group.index + 1, None);
            }
            let kept = &mut drawn[group.index];
            let origin = group.first().place;
            if kept.as_ref().is_none_or(|(before, _)| *before != past) {
                let north_up = MapCamera {
                    center: origin,
                    metres_per_point: view.metres_per_point,
                    up: 0.0,
                }
                .screen_from_world(Rect::ZERO);
                let shapes = shapes(&points(), now, style, |p| north_up.apply(&p.place));
                *kept = Some((past, Arc::new(triangles(painter, Rect::EVERYTHING, shapes))));
            }
            if let Some((_, drawn)) = kept {
                let placed = PlacedMesh {
                    origin: view.apply(&origin),
                    turned: view.up as f32,
                    ..PlacedMesh::whole(Arc::clone(drawn))
                };
                placed.append_to(&mut mesh);
            }
        };
        for group in self.near.groups(&ground) {
            if touches(group.times(), from, to) {
                add(&group, &mut self.near_drawn, &style);
            }
        }
        if !mesh.is_empty() {
            painter.add(Shape::mesh(mesh));
        }
    }
}

/// The lines through `points`.
fn shapes(
    points: &[ThinnedPoint],
    now: f64,
    style: &TrackStyle,
    place: impl Fn(&ThinnedPoint) -> Pos2,
) -> Vec<Shape> {
    let mut shapes = Vec::new();
    // A line has the look of its end.
    let kind = |point: &ThinnedPoint| (point.corrected, point.time <= now);
    let mut from = 0;
    while from + 1 < points.len() {
        let here = kind(&points[from + 1]);
        let alike = points[from + 1..].iter().take_while(|p| kind(p) == here);
        let to = from + alike.count();
        let line = points[from..=to].iter().map(&place).collect();
        add_line(&mut shapes, line, here, style);
        from = to;
    }
    shapes
}

fn add_line(
    shapes: &mut Vec<Shape>,
    points: Vec<Pos2>,
    (corrected, past): (bool, bool),
    style: &TrackStyle,
) {
    let (color, dash) = if corrected {
        (style.corrected, style.dash)
    } else {
        (style.other, style.other_dash)
    };
    let strength = if past { 1.0 } else { FUTURE };
    let stroke = Stroke::new(style.width, color.gamma_multiply(strength));
    if let Some((dash, gap)) = dash {
        shapes.extend(Shape::dashed_line(&points, stroke, dash, gap));
        return;
    }
    if past && style.outline != Color32::TRANSPARENT {
        let below = Stroke::new(style.width + 2.0, style.outline.gamma_multiply(0.5));
        shapes.push(Shape::line(points.clone(), below));
    }
    shapes.push(Shape::line(points, stroke));
}

#[cfg(test)]
mod tests {
    use egui::pos2;

    use super::*;

    #[test]
    fn kept_triangles_lie_where_new_ones_would() {
        let anchor = GroundPoint::new(40.0, -30.0);
        let camera = |center, up| MapCamera {
            center,
            metres_per_point: 0.5,
            up,
        };
        let north_up = camera(anchor, 0.0).screen_from_world(Rect::ZERO);
        let screen = Rect::from_min_max(pos2(100.0, 50.0), pos2(900.0, 650.0));
        let view = camera(GroundPoint::new(20.0, 10.0), 0.8).screen_from_world(screen);
        let mut kept = Mesh::default();
        let corners = [(40.0, -30.0), (60.0, -30.0), (45.0, 5.0)];
        let corners = corners.map(|(north, east)| GroundPoint::new(north, east));
        for corner in &corners {
            kept.colored_vertex(north_up.apply(corner), Color32::RED);
        }
        kept.add_triangle(0, 1, 2);
        let mut mesh = Mesh::default();
        let placed = PlacedMesh {
            origin: view.apply(&anchor),
            turned: view.up as f32,
            ..PlacedMesh::whole(Arc::new(kept))
        };
        placed.append_to(&mut mesh);
        for (vertex, corner) in mesh.vertices.iter().zip(&corners) {
            assert!(vertex.pos.distance(view.apply(corner)) < 1e-3);
        }
    }
}
