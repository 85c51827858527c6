//! A reference for the command port: a list of the words that it still wants.

use std::collections::VecDeque;

use crate::rig::stepper::bundles::Deal;
use incircle_protocol::{
    command_meshes, command_starts_batch, command_tag, Opcode, PADDING, TRIANGLES_SHORT, TRIANGLES_TWELVE,
};

/// Capacity of the core, and number of its contexts.
#[derive(Clone, Copy, Debug)]
pub struct Shape {
    pub capacity: u32,
    pub contexts: u32,
}

/// State of the engine and of the responder, as the port sees them.
#[derive(Clone, Copy, Debug, Default)]
pub struct Surroundings {
    pub sweeping: u64,
    /// Clocks until all points are inserted.
    pub busy: u64,
    pub triple_is_in: bool,
    pub seeded: bool,
    pub collinear: bool,
    /// The core is stuck: no insertion ends any more.
    pub stuck: bool,
    /// Clocks until the answer ends.
    pub answering: u64,
    pub answer_is_taken: bool,
}

/// Meaning of the next command word.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Meaning {
    Command,
    First,
    Count,
    Point,
}

/// The port as a list of words that it still wants, and the results of those that came.
#[derive(Clone, Debug, Default)]
pub struct Reference {
    pub wants: VecDeque<Meaning>,
    /// Opcode of the command at work.
    pub opcode: Option<u8>,
    /// Whether its word asks for short ids, and for those of 12 bits.
    pub ids: Option<(bool, bool)>,
    pub first: Option<u32>,
    pub count: Option<u32>,
    pub arrived: u32,
    pub refused: u32,
    /// The last point is refused, and counted at the next edge.
    pub is_surplus: bool,
    /// Id and word of the point that came with the last edge.
    pub came: Option<(u32, u32)>,
    pub clears: bool,
    /// Numbers of contexts that work, and of jobs.
    pub contexts: u32,
    pub jobs: u32,
    pub dealt_from: u64,
    /// A `Clear` of this many contexts and jobs is being checked, for so many more clocks.
    pub checked: Option<(u32, u32, u32)>,
    pub is_refused: Option<bool>,
    /// The tag of the last `Clear`, refused or not.
    pub tag: u8,
    /// All words of the command have come; an insert settles before it is answered.
    pub is_complete: bool,
    pub settles: bool,
    pub answers: bool,
    pub inserting: bool,
    pub reading: bool,
}

impl Reference {
    pub fn new(shape: Shape) -> Self {
        Self { wants: [Meaning::Command].into(), contexts: shape.contexts, jobs: 1, dealt_from: 3, ..Self::default() }
    }

    pub fn is_ready(&self, around: &Surroundings) -> bool {
        match self.wants.front() {
            None => false,
            Some(Meaning::Command) => around.sweeping == 0,
            Some(Meaning::First | Meaning::Count) => true,
            Some(Meaning::Point) => self.came.is_none() && (around.stuck || !self.start_is_open(around)),
        }
    }

    /// True while the engine looks at the first three points.
    pub fn start_is_open(&self, around: &Surroundings) -> bool {
        self.arrived == 3 && !around.seeded && !around.collinear
    }

    /// Deal of points to contexts; the first vertex that is dealt follows a clock after the rest.
    pub fn deal(&self) -> Deal {
        Deal { contexts: self.contexts.into(), jobs: self.jobs.into(), dealt_from: self.dealt_from }
    }

    /// True if an answer is due and no memory is about to be cleared.
    pub fn answers_now(&self) -> bool {
        self.answers && !self.clears && self.checked.is_none()
    }

    fn take(&mut self, word: u32, around: &Surroundings, shape: Shape) {
        match self.wants.pop_front().expect("a word that is wanted") {
            Meaning::Command if word == PADDING => self.wants.push_back(Meaning::Command),
            Meaning::Command => {
                let opcode = (word >> 24) as u8;
                self.opcode = Some(opcode);
                self.ids = Some((word & TRIANGLES_SHORT != 0, word & TRIANGLES_TWELVE != 0));
                let asked = word & 0xff;
                let is_clear = opcode == Opcode::Clear as u8;
                self.is_refused = Some(is_clear && asked > shape.contexts);
                if is_clear {
                    self.tag = command_tag(word);
                }
                if is_clear && asked <= shape.contexts {
                    let contexts = if asked == 0 { shape.contexts } else { asked };
                    self.checked = Some(check(contexts, word));
                }
                match Opcode::of_every_device(opcode) {
                    Some(Opcode::Insert) => self.wants.push_back(Meaning::Count),
                    Some(Opcode::Read | Opcode::Triangles) => self.wants.extend([Meaning::First, Meaning::Count]),
                    _ => self.answers = true,
                }
            }
            Meaning::First => self.first = Some(word),
            Meaning::Count => {
                self.count = Some(word);
                if self.opcode == Some(Opcode::Insert as u8) {
                    self.wants = (0..word).map(|_| Meaning::Point).collect();
                    self.is_complete = word == 0;
                } else {
                    self.reading = true;
                    self.answers = true;
                }
            }
            Meaning::Point => {
                self.count = self.count.map(|count| count - 1);
                self.is_complete = self.wants.is_empty();
                self.inserting = true;
                if around.collinear || around.stuck || self.arrived == shape.capacity {
                    self.is_surplus = true;
                } else {
                    self.came = Some((self.arrived, word));
                    self.arrived += 1;
                }
            }
        }
    }

    /// Passes a rising edge, at which `word` is taken if there is one.
    pub fn edge(&mut self, word: Option<u32>, pins: Pins, around: &Surroundings, shape: Shape) {
        let was = self.clone();
        self.dealt_from = 3 * u64::from(was.jobs);
        (self.came, self.clears, self.is_complete, self.is_surplus) = (None, false, false, false);
        self.refused += u32::from(was.is_surplus);
        if !was.answers && pins.responder_is_idle && around.answer_is_taken {
            self.reading = false;
        }
        match self.checked.take() {
            Some((contexts, jobs, 1)) if contexts.is_multiple_of(jobs) => {
                (self.contexts, self.jobs, self.clears) = (contexts, jobs, true);
            }
            Some((_, _, 1)) => self.is_refused = Some(true),
            Some((contexts, jobs, clocks)) => self.checked = Some((contexts, jobs, clocks - 1)),
            None => {}
        }
        if let Some(word) = word {
            self.take(word, around, shape);
        }
        self.settles |= was.is_complete;
        if was.settles && (pins.is_quiet || around.stuck) {
            (self.settles, self.inserting, self.answers) = (false, false, true);
        }
        if was.answers && pins.answer_ends {
            self.answers = false;
            self.wants.push_back(Meaning::Command);
        }
        if was.clears {
            (self.arrived, self.refused) = (0, 0);
        }
    }
}

/// The numbers of contexts and jobs of a `Clear`, and the clocks that their check takes: one for each context of a
/// team, or one outside a batch.
pub fn check(contexts: u32, word: u32) -> (u32, u32, u32) {
    match command_meshes(word) {
        _ if !command_starts_batch(word) => (contexts, 1, 1),
        0 => (contexts, contexts, 1),
        jobs => (contexts, jobs, contexts.div_ceil(jobs)),
    }
}

/// Inputs that follow from the surroundings.
#[derive(Clone, Copy, Debug)]
pub struct Pins {
    pub is_quiet: bool,
    pub responder_is_idle: bool,
    pub answer_ends: bool,
}
