//! Flights, simulated and recorded, through reading, filter and navigator together.

mod airplane_logs;
mod brighton_flight;
mod dead_reckoning;
mod flights_as_logs;
mod generic_landmarks;
mod gps_wind;
mod indoor_hall;
mod outage_with_landmarks;
mod recovery;
