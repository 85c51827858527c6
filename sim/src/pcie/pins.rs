//! The card itself: the Verilated `incircle_stream_top`, with all its AXI ports driven at every clock. The hardware
//! twin of this driver is a vendor's PCIe bridge.

use std::collections::VecDeque;

use incircle_model::stream::{BusError, Given};
use incircle_protocol::{Config, StreamRegister, CONTROL_RESET, STREAM_STATUS_BUSY, STREAM_STATUS_RUNS};
use verilated::{Model, PortError, PortId};

use super::beats::Beats;
use crate::error::SimError;
use crate::models;

/// Prefix that the build script puts before the name of a configuration; the bits of a beat follow behind it.
const STREAM: &str = "stream_";
/// The same for cards whose core has runs.
const LIVING: &str = "living_stream_";
/// Number of clocks for which the reset of the bus is held, more than a device needs.
const RESET_CLOCKS: u32 = 64;
/// Number of clocks within which a device must come out of its reset.
const START_CLOCKS: u32 = 1_000_000;
/// Number of clocks in a slice.
const SLICE: u32 = 2_000;
/// Number of clocks within which a register must answer.
const REGISTER_CLOCKS: u32 = 10_000;
/// Number of beats that the bridge holds in each direction.
const BRIDGE_BEATS: usize = 1_024;
/// Largest number of bytes of a beat.
const MOST_BYTES: usize = 16;
/// The response of a bus on success.
const OKAY: u64 = 0;

/// A beat of commands with its `tkeep`, and a beat of answers with its `tlast`.
type CommandBeat = ([u8; MOST_BYTES], u64);
type AnswerBeat = ([u8; MOST_BYTES], bool);

/// A card at its pins. The clock of the bus and the clock of the core are simulated, and rise together.
#[derive(Debug)]
pub struct PinCard {
    model: Model,
    ports: Ports,
    /// Number of bytes of a beat.
    beat: usize,
    /// Beats on their way to the device. The first is offered if `is_offered`.
    to_card: VecDeque<CommandBeat>,
    is_offered: bool,
    from_card: VecDeque<AnswerBeat>,
}

#[derive(Debug)]
struct Ports {
    bus_clock: PortId,
    core_clock: PortId,
    bus_reset_n: PortId,
    command: [PortId; 4],
    answer: [PortId; 4],
    write_address: [PortId; 3],
    write_data: [PortId; 4],
    write_answer: [PortId; 3],
    read_address: [PortId; 3],
    read_data: [PortId; 4],
}

impl Ports {
    fn of(model: &Model) -> Result<Self, PortError> {
        let port = |name: &str| model.port(name);
        let stream = |name: &str, last: &str| {
            Ok([
                port(&format!("{name}_tvalid"))?,
                port(&format!("{name}_tready"))?,
                port(&format!("{name}_tdata"))?,
                port(&format!("{name}_{last}"))?,
            ])
        };
        let axi = |name: &str| port(&format!("s_axi_{name}"));
        Ok(Self {
            bus_clock: port("bus_clock")?,
            core_clock: port("core_clock")?,
            bus_reset_n: port("bus_reset_n")?,
            command: stream("s_axis", "tkeep")?,
            answer: stream("m_axis", "tlast")?,
            write_address: [axi("awvalid")?, axi("awready")?, axi("awaddr")?],
            write_data: [axi("wvalid")?, axi("wready")?, axi("wdata")?, axi("wstrb")?],
            write_answer: [axi("bvalid")?, axi("bready")?, axi("bresp")?],
            read_address: [axi("arvalid")?, axi("arready")?, axi("araddr")?],
            read_data: [axi("rvalid")?, axi("rready")?, axi("rdata")?, axi("rresp")?],
        })
    }
}

impl PinCard {
    /// A card with the core of this configuration and beats of `beat_bits` bits, after its reset.
    ///
    /// # Errors
    /// [`SimError::NoCard`]: such cards were not translated when this crate was built, or the card does not come
    /// out of its reset.
    pub fn new(config: Config, beat_bits: u32) -> Result<Self, SimError> {
        Self::of(STREAM, config, beat_bits)
    }

    /// A card with the core with runs of this configuration and beats of `beat_bits` bits, after its reset.
    ///
    /// # Errors
    /// [`SimError::NoRuns`]: such cards were not translated when this crate was built, or the card does not come out of
    /// its reset.
    pub fn living(config: Config, beat_bits: u32) -> Result<Self, SimError> {
        Self::of(LIVING, config, beat_bits)
    }

    /// The card whose model has a name with this prefix.
    fn of(prefix: &str, config: Config, beat_bits: u32) -> Result<Self, SimError> {
        let name = format!("{prefix}{}_{beat_bits}", config.name);
        let missing = || {
            let built = models::NAMES.iter().filter_map(|name| name.strip_prefix(prefix)).collect::<Vec<_>>();
            let built = built.join(", ");
            if prefix == LIVING {
                return SimError::NoRuns { name: config.name, built: built.replace('_', " with beats of ") + " bits" };
            }
            SimError::NoCard { name: format!("{}_{beat_bits}", config.name), built }
        };
        let model = Model::new(models::find(&name).ok_or_else(missing)?);
        let ports = Ports::of(&model)?;
        let mut card = Self {
            model,
            ports,
            beat: beat_bits as usize / 8,
            to_card: VecDeque::new(),
            is_offered: false,
            from_card: VecDeque::new(),
        };
        for _ in 0..RESET_CLOCKS {
            card.clock();
        }
        card.model.set(card.ports.bus_reset_n, 1);
        for _ in 0..START_CLOCKS / SLICE {
            card.slice();
            if card.read(StreamRegister::Status.offset()) == Ok(STREAM_STATUS_RUNS) {
                return Ok(card);
            }
        }
        Err(missing())
    }

    /// Raises and lowers both clocks.
    fn clock(&mut self) {
        for level in [1, 0] {
            self.model.set(self.ports.bus_clock, level);
            self.model.set(self.ports.core_clock, level);
            self.model.eval();
        }
    }

    /// Simulates one clock, in which a beat may pass in each direction.
    fn step(&mut self) {
        let [valid, ready, data, keep] = self.ports.command;
        if !self.is_offered {
            if let Some(&(beat, bytes)) = self.to_card.front() {
                self.is_offered = true;
                self.model.set_wide(data, &words_of(&beat)[..self.beat / 4]);
                self.model.set(keep, bytes);
            }
            self.model.set(valid, u64::from(self.is_offered));
        }
        let [given, taken, answer, last] = self.ports.answer;
        let has_room = self.from_card.len() < BRIDGE_BEATS;
        self.model.set(taken, u64::from(has_room));
        self.model.eval();
        if self.is_offered && self.model.get(ready) != 0 {
            self.to_card.pop_front();
            self.is_offered = false;
        }
        if has_room && self.model.get(given) != 0 {
            let mut words = [0; MOST_BYTES / 4];
            self.model.get_wide(answer, &mut words[..self.beat / 4]);
            let mut beat = [0; MOST_BYTES];
            for (bytes, word) in beat.chunks_exact_mut(4).zip(words) {
                bytes.copy_from_slice(&word.to_le_bytes());
            }
            self.from_card.push_back((beat, self.model.get(last) != 0));
        }
        self.clock();
    }

    fn slice(&mut self) {
        for _ in 0..SLICE {
            self.step();
        }
    }

    /// Makes one access: offers on these channels, each a pair of `valid` and `ready`, until all were taken and the
    /// response channel `answer`, a pair as well, is valid.
    fn access(&mut self, offers: &[[PortId; 2]], answer: [PortId; 2]) -> Result<(), BusError> {
        let [answer_valid, answer_ready] = answer;
        let mut is_left = vec![true; offers.len()];
        offers.iter().for_each(|&[valid, _]| self.model.set(valid, 1));
        self.model.set(answer_ready, 0);
        for _ in 0..REGISTER_CLOCKS {
            self.model.eval();
            if self.model.get(answer_valid) != 0 && !is_left.contains(&true) {
                return Ok(());
            }
            let is_taken: Vec<bool> = offers.iter().map(|&[_, ready]| self.model.get(ready) != 0).collect();
            self.step();
            for ((&[valid, _], is_left), is_taken) in offers.iter().zip(&mut is_left).zip(is_taken) {
                *is_left &= !is_taken;
                self.model.set(valid, u64::from(*is_left));
            }
        }
        offers.iter().for_each(|&[valid, _]| self.model.set(valid, 0));
        Err(BusError)
    }

    /// Drops the commands that the bridge holds, so that they do not precede the commands after a reset. A beat that is
    /// already offered gets a moment to be taken, since AXI forbids withdrawing it.
    fn drop_commands(&mut self) {
        self.to_card.truncate(usize::from(self.is_offered));
        for _ in 0..RESET_CLOCKS {
            if self.to_card.is_empty() {
                return;
            }
            self.step();
        }
        self.to_card.clear();
        self.is_offered = false;
    }

    /// Takes the response to an access.
    fn take_answer(&mut self, ready: PortId) {
        self.model.set(ready, 1);
        self.step();
        self.model.set(ready, 0);
    }
}

/// The words of a beat.
fn words_of(beat: &[u8; MOST_BYTES]) -> [u32; MOST_BYTES / 4] {
    let mut words = [0; MOST_BYTES / 4];
    for (word, bytes) in words.iter_mut().zip(beat.chunks_exact(4)) {
        *word = u32::from_le_bytes([bytes[0], bytes[1], bytes[2], bytes[3]]);
    }
    words
}

impl Beats for PinCard {
    fn take(&mut self, bytes: &[u8]) -> usize {
        let mut taken = 0;
        for piece in bytes.chunks(self.beat) {
            if self.to_card.len() >= BRIDGE_BEATS {
                break;
            }
            let mut beat = [0; MOST_BYTES];
            beat[..piece.len()].copy_from_slice(piece);
            self.to_card.push_back((beat, (1 << piece.len()) - 1));
            taken += piece.len();
        }
        taken
    }

    fn give(&mut self, bytes: &mut [u8]) -> Given {
        let mut given = Given::default();
        for place in bytes.chunks_exact_mut(self.beat) {
            let Some((beat, is_last)) = self.from_card.pop_front() else {
                break;
            };
            place.copy_from_slice(&beat[..place.len()]);
            given.bytes += place.len();
            if is_last {
                given.is_end = true;
                break;
            }
        }
        given
    }

    fn read(&mut self, offset: u32) -> Result<u32, BusError> {
        let [valid, ready, address] = self.ports.read_address;
        let [has_come, take, data, response] = self.ports.read_data;
        self.model.set(address, u64::from(offset & 0xfff));
        self.access(&[[valid, ready]], [has_come, take])?;
        let (value, response) = (self.model.get(data), self.model.get(response));
        self.take_answer(take);
        // The port has 32 bits, so nothing is lost.
        (response == OKAY).then_some(value as u32).ok_or(BusError)
    }

    fn write(&mut self, offset: u32, value: u32) -> Result<(), BusError> {
        let resets = offset == StreamRegister::Control.offset() && value & CONTROL_RESET != 0;
        if resets {
            self.drop_commands();
        }
        let [valid, ready, address] = self.ports.write_address;
        let [data_valid, data_ready, data, bytes] = self.ports.write_data;
        let [has_come, take, response] = self.ports.write_answer;
        self.model.set(address, u64::from(offset & 0xfff));
        self.model.set(data, u64::from(value));
        self.model.set(bytes, 0xf);
        self.access(&[[valid, ready], [data_valid, data_ready]], [has_come, take])?;
        let response = self.model.get(response);
        self.take_answer(take);
        if resets {
            self.from_card.clear();
        }
        (response == OKAY).then_some(()).ok_or(BusError)
    }

    fn beat_bytes(&self) -> usize {
        self.beat
    }

    fn run(&mut self) -> bool {
        let before = (self.to_card.len(), self.from_card.len());
        self.slice();
        if (self.to_card.len(), self.from_card.len()) != before || !self.to_card.is_empty() {
            return true;
        }
        self.from_card.len() < BRIDGE_BEATS
            && self.read(StreamRegister::Status.offset()).is_ok_and(|status| status & STREAM_STATUS_BUSY != 0)
    }
}
