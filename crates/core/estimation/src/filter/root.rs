//! Square roots of covariances: factorisation and triangularisation.
//!
//! Everything here is exact in real arithmetic. A zero pivot is a direction without uncertainty
//! and stays one; nothing is ever added to make a factorisation succeed.

use nalgebra::allocator::Allocator;
use nalgebra::{Const, DefaultAllocator, Dim, OMatrix, OVector, SMatrix};

use super::FilterError;

/// Relative size below which a pivot is rounding error of zero, per component.
const ROUNDING: f64 = 32.0 * f64::EPSILON;
/// Relative asymmetry that is taken for rounding of the caller.
const ASYMMETRY: f64 = 1e-9;

/// Lower triangular L with L Lᵀ = `matrix`, for symmetric positive definite `matrix`.
pub(super) fn cholesky_root<D: Dim>(
    matrix: &OMatrix<f64, D, D>,
    name: &'static str,
) -> Result<OMatrix<f64, D, D>, FilterError>
where
    DefaultAllocator: Allocator<D, D>,
{
    factor(matrix, name, false)
}

/// Lower triangular L with L Lᵀ = `matrix`, for symmetric positive semidefinite `matrix`.
///
/// Where a pivot is zero to rounding, its column of L is zero: for a semidefinite matrix the rest
/// of that column is zero too, because |mᵢₖ|² ≤ mᵢᵢ mₖₖ; a larger rest is reported.
pub(super) fn semidefinite_root<D: Dim>(
    matrix: &OMatrix<f64, D, D>,
    name: &'static str,
) -> Result<OMatrix<f64, D, D>, FilterError>
where
    DefaultAllocator: Allocator<D, D>,
{
    factor(matrix, name, true)
}

#[inline]
fn factor<D: Dim>(
    matrix: &OMatrix<f64, D, D>,
    name: &'static str,
    zero_pivots: bool,
) -> Result<OMatrix<f64, D, D>, FilterError>
where
    DefaultAllocator: Allocator<D, D>,
{
    let (rows, columns) = matrix.shape_generic();
    let n = rows.value();
    let mut root = OMatrix::<f64, D, D>::zeros_generic(rows, columns);
    for k in 0..n {
        let diagonal = matrix[(k, k)];
        let mut pivot = diagonal;
        for j in 0..k {
            pivot -= root[(k, j)] * root[(k, j)];
        }
        let rounding = ROUNDING * n as f64 * diagonal.abs();
        if !pivot.is_finite() {
            return Err(FilterError::NotFinite { place: name });
        }
        if pivot < -rounding || (pivot <= rounding && !zero_pivots) {
            return Err(FilterError::NotPositive {
                matrix: name,
                component: k,
                pivot,
            });
        }
        let zero = pivot <= rounding;
        let diagonal_root = if zero { 0.0 } else { pivot.sqrt() };
        let inverse = if zero { 0.0 } else { 1.0 / diagonal_root };
        root[(k, k)] = diagonal_root;
        for i in k + 1..n {
            let below = matrix[(i, k)];
            let scale = (matrix[(i, i)] * diagonal).abs().sqrt();
            if (below - matrix[(k, i)]).abs() > ASYMMETRY * scale {
                return Err(FilterError::NotSymmetric {
                    matrix: name,
                    row: i,
                    column: k,
                });
            }
            let mut rest = below;
            for j in 0..k {
                rest -= root[(i, j)] * root[(k, j)];
            }
            if zero && rest.abs() > ASYMMETRY * scale {
                return Err(FilterError::NotPositive {
                    matrix: name,
                    component: i,
                    pivot: -rest.abs(),
                });
            }
            root[(i, k)] = rest * inverse;
        }
    }
    Ok(root)
}

/// L⁻¹ `right` for lower triangular L without zero pivots.
#[inline]
pub(super) fn solve_lower<D: Dim, C: Dim>(
    root: &OMatrix<f64, D, D>,
    mut right: OMatrix<f64, D, C>,
) -> OMatrix<f64, D, C>
where
    DefaultAllocator: Allocator<D, D> + Allocator<D, C>,
{
    let n = root.nrows();
    for c in 0..right.ncols() {
        for i in 0..n {
            let mut value = right[(i, c)];
            for j in 0..i {
                value -= root[(i, j)] * right[(j, c)];
            }
            right[(i, c)] = value / root[(i, i)];
        }
    }
    right
}

/// A solution of L x = `right`, for `right` in the range of L, where pivots of L may be zero with all of
/// their column; x is zero there.
pub(super) fn solve_semidefinite<D: Dim, C: Dim>(
    root: &OMatrix<f64, D, D>,
    mut right: OMatrix<f64, D, C>,
) -> OMatrix<f64, D, C>
where
    DefaultAllocator: Allocator<D, D> + Allocator<D, C>,
{
    for c in 0..right.ncols() {
        for i in 0..root.nrows() {
            let mut value = right[(i, c)];
            for j in 0..i {
                value -= root[(i, j)] * right[(j, c)];
            }
            let pivot = root[(i, i)];
            right[(i, c)] = if pivot > 0.0 { value / pivot } else { 0.0 };
        }
    }
    right
}

/// A solution of Lᵀ x = `right`, as [`solve_semidefinite`] for L.
pub(super) fn solve_semidefinite_transposed<D: Dim, C: Dim>(
    root: &OMatrix<f64, D, D>,
    mut right: OMatrix<f64, D, C>,
) -> OMatrix<f64, D, C>
where
    DefaultAllocator: Allocator<D, D> + Allocator<D, C>,
{
    let n = root.nrows();
    for c in 0..right.ncols() {
        for i in (0..n).rev() {
            let mut value = right[(i, c)];
            for j in i + 1..n {
                value -= root[(j, i)] * right[(j, c)];
            }
            let pivot = root[(i, i)];
            right[(i, c)] = if pivot > 0.0 { value / pivot } else { 0.0 };
        }
    }
    right
}

/// L⁻ᵀ `right` for lower triangular L without zero pivots.
#[inline]
pub(super) fn solve_upper<D: Dim, C: Dim>(
    root: &OMatrix<f64, D, D>,
    mut right: OMatrix<f64, D, C>,
) -> OMatrix<f64, D, C>
where
    DefaultAllocator: Allocator<D, D> + Allocator<D, C>,
{
    let n = root.nrows();
    for c in 0..right.ncols() {
        for i in (0..n).rev() {
            let mut value = right[(i, c)];
            for j in i + 1..n {
                value -= root[(j, i)] * right[(j, c)];
            }
            right[(i, c)] = value / root[(i, i)];
        }
    }
    right
}

/// L Lᵀ, symmetric to the bit.
#[inline]
pub(super) fn square<D: Dim>(root: &OMatrix<f64, D, D>) -> OMatrix<f64, D, D>
where
    DefaultAllocator: Allocator<D, D>,
{
    let (rows, columns) = root.shape_generic();
    let mut product = OMatrix::<f64, D, D>::zeros_generic(rows, columns);
    for j in 0..rows.value() {
        for i in j..rows.value() {
            let mut sum = 0.0;
            for k in 0..=j {
                sum += root[(i, k)] * root[(j, k)];
            }
            product[(i, j)] = sum;
            product[(j, i)] = sum;
        }
    }
    product
}

/// The wide matrix A = [blocks | tail] whose square A Aᵀ is wanted in triangular form.
///
/// Row `i` of A is `blocks[i]` (B blocks of N columns) followed by column `i` of `tail`.
pub(super) struct WideRoot<const N: usize, const B: usize, C: Dim>
where
    DefaultAllocator: Allocator<C, Const<N>>,
{
    /// Row, block, column in the block.
    pub(super) blocks: [[[f64; N]; B]; N],
    /// The last columns of A, transposed.
    pub(super) tail: OMatrix<f64, C, Const<N>>,
}

impl<const N: usize, const B: usize, C: Dim> WideRoot<N, B, C>
where
    DefaultAllocator: Allocator<C, Const<N>> + Allocator<C>,
{
    /// Lower triangular L with L Lᵀ = A Aᵀ and a diagonal that is not negative.
    ///
    /// A Householder reflection per row, from the right: A Q = [L 0]. Nothing is squared and
    /// nothing subtracted, so that L keeps all digits also where A Aᵀ would lose half of them.
    #[inline]
    pub(super) fn triangularise(mut self) -> SMatrix<f64, N, N> {
        let mut lower = SMatrix::<f64, N, N>::zeros();
        for k in 0..N {
            let mut normal = self.blocks[k];
            // The first k columns already hold L.
            for value in normal.as_flattened_mut().iter_mut().take(k) {
                *value = 0.0;
            }
            let tail_normal: OVector<f64, C> = self.tail.column(k).into_owned();
            let squared = lanes(&normal, &normal) + tail_normal.norm_squared();
            if squared < f64::MIN_POSITIVE {
                // A direction without uncertainty: nothing to reflect, the rows below stay.
                for i in k + 1..N {
                    lower[(i, k)] = self.blocks[i][0][k];
                }
                continue;
            }
            let norm = squared.sqrt();
            let head = normal[0][k];
            // The reflection goes to -sign(head) norm, so that the subtraction cannot cancel.
            let sign = if head > 0.0 { -1.0 } else { 1.0 };
            normal[0][k] = head - sign * norm;
            let scale = 1.0 / (squared - sign * norm * head);
            lower[(k, k)] = norm;
            for i in k + 1..N {
                let row = &mut self.blocks[i];
                let mut tail = self.tail.column_mut(i);
                let projection = (lanes(&normal, row) + tail.dot(&tail_normal)) * scale;
                for (block, n) in row.iter_mut().zip(&normal) {
                    for (value, n) in block.iter_mut().zip(n) {
                        *value -= projection * n;
                    }
                }
                tail.axpy(-projection, &tail_normal, 1.0);
                lower[(i, k)] = row[0][k] * sign;
            }
        }
        lower
    }
}

/// Dot product of two rows, summed in N lanes so that it vectorises.
#[inline]
fn lanes<const N: usize, const B: usize>(a: &[[f64; N]; B], b: &[[f64; N]; B]) -> f64 {
    let mut sums = [0.0; N];
    for (a, b) in a.iter().zip(b) {
        for ((sum, a), b) in sums.iter_mut().zip(a).zip(b) {
            *sum += a * b;
        }
    }
    sums.iter().sum()
}
