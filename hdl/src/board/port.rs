//! The Ethernet port of a board.

/// Clock of the PHY in MHz, for both directions of gigabit Ethernet.
pub(super) const PORT_MHZ: u32 = 125;

/// The Ethernet port of a board, with the pins of RGMII.
///
/// PHYs and boards differ in which side delays a clock against its data. The delays are those that public files of the
/// board use, and nobody has tried them with this core.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Rgmii {
    /// Type of the PHY.
    pub phy: &'static str,
    /// The clock of the core behind this port, in MHz, unless the user names another. With a second clock and the
    /// memories of the port, a core may meet less than behind the serial line.
    pub usual_mhz: u32,
    /// Taps of 25 ps, 0 to 127, by which the FPGA delays the data from the PHY.
    pub delay: u8,
    /// Taps of 25 ps, 0 to 127, by which the FPGA delays the clock to the PHY.
    pub clock_delay: u8,
}
