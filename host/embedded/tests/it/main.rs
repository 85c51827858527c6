//! Tests of the driver against a simulated board, on a line in virtual time.

mod chatter;
mod errors;
mod faults;
mod jobs;
mod lies;
mod rates;
mod rig;
mod sources;
