//! Plain loops, which the compiler may make vectors of.

use crate::road::network::tensor::ChannelGrid;

/// See [`super::matrix_product`].
pub(super) fn matrix_product(
    input: &[f32],
    matrix: &[f32],
    offsets: &[f32],
    least: f32,
    out: &mut [f32],
) {
    let outputs = offsets.len();
    let inputs = matrix.len() / outputs;
    let pixels = input
        .chunks_exact(inputs)
        .zip(out.chunks_exact_mut(outputs));
    for (values, sums) in pixels {
        sums.copy_from_slice(offsets);
        for (row, value) in matrix.chunks_exact(outputs).zip(values) {
            let blocks = sums
                .as_chunks_mut::<8>()
                .0
                .iter_mut()
                .zip(row.as_chunks::<8>().0);
            for (sums, weights) in blocks {
                for i in 0..8 {
                    sums[i] += value * weights[i];
                }
            }
        }
        for sum in sums {
            *sum = sum.max(least);
        }
    }
}

/// See [`super::depthwise_row`].
pub(super) fn depthwise_row(
    input: &ChannelGrid,
    row: usize,
    taps: &[f32],
    offsets: &[f32],
    apart: usize,
    least: f32,
    line: &mut [f32],
) {
    let channels = input.channels;
    let sources = input.three_rows(row, apart);
    for (x, sums) in line.chunks_exact_mut(channels).enumerate() {
        sums.copy_from_slice(offsets);
        for (source, taps) in sources.iter().zip(taps.chunks_exact(3 * channels)) {
            for (i, weights) in taps.chunks_exact(channels).enumerate() {
                let from = (x + i * apart).checked_sub(apart);
                let values =
                    from.and_then(|from| source.get(from * channels..(from + 1) * channels));
                for ((sum, weight), value) in
                    sums.iter_mut().zip(weights).zip(values.unwrap_or_default())
                {
                    *sum += weight * value;
                }
            }
        }
        for sum in sums {
            *sum = sum.max(least);
        }
    }
}
