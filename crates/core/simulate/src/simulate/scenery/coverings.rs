//! Coverings of roofs, as seen from above.

use super::face::Face;
use super::fields::{line_share, repeated, stripes};
use super::light::{Color, mix, scale};
use super::noise::{fractal, hash2, smooth_step, unit};
use super::things::{RoofCover, Solid};

/// Fine variation at a place on a roof, and the roof's own tint from 0 to 1.
pub(super) struct Grain {
    pub(super) speckle: f32,
    pub(super) clumps: f32,
    pub(super) patches: f32,
    pub(super) veins: f32,
    pub(super) tint: f32,
}

/// Reflectance of a roof's covering at (along, across, inside the eaves).
pub(super) fn covering(
    solid: &Solid,
    f: &Face,
    (u, v, inside): (f32, f32, f32),
    grain: &Grain,
    gsd: f32,
) -> Color {
    match solid.cover {
        RoofCover::Tiles => tiles(solid, f, grain, gsd),
        RoofCover::Metal => metal(solid, f, grain, gsd),
        RoofCover::Felt | RoofCover::Ballast => felt(solid, v, grain, gsd),
        RoofCover::Glass => glass(solid, u, v, grain, gsd),
        RoofCover::Plain => plain(solid, f, inside, grain, gsd),
    }
}

fn tiles(solid: &Solid, f: &Face, grain: &Grain, gsd: f32) -> Color {
    let &Grain {
        speckle,
        clumps,
        patches,
        tint,
        ..
    } = grain;
    let mut c = solid.color;

    let course = stripes(f.down, 0.36, gsd);
    let tile = unit(hash2(
        (f.down / 0.36).floor() as i32,
        (f.along / 0.3).floor() as i32,
        solid.variant,
    )) - 0.5;
    let tile = if gsd < 0.35 {
        tile * (1.0 - gsd / 0.35)
    } else {
        0.0
    };
    let moss = smooth_step(0.15, 0.8, patches + 0.4 * clumps + 0.6 * (tint - 0.6));
    c = scale(
        c,
        1.0 + 0.1 * course + 0.3 * tile + 0.1 * patches + 0.12 * clumps + 0.06 * speckle,
    );
    c = mix(c, [0.07, 0.072, 0.045], 0.4 * moss);
    c = mix(
        c,
        scale(solid.color, 1.3),
        0.6 * line_share(f.ridge, 0.14, gsd),
    );
    c
}

fn metal(solid: &Solid, f: &Face, grain: &Grain, gsd: f32) -> Color {
    let &Grain {
        speckle,
        patches,
        tint,
        ..
    } = grain;
    let mut c = solid.color;

    let sheet = unit(hash2(
        (f.along / 3.6).floor() as i32,
        (f.down / 6.0).floor() as i32,
        solid.variant,
    )) - 0.5;
    let streak = smooth_step(
        0.1,
        0.8,
        fractal(
            f.along * 2.0,
            f.down * 0.16,
            1.6,
            3,
            gsd,
            solid.variant & 0xff,
        ) + 0.5 * (tint - 0.5),
    );
    c = scale(c, 1.0 + 0.09 * sheet + 0.05 * patches + 0.03 * speckle);
    c = mix(
        c,
        mix([0.2, 0.12, 0.075], scale(c, 0.7), 0.5),
        0.32 * streak,
    );
    c
}

fn felt(solid: &Solid, v: f32, grain: &Grain, gsd: f32) -> Color {
    let &Grain {
        speckle,
        clumps,
        patches,
        veins,
        ..
    } = grain;
    let mut c = solid.color;

    let seam = line_share(repeated(v, 2.1), 0.05, gsd);
    let pond = smooth_step(0.2, 0.65, patches + 0.3 * clumps);
    c = scale(
        c,
        1.0 + 0.07 * patches + 0.05 * clumps + 0.05 * speckle - 0.18 * pond - 0.1 * seam,
    );
    c = mix(
        c,
        scale(solid.color, 0.6),
        0.35 * veins * smooth_step(0.0, 0.4, patches),
    );
    if solid.cover == RoofCover::Ballast {
        c = scale(c, 1.0 + 0.14 * speckle + 0.08 * clumps);
    }
    c
}

fn glass(solid: &Solid, u: f32, v: f32, grain: &Grain, gsd: f32) -> Color {
    let &Grain { patches, tint, .. } = grain;

    let frame = line_share(repeated(u, 1.6), 0.07, gsd).max(line_share(v, 0.12, gsd));
    let inner = mix(
        [0.12, 0.16, 0.1],
        solid.color,
        0.45 + 0.3 * patches + 0.25 * tint,
    );
    let pane = unit(hash2(
        (u / 1.6).round() as i32,
        (v / 1.9).round() as i32,
        solid.variant,
    )) - 0.5;
    mix(
        scale(inner, 1.0 + 0.35 * pane),
        [0.5, 0.51, 0.5],
        0.75 * frame,
    )
}

fn plain(solid: &Solid, f: &Face, inside: f32, grain: &Grain, gsd: f32) -> Color {
    let &Grain {
        speckle,
        clumps,
        patches,
        ..
    } = grain;
    let mut c = solid.color;

    c = scale(c, 1.0 + 0.06 * patches + 0.05 * clumps + 0.04 * speckle);
    if solid.is_round() && solid.slab.half_along > 6.0 {
        let sector = repeated(f.along, solid.slab.half_along * std::f32::consts::PI / 12.0)
            * f.down
            / solid.slab.half_along;
        c = scale(c, 1.0 - 0.2 * line_share(sector, 0.06, gsd));
        let rust = smooth_step(0.25, 0.8, patches + 0.5 * clumps);
        c = mix(c, [0.2, 0.13, 0.085], 0.3 * rust);
        c = mix(c, scale(c, 0.55), line_share(f.down - 1.4, 0.15, gsd));
        c = mix(c, scale(c, 1.25), line_share(inside - 0.25, 0.2, gsd));
    }
    c
}
