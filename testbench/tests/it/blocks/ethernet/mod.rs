//! Tests of the blocks in `hdl/src/ethernet`.

mod byte_crc;
mod mac_in;
mod mac_out;
mod mdio_writer;
mod ones_sum;
mod rgmii_in;
mod rgmii_out;
mod udp_port;
