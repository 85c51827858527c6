//! The tests of the model, in one test program whose modules mirror the sources. The module `common` drives a
//! core by command words.

mod common;

mod protocol_readme;
mod runs;

mod clock {
    mod batch;
    mod by_command;
    mod defects;
    mod delete_cycles;
    mod deletion_defects;
    mod deletions;
    mod hang;
    mod move_cycles;
    mod move_defects;
    mod moves;
    mod orders;
    mod questions;
    mod read_out;
    mod view;
    mod waiting;
    mod watchdog;
}

mod living;

mod mesh {
    mod approach;
    mod changes;
    mod insertion;
}

mod serial {
    mod page;
}

mod udp {
    mod page;
}
