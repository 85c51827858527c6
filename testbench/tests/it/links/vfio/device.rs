//! Tests the device register by register: its identity, the answers of its windows, and the
//! memory that it may not reach.

use std::io::{Read, Write};

use incircle_protocol::{command_word, Opcode, StreamRegister, MAGIC, SMALL, STREAM_VERSION};
use incircle_sim::pcie::Beats;
use incircle_testbench::card::vfio::numbers::{block, channel, config, status, ALL_ONES};
use incircle_testbench::card::vfio::{Answers, Commands, Descriptor, DmaMemory, Transfers, VfioDriver, Way};
use incircle_testbench::link::{is_one_mesh, random_points};

use super::rig::{card, model, opened, triangulate, until, within, LIMIT};

/// Bytes of the answer to a `Hello`: nine words in beats of 64 bits.
const IDENTITY: usize = 40;

fn channels(driver: &VfioDriver) -> (Transfers, Transfers) {
    let new = |way| Transfers::new(driver.link(), way, LIMIT).unwrap();
    (new(Way::ToCard), new(Way::ToHost))
}

fn hello() -> [u8; 8] {
    u64::from(command_word(Opcode::Hello)).to_le_bytes()
}

/// Checks that the device works: it answers a `Hello` and does a job.
fn works(driver: &VfioDriver) {
    let (commands, answers) = channels(driver);
    assert_eq!(Commands(commands).write(&hello()).unwrap(), 8);
    let mut bytes = [0; 4096];
    assert_eq!(Answers(answers).read(&mut bytes).unwrap(), IDENTITY);
    assert_eq!(bytes[8..12], MAGIC.to_le_bytes());
    let points = random_points(200, 1);
    let mesh = triangulate(&mut opened(driver.files(LIMIT).unwrap()).unwrap(), &points).unwrap();
    assert!(is_one_mesh(&mesh, &incircle::triangulate(&points).unwrap()));
}

#[test]
fn configuration_space_says_what_it_is() {
    within(|| {
        let card = card(64);
        let driver = VfioDriver::open(card.path()).unwrap();
        assert_eq!(driver.config(0), 0x7024_10ee);
        assert_eq!(driver.config(8), 0x0700_0100);
        assert_eq!(driver.config(config::COMMAND as u64), 0x0010_0006);
        // A window tells its size, and takes an address that is a multiple of its size.
        for (at, size) in [(0x10, 0xffff_f000), (0x14, 0xffff_0000), (0x18, 0), (0x24, 0)] {
            driver.set_config(at, ALL_ONES);
            assert_eq!(driver.config(at), size, "{at:#x}");
            driver.set_config(at, 0x1234_5678 & !0xffff);
            assert_eq!(driver.config(at), 0x1234_0000 & size, "{at:#x}");
        }
        let capability = driver.config(0x34);
        assert_eq!(driver.config(capability.into()), 0x801f_0011);
        assert_eq!(driver.config(u64::from(capability) + 4), 0x8001);
        assert_eq!(driver.config(u64::from(capability) + 8), 0x8fe1);
        // The identity cannot be written, and behind the end of the space there is nothing.
        driver.set_config(0, 0);
        assert_eq!((driver.config(0), driver.config(4096)), (0x7024_10ee, ALL_ONES));
        driver.reset().unwrap();
        assert_eq!((driver.config(0x10), driver.config(0x14)), (0, 0));
    });
}

#[test]
fn the_first_window_has_the_registers_of_the_card() {
    within(|| {
        for bits in [64, 128] {
            let (card, mut model) = (card(bits), model(bits));
            let driver = VfioDriver::open(card.path()).unwrap();
            for register in StreamRegister::ALL {
                let value = Beats::read(&mut model, register.offset()).unwrap();
                assert_eq!(driver.user(register.offset()), value, "{register:?}");
                driver.set_user(register.offset(), 0);
            }
            assert_eq!(driver.user(0x00), 0x696e_4369);
            assert_eq!(driver.user(0x04), STREAM_VERSION);
            assert_eq!((driver.user(0x14), driver.user(0x20)), (SMALL.points, bits));
            // A read that the card answers with SLVERR is all ones on the bus. So is a read of no register, and any
            // read while the window is closed.
            for offset in [0x28, 0x3c, 0x50, 0x9c, 0xffc, 0x1000, 0x02, 0x16] {
                driver.set_user(offset, 1);
                assert_eq!(driver.user(offset), ALL_ONES, "{offset:#x}");
            }
            driver.set_config(config::COMMAND as u64, 0);
            assert_eq!((driver.user(0), driver.link().dma(block::INTERRUPTS)), (ALL_ONES, ALL_ONES));
            driver.reset().unwrap();
            assert_eq!(driver.user(0), MAGIC);
        }
    });
}

#[test]
fn the_second_window_has_the_registers_of_the_bridge() {
    within(|| {
        let card = card(64);
        let driver = VfioDriver::open(card.path()).unwrap();
        let link = driver.link();
        let known = [0x1fc0_8006, 0x1fc1_8006, 0x1fc2_0006, 0x1fc3_0006, 0x1fc4_8006, 0x1fc5_8006, 0];
        for (at, identifier) in (0..).step_by(0x1000).zip(known) {
            assert_eq!(link.dma(at), identifier, "{at:#x}");
        }
        for way in [0, 1] {
            let control = block::CHANNEL[way] + channel::CONTROL;
            let first = link.dma(control);
            link.set_dma(control + 8, first);
            assert_eq!(link.dma(control), 0);
            link.set_dma(control + 4, first);
            assert_eq!((link.dma(control), link.dma(block::CHANNEL[way] + channel::STATUS)), (first, 0));
            let low = block::DESCRIPTORS[way] + 0x80;
            link.set_dma(low, 0x89ab_cde0);
            link.set_dma(low + 4, 0x0123_4567);
            assert_eq!((link.dma(low), link.dma(low + 4)), (0x89ab_cde0, 0x0123_4567));
        }
        driver.reset().unwrap();
        for way in [0, 1] {
            let low = block::DESCRIPTORS[way] + 0x80;
            assert_eq!((link.dma(low), link.dma(low + 4)), (0, 0));
        }
        assert_eq!((link.dma(0x3ffc), link.dma(0x1_0000), link.dma(0x42)), (0, ALL_ONES, ALL_ONES));
    });
}

/// Runs a descriptor that must end with this error; then a reset, and the device works again.
fn must_be_refused(way: Way, descriptor: Descriptor, first: Option<u64>, error: u32) {
    let card = card(64);
    let driver = VfioDriver::open(card.path()).unwrap();
    let (commands, answers) = channels(&driver);
    // Commands first, so that there is an answer to read.
    let mut commands = Commands(commands);
    if way == Way::ToHost {
        commands.write_all(&hello()).unwrap();
    }
    let transfers = if way == Way::ToHost { &answers } else { &commands.0 };
    let descriptor = Descriptor { stops: true, completes: true, ..descriptor };
    transfers.describe(&[descriptor]).unwrap();
    transfers.begin(first.unwrap_or(transfers.memory().address()));
    let ended = transfers.wait().unwrap();
    assert_eq!(ended, error, "{way:?}, {descriptor:x?}");
    let register = |register| driver.link().dma(transfers.register(register));
    assert_eq!((register(channel::STATUS), register(channel::COMPLETED)), (0, 0), "{way:?}, {descriptor:x?}");
    driver.reset().unwrap();
    works(&driver);
    assert_eq!(driver.untold(), 0);
}

#[test]
fn what_is_not_mapped_is_not_reached() {
    within(|| {
        let nowhere = 0xdead_0000_0000;
        let length = 64;
        for source in [nowhere, 0, u64::MAX - 8] {
            must_be_refused(Way::ToCard, Descriptor { length, source, ..Descriptor::default() }, None, status::READ);
        }
        for destination in [nowhere, 0, u64::MAX - 8] {
            let descriptor = Descriptor { length, destination, ..Descriptor::default() };
            must_be_refused(Way::ToHost, descriptor, None, status::WRITE);
        }
        for way in [Way::ToCard, Way::ToHost] {
            must_be_refused(way, Descriptor::default(), Some(nowhere), status::DESCRIPTOR);
            must_be_refused(way, Descriptor { length: 12, ..Descriptor::default() }, None, status::LENGTH);
            must_be_refused(way, Descriptor { length: 0, ..Descriptor::default() }, None, status::LENGTH);
        }
    });
}

#[test]
fn a_descriptor_without_its_letters_is_refused() {
    within(|| {
        let card = card(64);
        let driver = VfioDriver::open(card.path()).unwrap();
        let (commands, _answers) = channels(&driver);
        // A page of zeros has no magic number.
        commands.begin(commands.memory().address());
        assert_eq!(commands.wait().unwrap(), status::MAGIC);
        driver.reset().unwrap();
        works(&driver);
    });
}

/// Unmaps the memory of the data under a run: towards the host while it waits for an answer, towards the
/// card while it waits for room.
fn unmapped_meanwhile(way: Way) {
    let card = card(64);
    let driver = VfioDriver::open(card.path()).unwrap();
    let (commands, answers) = channels(&driver);
    let transfers = if way == Way::ToHost { &answers } else { &commands };
    let data = DmaMemory::new(driver.link().new_range(), 1 << 16).unwrap();
    // Commands in such number, whose answers nobody reads, fill every FIFO.
    data.write(0, &command_word(Opcode::Latencies).to_le_bytes().repeat(1 << 14)).unwrap();
    driver.link().map(&data).unwrap();
    let (source, destination) = match way {
        Way::ToCard => (data.address(), 0),
        Way::ToHost => (transfers.memory().address() + 2048, data.address()),
    };
    let length = data.size() as u32;
    transfers.describe(&[Descriptor { stops: true, length, source, destination, ..Descriptor::default() }]).unwrap();
    transfers.begin(transfers.memory().address());
    if way == Way::ToCard {
        until("commands are with the card", || driver.user(StreamRegister::CommandBeats.offset()) > 0);
    }
    assert_eq!(driver.link().dma(transfers.register(channel::STATUS)), status::BUSY);
    driver.link().unmap(&data).unwrap();
    let error = match way {
        Way::ToCard => status::READ,
        Way::ToHost => {
            let commands = Transfers::new(driver.link(), Way::ToCard, LIMIT).unwrap();
            Commands(commands).write_all(&hello()).unwrap();
            status::WRITE
        }
    };
    assert_eq!(transfers.wait().unwrap(), error, "{way:?}");
    driver.reset().unwrap();
    works(&driver);
    assert_eq!(driver.untold(), 0);
}

#[test]
fn memory_that_is_unmapped_during_a_transfer_is_not_reached_any_more() {
    within(|| unmapped_meanwhile(Way::ToCard));
    within(|| unmapped_meanwhile(Way::ToHost));
}

#[test]
fn a_reset_ends_a_run_that_waits() {
    within(|| {
        let card = card(64);
        let driver = VfioDriver::open(card.path()).unwrap();
        let (_commands, answers) = channels(&driver);
        let destination = answers.memory().address() + 4096;
        let descriptor = Descriptor { stops: true, length: 4096, destination, ..Descriptor::default() };
        answers.describe(&[descriptor]).unwrap();
        answers.begin(answers.memory().address());
        assert_eq!(driver.link().dma(answers.register(channel::STATUS)), status::BUSY);
        driver.reset().unwrap();
        assert_eq!(driver.link().dma(answers.register(channel::STATUS)), 0);
        assert_eq!(answers.wait().unwrap_err().raw_os_error(), Some(5));
        works(&driver);
    });
}

#[test]
fn memory_of_a_host_that_left_is_not_reached() {
    within(|| {
        let card = card(64);
        let first = VfioDriver::open(card.path()).unwrap();
        let memory = DmaMemory::new(0x5000_0000_0000, 4096).unwrap();
        first.link().map(&memory).unwrap();
        let source = memory.address();
        let descriptor = Descriptor { stops: true, length: 64, source, ..Descriptor::default() };
        for (driver, ended) in [(Some(first), status::STOPPED), (None, status::READ)] {
            let driver = driver.unwrap_or_else(|| VfioDriver::open(card.path()).unwrap());
            let transfers = Transfers::new(driver.link(), Way::ToCard, LIMIT).unwrap();
            transfers.describe(&[descriptor]).unwrap();
            transfers.begin(transfers.memory().address());
            assert_eq!(transfers.wait().unwrap(), ended);
        }
    });
}
