//! The tests of the library, in one program. Modules mirror the sources; `common` has the devices made for the tests.

mod common;

mod constrained;
mod cpu;
mod fleet;
mod hostile;
mod in_parts;
mod living;
mod numbers;
mod oracle;
mod quantize;

mod batch {
    mod engines;
    mod exclusive;
    mod jobs;
    mod meshes;
    mod middle_jobs;
}

mod transports {
    mod clock;
    mod model;
    mod older;
    mod pcie;
    mod serial {
        mod hostile;
        mod jobs;
        mod living;
        #[cfg(unix)]
        mod port;
        mod sessions;
    }
    mod udp {
        mod engines;
        mod faults;
        mod goodput;
        mod living;
        mod pace;
        mod socket;
    }
}
