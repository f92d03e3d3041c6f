//! Places of workers: a role and a program each.

use super::Program;
use super::order::WorkerRole;

/// Number of roles of workers.
pub const ROLES: usize = WorkerRole::ALL.len();
/// Places of workers: each role may be filled twice, with the small program and with the whole one.
pub const PLACES: usize = ROLES * Program::ALL.len();

/// The place of a role in a program.
pub fn place(role: usize, program: Program) -> usize {
    role + ROLES * program as usize
}

/// The role of a place.
pub fn role_at(place: usize) -> usize {
    place % ROLES
}

/// The program of a place.
pub fn program_at(place: usize) -> Program {
    Program::ALL[place / ROLES]
}
