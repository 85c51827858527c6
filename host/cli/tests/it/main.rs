//! The tests of the command, in one program. Modules mirror the sources; `contract` tests all that scripts rely on.

mod common;

mod contract;
mod output;

mod backend {
    mod clock;
    mod fleet;
    mod pcie;
    mod serial;
    #[cfg(feature = "sim")]
    mod sim;
    #[cfg(feature = "sim")]
    mod sim_living;
    #[cfg(feature = "sim")]
    mod udp_living;
}

mod commands {
    mod bench;
    mod constraints;
    mod generate;
    mod generate_numbers;
    mod interpolate;
    mod lloyd;
    mod man;
    mod replay;
    mod snap;
    mod tile;
    mod triangulate_large;
    mod verify_large;
    mod voronoi;
    mod wrong_plans;
}

mod formats {
    mod arrays;
    mod bad_input;
    mod bad_structure;
    mod files;
    mod hostile;
    pub mod lidar;
    mod lidar_hostile;
    mod memory;
    mod packed;
}
