//! Cars and other small things from above.

use super::fields::{line_share, stripes};
use super::light::{Color, mix, scale};
use super::noise::smooth_step;
use super::shape::Spot;
use super::things::{Prop, PropForm};
use super::world::SceneryWorld;

impl SceneryWorld {
    /// Paints a small thing over `light`.
    pub(super) fn prop(&self, light: Color, prop: &Prop, p: Spot, gsd: f32, soft: f32) -> Color {
        let (u, v) = prop.slab.local(p);
        let (a, b) = (prop.slab.half_along, prop.slab.half_across);
        if u.abs() > a + 0.6 * gsd || v.abs() > b + 0.6 * gsd {
            return light;
        }
        let mut share = line_share(u, a, gsd) * line_share(v, b, gsd);
        let mut c = prop.color;
        let mut slope = Spot::default();
        let mut height = prop.height;
        match prop.form {
            PropForm::Car => {
                // Rounded corners, bonnet, glass, roof.
                let corner = (u.abs() - a + 0.45)
                    .max(0.0)
                    .hypot((v.abs() - b + 0.45).max(0.0))
                    - 0.45;
                share *= (0.5 - corner / soft.max(0.12)).clamp(0.0, 1.0);
                let t = u / a;
                let cabin = smooth_step(-0.78, -0.7, t) * smooth_step(0.36, 0.28, t);
                let roof = smooth_step(-0.56, -0.5, t)
                    * smooth_step(0.1, 0.04, t)
                    * smooth_step(0.86, 0.76, v.abs() / b);
                let glass = [0.018, 0.022, 0.027];
                let side = axis_slope(
                    prop,
                    0.5 * smooth_step(0.55, 1.0, v.abs() / b) * -v.signum(),
                );
                slope = side + prop.slab.axis * (-0.18 * t);
                height = if roof > 0.5 {
                    prop.height
                } else {
                    0.6 * prop.height
                };
                c = mix(c, glass, 0.92 * cabin);
                c = mix(c, scale(prop.color, 1.04), roof);
                c = mix(c, scale(c, 0.7), 0.5 * line_share(t - 0.33, 0.02, gsd / a));
            }
            PropForm::Truck => {
                let cab = smooth_step(0.62, 0.66, u / a);
                c = mix(
                    scale(c, 1.0 + 0.08 * stripes(u, 1.2, gsd)),
                    [0.2, 0.06, 0.05],
                    0.8 * cab,
                );
                c = mix(c, [0.02, 0.02, 0.025], line_share(u - 0.6 * a, 0.12, gsd));
            }
            PropForm::Bale => {
                slope = axis_slope(prop, -0.8 * v / b);
                c = scale(c, 1.0 + 0.1 * stripes(u, 0.3, gsd));
            }
            PropForm::Crate => c = scale(c, 1.0 + 0.12 * stripes(u, 0.6, gsd)),
        }
        let sunlit = self.sun_reaching(p, height, u32::MAX, gsd, soft);
        let mut own = self
            .light
            .reflect(c, sunlit * self.light.cosine(slope), 0.95);
        if prop.form == PropForm::Car {
            // Paint and glass mirror some sky.
            own = mix(own, [0.3, 0.34, 0.4], 0.06);
        }
        mix(light, own, share)
    }
}

fn axis_slope(prop: &Prop, grade: f32) -> Spot {
    prop.slab.axis.right() * grade
}
