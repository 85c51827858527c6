//! Tests the device's interrupts: none is lost, and none comes that is masked or not asked for.

use incircle_testbench::card::vfio::numbers::{block, channel, config, interrupts, status, ENTRY_CONTROL};
use incircle_testbench::card::vfio::{Descriptor, Transfers, VfioDriver, Way};

use super::rig::{card, until, within, LIMIT};

/// Number of runs whose ends are counted.
const RUNS: u32 = 300;

/// Offsets in the configuration space and in the second window.
const MESSAGES: u64 = config::MESSAGES_AT as u64;
const ENABLED: u32 = (config::MESSAGES_ENABLED as u32) << 16;
const MASKED: u32 = (config::MESSAGES_MASKED as u32) << 16;
const CHANNEL_MASK: u32 = block::INTERRUPTS + interrupts::CHANNEL_MASK;
const MASK: u32 = block::CHANNEL[0] + channel::MASK;

/// Starts a run of descriptors with a beat of padding each.
fn begin(transfers: &Transfers, descriptors: usize, completes: bool) {
    let source = transfers.memory().address() + 4096;
    let all: Vec<_> = (1..=descriptors)
        .map(|place| Descriptor { stops: place == descriptors, completes, length: 8, source, ..Descriptor::default() })
        .collect();
    transfers.describe(&all).unwrap();
    transfers.begin(transfers.memory().address());
}

#[test]
fn the_end_of_every_run_is_told() {
    within(|| {
        let card = card(64);
        let driver = VfioDriver::open(card.path()).unwrap();
        let transfers = Transfers::new(driver.link(), Way::ToCard, LIMIT).unwrap();
        for run in 0..RUNS {
            // A message may come for each descriptor, and one must come for the last.
            let (descriptors, completes) = (1 + run as usize % 16, run % 2 == 0);
            begin(&transfers, descriptors, completes);
            let bits = status::STOPPED | if completes { status::COMPLETED } else { 0 };
            assert_eq!(transfers.wait().unwrap(), bits, "run {run}");
            let completed = driver.link().dma(transfers.register(channel::COMPLETED));
            assert_eq!(completed as usize, descriptors, "run {run}");
            transfers.end();
        }
        assert_eq!(driver.untold(), 0);
        assert!(!transfers.was_told(), "there are more messages than runs");
    });
}

/// Checks that a run sends no message under `mask`, and exactly one as soon as `unmask` is called.
fn is_held_back(what: &str, mask: impl Fn(&VfioDriver), unmask: impl Fn(&VfioDriver)) {
    let card = card(64);
    let driver = VfioDriver::open(card.path()).unwrap();
    let transfers = Transfers::new(driver.link(), Way::ToCard, LIMIT).unwrap();
    for run in 0..3 {
        mask(&driver);
        begin(&transfers, 1, true);
        until("the run ends", || driver.link().dma(transfers.register(channel::COMPLETED)) == 1);
        assert!(!transfers.was_told(), "{what}, run {run}: masked");
        unmask(&driver);
        assert!(transfers.was_told(), "{what}, run {run}: lost");
        assert!(!transfers.was_told(), "{what}, run {run}: twice");
        assert_eq!(transfers.wait().unwrap(), status::STOPPED | status::COMPLETED);
        transfers.end();
    }
}

#[test]
fn what_is_masked_is_told_when_that_ends() {
    within(|| {
        let set = |offset: u32, value: u32| move |driver: &VfioDriver| driver.link().set_dma(offset, value);
        let config = |value: u32| move |driver: &VfioDriver| driver.set_config(MESSAGES, value);
        is_held_back("the channel's mask", set(MASK, 0), set(MASK, status::ALL));
        is_held_back("the mask of channels", set(CHANNEL_MASK, 2), set(CHANNEL_MASK, 3));
        let entry = block::MESSAGE_TABLE + ENTRY_CONTROL;
        is_held_back("the message's mask", set(entry, 1), set(entry, 0));
        is_held_back("the mask of messages", config(ENABLED | MASKED), config(ENABLED));
        is_held_back("messages", config(0), config(ENABLED));
        is_held_back("the socket's mask", |driver| driver.mask(true).unwrap(), |driver| driver.mask(false).unwrap());
    });
}

#[test]
fn what_waits_for_its_mask_is_pending() {
    within(|| {
        let card = card(64);
        let driver = VfioDriver::open(card.path()).unwrap();
        let transfers = Transfers::new(driver.link(), Way::ToCard, LIMIT).unwrap();
        let link = driver.link();
        // The channel gets another message, which nobody has unmasked or given an event.
        link.set_dma(block::INTERRUPTS + interrupts::CHANNEL_VECTORS, 0x0105);
        begin(&transfers, 1, true);
        until("it is pending", || link.dma(block::PENDING) == 1 << 5);
        assert_eq!(link.dma(block::INTERRUPTS + interrupts::CHANNEL_REQUEST), 1);
        assert_eq!(link.dma(block::INTERRUPTS + interrupts::CHANNEL_PENDING), 1);
        link.set_dma(block::INTERRUPTS + interrupts::CHANNEL_VECTORS, 0x0100);
        assert!(transfers.was_told());
        assert_eq!(link.dma(block::PENDING), 0);
    });
}

#[test]
fn what_the_control_does_not_ask_for_is_not_told() {
    within(|| {
        let card = card(64);
        let driver = VfioDriver::open(card.path()).unwrap();
        let transfers = Transfers::new(driver.link(), Way::ToCard, LIMIT).unwrap();
        let link = driver.link();
        link.set_dma(transfers.register(channel::CONTROL), 0);
        begin(&transfers, 4, true);
        until("the run ends", || link.dma(transfers.register(channel::COMPLETED)) == 4);
        assert_eq!(link.dma(transfers.register(channel::STATUS)), 0);
        assert!(!transfers.was_told());
        // A reset forgets the requests, not the events of the host.
        driver.reset().unwrap();
        assert!(!transfers.was_told());
        begin(&transfers, 1, true);
        assert_eq!(transfers.wait().unwrap(), status::STOPPED | status::COMPLETED);
        assert_eq!(driver.untold(), 0);
    });
}
