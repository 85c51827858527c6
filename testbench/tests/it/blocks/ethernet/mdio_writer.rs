//! Runs `MdioWriter` in Rust and in Verilog beside plain code: all three must agree.

use crate::rig::stepper::{named_ports, Cell, Stepper, Wave};
use incircle_blocks::PHY_WRITES;
use incircle_hdl::ethernet::MdioWriter;

named_ports!(MdioWriter, [reset], [mdc, mdio_out, mdio_drives, is_done], clock);

/// The bits of the management interface for these writes, as IEEE 802.3 lists the fields.
fn expected_bits(phy: u8) -> String {
    let writes =
        PHY_WRITES.map(|(register, value)| format!("{}0101{phy:05b}{register:05b}10{value:016b}", "1".repeat(32)));
    writes.concat()
}

#[test]
fn registers_are_written_once_after_each_reset() {
    let mut block = Stepper::new("ethernet_mdio_writer", MdioWriter::new(5, &PHY_WRITES, 7), 1);
    for _ in 0..2 {
        block.set("reset", true);
        block.settle();
        block.edge();
        block.set("reset", false);
        let start = block.clocks();
        let (mut bits, mut was_high, mut last_rise, mut last_value) = (String::new(), false, None, false);
        while bits.is_empty() || !block.is("is_done") {
            block.settle();
            let (is_high, value) = (block.is("mdc"), block.is("mdio_out"));
            if is_high && !was_high {
                assert!(block.is("mdio_drives"), "a bit that nobody drives");
                assert!(bits.is_empty() || block.clocks() - last_rise.unwrap_or(0) == 64, "the pace of mdc");
                assert!(!bits.is_empty() || block.clocks() >= start + 128, "the wait for the PHY");
                last_rise = Some(block.clocks());
                bits.push(if value { '1' } else { '0' });
            }
            // The value stays while the clock of the PHY is high.
            assert!(!(is_high && was_high) || value == last_value, "a bit that changes under a high clock");
            (was_high, last_value) = (is_high, value);
            block.edge();
        }
        assert_eq!(bits, expected_bits(5));
        block.settle();
        block.edge();
        for _ in 0..300 {
            block.settle();
            block.expect("mdc", false);
            block.expect("mdio_drives", false);
            block.expect("is_done", true);
            block.edge();
        }
    }
}

#[test]
fn wave_of_the_first_bits_behind_the_preamble() {
    let mut block = Stepper::new("ethernet_mdio_writer", MdioWriter::new(5, &PHY_WRITES, 7), 1);
    block.set("reset", true);
    block.settle();
    block.edge();
    block.set("reset", false);
    block.settle();
    while !block.is("mdc") {
        block.edge();
        block.settle();
    }
    let mut wave = Wave::default();
    // A bit has 64 clocks, and the first one has just passed its half. A column stands for 16 clocks.
    for clock in 32..64 * 37 {
        if clock >= 64 * 30 && clock % 16 == 8 {
            wave.take(&[
                ("mdc", Cell::Bit(block.is("mdc"))),
                ("mdio_out", Cell::Bit(block.is("mdio_out"))),
                ("mdio_drives", Cell::Bit(block.is("mdio_drives"))),
                ("is_done", Cell::Bit(block.is("is_done"))),
            ]);
        }
        block.edge();
        block.settle();
    }
    wave.assert_drawn_in("mdio_writer");
}
