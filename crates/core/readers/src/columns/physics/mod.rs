//! Units and axes of columns judged together, by what physics says that they have to do with each other.
//!
//! The position's steps are the reference of speeds, courses and velocities; these that of attitudes; attitude that of
//! gyros and accelerometers, whose reading at rest is gravity; velocity, airspeed and heading that of the wind. What is
//! found so is told; what cannot be is asked.

mod air;
mod angles;
mod attitude;
mod axes;
mod blackbox;
mod board;
mod body_velocity;
mod evidence;
mod gimbal;
mod grid;
mod heights;
mod inertial;
mod known;
mod lean;
mod nameless;
mod place;
mod quaternion;
mod questions;
mod ros;
mod unknown;
mod velocity;

use super::ColumnMap;
use super::settle::settle;
use board::FlightColumns;
use known::Known;

pub(super) use evidence::{Hint, TableEvidence};
pub(super) use ros::is_of_ros;

/// Judges the tables of one flight, a map each, and writes into the maps what was found.
pub(super) fn judge(maps: &mut [&mut ColumnMap], evidence: &[TableEvidence]) {
    let mut board = FlightColumns::new(maps, evidence);
    let Some(grid) = board.grid() else {
        gimbal::from_below(&mut board);
        nameless::tell(&mut board);
        questions::ask(&mut board);
        return;
    };
    let mut known = Known::new(grid);
    nameless::place(&mut board);
    place::judge(&mut board, &mut known);
    unknown::place(&mut board, &known);
    nameless::heights(&mut board, &known);
    velocity::judge(&mut board, &mut known);
    heights::judge(&mut board, &mut known);
    nameless::attitude(&mut board, &known);
    attitude::judge(&mut board, &mut known);
    heights::by_pitch(&mut board, &known);
    body_velocity::judge(&mut board, &known);
    unknown::inertial(&mut board, &known);
    inertial::judge(&mut board, &mut known);
    nameless::airspeed(&mut board, &known);
    air::judge(&mut board, &known);
    gimbal::from_below(&mut board);
    // What contradicted the track may have left others alone.
    for map in board.maps.iter_mut() {
        settle(&mut map.columns);
    }
    nameless::tell(&mut board);
    questions::ask(&mut board);
}
