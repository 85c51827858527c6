//! Runs `RegisterPort` in Rust and in Verilog beside plain code: all three must agree in every clock.

use crate::rig::stepper::{named_ports, Cell, Stepper, Wave};
use incircle_hdl::stream::RegisterPort;
use incircle_testkit::SplitMix64;

named_ports!([] RegisterPort,
    [
        reset, s_axi.awvalid, s_axi.awaddr, s_axi.wvalid, s_axi.wdata, s_axi.wstrb, s_axi.bready, s_axi.arvalid,
        s_axi.araddr, s_axi.rready, write_is_known, read_data, read_is_known
    ],
    [
        s_axi.awready, s_axi.wready, s_axi.bvalid, s_axi.bresp, s_axi.arready, s_axi.rvalid, s_axi.rdata, s_axi.rresp,
        write_enable, write_address, write_data, write_bytes, read_enable, read_address
    ],
    clock
);

/// Drives the offer of a master on one channel; an offer stays until it is taken.
fn channel<T: Copy>(offered: &mut Option<T>, ready: bool, one_in: u64, random: &mut SplitMix64, new: T) {
    if ready {
        *offered = None;
    }
    if offered.is_none() && random.below(one_in) == 0 {
        *offered = Some(new);
    }
}

#[test]
fn the_port_follows_the_rules_of_axi() {
    let mut random = SplitMix64::new(3);
    let mut block = Stepper::new("stream_register_port", RegisterPort::default(), 1);
    let (mut aw, mut w, mut ar): (Option<u64>, Option<(u64, u64)>, Option<u64>) = (None, None, None);
    // Words taken and not written, written and not answered; the same for reads.
    let (mut addresses, mut words, mut reads): (Vec<u64>, Vec<(u64, u64)>, Vec<u64>) = Default::default();
    let (mut b, mut r): (Option<u64>, Option<(u64, u64)>) = (None, None);
    let (mut writes_done, mut reads_done) = (0, 0);
    for clock in 0..20_000 {
        let reset = clock == 0 || random.below(2500) == 0;
        let pace = [1, 6][clock / 1000 % 2];
        let (b_ready, r_ready) = (random.below(pace) == 0, random.below(pace) == 0);
        let (write_is_known, read_is_known, value) =
            (random.below(2) == 0, random.below(2) == 0, random.below(1 << 32));
        block.set("reset", reset);
        for (port, bit) in [
            ("s_axi_awvalid", aw.is_some()),
            ("s_axi_wvalid", w.is_some()),
            ("s_axi_arvalid", ar.is_some()),
            ("write_is_known", write_is_known),
            ("read_is_known", read_is_known),
        ] {
            block.set(port, bit);
        }
        let (data, bytes) = w.unwrap_or((5, 5));
        for (port, number) in [
            ("s_axi_awaddr", aw.unwrap_or(99)),
            ("s_axi_wdata", data),
            ("s_axi_wstrb", bytes),
            ("s_axi_araddr", ar.unwrap_or(77)),
            ("read_data", value),
        ] {
            block.set(port, number);
        }
        // No output follows a `ready` of the master within the clock.
        for (b_ready, r_ready) in [(!b_ready, !r_ready), (b_ready, r_ready)] {
            block.set("s_axi_bready", b_ready);
            block.set("s_axi_rready", r_ready);
            block.settle();
            if clock > 0 {
                block.expect("s_axi_bvalid", b.is_some());
                block.expect("s_axi_rvalid", r.is_some());
                block.expect("s_axi_awready", addresses.is_empty());
                block.expect("s_axi_wready", words.is_empty());
                block.expect("s_axi_arready", reads.is_empty());
            }
        }
        if clock == 0 {
            block.edge();
            continue;
        }
        if let Some(response) = b {
            block.expect("s_axi_bresp", response);
        }
        if let Some((data, response)) = r {
            block.expect("s_axi_rdata", data);
            block.expect("s_axi_rresp", response);
        }
        let writes = !addresses.is_empty() && !words.is_empty() && b.is_none();
        block.expect("write_enable", writes);
        if writes {
            block.expect("write_address", addresses[0]);
            block.expect("write_data", words[0].0);
            block.expect("write_bytes", words[0].1);
        }
        let reads_now = !reads.is_empty() && r.is_none();
        block.expect("read_enable", reads_now);
        if reads_now {
            block.expect("read_address", reads[0]);
        }
        block.edge();
        let taken = [addresses.is_empty(), words.is_empty(), reads.is_empty()];
        if b.is_some() && b_ready {
            b = None;
            writes_done += 1;
        }
        if r.is_some() && r_ready {
            r = None;
            reads_done += 1;
        }
        if writes {
            addresses.clear();
            words.clear();
            b = Some(if write_is_known { 0 } else { 2 });
        }
        if reads_now {
            reads.clear();
            r = Some((value, if read_is_known { 0 } else { 2 }));
        }
        if taken[0] {
            addresses.extend(aw);
        }
        if taken[1] {
            words.extend(w);
        }
        if taken[2] {
            reads.extend(ar);
        }
        let new = random.below(1 << 12);
        channel(&mut aw, taken[0], pace, &mut random, new);
        let new = (random.below(1 << 32), random.below(16));
        channel(&mut w, taken[1], pace, &mut random, new);
        let new = random.below(1 << 12);
        channel(&mut ar, taken[2], pace, &mut random, new);
        if reset {
            (addresses, words, reads, b, r) = Default::default();
        }
    }
    assert!(writes_done > 1500 && reads_done > 2000, "{writes_done} writes, {reads_done} reads");
}

#[test]
fn the_port_shows_the_wave_of_its_header() {
    let mut block = Stepper::new("stream_register_port", RegisterPort::default(), 1);
    for (port, bit) in [("reset", true), ("write_is_known", true), ("read_is_known", true), ("s_axi_rready", true)] {
        block.set(port, bit);
    }
    block.set("read_data", 5u32);
    block.settle();
    block.edge();
    block.set("reset", false);
    let mut wave = Wave::default();
    for clock in 0..9 {
        for (port, at) in [("s_axi_wvalid", 1), ("s_axi_awvalid", 2), ("s_axi_arvalid", 2), ("s_axi_bready", 5)] {
            block.set(port, clock == at);
        }
        block.settle();
        let bit = |port: &str| Cell::Bit(block.is(port));
        wave.take(&[
            ("awvalid", Cell::Bit(clock == 2)),
            ("awready", bit("s_axi_awready")),
            ("wvalid", Cell::Bit(clock == 1)),
            ("wready", bit("s_axi_wready")),
            ("write", bit("write_enable")),
            ("bvalid", bit("s_axi_bvalid")),
            ("bready", Cell::Bit(clock == 5)),
            ("arvalid", Cell::Bit(clock == 2)),
            ("read", bit("read_enable")),
            ("rvalid", bit("s_axi_rvalid")),
            ("rdata", if block.is("s_axi_rvalid") { Cell::Number(block.get("s_axi_rdata")) } else { Cell::Open }),
        ]);
        block.edge();
    }
    wave.assert_drawn_in("register_port");
}
