//! Commands of the terminal as a user calls them, each in a file.

mod classes;
mod closed_pipe;
mod columns;
mod compare;
mod convert;
mod detect;
mod export;
mod folder;
mod georef;
mod inspect;
mod map;
mod map_work;
mod numbers;
mod own_map;
mod plan;
mod reference_map;
mod register;
mod rehearse;
mod replay;
mod roads;
mod study;
mod study_records;
mod vehicles;
