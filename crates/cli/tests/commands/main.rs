//! One file for each command of the terminal, or for what all of them keep.

mod closed_pipe;
mod columns;
mod convert;
mod detect;
mod folder;
mod georef;
mod map;
mod own_map;
mod plan;
mod register;
mod vehicles;
