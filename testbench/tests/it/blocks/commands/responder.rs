//! Runs the answer stream in Rust and in Verilog beside the words that an answer has: all three must agree, while idle
//! clocks, back-pressure and resets come in between. Words on offer must stay until they are taken, and the number of
//! words loaded fixes the clock in which an answer ends.

use std::collections::VecDeque;

use crate::rig::record_beats::{payload_of, Columns, Form};
use crate::rig::stepper::{named_ports, Cell, Stepper, Wave};
use incircle_hdl::commands::{RecordStream, Responder};
use incircle_protocol::{ShortIds, LATENCY_BUCKETS};
use incircle_testkit::SplitMix64;

named_ports!(
    Responder,
    [reset, answers, sweeps, request, head, word, read_done, record, response.ready],
    [index, index_ahead, chooses, read, read_id, response.valid, response.data, response.both, response.last, progress],
    clock
);

/// Returns true `times` times in a hundred.
fn percent(random: &mut SplitMix64, times: u64) -> bool {
    random.below(100) < times
}

/// Returns a random word of 32 bits, often one of the extremes.
fn word(random: &mut SplitMix64) -> u32 {
    [0, 1, u32::MAX, 1 << 31, random.next_u64() as u32, random.below(8) as u32][random.below(6) as usize]
}

/// The parts of an answer that the responder sends.
#[derive(Default)]
struct Sent {
    header: u32,
    payload: Vec<u32>,
    /// For a read, its first record and number of records; the payload then has them in this form.
    range: Option<(u32, u32)>,
    form: Option<Form>,
}

impl Sent {
    fn random(random: &mut SplitMix64) -> Self {
        let header = word(random);
        let first = random.below((1 << 15) - 64);
        match random.below(4) {
            0..3 => {
                let count = [random.below(8), random.below(64)][random.below(2) as usize];
                Self::read_out(header, first as u32, count as u32, Form::random(random))
            }
            _ => {
                let most = [15, LATENCY_BUCKETS as u64 + 1][random.below(2) as usize];
                Self { header, payload: (0..random.below(most)).map(|_| word(random)).collect(), ..Self::default() }
            }
        }
    }

    /// Makes the answer to a read of records.
    fn read_out(header: u32, first: u32, count: u32, form: Form) -> Self {
        let records: Vec<Columns> = (first..first + count).map(Columns::of).collect();
        Self { header, payload: payload_of(&records, form), range: Some((first, count)), form: Some(form) }
    }

    fn words(&self) -> Vec<u32> {
        [&[self.header, self.payload.len() as u32], &self.payload[..]].concat()
    }

    /// Number of words in the last beat. Header and length share a beat; beats of records have two words,
    /// except one that is left over.
    fn last_beat(&self) -> usize {
        match self.payload.len() {
            0 => 2,
            length if self.range.is_some() => 2 - length % 2,
            _ => 1,
        }
    }
}

/// Clocks from a read to its record in the core.
const READ_CLOCKS: usize = 3;

/// The responder and the blocks around it: the answer words, the memory, the host.
struct ResponderRig {
    block: Stepper<Responder>,
    random: SplitMix64,
    /// Percentage of the clocks in which the host takes a word.
    ready: u64,
    /// Reads under way: clocks left, id.
    reads: VecDeque<(usize, u32)>,
    read_clocks: usize,
    /// Clocks that an answer has been due, then `index` of a clock ago, then `index_ahead` of one and two clocks ago.
    due: usize,
    index: usize,
    aheads: [usize; 2],
    /// The word that was chosen last.
    chosen: u32,
    /// Clocks that are left of a sweep.
    sweeping: u64,
    offered: Option<(u128, bool, bool)>,
    taken: Vec<u32>,
    /// Number of words taken up to the end of each answer.
    lasts: Vec<usize>,
    /// Number of beats loaded since reset.
    beats: usize,
    /// Number of words loaded since reset, and of those in answers that have ended.
    loaded: usize,
    ended: usize,
    wave: Wave,
}

/// Outputs of a clock.
struct Clocked {
    ends: bool,
    valid: bool,
}

impl ResponderRig {
    fn new(ready: u64, read_clocks: usize) -> Self {
        let mut rig = Self {
            block: Stepper::new("responder", Responder::default(), 1),
            random: SplitMix64::new(ready),
            ready,
            reads: VecDeque::new(),
            read_clocks,
            due: 0,
            index: 0,
            aheads: [0; 2],
            chosen: 0,
            sweeping: 0,
            offered: None,
            taken: vec![],
            lasts: vec![],
            beats: 0,
            loaded: 0,
            ended: 0,
            wave: Wave::default(),
        };
        rig.reset();
        rig
    }

    fn reset(&mut self) {
        self.block.set("reset", true);
        self.block.settle();
        self.block.edge();
        self.block.set("reset", false);
        self.reads.clear();
        (self.due, self.index, self.aheads) = (0, 0, [0; 2]);
        self.sweeping = 0;
        self.offered = None;
        self.taken.clear();
        self.lasts.clear();
        (self.loaded, self.ended, self.beats) = (0, 0, 0);
    }

    fn set_inputs(&mut self, answers: bool, sent: &Sent) {
        let block = &mut self.block;
        block.set("answers", answers);
        // In the middle of an answer a sweep must not matter.
        let is_under_way = self.loaded > self.ended;
        block.set("sweeps", self.sweeping > 0 || is_under_way && self.random.below(2) == 0);
        self.sweeping = self.sweeping.saturating_sub(1);
        // Status and length take three clocks to compute.
        self.due = if answers { self.due + 1 } else { 0 };
        let is_good = self.due > 3;
        block.set("header", if is_good { sent.header } else { 0xbad });
        block.set("length", if is_good { sent.payload.len() as u64 } else { 0xbad });
        block.set("is_empty", is_good == sent.payload.is_empty());
        block.set("is_read", sent.range.is_some());
        let asked = sent.form.unwrap_or(Form::Whole).asked(self.random.below(2) == 0);
        for (port, bit) in ["is_packed", "head_has_short_ids", "head_has_rests"].into_iter().zip(asked) {
            block.set(port, bit);
        }
        // Bits above those of an id must not matter.
        let (first, count) = sent.range.unwrap_or((0, 77));
        block.set("first", first | 0xabcd_0000);
        block.set("count", count | 0x1234_0000);
        block.settle();
        let mask = if is_under_way { 127 } else { 0 };
        let [index, ahead] = ["index", "index_ahead"].map(|port| block.get_masked(port, mask) as usize);
        block.set("word", self.chosen);
        // A word is chosen within two clocks, or within three from where it is announced.
        if block.is("chooses") {
            let is_announced = self.aheads[1] == self.index;
            self.chosen = sent.payload.get(self.index).filter(|_| is_announced).copied().unwrap_or(0xbad);
        }
        (self.index, self.aheads) = (index, [ahead, self.aheads[0]]);
        let due = self.reads.front().is_some_and(|(clocks, _)| *clocks == 0);
        let id = if due { self.reads.pop_front().map(|(_, id)| id) } else { None };
        Columns::of(id.unwrap_or_else(|| self.random.below(1 << 15) as u32)).set(block);
        block.set("read_done", due);
    }

    /// Runs one clock; the command port holds `answers`.
    fn clock(&mut self, answers: bool, sent: &Sent) -> Clocked {
        self.set_inputs(answers, sent);
        let ready = percent(&mut self.random, self.ready);
        self.block.set("response_ready", !ready);
        self.block.settle();
        let valid = self.block.is("response_valid");
        self.block.set("response_ready", ready);
        self.block.settle();
        self.block.expect("response_valid", valid);
        self.block.expect("is_taken", !valid || ready);
        let block = &self.block;
        let beat = valid.then(|| (block.get("response_data"), block.is("response_both"), block.is("response_last")));
        if self.offered.is_some() {
            assert_eq!(beat, self.offered, "a word offered stands until it is taken");
        } else if let Some((data, both, _)) = beat {
            self.loaded += 1 + usize::from(both);
            self.beats += 1;
            assert!(both || data >> 32 == 0, "the unused half is not zero: {data:x}");
        }
        for read in &mut self.reads {
            read.0 = read.0.saturating_sub(1);
        }
        if self.block.is("read") {
            self.reads.push_back((self.read_clocks - 1, self.block.get("read_id") as u32));
        }
        self.offered = beat.filter(|_| !ready);
        if let (true, Some((data, both, last))) = (ready, beat) {
            self.taken.push(data as u32);
            self.taken.extend(both.then_some((data >> 32) as u32));
            self.lasts.extend(last.then_some(self.taken.len()));
        }
        let ends = self.block.is("ends");
        self.wave.take(&[
            ("answers", Cell::Bit(answers)),
            ("read", Cell::Bit(self.block.is("read"))),
            ("response_valid", Cell::Bit(valid)),
            ("beat", if valid { Cell::Number(self.beats as u128 - 1) } else { Cell::Open }),
            ("response_ready", Cell::Bit(ready)),
            ("response_last", Cell::Bit(beat.is_some_and(|(_, _, last)| last))),
            ("ends", Cell::Bit(ends)),
            ("is_idle", Cell::Bit(self.block.is("is_idle"))),
        ]);
        self.block.edge();
        Clocked { ends, valid }
    }

    /// Runs a whole answer. Returns the clocks from its first to that of `ends`, and the clocks of the header
    /// and of the beat after it.
    fn answer(&mut self, sent: &Sent) -> (usize, [usize; 2]) {
        // The command port awaits a command between answers.
        self.due = 0;
        let before = self.beats;
        let mut beats = [None; 2];
        for clock in 0..10_000 {
            let shown = self.clock(true, sent);
            for (place, beat) in beats.iter_mut().enumerate() {
                if self.beats > before + place {
                    beat.get_or_insert(clock);
                }
            }
            if shown.ends {
                self.ended += sent.words().len();
                assert_eq!(self.loaded, self.ended - sent.last_beat(), "the last word is loaded at the edge of `ends`");
                // A beat that is loaded at this edge is on offer in the next clock.
                return (clock, beats.map(|beat| beat.unwrap_or(clock + 1)));
            }
        }
        panic!("an answer without end");
    }
}

#[test]
fn responder_sends_every_answer_whole_and_in_order() {
    for (ready, read_clocks) in [(100, READ_CLOCKS), (50, 1), (10, 3), (80, RecordStream::PATIENCE)] {
        let mut rig = ResponderRig::new(ready, read_clocks);
        let mut random = SplitMix64::new(6);
        let (mut expected, mut lasts) = (vec![], vec![]);
        for _ in 0..60 {
            let sent = Sent::random(&mut random);
            if random.below(8) == 0 {
                // A reset in the middle of an answer drops everything that was under way.
                for _ in 0..random.below(30) {
                    if rig.clock(true, &sent).ends {
                        break;
                    }
                }
                rig.reset();
                expected.clear();
                lasts.clear();
                continue;
            }
            rig.sweeping = random.below(6);
            rig.answer(&sent);
            expected.extend(sent.words());
            lasts.push(expected.len());
            for _ in 0..random.below(4) {
                let shown = rig.clock(false, &sent);
                assert!(!shown.ends);
            }
        }
        while rig.clock(false, &Sent::default()).valid {}
        assert_eq!(rig.taken, expected);
        assert_eq!(rig.lasts, lasts, "an answer ends with its last word");
    }
}

#[test]
fn responder_is_as_fast_as_it_says() {
    let mut rig = ResponderRig::new(100, READ_CLOCKS);
    let mut ends_of = |answers: &[Sent]| -> Vec<usize> {
        let mut ends = vec![];
        for sent in answers {
            let (end, [header, _]) = rig.answer(sent);
            rig.clock(false, sent);
            assert_eq!(header, 4);
            ends.push(end);
        }
        ends
    };
    let ends = ends_of(&[2, 4, 1004].map(|count| Sent::read_out(7, 3, count, Form::Whole)));
    assert_eq!([ends[1] - ends[0], ends[2] - ends[0]], [3, 1503], "three clocks for two whole records");
    let ends = ends_of(&[1, 25].map(|count| Sent { header: 8, payload: vec![5; count], ..Sent::default() }));
    assert_eq!(ends[1] - ends[0], 24 * 3, "clocks a word");
    for form in [Form::Vertices, Form::Short(ShortIds::Ten), Form::Short(ShortIds::Twelve)] {
        let mut ends_of = |counts: [u32; 2]| {
            counts.map(|count| {
                let (end, _) = rig.answer(&Sent::read_out(9, 3, count, form));
                rig.clock(false, &Sent::default());
                end
            })
        };
        let ends = ends_of([16, 1008]);
        assert_eq!(ends[1] - ends[0], 992, "clocks of as many records, {form:?}");
    }
    for (form, clocks) in [(Form::Whole, 7), (Form::Vertices, 8)] {
        let (_, [header, first]) = rig.answer(&Sent::read_out(9, 3, 4, form));
        rig.clock(false, &Sent::default());
        assert_eq!(first - header, clocks, "from the header to the first beat of records");
    }
}

#[test]
fn responder_begins_no_answer_in_a_sweep() {
    let mut rig = ResponderRig::new(100, READ_CLOCKS);
    let sent = Sent { header: 9, ..Sent::default() };
    for sweep in [0, 1, 2, LATENCY_BUCKETS as u64] {
        rig.sweeping = sweep;
        let (_, [header, _]) = rig.answer(&sent);
        assert_eq!(header as u64, 4 + sweep);
        rig.clock(false, &sent);
    }
}

/// Reads three records. The header has to wait.
#[test]
fn responder_shows_the_wave_of_its_header() {
    let mut rig = ResponderRig::new(100, READ_CLOCKS);
    let sent = Sent::read_out(7, 5, 3, Form::Whole);
    let mut answers = false;
    for clock in 0..20 {
        rig.ready = if (5..7).contains(&clock) { 0 } else { 100 };
        answers |= clock == 1;
        answers &= !rig.clock(answers, &sent).ends;
    }
    assert_eq!(rig.taken, sent.words());
    rig.wave.assert_drawn_in("responder");
}
