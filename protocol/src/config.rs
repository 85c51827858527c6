//! The parameters of a core, and the named configurations.

/// The numbers with which a core, or a chip of several engines, is built.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Config {
    /// Name of the configuration in files, messages and on the command line.
    pub name: &'static str,
    /// Number of points that the memory of an engine holds.
    pub points: u32,
    /// Number of boundary edges that the list of a context holds.
    pub ring: u32,
    /// Number of contexts of an engine, which is the number of its insertions in progress at a time.
    pub contexts: u32,
    /// Number of engines, each with a memory and contexts of its own.
    pub engines: u32,
}

/// A core for tests and drawings: a wave fits on a page, and boundary lists overflow often.
pub const TINY: Config = Config { name: "tiny", points: 8, ring: 6, contexts: 2, engines: 1 };
/// A core for a small board.
pub const SMALL: Config = Config { name: "small", points: 1024, ring: 32, contexts: 16, engines: 1 };
/// A core for an ECP5-85F.
pub const FULL: Config = Config { name: "full", points: 8192, ring: 32, contexts: 16, engines: 1 };
/// The largest core that ids of 15 bits allow, for simulation.
pub const LARGE: Config = Config { name: "large", points: 16384, ring: 32, contexts: 24, engines: 1 };
/// Two engines, for an ECP5-85F.
pub const DUAL: Config = Config { name: "dual", points: 4096, ring: 32, contexts: 16, engines: 2 };
/// Four engines, for an ECP5-85F.
pub const QUAD: Config = Config { name: "quad", points: 2048, ring: 32, contexts: 16, engines: 4 };
/// All named configurations: those of one engine, smallest first, then the others.
pub const NAMED: [Config; 6] = [TINY, SMALL, FULL, LARGE, DUAL, QUAD];

/// Largest number of points of a core: a triangle id must fit into 15 bits.
pub const MAX_POINTS: u32 = 16384;
/// Largest number of points of any device, the software model included: twice as many record ids must fit into 31 bits.
pub const MAX_MODEL_POINTS: u32 = (1 << 30) - 1;
/// Smallest number of points of a core. One address bit would do for a memory of two records, but a mesh needs three
/// points, and ids need two bits.
pub const MIN_POINTS: u32 = 4;
/// Largest number of boundary edges in a list: the number of an entry must fit into 6 bits.
pub const MAX_RING: u32 = 64;
/// Most edges of a boundary list in a core with deletions: a place of a star, with its side, has six bits.
pub const MAX_DELETE_RING: u32 = 32;
/// Smallest number of boundary edges in a list: the three edges of the root.
pub const MIN_RING: u32 = 3;

/// Largest number of contexts: the core has a bit for each in sets of 24, and more would only hinder each other in any
/// mesh that fits.
pub const MAX_CONTEXTS: u32 = 24;
/// Smallest number of contexts.
pub const MIN_CONTEXTS: u32 = 1;
/// The numbers of engines that a chip may have: the blocks between the streams and the engines are drawn for these.
pub const ENGINES: [u32; 3] = [1, 2, 4];
/// Number of words of commands that wait for an engine while it works, so that the commands behind a long `Insert` do
/// not hold up those for other engines. Over the UDP link a mesh of 8,192 points is read by at most 69 commands of
/// three words, so all commands behind the `Insert` have room.
pub const ENGINE_QUEUE_WORDS: usize = 256;
/// Number of points that context 0 inserts on its own, the first three included, because a smaller mesh has no room for
/// many insertions at once. From here on, point `j` belongs to context `(j - FIRST_ROUND) mod contexts`. In a batch the
/// same holds for the points of each job and the contexts of its team.
pub const FIRST_ROUND: u32 = 16;

/// Number of clocks without the end of an insertion after which a core of this capacity reports `Stuck`.
///
/// The longest insertion is a solo insertion that flips every triangle. Each of its `points` flips takes three visits
/// of fewer than 24 clocks. As much again is allowed for walks and for all other insertions that were in progress.
pub const fn patience(points: u32) -> u32 {
    160 * points + 65_536
}

/// A parameter with which no core can be built.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ConfigError {
    /// The number of points is not a power of two in `MIN_POINTS..=MAX_POINTS`.
    Points(u32),
    /// The length of the boundary lists is outside `MIN_RING..=MAX_RING`.
    Ring(u32),
    /// The number of contexts is outside `MIN_CONTEXTS..=MAX_CONTEXTS`.
    Contexts(u32),
    /// The number of engines is not one of `ENGINES`.
    Engines(u32),
    /// The number of engines of a core that answers questions about its mesh is not 1.
    EnginesForQuestions(u32),
    /// The boundary list of a core with deletions is longer than `MAX_DELETE_RING`.
    RingForDeletions(u32),
}

impl core::fmt::Display for ConfigError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::Points(given) => {
                write!(f, "a core cannot hold {given} points: choose a power of two from {MIN_POINTS} to {MAX_POINTS}")
            }
            Self::Ring(given) => {
                write!(f, "a boundary list cannot hold {given} edges: choose a number from {MIN_RING} to {MAX_RING}")
            }
            Self::Contexts(given) => {
                write!(f, "a core cannot have {given} contexts: choose a number from {MIN_CONTEXTS} to {MAX_CONTEXTS}")
            }
            Self::Engines(given) => {
                let [one, two, four] = ENGINES;
                write!(f, "a chip cannot have {given} engines: choose {one}, {two} or {four}")
            }
            Self::EnginesForQuestions(given) => {
                write!(f, "a core that answers questions cannot have {given} engines: choose a configuration of one")
            }
            Self::RingForDeletions(given) => {
                write!(f, "a core with deletions cannot have a boundary list of {given} edges: ")?;
                write!(f, "choose a number from {MIN_RING} to {MAX_DELETE_RING}")
            }
        }
    }
}

impl core::error::Error for ConfigError {}

impl Config {
    /// The configuration of this name, if there is one.
    pub fn named(name: &str) -> Option<Self> {
        NAMED.into_iter().find(|config| config.name == name)
    }

    /// Checks every parameter, and returns the configuration if all are valid.
    pub const fn check(self) -> Result<Self, ConfigError> {
        if self.points < MIN_POINTS || self.points > MAX_POINTS || !self.points.is_power_of_two() {
            return Err(ConfigError::Points(self.points));
        }
        if self.ring < MIN_RING || self.ring > MAX_RING {
            return Err(ConfigError::Ring(self.ring));
        }
        if self.contexts < MIN_CONTEXTS || self.contexts > MAX_CONTEXTS {
            return Err(ConfigError::Contexts(self.contexts));
        }
        if self.engines != ENGINES[0] && self.engines != ENGINES[1] && self.engines != ENGINES[2] {
            return Err(ConfigError::Engines(self.engines));
        }
        Ok(self)
    }
}
