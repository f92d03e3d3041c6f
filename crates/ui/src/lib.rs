//! The views and commands of Pilotage.
