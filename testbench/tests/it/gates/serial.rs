//! Passes a core behind a serial link through the gate, and keeps the size of the link on an ECP5 in bounds.

use incircle_hdl::export;
use incircle_hdl::top::SERIAL_TOP_NAME;
use incircle_protocol::{Config, LinkConfig, FULL, SILENCE_MS, SMALL};
use incircle_testbench::gate::{self, Cells};

/// The links of boards.
const LINK: LinkConfig = LinkConfig { clock_hz: 125_000_000, fifo_bytes: 4_096, silence_ms: SILENCE_MS };
const FULL_LINK: LinkConfig = LinkConfig { fifo_bytes: 16_384, ..LINK };

/// Cells of the link of a small core by Yosys 0.23.
const MEASURED: Cells =
    Cells { lut4: 1174, carry: 139, distributed_ram: 0, flip_flops: 997, multipliers: 0, block_ram: 2 };

/// Largest number of look-up tables of four inputs for the link, with two for each carry cell.
const MOST_TABLES: u64 = 1500;
/// Block memories of the FIFO of a small board. The link has no other block memory.
const FIFO_MEMORIES: u64 = 2;

#[test]
fn devices_with_a_serial_link_pass_lint_and_synthesis() {
    let devices: [(Config, LinkConfig, bool); 3] =
        [(SMALL, LINK, false), (SMALL, LINK, true), (FULL, FULL_LINK, false)];
    for (config, link, with_probe) in devices {
        let passed = gate::pass(&export::serial_top(config, link, with_probe).unwrap(), SERIAL_TOP_NAME);
        assert!(passed.is_ok(), "{} with probe {with_probe}: {}", config.name, passed.unwrap_err());
    }
}

#[test]
fn a_device_with_runs_passes_lint_and_synthesis() {
    let passed = gate::pass(&export::serial_top_with_runs(SMALL, LINK, false).unwrap(), SERIAL_TOP_NAME);
    assert!(passed.is_ok(), "{}", passed.unwrap_err());
}

#[test]
fn the_link_alone_is_small() {
    let cells = gate::cell_count(&export::serial_link(SMALL, LINK, "serial_link").unwrap(), "serial_link").unwrap();
    println!("serial link on ECP5: {cells:?}");
    let tables = cells.lut4 + 2 * cells.carry + 4 * cells.distributed_ram;
    assert!(tables <= MOST_TABLES, "{tables} tables, more than {MOST_TABLES}");
    assert_eq!((cells.block_ram, cells.multipliers), (FIFO_MEMORIES, 0));
    assert_eq!(cells.check_near(&MEASURED), Ok(()));
}
