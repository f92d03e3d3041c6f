//! Windows that mean the same thing, made one.

use super::scan::{Rectangle, Scanned};

/// Largest distance between the edges of two alike windows, as a share of their sides.
const SLACK: f64 = 0.2;

/// Windows that lie together.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WindowGroup {
    /// Their mean.
    pub rectangle: Rectangle,
    /// Number of the windows.
    pub members: usize,
    /// The greatest of their scores.
    pub score: f64,
}

/// Groups of more than `least` windows, as OpenCV's `groupRectangles` makes them with 0.2 of slack:
/// windows are alike by their edges, groups are what alikeness connects, and a small group within a
/// larger one of more members is left out.
pub fn group(windows: &[Scanned], least: usize) -> Vec<WindowGroup> {
    let mut groups: Vec<(Vec<usize>, Rectangle, f64)> = Vec::new();
    for members in connected(windows) {
        let mean = mean(windows, &members);
        let scores = members.iter().map(|&i| windows[i].score);
        let score = scores.fold(f64::NEG_INFINITY, f64::max);
        groups.push((members, mean, score));
    }
    let counted = |members: &[usize]| members.len() > least;
    let mut kept = Vec::new();
    for (i, (members, a, score)) in groups.iter().enumerate() {
        if !counted(members) {
            continue;
        }
        let n = members.len();
        let swallowed = groups.iter().enumerate().any(|(j, (others, b, _))| {
            let m = others.len();
            let round = |v: f64| v.round_ties_even() as i32;
            let (dx, dy) = (
                round(f64::from(b.width) * SLACK),
                round(f64::from(b.height) * SLACK),
            );
            j != i
                && counted(others)
                && a.x >= b.x - dx
                && a.y >= b.y - dy
                && a.x + a.width <= b.x + b.width + dx
                && a.y + a.height <= b.y + b.height + dy
                && (m > n.max(3) || n < 3)
        });
        if !swallowed {
            kept.push(WindowGroup {
                rectangle: *a,
                members: n,
                score: *score,
            });
        }
    }
    kept
}

fn are_alike(a: &Rectangle, b: &Rectangle) -> bool {
    let least = f64::from(a.width.min(b.width) + a.height.min(b.height));
    let delta = SLACK * least * 0.5;
    let near = |a: i32, b: i32| f64::from((a - b).abs()) <= delta;
    near(a.x, b.x)
        && near(a.y, b.y)
        && near(a.x + a.width, b.x + b.width)
        && near(a.y + a.height, b.y + b.height)
}

/// Sets of windows that alikeness connects, in the order of their first members.
fn connected(windows: &[Scanned]) -> Vec<Vec<usize>> {
    let mut group_of = vec![usize::MAX; windows.len()];
    let mut groups = Vec::new();
    for first in 0..windows.len() {
        if group_of[first] != usize::MAX {
            continue;
        }
        let number = groups.len();
        group_of[first] = number;
        let mut members = vec![first];
        let mut next = 0;
        while let Some(&member) = members.get(next) {
            next += 1;
            for other in 0..windows.len() {
                let (a, b) = (&windows[member].rectangle, &windows[other].rectangle);
                if group_of[other] == usize::MAX && are_alike(a, b) {
                    group_of[other] = number;
                    members.push(other);
                }
            }
        }
        groups.push(members);
    }
    groups
}

fn mean(windows: &[Scanned], members: &[usize]) -> Rectangle {
    let share = 1.0 / members.len() as f32;
    let mean = |of: fn(&Rectangle) -> i32| {
        let sum: i32 = members.iter().map(|&i| of(&windows[i].rectangle)).sum();
        (sum as f32 * share).round_ties_even() as i32
    };
    Rectangle {
        x: mean(|r| r.x),
        y: mean(|r| r.y),
        width: mean(|r| r.width),
        height: mean(|r| r.height),
    }
}
