//! The three pictures of a match.

use egui::{Align2, Rect, Sense, Stroke, TextureHandle, TextureOptions, Ui, pos2, vec2};

use super::super::{ExplainedStep, color_map, parts};
use crate::tokens::Tokens;
use crate::units::Units;
use pilotage_jobs::MatchPictures;

/// Most height of a picture, points.
const TALLEST: f32 = 260.0;
/// A picture more times as wide as the patch is shown in part.
const MOST_PATCHES: f32 = 4.0;

/// Textures of the pictures shown last.
#[derive(Default)]
pub(super) struct MatchTextures {
    of: Option<ExplainedStep>,
    textures: Vec<TextureHandle>,
}

/// Pictures of a match that are shown.
pub enum ShownMatch<'a> {
    /// They have arrived, with what they are of.
    Pictures(ExplainedStep, &'a MatchPictures),
    /// They were asked for.
    OnTheirWay,
    /// There are none, and why.
    None(&'a str),
}

/// Draws the room of the pictures with a sentence in it.
fn nothing(ui: &mut Ui, tokens: &Tokens, text: &str) {
    let width = ui.available_width();
    let (rect, response) = ui.allocate_exact_size(vec2(width, 0.34 * width), Sense::hover());
    parts::name(&response, text.to_owned());
    let painter = ui.painter();
    painter.rect_filled(rect, tokens.radius, tokens.raised);
    let wrapped = painter.layout(
        text.to_owned(),
        parts::small(tokens),
        tokens.muted,
        width - 2.0 * tokens.space,
    );
    let corner = rect.center() - 0.5 * wrapped.size();
    painter.galley(corner, wrapped, tokens.muted);
}

impl MatchTextures {
    /// Draws patch, rectified picture and score surface at one scale, or says why they are not there.
    pub fn show(&mut self, ui: &mut Ui, tokens: &Tokens, shown: &ShownMatch<'_>, units: Units) {
        let gap = tokens.space;
        let width = ui.available_width();
        let caption = 1.6 * tokens.text_sizes[0];
        let (of, pictures) = match shown {
            ShownMatch::Pictures(of, pictures) => (*of, *pictures),
            ShownMatch::OnTheirWay => {
                return nothing(ui, tokens, "The pictures of this match are on their way");
            }
            ShownMatch::None(why) => return nothing(ui, tokens, &format!("No pictures: {why}")),
        };
        self.update(ui, of, pictures);
        let rasters = [&pictures.patch, &pictures.rectified, &pictures.surface];
        let whole = rasters.map(|r| vec2(r.width().max(1) as f32, r.height().max(1) as f32));
        let part = worth_seeing(pictures, whole[0], whole[1]);
        let sizes = [whole[0], part.size(), whole[2]];
        // Patch and picture share a scale; the surface, often small, takes a third of the width.
        let surface = (0.3 * width / sizes[2].x).min(TALLEST / sizes[2].y);
        let free = width - 2.0 * gap - surface * sizes[2].x;
        let part_of_picture = Rect::from_min_max(
            pos2(part.left() / whole[1].x, part.top() / whole[1].y),
            pos2(part.right() / whole[1].x, part.bottom() / whole[1].y),
        );
        let tallest = sizes[0].y.max(sizes[1].y);
        let scale = (free / (sizes[0].x + sizes[1].x)).min(TALLEST / tallest);
        let scales = [scale, scale, surface];
        let height = (tallest * scale).max(surface * sizes[2].y);
        let (area, response) =
            ui.allocate_exact_size(vec2(width, height + caption), Sense::hover());
        parts::name(
            &response,
            "Map patch, rectified picture, and score at every place",
        );
        let painter = ui.painter_at(area);
        let full = Rect::from_min_max(pos2(0.0, 0.0), pos2(1.0, 1.0));
        let mut left = area.left();
        let mut places = Vec::new();
        let texts = [
            ("Map patch", "Map"),
            ("Camera, seen from above", "Camera"),
            ("Score", "Score"),
        ];
        for (i, (long, short)) in texts.into_iter().enumerate() {
            let (texture, size) = (&self.textures[i], sizes[i] * scales[i]);
            let rect = Rect::from_min_size(pos2(left, area.top() + caption), size);
            let uv = if i == 1 { part_of_picture } else { full };
            painter.image(texture.id(), rect, uv, egui::Color32::WHITE);
            painter.rect_stroke(
                rect,
                0.0,
                Stroke::new(1.0, tokens.line),
                egui::StrokeKind::Outside,
            );
            let room = if i == 2 { area.right() - left } else { size.x };
            let lay = |text: &str| {
                painter.layout_no_wrap(text.to_owned(), parts::small(tokens), tokens.muted)
            };
            let galley = Some(lay(long)).filter(|long| long.size().x <= room);
            let galley = galley.unwrap_or_else(|| lay(short));
            // Two captions never touch.
            let slot = Rect::from_min_size(pos2(left, area.top()), vec2(room, caption));
            painter
                .with_clip_rect(slot)
                .galley(slot.min, galley, tokens.muted);
            places.push(rect);
            left += size.x + gap;
        }
        if let [patch, rectified, surface] = places[..] {
            marks(
                &painter,
                tokens,
                pictures,
                scales,
                part.min.to_vec2(),
                [patch, rectified, surface],
            );
        }
        ui.add_space(0.5 * gap);
        legend(ui, tokens, pictures, units);
    }

    /// Textures of the patch, the rectified picture and the score surface, as shown last.
    #[cfg(test)]
    pub fn ids(&self) -> Vec<egui::TextureId> {
        self.textures.iter().map(TextureHandle::id).collect()
    }

    fn update(&mut self, ui: &Ui, of: ExplainedStep, pictures: &MatchPictures) {
        if self.of == Some(of) && self.textures.len() == 3 {
            return;
        }
        self.of = Some(of);
        let gray_range = color_map::range(&pictures.rectified).unwrap_or((0.0, 255.0));
        let patch_range = color_map::range(&pictures.patch).unwrap_or((0.0, 255.0));
        let images = [
            color_map::picture(&pictures.patch, patch_range, color_map::gray),
            color_map::picture(&pictures.rectified, gray_range, color_map::gray),
            color_map::picture(&pictures.surface, SCORES, color_map::viridis),
        ];
        self.textures = images
            .into_iter()
            .enumerate()
            .map(|(i, image)| {
                let options = if i == 2 {
                    TextureOptions::LINEAR
                } else {
                    TextureOptions::NEAREST
                };
                ui.ctx().load_texture(format!("match {i}"), image, options)
            })
            .collect();
    }
}

/// The part of the rectified picture around the two best places, in its pixels: all of it unless
/// the patch would be lost in it.
fn worth_seeing(pictures: &MatchPictures, patch: egui::Vec2, picture: egui::Vec2) -> Rect {
    let all = Rect::from_min_size(egui::Pos2::ZERO, picture);
    let places = [pictures.peak, pictures.second];
    let found = places.into_iter().flatten();
    let around = found
        .map(|(column, row)| Rect::from_min_size(pos2(column as f32, row as f32), patch))
        .reduce(Rect::union);
    match around {
        Some(around) if picture.max_elem() > MOST_PATCHES * patch.max_elem() => {
            around.expand2(0.75 * patch).intersect(all)
        }
        _ => all,
    }
}

/// Best place with the patch's outline, second-best place, on both pictures that have places.
fn marks(
    painter: &egui::Painter,
    tokens: &Tokens,
    pictures: &MatchPictures,
    scales: [f32; 3],
    corner: egui::Vec2,
    [patch, rectified, surface]: [Rect; 3],
) {
    let over = Tokens::over_imagery();
    let both = [
        (pictures.peak, over.observed, 2.0),
        (pictures.second, over.refused, 1.5),
    ];
    for (place, color, width) in both {
        let Some((column, row)) = place else { continue };
        let offset = vec2(column as f32, row as f32);
        let outline =
            Rect::from_min_size(rectified.min + (offset - corner) * scales[1], patch.size());
        let clipped = painter.with_clip_rect(rectified);
        clipped.rect_stroke(
            outline,
            0.0,
            Stroke::new(width + 2.0, parts::rim(tokens)),
            egui::StrokeKind::Middle,
        );
        clipped.rect_stroke(
            outline,
            0.0,
            Stroke::new(width, color),
            egui::StrokeKind::Middle,
        );
        let at = surface.min + (offset + vec2(0.5, 0.5)) * scales[2];
        painter.circle_stroke(at, 6.0, Stroke::new(width + 2.0, parts::rim(tokens)));
        painter.circle_stroke(at, 6.0, Stroke::new(width, color));
    }
}

/// Scores at the two ends of the colour scale, the same for every match so that they compare.
const SCORES: (f32, f32) = (-0.2, 1.0);

/// The colour scale of the score, the marks, and the common scale.
fn legend(ui: &mut Ui, tokens: &Tokens, pictures: &MatchPictures, units: Units) {
    let height = 1.5 * tokens.text_sizes[0];
    let (rect, _) = ui.allocate_exact_size(vec2(ui.available_width(), height), Sense::hover());
    let painter = ui.painter_at(rect);
    let mut left = rect.left();
    let middle = rect.center().y;
    let text = |at: f32, text: String| {
        painter
            .text(
                pos2(at, middle),
                Align2::LEFT_CENTER,
                text,
                parts::small(tokens),
                tokens.muted,
            )
            .right()
    };
    for (color, name) in [(tokens.observed, "best"), (tokens.refused, "second best")] {
        painter.circle_stroke(pos2(left + 5.0, middle), 4.0, Stroke::new(2.0, color));
        left = text(left + 13.0, name.to_owned()) + tokens.space;
    }
    left = text(left, format!("{:.1}", SCORES.0).replace('-', "−")) + 4.0;
    let bar = Rect::from_min_size(pos2(left, middle - 4.0), vec2(60.0, 8.0));
    for i in 0..30 {
        let fraction = i as f32 / 29.0;
        let part = Rect::from_min_size(bar.min + vec2(2.0 * i as f32, 0.0), vec2(2.5, 8.0));
        painter.rect_filled(part, 0.0, color_map::viridis(fraction));
    }
    left = text(bar.right() + 4.0, format!("{:.0}", SCORES.1)) + tokens.space;
    let (factor, unit) = units.length();
    let pixel = factor * pictures.gsd;
    let scale = format!("{pixel:.2} {unit} per pixel");
    let galley = painter.layout_no_wrap(scale.clone(), parts::small(tokens), tokens.muted);
    if left + galley.size().x <= rect.right() {
        text(left, scale);
    } else {
        text(left, format!("{pixel:.2} {unit}/px"));
    }
}
