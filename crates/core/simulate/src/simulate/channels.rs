//! Four channels at once, written out: `std::array::from_fn` and `map` stay calls for each channel where a crate is
//! optimised by itself, and took a sixth of the time of a drawn flight.

/// Four whole numbers as numbers with fractions.
#[inline]
pub(in crate::simulate) fn floats<T: Copy>([a, b, c, d]: [T; 4]) -> [f32; 4]
where
    f32: From<T>,
{
    [f32::from(a), f32::from(b), f32::from(c), f32::from(d)]
}

/// From `a` towards `b` by the share `t` of the way, channel by channel.
#[inline]
pub(in crate::simulate) fn between(a: [f32; 4], b: [f32; 4], t: f32) -> [f32; 4] {
    [
        a[0] + t * (b[0] - a[0]),
        a[1] + t * (b[1] - a[1]),
        a[2] + t * (b[2] - a[2]),
        a[3] + t * (b[3] - a[3]),
    ]
}

/// Each channel times `factor`.
#[inline]
pub(in crate::simulate) fn times(a: [f32; 4], factor: f32) -> [f32; 4] {
    [a[0] * factor, a[1] * factor, a[2] * factor, a[3] * factor]
}

/// Sum of each channel.
#[inline]
pub(in crate::simulate) fn plus(a: [f32; 4], b: [f32; 4]) -> [f32; 4] {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2], a[3] + b[3]]
}
