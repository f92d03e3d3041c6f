//! `pilotage`: the jobs of the app without a screen.
fn main() {}
