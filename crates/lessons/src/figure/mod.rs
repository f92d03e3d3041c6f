//! Figures as SVG: drawn by a few shapes, in the colours of the page.

mod axis;
mod clip;
mod plot;
mod svg;

pub use axis::Axis;
pub use plot::FigurePlot;
pub use svg::{STYLE, Svg, TextAnchor};
