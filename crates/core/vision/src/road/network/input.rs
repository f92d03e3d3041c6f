//! A picture as the network sees it.

use pilotage_raster::raster::{Raster, Rgba};

use super::tensor::ChannelGrid;

/// Channels of the input: brightness, red against green, blue against green, whether it was seen.
pub const INPUT_CHANNELS: usize = 4;

/// The picture in channels: brightness less its mean by its standard deviation over what was seen; differences of
/// colours by the sum of all three; 1 where it was seen. Padded with what is not seen to multiples of 4.
pub fn network_input(picture: &Raster<Rgba>) -> ChannelGrid {
    let (mut count, mut sum, mut squares) = (0_u32, 0.0_f64, 0.0_f64);
    for row in 0..picture.height() {
        let (mut row_sum, mut row_squares) = (0_u32, 0_u64);
        for &[red, green, blue, coverage] in picture.row(row) {
            if coverage > 0 {
                let total = u32::from(red) + u32::from(green) + u32::from(blue);
                count += 1;
                row_sum += total;
                row_squares += u64::from(total * total);
            }
        }
        sum += f64::from(row_sum);
        squares += row_squares as f64;
    }
    let mean = sum / f64::from(count.max(1));
    let spread = (squares / f64::from(count.max(1)) - mean * mean)
        .max(9.0)
        .sqrt();
    let (mean, scale) = (mean as f32, (1.0 / spread) as f32);
    let padded = |pixels: usize| pixels.next_multiple_of(4);
    let mut out = ChannelGrid::zeros(
        padded(picture.width()),
        padded(picture.height()),
        INPUT_CHANNELS,
    );
    let row_length = out.width * INPUT_CHANNELS;
    for (row, line) in (0..picture.height()).zip(out.values.chunks_exact_mut(row_length)) {
        for (place, pixel) in line.as_chunks_mut::<4>().0.iter_mut().zip(picture.row(row)) {
            let [red, green, blue, coverage] = pixel.map(f32::from);
            let total = red + green + blue;
            let seen = if coverage > 0.0 { 1.0 } else { 0.0 };
            let share = seen * 6.0 / (total + 24.0);
            *place = [
                seen * scale * (total - mean),
                share * (red - green),
                share * (blue - green),
                seen,
            ];
        }
    }
    out
}
