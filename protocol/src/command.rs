//! Commands: how they are written as words, how they are read from words, and how long their answers are.

use crate::counters::{COUNTER_WORDS, LATENCY_BUCKETS};
use crate::layout::{Layout, IDENTITY_WORDS, INSERT_REPORT_WORDS};
use crate::living::RunKind;
use crate::opcode::Opcode;
use crate::short_ids::ShortIds;
use crate::status::Status;

/// A command word that does nothing and has no answer. Links whose beats hold several words fill the last beat with it.
pub const PADDING: u32 = 0;

/// The first word of a command, without the bits that only `Clear` and `Triangles` use.
pub const fn command_word(opcode: Opcode) -> u32 {
    (opcode as u32) << 24
}

/// The parameters of a job on a device: of all commands from this `Clear` up to the next one.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Clear {
    /// Number of contexts that work from now on; 0 stands for all that an engine has.
    pub contexts: u32,
    /// Number of meshes, and how the contexts share them.
    pub meshes: Meshes,
    /// The job's tag, which the host chooses. The header of every answer repeats the tag of the last `Clear`.
    pub tag: u8,
}

/// The meshes of a job, which the contexts work on.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Meshes {
    /// One mesh, for all contexts.
    #[default]
    One,
    /// A batch with a mesh for each context.
    OnePerContext,
    /// A batch of this many meshes, 1 to [`MAX_SIDE_BY_SIDE`]. The number must divide that of the contexts, and each
    /// mesh has an equal share of them.
    SideBySide(u32),
}

/// The bit of a [`Clear`] that begins a batch.
pub const CLEAR_BATCH: u32 = 1 << 8;
/// Lowest bit of the number of meshes in the word of a [`Clear`] that begins a batch; 0 stands for one for each
/// context.
pub const CLEAR_MESHES_SHIFT: u32 = 9;
/// Largest number of meshes that the word of a [`Clear`] can name.
pub const MAX_SIDE_BY_SIDE: u32 = 127;
/// Lowest bit of the tag in the word of a [`Clear`].
pub const CLEAR_TAG_SHIFT: u32 = 16;

impl Clear {
    /// One mesh for this many contexts, 0 for all, with the tag 0.
    pub const fn one_mesh(contexts: u32) -> Self {
        Self { contexts, meshes: Meshes::One, tag: 0 }
    }

    /// A batch with a mesh for each of this many contexts, 0 for all, with the tag 0.
    pub const fn batch(contexts: u32) -> Self {
        Self { contexts, meshes: Meshes::OnePerContext, tag: 0 }
    }

    /// The command word.
    ///
    /// The word can name at most 255 contexts and [`MAX_SIDE_BY_SIDE`] meshes. Larger numbers become these, which every
    /// device refuses.
    pub const fn word(self) -> u32 {
        let contexts = if self.contexts > 255 { 255 } else { self.contexts };
        let meshes = match self.meshes {
            Meshes::One => 0,
            Meshes::OnePerContext => CLEAR_BATCH,
            Meshes::SideBySide(meshes) => {
                let meshes = if meshes > MAX_SIDE_BY_SIDE { MAX_SIDE_BY_SIDE } else { meshes };
                CLEAR_BATCH | meshes << CLEAR_MESHES_SHIFT
            }
        };
        command_word(Opcode::Clear) | (self.tag as u32) << CLEAR_TAG_SHIFT | meshes | contexts
    }

    /// The `Clear` of this command word.
    pub const fn from_word(word: u32) -> Self {
        let meshes = match command_meshes(word) {
            _ if !command_starts_batch(word) => Meshes::One,
            0 => Meshes::OnePerContext,
            meshes => Meshes::SideBySide(meshes),
        };
        Self { contexts: command_contexts(word), meshes, tag: command_tag(word) }
    }
}

/// The word of a [`Clear`] for one mesh and this many contexts, 0 for all, with the tag 0.
pub const fn clear_word(contexts: u32) -> u32 {
    Clear::one_mesh(contexts).word()
}

/// The word of a [`Clear`] for a batch with a mesh for each of this many contexts, 0 for all, with the tag 0.
pub const fn batch_word(contexts: u32) -> u32 {
    Clear::batch(contexts).word()
}

/// Whether the word of a `Clear` begins a batch.
pub const fn command_starts_batch(word: u32) -> bool {
    word & CLEAR_BATCH != 0
}

/// The number of contexts in the word of a `Clear`.
pub const fn command_contexts(word: u32) -> u32 {
    word & 0xff
}

/// The number of meshes in the word of a `Clear`, which counts only in a batch; 0 stands for a mesh for each context.
pub const fn command_meshes(word: u32) -> u32 {
    word >> CLEAR_MESHES_SHIFT & MAX_SIDE_BY_SIDE
}

/// The tag in the word of a `Clear`.
pub const fn command_tag(word: u32) -> u8 {
    (word >> CLEAR_TAG_SHIFT) as u8
}

/// The opcode byte of a command word, known or not.
pub const fn command_opcode(word: u32) -> u8 {
    (word >> 24) as u8
}

/// The first word of an answer of engine 0 in a job with the tag 0: the opcode in the top byte, the status in the next,
/// zeros below. For an unknown opcode the device sends the byte back as it came. [`signed_header`] adds the rest.
pub const fn answer_header(opcode: u8, status: crate::status::Status) -> u32 {
    (opcode as u32) << 24 | (status as u32) << 16
}

/// The same header from this engine, in a job with this tag.
pub const fn signed_header(header: u32, engine: u8, tag: u8) -> u32 {
    header & 0xffff_0000 | (engine as u32) << 8 | tag as u32
}

/// The number of the engine in the header of an answer.
pub const fn answer_engine(header: u32) -> u8 {
    (header >> 8) as u8
}

/// The tag in the header of an answer: that of the last `Clear`, or 0 if there was none since the reset.
pub const fn answer_tag(header: u32) -> u8 {
    header as u8
}

/// The opcode byte in the header of an answer.
pub const fn answer_opcode(header: u32) -> u8 {
    (header >> 24) as u8
}

/// The status byte in the header of an answer.
pub const fn answer_status(header: u32) -> u8 {
    (header >> 16) as u8
}

/// Number of words in front of an answer's payload: the header, and the count of payload words.
pub const ANSWER_HEAD_WORDS: usize = 2;

/// Largest number of words that a command has in front of its points.
pub const COMMAND_HEAD_WORDS: usize = 3;

/// A command with its arguments; each variant is described at the [`Opcode`] of its name, and `Run` stands for the six
/// runs. `P` holds the points of an `Insert` or the items of a run: a slice or a list of words, in which points are as
/// [`Layout::point_to_words`] packs them, or `()` if the words are kept elsewhere.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Command<P> {
    Hello,
    Clear(Clear),
    Insert {
        count: u32,
        points: P,
    },
    Read(RecordRange),
    Counters,
    Latencies,
    Triangles(RecordRange),
    /// A `Triangles` whose answer has ids of fewer bits, from a device with the feature
    /// [`FEATURE_SHORT_IDS`](crate::FEATURE_SHORT_IDS).
    ShortTriangles(RecordRange, ShortIds),
    Run {
        kind: RunKind,
        count: u32,
        items: P,
    },
}

/// A range of triangle records with consecutive ids.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RecordRange {
    /// Id of the first record.
    pub first: u32,
    pub count: u32,
}

impl<P> Command<P> {
    /// The opcode of the command.
    pub const fn opcode(&self) -> Opcode {
        match self {
            Self::Hello => Opcode::Hello,
            Self::Clear(_) => Opcode::Clear,
            Self::Insert { .. } => Opcode::Insert,
            Self::Read(_) => Opcode::Read,
            Self::Counters => Opcode::Counters,
            Self::Latencies => Opcode::Latencies,
            Self::Triangles(_) | Self::ShortTriangles(..) => Opcode::Triangles,
            Self::Run { kind, .. } => kind.opcode(),
        }
    }

    /// The command without its points or items.
    pub const fn bare(&self) -> Command<()> {
        match self {
            Self::Hello => Command::Hello,
            Self::Clear(clear) => Command::Clear(*clear),
            Self::Insert { count, .. } => Command::Insert { count: *count, points: () },
            Self::Read(range) => Command::Read(*range),
            Self::Counters => Command::Counters,
            Self::Latencies => Command::Latencies,
            Self::Triangles(range) => Command::Triangles(*range),
            Self::ShortTriangles(range, ids) => Command::ShortTriangles(*range, *ids),
            Self::Run { kind, count, .. } => Command::Run { kind: *kind, count: *count, items: () },
        }
    }

    /// The same command with its points or items converted by `form`.
    pub fn map<Q>(self, form: impl FnOnce(P) -> Q) -> Command<Q> {
        match self {
            Self::Hello => Command::Hello,
            Self::Clear(clear) => Command::Clear(clear),
            Self::Insert { count, points } => Command::Insert { count, points: form(points) },
            Self::Read(range) => Command::Read(range),
            Self::Counters => Command::Counters,
            Self::Latencies => Command::Latencies,
            Self::Triangles(range) => Command::Triangles(range),
            Self::ShortTriangles(range, ids) => Command::ShortTriangles(range, ids),
            Self::Run { kind, count, items } => Command::Run { kind, count, items: form(items) },
        }
    }

    /// The words in front of the points or items, and how many of them the command uses.
    pub const fn head(&self) -> ([u32; COMMAND_HEAD_WORDS], usize) {
        let word = command_word(self.opcode());
        match self {
            Self::Clear(clear) => ([clear.word(), 0, 0], 1),
            Self::Insert { count, .. } | Self::Run { count, .. } => ([word, *count, 0], 2),
            Self::Read(range) | Self::Triangles(range) => ([word, range.first, range.count], 3),
            Self::ShortTriangles(range, ids) => ([word | ids.word_bits(), range.first, range.count], 3),
            Self::Hello | Self::Counters | Self::Latencies => ([word, 0, 0], 1),
        }
    }

    /// Number of words of points or items that follow the head.
    pub const fn point_words(&self, layout: Layout) -> u64 {
        match self {
            Self::Insert { count, .. } => *count as u64 * layout.point_words as u64,
            Self::Run { kind, count, .. } => *count as u64 * kind.item_words(layout) as u64,
            _ => 0,
        }
    }

    /// Number of payload words in the answer, if the device does what the command asks. An answer with an error status
    /// has no payload, or that of an `Insert`.
    pub const fn payload_words(&self, layout: Layout) -> u64 {
        match self {
            Self::Hello => IDENTITY_WORDS as u64,
            Self::Clear(_) => 0,
            Self::Insert { .. } => INSERT_REPORT_WORDS as u64,
            Self::Read(range) => range.count as u64 * layout.record_words as u64,
            Self::Counters => COUNTER_WORDS as u64,
            Self::Latencies => LATENCY_BUCKETS as u64,
            Self::Triangles(range) => layout.packed_words(range.count),
            Self::ShortTriangles(range, ids) => ids.words(range.count),
            Self::Run { kind, count, .. } => *count as u64 * kind.part_words() as u64,
        }
    }
}

impl<P: AsRef<[u32]>> Command<P> {
    /// An `Insert` of the points in these words. The words must be whole points of this layout: the head counts points,
    /// so the device would take words left over for its next command.
    pub fn insert(points: P, layout: Layout) -> Self {
        debug_assert!(points.as_ref().len().is_multiple_of(layout.point_words), "the words are whole points");
        Self::Insert { count: (points.as_ref().len() / layout.point_words) as u32, points }
    }

    /// A run of the items in these words, which must be whole items of this layout, as the points of an `Insert`.
    pub fn run(kind: RunKind, items: P, layout: Layout) -> Self {
        let words = kind.item_words(layout);
        debug_assert!(items.as_ref().len().is_multiple_of(words), "the words are whole items");
        Self::Run { kind, count: (items.as_ref().len() / words) as u32, items }
    }

    /// The same command, borrowing the points or items of this one.
    pub fn borrowed(&self) -> Command<&[u32]> {
        self.bare().map(|()| self.points())
    }

    /// The words of the points of an `Insert` or the items of a run; empty for every other command.
    pub fn points(&self) -> &[u32] {
        match self {
            Self::Insert { points, .. } => points.as_ref(),
            Self::Run { items, .. } => items.as_ref(),
            _ => &[],
        }
    }

    /// Number of words of the whole command.
    pub fn words(&self) -> usize {
        self.head().1 + self.points().len()
    }

    /// Appends the words of the whole command.
    pub fn encode(&self, words: &mut impl Extend<u32>) {
        let (head, count) = self.head();
        words.extend(head.into_iter().take(count));
        words.extend(self.points().iter().copied());
    }
}

/// The first words of an answer with the status `Ok`: the header, and the number of payload words.
pub const fn answer_head(opcode: Opcode, payload_words: u32) -> [u32; ANSWER_HEAD_WORDS] {
    [answer_header(opcode as u8, Status::Ok), payload_words]
}

/// Reads the heads of commands from a stream, word by word. After the head of an `Insert` or a run, the caller takes
/// the points or items from the stream itself before it hands over the next word.
#[derive(Clone, Copy, Debug, Default)]
pub struct CommandReader {
    words: [u32; COMMAND_HEAD_WORDS],
    count: usize,
}

impl CommandReader {
    /// Takes the next word, and returns a command when its head is complete. An unknown opcode is returned as an error;
    /// the next word then begins a command.
    pub fn take(&mut self, word: u32) -> Option<Result<Command<()>, u8>> {
        if self.count == 0 && word == PADDING {
            return None;
        }
        self.words[self.count] = word;
        self.count += 1;
        let read = Self::read(&self.words[..self.count])?;
        self.count = 0;
        Some(read)
    }

    fn read(words: &[u32]) -> Option<Result<Command<()>, u8>> {
        let (&word, arguments) = words.split_first()?;
        let number = command_opcode(word);
        let Some(opcode) = Opcode::from_u8(number) else {
            return Some(Err(number));
        };
        Some(Ok(match (opcode, arguments) {
            (Opcode::Hello, _) => Command::Hello,
            (Opcode::Clear, _) => Command::Clear(Clear::from_word(word)),
            (Opcode::Counters, _) => Command::Counters,
            (Opcode::Latencies, _) => Command::Latencies,
            (Opcode::Insert, &[count]) => Command::Insert { count, points: () },
            (Opcode::Read, &[first, count]) => Command::Read(RecordRange { first, count }),
            (Opcode::Triangles, &[first, count]) => match ShortIds::of_word(word) {
                Some(ids) => Command::ShortTriangles(RecordRange { first, count }, ids),
                None => Command::Triangles(RecordRange { first, count }),
            },
            (Opcode::Insert | Opcode::Read | Opcode::Triangles, _) => return None,
            (_, &[count]) => Command::Run { kind: RunKind::of(opcode)?, count, items: () },
            _ => return None,
        }))
    }
}

#[cfg(test)]
mod tests;
