//! The incircle core in Verilator, as a device that takes and gives words.
