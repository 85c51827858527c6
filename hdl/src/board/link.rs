//! The link between the core of a board and its host: which files of the board's folder belong to it, and its
//! parameters.

use super::error::BoardError;
use super::pll::MHZ;
use super::port::Rgmii;
use super::Board;
use crate::export;
use crate::top::UdpPins;
use crate::udp::UdpParameters;
use incircle_protocol::Config;

/// Bits of the count of clocks for which the PHY is held in reset: 11.6 ms at 180 MHz, and longer at slower clocks.
const PHY_WAIT_BITS: u32 = 21;

/// The link that joins the core of a board to its host.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BoardLink {
    /// The serial line, which every board has.
    Serial,
    /// The Ethernet port, with the addresses of the device. The clock in the parameters is replaced by the clock for
    /// which the board is made.
    Udp(UdpParameters),
}

impl BoardLink {
    /// The part that the names of files have for this link, such as `-udp` in `top-udp.v`.
    pub fn suffix(self) -> &'static str {
        match self {
            Self::Serial => "",
            Self::Udp(_) => "-udp",
        }
    }

    /// Name of the module in the file `top.v`, or `top-udp.v`, of a board.
    pub fn top(self, board: &Board) -> String {
        board.top.to_owned() + &self.suffix().replace('-', "_")
    }

    /// The clock in MHz of a core of the board behind this link, unless the user names another.
    ///
    /// # Errors
    /// If the board has no port for this link.
    pub fn usual_mhz(self, board: &Board, config: Config) -> Result<u32, BoardError> {
        Ok(match self {
            Self::Serial => board.core(config).usual_mhz,
            Self::Udp(_) => board.port()?.usual_mhz,
        })
    }

    /// The name that the clock of the PHY has at its pin, if the link has such a clock.
    pub(super) fn port_clock(self) -> Option<&'static str> {
        matches!(self, Self::Udp(_)).then_some("rgmii_rx_clock")
    }

    /// The parameters of the device at a clock of the core.
    pub(super) fn at(self, clock_mhz: u32) -> Self {
        match self {
            Self::Serial => Self::Serial,
            Self::Udp(mut parameters) => {
                parameters.link.clock_hz = clock_mhz * MHZ;
                Self::Udp(parameters)
            }
        }
    }

    /// The Verilog macros that the top of a board needs for this link, beside that of the PLL, as arguments of yosys.
    pub(super) fn defines(self) -> String {
        match self {
            Self::Serial => String::new(),
            Self::Udp(_) => format!(" -D BOARD_PHY_WAIT={PHY_WAIT_BITS}"),
        }
    }

    /// The file of `constraints/ecp5` that the top of a board needs for this link, beside that of the PLL.
    pub(super) fn source(self) -> Option<&'static str> {
        matches!(self, Self::Udp(_)).then_some("phy_start.v")
    }

    /// The Verilog of the device that the top of a board holds, with runs or without.
    ///
    /// # Errors
    /// If a parameter is out of range, or the board has no port for this link.
    pub(super) fn device(
        self,
        board: &Board,
        config: Config,
        has_runs: bool,
        clock_mhz: u32,
    ) -> Result<String, BoardError> {
        match self.at(clock_mhz) {
            Self::Serial if has_runs => Ok(export::serial_top_with_runs(config, board.link(clock_mhz), false)?),
            Self::Serial => Ok(export::serial_top(config, board.link(clock_mhz), false)?),
            Self::Udp(parameters) => {
                let Rgmii { delay, clock_delay, .. } = board.port()?;
                let pins = UdpPins::Rgmii { delay, clock_delay };
                let device = if has_runs { export::udp_top_with_runs } else { export::udp_top };
                Ok(device(config, parameters, pins, false)?)
            }
        }
    }
}

impl Board {
    /// The Ethernet port of the board.
    ///
    /// # Errors
    /// If the board has none.
    pub fn port(&self) -> Result<Rgmii, BoardError> {
        self.ethernet.ok_or(BoardError::NoPort { board: self.name })
    }
}
