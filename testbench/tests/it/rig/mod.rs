//! Helpers that several tests share.

pub mod answer_words;
pub mod asked;
pub mod attempt_state;
pub mod block_ports;
pub mod cavity_growth;
pub mod cells;
pub mod command_reference;
pub mod drawing;
pub mod ethernet_frames;
pub mod flip_mesh;
pub mod head_bytes;
pub mod ids;
pub mod lockstep;
pub mod memories;
pub mod nearest;
pub mod random_rings;
pub mod record_beats;
pub mod record_count;
pub mod serial_host;
pub mod serial_rig;
pub mod standing_mesh;
pub mod stepper;
pub mod stream_bits;
pub mod stream_rig;
pub mod visit_model;
pub mod visit_points;
