//! Models of the boards' tops around a tiny device with a quick link, so that tests can drive the pins.

use std::fs;
use std::net::Ipv4Addr;

use incircle_blocks::{QUICK_LINK, QUICK_UDP_LINK};
use incircle_hdl::board::{Board, BOARDS};
use incircle_hdl::export;
use incircle_hdl::top::UdpPins;
use incircle_hdl::udp::UdpParameters;
use incircle_protocol::{TINY, UDP_PORT};

/// Name of the module around each top. The module gives all boards the same pins; a lamp is 1 when lit.
pub const NAME: &str = "board_under_test";

const PORTS: &str = "input wire clock, input wire rx, input wire button, output wire tx, output wire [2:0] lamps";

/// The Verilog inside that module, by the name of the board's top.
const INSIDE: [(&str, &str); 3] = [
    (
        "ulx3s_85f",
        "ulx3s_85f board (.clk_25mhz(clock), .ftdi_txd(rx), .ftdi_rxd(tx), .btn_fire1(button), .led(lamps));",
    ),
    (
        "colorlight_i5",
        "wire led_n;
        colorlight_i5 board (.clk_25mhz(clock), .uart_rx(rx), .uart_tx(tx), .led_n(led_n), .pmod(lamps[2:1]));
        assign lamps[0] = !led_n;",
    ),
    (
        "ecpix_5",
        "wire [2:0] dark;
        ecpix_5 board (.clk_100mhz(clock), .uart_rx(rx), .uart_tx(tx), \
         .ld5_g(dark[0]), .ld6_b(dark[1]), .ld7_r(dark[2]));
        assign lamps = ~dark;",
    ),
];

/// The ports of that module for the boards with an Ethernet port.
const NETWORK_PORTS: &str = "input wire clock, input wire phy_clock, input wire rx_ctl, input wire [3:0] rxd, \
     output wire phy_reset_n, output wire phy_mdc, output wire tx_clock, output wire tx_ctl, output wire [3:0] txd, \
     output wire [2:0] lamps";

/// The connections of the Ethernet port, which have the same names on all boards.
const ETHERNET: &str = ".phy_reset_n(phy_reset_n), .phy_mdc(phy_mdc), .rgmii_rx_clock(phy_clock), \
     .rgmii_rx_ctl(rx_ctl), .rgmii_rxd(rxd), .rgmii_tx_clock(tx_clock), .rgmii_tx_ctl(tx_ctl), .rgmii_txd(txd)";

/// The Verilog inside that module, by the name of the board's top without its ending; ETHERNET stands for the
/// connections of the port.
const NETWORK_INSIDE: [(&str, &str); 2] = [
    (
        "colorlight_i5",
        "wire led_n;
        colorlight_i5_udp board (.clk_25mhz(clock), .led_n(led_n), .pmod(lamps[2:1]), ETHERNET);
        assign lamps[0] = !led_n;",
    ),
    (
        "ecpix_5",
        "wire [2:0] dark;
        ecpix_5_udp board (.clk_100mhz(clock), .ld5_g(dark[0]), .ld6_b(dark[1]), .ld7_r(dark[2]), ETHERNET);
        assign lamps = ~dark;",
    ),
];

/// A module with the clock and the reset of a board and nothing else.
const CLOCK: &str = "module board_under_test (input wire clock, input wire asks_reset, output wire reset);
    wire through;
    clock_and_reset #(1, 25, 5) clock_and_reset (
        .board_clock(clock), .asks_reset(asks_reset), .clock(through), .reset(reset)
    );
endmodule
";

/// The tops leave pins of the PLL open.
const OPEN_PINS: &str = "/* verilator lint_off PINMISSING */\n";

/// Name and Verilog of each model; all have the root module [`NAME`].
pub fn all() -> Vec<(String, String)> {
    let read = |path: &str| fs::read_to_string(path).unwrap_or_else(|error| panic!("{path}: {error}"));
    let clock = OPEN_PINS.to_string() + &read("cells/EHXPLLL.v") + &read("../constraints/ecp5/clock.v");
    let device = export::serial_top(TINY, QUICK_LINK, false).unwrap_or_else(|error| panic!("device: {error}"));
    let mut models = vec![("board_clock".to_string(), clock.clone() + CLOCK)];
    for board in BOARDS {
        let inside = INSIDE.iter().find(|(top, _)| *top == board.top);
        let (_, inside) = inside.unwrap_or_else(|| panic!("no pins for {}: add them to build/boards.rs", board.name));
        let top = read(&format!("../constraints/{}/top.v", board.name));
        let text =
            format!("`define BOARD_PLL 1,25,5\n{clock}{top}{device}module {NAME} ({PORTS});\n{inside}\nendmodule\n");
        models.push((format!("board_{}", board.top), text));
        models.extend(board.ethernet.map(|_| behind_ethernet(&board, &clock)));
    }
    models
}

/// The model of a board whose device is behind the Ethernet port; the wait for the PHY is short.
fn behind_ethernet(board: &Board, clock: &str) -> (String, String) {
    let read = |path: &str| fs::read_to_string(path).unwrap_or_else(|error| panic!("{path}: {error}"));
    let inside = NETWORK_INSIDE.iter().find(|(top, _)| *top == board.top);
    let (_, inside) = inside.unwrap_or_else(|| panic!("no pins for {}: add them to build/boards.rs", board.name));
    let inside = inside.replace("ETHERNET", ETHERNET);
    let (link, address) = (QUICK_UDP_LINK, Ipv4Addr::new(10, 0, 7, 2));
    let parameters = UdpParameters { link, address, prefix: 24, port: UDP_PORT };
    let pins = UdpPins::Rgmii { delay: 0, clock_delay: 0 };
    let device = export::udp_top(TINY, parameters, pins, false).unwrap_or_else(|error| panic!("device: {error}"));
    let start = read("../constraints/ecp5/phy_start.v");
    let top = read(&format!("../constraints/{}/top-udp.v", board.name));
    let defines = "`define BOARD_PLL 1,25,5\n`define BOARD_PHY_WAIT 6\n";
    let text = format!("{defines}{clock}{start}{top}{device}module {NAME} ({NETWORK_PORTS});\n{inside}\nendmodule\n");
    (format!("board_{}_udp", board.top), text)
}
