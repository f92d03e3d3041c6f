//! A picture of which nobody knows what it shows, on other days.

use std::convert::Infallible;
use std::f64::consts::TAU;
use std::sync::Arc;

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::days::{OtherDays, seeds};
use pilotage_base::frames::{GroundPoint, GroundRect};
use pilotage_raster::imagery::kept::RecentValues;
use pilotage_raster::imagery::{Imagery, Window};
use pilotage_raster::raster::{Gray, Raster, Rgba, gaussian_blur, luminance, wide_blur};

/// Width of the surroundings next to which a pixel counts as in shadow, metres.
const SURROUNDINGS: f64 = 6.0;
/// Size of the fields over which the light changes, metres.
const FIELD: f64 = 25.0;
/// Width below which texture is taken to be leaves and grass, metres.
const TEXTURE: f64 = 0.5;
/// Share of that texture that is the same on another day.
const TEXTURE_KEPT: f32 = 0.5;
/// The least of it in a photograph.
const LEAST_TEXTURE: f32 = 0.2;
/// By how much the light changes over the fields.
const LIGHT: f32 = 0.25;
/// Furthest that shadows move, metres.
const SHADOW_SHIFT: f64 = 3.0;
/// Size of what stands up, metres.
const CROWN: f64 = 4.0;
/// Largest lean of the ground where nothing is known to stand on it, metres.
const LEAN: f64 = 0.5;
/// The same in a photograph that was laid on the map with care.
const PHOTOGRAPHED_LEAN: f64 = 0.15;
/// Largest lean of a canopy in such a photograph, metres: what leans further is not where the map has it.
const PHOTOGRAPHED_CANOPY_LEAN: f64 = 1.0;
/// Largest lean of a canopy, metres: a tree of 10 m seen 20° off.
const CANOPY_LEAN: f64 = 3.5;
/// Width over which a canopy is green and rough, metres: what is smaller is not high.
const CANOPY: f64 = 3.0;
/// Width of the surroundings next to which a canopy is rough, metres.
const FOLIAGE: f64 = 1.0;
/// Excess of green times roughness, both as shares of the brightness, from which on something may be a
/// canopy; from three times as much on it is one.
const ROUGH_GREEN: f32 = 0.006;
/// Brightness next to its surroundings below which a pixel is in shadow.
const SHADOW: f32 = 0.72;

/// Side of the blocks of ground that are studied at once, pixels.
const BLOCK: i64 = 512;
/// Memory for what was found out about the ground, bytes.
const KEPT: usize = 64_000_000;

/// Other days of a picture of which nobody knows what it shows.
pub struct PictureDays {
    ground: Arc<StudiedGround>,
}

impl PictureDays {
    /// Other days of `map`.
    pub fn new(map: Arc<dyn Imagery>) -> Self {
        let blocks = RecentValues::new(KEPT);
        Self {
            ground: Arc::new(StudiedGround { map, blocks }),
        }
    }

    fn changed(&self, seed: u64, leaning: Leaning) -> Arc<dyn Imagery> {
        Arc::new(ChangedPicture {
            ground: Arc::clone(&self.ground),
            seed,
            leaning,
        })
    }
}

impl OtherDays for PictureDays {
    fn drawn(&self, seed: u64) -> Arc<dyn Imagery> {
        self.changed(seed, Leaning::AnyWay)
    }

    fn photographed(&self, count: usize, seed: u64) -> Vec<Arc<dyn Imagery>> {
        seeds(count, seed)
            .map(|seed| self.changed(seed, Leaning::OneWay))
            .collect()
    }
}

/// Direction in which what stands up leans.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Leaning {
    /// Every crown another way: none of it can be relied upon.
    AnyWay,
    /// All of it away from one camera, the higher the further.
    OneWay,
}

/// A picture made to look as on another day and from another place, as far as that can be done without
/// knowing what it shows: shadows fall elsewhere, fine texture grew anew, light and contrast changed by
/// the field, and what stands up leans another way. Leaning is what tells woods from roads: every few
/// metres the ground moves, by half a metre anywhere and by metres where it is green and rough over
/// several metres, which is what a canopy looks like from above. A lawn is not rough, a bush not wide.
/// In a photograph, all of it leans one way.
struct ChangedPicture {
    ground: Arc<StudiedGround>,
    seed: u64,
    leaning: Leaning,
}

/// Properties of the ground that are the same on every day, found out once for all of them.
struct StudiedGround {
    map: Arc<dyn Imagery>,
    /// By ground sample distance (its bits), row from the north and column from the west.
    blocks: RecentValues<(u64, i64, i64), GroundProperties>,
}

/// Properties that a piece of ground shows.
struct GroundProperties {
    window: Window,
    /// Pixels around the window that are known, too: as far as shadows move and canopies lean.
    margin: usize,
    /// With the margin.
    picture: Raster<Rgba>,
    /// The picture without leaves and grass, with the margin.
    smooth: Gray,
    /// Share of the light that reaches each pixel, with the margin.
    lit: Gray,
    /// Degree to which every pixel is canopy, 0 to 1, without the margin.
    canopy: Gray,
}

impl GroundProperties {
    fn of(map: &dyn Imagery, window: &Window) -> Self {
        let gsd = window.gsd;
        // Enough that no pixel depends on where the window ends.
        let margin = ((SHADOW_SHIFT + CANOPY_LEAN) / gsd).ceil() as usize + 1;
        let far = margin.max(((2.0 * SURROUNDINGS + SHADOW_SHIFT) / gsd).ceil() as usize);
        let picture = map.window(&Window {
            north_edge: window.north_edge + far as f64 * gsd,
            west_edge: window.west_edge - far as f64 * gsd,
            width: window.width + 2 * far,
            height: window.height + 2 * far,
            ..*window
        });
        let bright = picture.to_gray();
        let around = wide_blur(&bright, SURROUNDINGS / gsd);
        let smooth = gaussian_blur(&bright, (TEXTURE / gsd).max(0.3));
        let canopy = canopy(&picture, &bright, gsd);
        let known = far - margin;
        let (width, height) = (window.width + 2 * margin, window.height + 2 * margin);
        Self {
            window: *window,
            margin,
            picture: part(&picture, known, width, height),
            lit: Gray::from_fn(width, height, |c, r| {
                shadow(
                    smooth.get(c + known, r + known),
                    around.get(c + known, r + known),
                )
            }),
            smooth: part(&smooth, known, width, height),
            canopy: part(&canopy, far, window.width, window.height),
        }
    }

    fn bytes(&self) -> usize {
        12 * self.picture.pixels().len() + 4 * self.canopy.pixels().len()
    }
}

impl StudiedGround {
    /// The studies of a window, each with the part of the window that it serves, as columns and rows.
    fn studies(&self, window: &Window) -> Vec<(Arc<GroundProperties>, [usize; 4])> {
        let (column, row) = (
            window.west_edge / window.gsd,
            -window.north_edge / window.gsd,
        );
        let is_whole = |v: f64| (v - v.round()).abs() < 1e-6;
        if !is_whole(column) || !is_whole(row) {
            let whole = [0, 0, window.width, window.height];
            return vec![(
                Arc::new(GroundProperties::of(self.map.as_ref(), window)),
                whole,
            )];
        }
        let (left, top) = (column.round() as i64, row.round() as i64);
        let (right, bottom) = (left + window.width as i64, top + window.height as i64);
        let blocks = |from: i64, to: i64| from.div_euclid(BLOCK)..=(to - 1).div_euclid(BLOCK);
        let mut studies = Vec::new();
        for r in blocks(top, bottom) {
            for c in blocks(left, right) {
                let part = |at: i64, from: i64, to: i64| {
                    (
                        (at * BLOCK).max(from) - from,
                        ((at + 1) * BLOCK).min(to) - from,
                    )
                };
                let ((x0, x1), (y0, y1)) = (part(c, left, right), part(r, top, bottom));
                let part = [x0, y0, x1, y1].map(|v| v as usize);
                studies.push((self.block(window.gsd, r, c), part));
            }
        }
        studies
    }

    fn block(&self, gsd: f64, row: i64, column: i64) -> Arc<GroundProperties> {
        let make = || {
            let study = GroundProperties::of(
                self.map.as_ref(),
                &Window {
                    north_edge: -((row * BLOCK) as f64) * gsd,
                    west_edge: (column * BLOCK) as f64 * gsd,
                    gsd,
                    width: BLOCK as usize,
                    height: BLOCK as usize,
                },
            );
            let bytes = study.bytes();
            Ok::<_, Infallible>((study, bytes))
        };
        let Ok(study) = self.blocks.get_or_make((gsd.to_bits(), row, column), make);
        study
    }
}

/// Changes that are drawn of a day.
struct Changes {
    /// Shift of the shadows, pixels to the east and down.
    shadows: [f64; 2],
    contrast: f32,
    /// Lean of the highest, metres to the east and down.
    lean: [f64; 2],
    /// Share of the texture that is the same.
    texture_kept: f32,
    /// By how much the light changes over the fields, at most.
    light: f32,
}

impl Imagery for ChangedPicture {
    fn name(&self) -> &str {
        self.ground.map.name()
    }

    fn bounds(&self) -> GroundRect {
        self.ground.map.bounds()
    }

    fn native_gsd(&self) -> f64 {
        self.ground.map.native_gsd()
    }

    fn window(&self, window: &Window) -> Raster<Rgba> {
        let mut random = ChaCha8Rng::seed_from_u64(self.seed);
        let bearing = TAU * random.random::<f64>();
        let shift = SHADOW_SHIFT * random.random::<f64>() / window.gsd;
        let changes = Changes {
            shadows: [shift * bearing.sin(), -shift * bearing.cos()],
            contrast: (0.8 + 0.35 * random.random::<f64>()) as f32,
            lean: {
                let (sin, cos) = (TAU * random.random::<f64>()).sin_cos();
                let metres = PHOTOGRAPHED_CANOPY_LEAN * random.random::<f64>();
                [metres * sin, -metres * cos]
            },
            texture_kept: TEXTURE_KEPT,
            light: LIGHT,
        };
        let changes = match self.leaning {
            Leaning::AnyWay => changes,
            // Of photographs, some are of the map's own day and some of one far from it.
            Leaning::OneWay => Changes {
                texture_kept: 1.0 - (1.0 - LEAST_TEXTURE) * random.random::<f32>(),
                light: LIGHT * random.random::<f32>(),
                contrast: 0.6 + 0.7 * random.random::<f32>(),
                ..changes
            },
        };
        let mut out = Raster::filled(window.width, window.height, [0; 4]);
        for (study, [left, top, right, bottom]) in self.ground.studies(window) {
            let (x, y) = study
                .window
                .pixel_at(&window.ground_at(left as f64, top as f64));
            let (x, y) = (x.round() as usize, y.round() as usize);
            for row in top..bottom {
                for (column, pixel) in (left..right).zip(&mut out.row_mut(row)[left..right]) {
                    *pixel = self.pixel(&study, &changes, x + column - left, y + row - top);
                }
            }
        }
        out
    }
}

impl ChangedPicture {
    /// The pixel in a column and a row of the study's window.
    fn pixel(
        &self,
        study: &GroundProperties,
        changes: &Changes,
        column: usize,
        row: usize,
    ) -> Rgba {
        let (window, margin) = (&study.window, study.margin);
        let place = window.ground_at(column as f64 + 0.5, row as f64 + 0.5);
        let grown_over = f64::from(study.canopy.get(column, row));
        let [x, y] = self.lean(changes, &place, grown_over);
        let pixels = |metres: f64| (metres / window.gsd).round() as isize;
        let (c, r) = (
            (column + margin).saturating_add_signed(pixels(x)),
            (row + margin).saturating_add_signed(pixels(y)),
        );
        let pixel = study.picture.get(c, r);
        let bright = luminance([pixel[0], pixel[1], pixel[2]]);
        let [dx, dy] = changes.shadows;
        let shaded = study.lit.get(
            (c as f64 - dx)
                .round()
                .clamp(0.0, study.lit.width() as f64 - 1.0) as usize,
            (r as f64 - dy)
                .round()
                .clamp(0.0, study.lit.height() as f64 - 1.0) as usize,
        );
        let field = self.noise(place.north / FIELD, place.east / FIELD, 1);
        let leaf = self.noise(place.north / TEXTURE, place.east / TEXTURE, 2);
        let smooth = study.smooth.get(c, r);
        let texture = bright - smooth;
        let strength = texture.abs().min(30.0);
        let kept = changes.texture_kept;
        let grown = kept * texture + (1.0 - kept) * strength * 2.0 * leaf as f32;
        let lit = smooth / study.lit.get(c, r) * shaded + grown;
        let after =
            (128.0 + changes.contrast * (lit - 128.0)) * (1.0 + changes.light * field as f32);
        let gain = after.max(0.0) / bright.max(1.0);
        let scale = |v: u8| (f32::from(v) * gain).clamp(0.0, 255.0) as u8;
        [scale(pixel[0]), scale(pixel[1]), scale(pixel[2]), pixel[3]]
    }

    /// From how far beside a place its picture comes, metres to the east and down.
    fn lean(&self, changes: &Changes, place: &GroundPoint, grown_over: f64) -> [f64; 2] {
        let noise = |layer| self.noise(place.north / CROWN, place.east / CROWN, layer);
        match self.leaning {
            Leaning::AnyWay => {
                let most = LEAN + (CANOPY_LEAN - LEAN) * grown_over;
                [most * noise(3), most * noise(4)]
            }
            Leaning::OneWay => {
                // Crowns are half as high as the highest, or more.
                let height = grown_over * (0.75 + 0.25 * noise(5));
                let [x, y] = changes.lean;
                [
                    height * x + PHOTOGRAPHED_LEAN * noise(3),
                    height * y + PHOTOGRAPHED_LEAN * noise(4),
                ]
            }
        }
    }

    /// Smooth noise of unit cells, -1 to 1.
    fn noise(&self, north: f64, east: f64, layer: u64) -> f64 {
        let (n0, e0) = (north.floor(), east.floor());
        let ease = |t: f64| t * t * (3.0 - 2.0 * t);
        let (tn, te) = (ease(north - n0), ease(east - e0));
        let corner = |dn: f64, de: f64| {
            let mut hash = self.seed ^ layer.wrapping_mul(0x9e37_79b9_7f4a_7c15);
            for key in [(n0 + dn) as i64, (e0 + de) as i64] {
                hash = (hash ^ key as u64).wrapping_mul(0xbf58_476d_1ce4_e5b9);
                hash ^= hash >> 29;
            }
            (hash >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
        };
        let low = corner(0.0, 0.0) * (1.0 - te) + corner(0.0, 1.0) * te;
        let high = corner(1.0, 0.0) * (1.0 - te) + corner(1.0, 1.0) * te;
        low * (1.0 - tn) + high * tn
    }
}

/// The part of a picture that begins `at` pixels from the left and from the top.
fn part<T: Copy>(picture: &Raster<T>, at: usize, width: usize, height: usize) -> Raster<T> {
    Raster::from_fn(width, height, |c, r| picture.get(at + c, at + r))
}

/// Share of the light that reaches a pixel: 1, or less where it is much darker than its surroundings.
fn shadow(bright: f32, around: f32) -> f32 {
    let ratio = bright / around.max(1.0);
    if ratio < SHADOW { ratio.max(0.4) } else { 1.0 }
}

/// Degree to which every pixel is canopy, 0 to 1.
fn canopy(picture: &Raster<Rgba>, bright: &Gray, gsd: f64) -> Gray {
    let smooth = wide_blur(bright, FOLIAGE / gsd);
    let rough_green = Gray::from_fn(bright.width(), bright.height(), |column, row| {
        let [red, green, blue, _] = picture.get(column, row).map(f32::from);
        let excess = (2.0 * green - red - blue) / (red + green + blue).max(1.0);
        let around = smooth.get(column, row).max(8.0);
        excess.max(0.0) * (bright.get(column, row) - around).abs() / around
    });
    let sure = |v: f32| (0.5 * (v - ROUGH_GREEN) / ROUGH_GREEN).clamp(0.0, 1.0);
    wide_blur(&rough_green, CANOPY / gsd).map(sure)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Degree to which the middle of a ground is canopy that is painted with the colour `paint` gives to a
    /// coarse random number, 0 to 1, within `half` metres of the middle, and lawn elsewhere.
    fn canopy_of(half: f64, paint: impl Fn(f64) -> [f64; 3]) -> f32 {
        const GSD: f64 = 0.25;
        let mut random = ChaCha8Rng::seed_from_u64(7);
        let numbers: Vec<f64> = (0..40 * 40).map(|_| random.random()).collect();
        let picture = Raster::from_fn(160, 160, |column, row| {
            let off = |at: usize| (GSD * (at as f64 + 0.5) - 20.0).abs();
            let [r, g, b] = if off(column).max(off(row)) < half {
                paint(numbers[row / 4 * 40 + column / 4])
            } else {
                [100.0, 130.0, 60.0]
            };
            [r as u8, g as u8, b as u8, 255]
        });
        canopy(&picture, &picture.to_gray(), GSD).get(80, 80)
    }

    #[test]
    fn wide_rough_green_is_a_canopy_and_a_lawn_a_bush_and_gravel_are_not() {
        let leaves = |v: f64| [60.0, 90.0, 40.0].map(|c| c * (0.5 + v));
        let gravel = |v: f64| [90.0; 3].map(|c| c * (0.5 + v));
        let wood = canopy_of(18.0, leaves);
        assert!(wood > 0.8, "{wood}");
        let bush = canopy_of(1.0, leaves);
        assert!(bush < 0.3, "{bush}");
        let lawn = canopy_of(0.0, leaves);
        assert!(lawn < 0.05, "{lawn}");
        let stones = canopy_of(18.0, gravel);
        assert!(stones < 0.05, "{stones}");
    }

    /// A grey ground with a field of stripes, without anything green.
    struct Stripes;

    impl Imagery for Stripes {
        fn name(&self) -> &'static str {
            "stripes"
        }
        fn bounds(&self) -> GroundRect {
            GroundRect::centered(GroundPoint::default(), 200.0, 200.0)
        }
        fn native_gsd(&self) -> f64 {
            0.1
        }
        fn window(&self, window: &Window) -> Raster<Rgba> {
            Raster::from_fn(window.width, window.height, |column, row| {
                let p = window.ground_at(column as f64 + 0.5, row as f64 + 0.5);
                let grey = if (p.north / 5.0).floor() as i64 % 2 == 0 {
                    105
                } else {
                    150
                };
                [grey, grey, grey, 255]
            })
        }
    }

    #[test]
    fn in_a_photograph_the_ground_stays_where_the_map_has_it() {
        let days = PictureDays::new(Arc::new(Stripes));
        let window = Window {
            north_edge: 10.0,
            west_edge: -10.0,
            gsd: 0.1,
            width: 200,
            height: 200,
        };
        // How far the edge between stripes at 5 m north lies off, metres, in the mean of all columns.
        let off = |day: &Arc<dyn Imagery>| {
            let grey = day.window(&window).to_gray();
            let edge = |column: usize| {
                let step = |row: &usize| (grey.get(column, row + 1) - grey.get(column, *row)).abs();
                let row = (30..70)
                    .max_by(|a, b| step(a).total_cmp(&step(b)))
                    .unwrap_or(0);
                (10.0 - 0.1 * (row as f64 + 1.0) - 5.0).abs()
            };
            (0..200).map(edge).sum::<f64>() / 200.0
        };
        let still = days.photographed(6, 3).iter().map(off).fold(0.0, f64::max);
        let moving = days.spread(6, 3).iter().map(off).fold(0.0, f64::max);
        assert!(still < PHOTOGRAPHED_LEAN, "{still} m");
        assert!(moving > 1.3 * still, "{moving} m beside {still} m");
    }
}
