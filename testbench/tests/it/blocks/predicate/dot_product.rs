//! `DotProduct`: Rust, Verilog and plain integer arithmetic agree clock by clock.

use crate::rig::cosimulation::named_ports;
use incircle_hdl::predicate::DotProduct;

named_ports!([] DotProduct, [a_x, a_y, b_x, b_y], [product], clock);
