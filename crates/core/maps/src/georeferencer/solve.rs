//! Least squares for the transforms.

use nalgebra::{Matrix3, Point2, SMatrix, SVector, Vector2};

use super::kind::TransformKind;

/// A pixel and its place.
type ControlPair = (Point2<f64>, Point2<f64>);

/// Most unknowns of a transform, its factor among them.
const UNKNOWNS: usize = 9;
/// A linear equation of the unknowns.
type Equation = SVector<f64, UNKNOWNS>;
/// Eigenvalues of a normal matrix below this part of the largest count as zero; they are squares.
const RANK: f64 = 1e-13;
/// Rounds of the projective fit; it settles in a few.
const ROUNDS: usize = 50;

/// The transform that minimizes the squared distances in the plane; `None` if the points do not
/// determine it.
pub(super) fn transform(pairs: &[ControlPair], kind: TransformKind) -> Option<Matrix3<f64>> {
    // Numbers around zero and of size one keep the equations well conditioned.
    let from = normalizer(pairs.iter().map(|(pixel, _)| pixel))?;
    let to = normalizer(pairs.iter().map(|(_, place)| place))?;
    let scaled: Vec<ControlPair> = pairs
        .iter()
        .map(|(pixel, place)| (from.transform_point(pixel), to.transform_point(place)))
        .collect();
    let matrix = match kind {
        TransformKind::Similarity => similarity(&scaled),
        TransformKind::Affine => affine(&scaled),
        TransformKind::Projective => projective(&scaled),
    }?;
    let mut matrix = to.try_inverse()? * matrix * from;
    // Positive before the horizon, on which side the points are.
    let side = |(pixel, _): &ControlPair| (matrix * pixel.to_homogeneous()).z > 0.0;
    let before = pairs.iter().filter(|pair| side(pair)).count();
    if before == 0 {
        matrix = -matrix;
    } else if before < pairs.len() {
        return None;
    }
    let is_sound = matrix.iter().all(|v| v.is_finite()) && matrix.determinant() != 0.0;
    is_sound.then_some(matrix)
}

/// Moves the middle of the points to zero and their mean distance from it to one.
fn normalizer<'a>(points: impl Iterator<Item = &'a Point2<f64>> + Clone) -> Option<Matrix3<f64>> {
    let count = points.clone().count() as f64;
    let middle = points.clone().fold(Vector2::zeros(), |s, p| s + p.coords) / count;
    let spread = points.map(|p| (p.coords - middle).norm()).sum::<f64>() / count;
    let scale = 1.0 / spread;
    (scale.is_finite() && scale > 0.0).then(|| {
        Matrix3::new(
            scale,
            0.0,
            -scale * middle.x,
            0.0,
            scale,
            -scale * middle.y,
            0.0,
            0.0,
            1.0,
        )
    })
}

/// x = p·column + q·row + c, y = q·column - p·row + f: rows go down where y goes up.
fn similarity(pairs: &[ControlPair]) -> Option<Matrix3<f64>> {
    let rows = pairs.iter().flat_map(|(pixel, place)| {
        [
            (equation(0, [pixel.x, pixel.y, 1.0, 0.0]), place.x),
            (equation(0, [-pixel.y, pixel.x, 0.0, 1.0]), place.y),
        ]
    });
    let s = least_squares(&rows.collect::<Vec<_>>(), 4)?;
    Some(Matrix3::new(
        s[0], s[1], s[2], s[1], -s[0], s[3], 0.0, 0.0, 1.0,
    ))
}

/// x = a·column + b·row + c, y = d·column + e·row + f.
fn affine(pairs: &[ControlPair]) -> Option<Matrix3<f64>> {
    let rows = pairs.iter().flat_map(|(pixel, place)| {
        let row = [pixel.x, pixel.y, 1.0];
        [(equation(0, row), place.x), (equation(3, row), place.y)]
    });
    let s = least_squares(&rows.collect::<Vec<_>>(), 6)?;
    Some(Matrix3::new(
        s[0], s[1], s[2], s[3], s[4], s[5], 0.0, 0.0, 1.0,
    ))
}

/// `parts` of the unknowns from number `first` on.
fn equation<const N: usize>(first: usize, parts: [f64; N]) -> Equation {
    let mut equation = Equation::zeros();
    for (i, part) in parts.into_iter().enumerate() {
        equation[first + i] = part;
    }
    equation
}

/// Solves overdetermined linear equations of the first `unknowns`; `None` if they leave something open.
fn least_squares(rows: &[(Equation, f64)], unknowns: usize) -> Option<Equation> {
    let mut normal = SMatrix::<f64, UNKNOWNS, UNKNOWNS>::zeros();
    let mut gradient = Equation::zeros();
    for (row, value) in rows {
        normal += row * row.transpose();
        gradient += row * *value;
    }
    // What is not asked for is as well known as the others are in the mean, and zero.
    let mean = normal.trace() / unknowns as f64;
    for unasked in unknowns..UNKNOWNS {
        normal[(unasked, unasked)] = mean;
    }
    let eigen = normal.symmetric_eigen();
    if eigen.eigenvalues.min() <= RANK * eigen.eigenvalues.max() {
        return None;
    }
    let along = eigen.eigenvectors.tr_mul(&gradient);
    Some(eigen.eigenvectors * along.component_div(&eigen.eigenvalues))
}

/// Direct linear transform first, then Levenberg's and Marquardt's rounds on the distances.
fn projective(pairs: &[ControlPair]) -> Option<Matrix3<f64>> {
    let mut matrix = direct(pairs)?;
    let mut error = squared_error(&matrix, pairs)?;
    let mut damping = 1e-6;
    for _ in 0..ROUNDS {
        let (normal, gradient) = equations(&matrix, pairs);
        let mut damped = normal;
        for i in 0..8 {
            damped[(i, i)] += damping * normal[(i, i)].max(1e-12);
        }
        let step = damped.lu().solve(&gradient)?;
        let next = stepped(&matrix, &step);
        match squared_error(&next, pairs) {
            Some(better) if better <= error => {
                let gained = error - better;
                (matrix, error) = (next, better);
                damping *= 0.1;
                if gained <= 1e-15 * error || step.norm() < 1e-14 {
                    break;
                }
            }
            _ => damping *= 10.0,
        }
        if damping > 1e12 {
            break;
        }
    }
    Some(matrix)
}

/// The transform from the linear equations x·(g·column + h·row + 1) = a·column + b·row + c and those
/// for y, as the eigenvector that they map nearest to zero.
fn direct(pairs: &[ControlPair]) -> Option<Matrix3<f64>> {
    let mut normal = SMatrix::<f64, UNKNOWNS, UNKNOWNS>::zeros();
    for (pixel, place) in pairs {
        let parts = [pixel.x, pixel.y, 1.0];
        for (row, value) in [(0, place.x), (3, place.y)] {
            let row = equation(row, parts) + equation(6, parts.map(|part| -value * part));
            normal += row * row.transpose();
        }
    }
    let eigen = normal.symmetric_eigen();
    let mut order: Vec<usize> = (0..9).collect();
    order.sort_by(|a, b| eigen.eigenvalues[*a].total_cmp(&eigen.eigenvalues[*b]));
    // Two directions mapped to zero leave the transform open.
    if eigen.eigenvalues[order[1]] <= RANK * eigen.eigenvalues[order[8]] {
        return None;
    }
    let h = eigen.eigenvectors.column(order[0]);
    let matrix = Matrix3::from_fn(|r, c| h[3 * r + c]);
    (matrix[(2, 2)].abs() > 1e-12).then(|| matrix / matrix[(2, 2)])
}

fn squared_error(matrix: &Matrix3<f64>, pairs: &[ControlPair]) -> Option<f64> {
    let mut sum = 0.0;
    let mut side = None;
    for (pixel, place) in pairs {
        let h = matrix * pixel.to_homogeneous();
        // All points on one side of the horizon.
        if *side.get_or_insert(h.z > 0.0) != (h.z > 0.0) {
            return None;
        }
        sum += (Vector2::new(h.x / h.z, h.y / h.z) - place.coords).norm_squared();
    }
    sum.is_finite().then_some(sum)
}

/// Normal matrix and gradient of the distances by the first eight elements, the ninth being one.
fn equations(
    matrix: &Matrix3<f64>,
    pairs: &[ControlPair],
) -> (SMatrix<f64, 8, 8>, SVector<f64, 8>) {
    let mut normal = SMatrix::zeros();
    let mut gradient = SVector::zeros();
    for (pixel, place) in pairs {
        let h = matrix * pixel.to_homogeneous();
        let (x, y) = (h.x / h.z, h.y / h.z);
        let (u, v, w) = (pixel.x / h.z, pixel.y / h.z, 1.0 / h.z);
        let by_x = SVector::from([u, v, w, 0.0, 0.0, 0.0, -x * u, -x * v]);
        let by_y = SVector::from([0.0, 0.0, 0.0, u, v, w, -y * u, -y * v]);
        normal += by_x * by_x.transpose() + by_y * by_y.transpose();
        gradient += by_x * (place.x - x) + by_y * (place.y - y);
    }
    (normal, gradient)
}

fn stepped(matrix: &Matrix3<f64>, step: &SVector<f64, 8>) -> Matrix3<f64> {
    Matrix3::from_fn(|r, c| matrix[(r, c)] + step.get(3 * r + c).copied().unwrap_or(0.0))
}
