//! Parameters of a core, and the named configurations.

/// What a core is built for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Config {
    /// Name used in files, messages and on the command line.
    pub name: &'static str,
    /// Points it holds.
    pub points: u32,
    /// Boundary edges of one cavity that the list of a context holds.
    pub ring: u32,
    /// Contexts: insertions in flight at once.
    pub contexts: u32,
}

/// For tests and drawings: a wave fits a page, and boundary lists overflow often.
pub const TINY: Config = Config { name: "tiny", points: 8, ring: 6, contexts: 2 };
/// For a small board.
pub const SMALL: Config = Config { name: "small", points: 1024, ring: 32, contexts: 4 };
/// For an ECP5-85F.
pub const FULL: Config = Config { name: "full", points: 8192, ring: 32, contexts: 16 };
/// The largest that ids of 15 bits allow; for simulation.
pub const LARGE: Config = Config { name: "large", points: 16384, ring: 32, contexts: 24 };
/// All named configurations, smallest first.
pub const NAMED: [Config; 4] = [TINY, SMALL, FULL, LARGE];

/// Most points a core can be built for: a triangle id must fit 15 bits.
pub const MAX_POINTS: u32 = 16384;
/// Most points any implementation may hold, the software model too: twice as many record ids fit 31 bits.
pub const MAX_MODEL_POINTS: u32 = (1 << 30) - 1;
/// Fewest points: two records fit a memory of one address bit, but a mesh wants three points and ids two bits.
pub const MIN_POINTS: u32 = 4;
/// Most boundary edges: an entry number must fit 6 bits.
pub const MAX_RING: u32 = 64;
/// Fewest boundary edges: the three of the located triangle.
pub const MIN_RING: u32 = 3;

/// Most contexts: more of them stand in each other's way on any mesh that fits.
pub const MAX_CONTEXTS: u32 = 24;
/// Fewest contexts.
pub const MIN_CONTEXTS: u32 = 1;
/// Points that context 0 inserts alone, the first three included: a smaller mesh has no room for many insertions at once. Point
/// `j` from here on belongs to context `(j - FIRST_ROUND) mod contexts`.
pub const FIRST_ROUND: u32 = 16;

/// Clocks without a finished point after which a core of this capacity calls itself stuck.
///
/// The longest insertion is one done alone that flips every triangle: three visits of under 24 clocks for each of `points` flips,
/// and as much again for walks and whatever else was in flight.
pub const fn patience(points: u32) -> u32 {
    160 * points + 65_536
}

/// A parameter that no core can be built with.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ConfigError {
    /// Not a power of two in `MIN_POINTS..=MAX_POINTS`.
    Points(u32),
    /// Outside `MIN_RING..=MAX_RING`.
    Ring(u32),
    /// Outside `MIN_CONTEXTS..=MAX_CONTEXTS`.
    Contexts(u32),
}

impl core::fmt::Display for ConfigError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::Points(given) => write!(
                f,
                "a core holds a power of two of points, {MIN_POINTS} to {MAX_POINTS}, not {given}: choose the next larger one"
            ),
            Self::Ring(given) => {
                write!(f, "a boundary list holds {MIN_RING} to {MAX_RING} edges, not {given}: choose a number between them")
            }
            Self::Contexts(given) => {
                write!(f, "a core has {MIN_CONTEXTS} to {MAX_CONTEXTS} contexts, not {given}: choose a number between them")
            }
        }
    }
}

impl core::error::Error for ConfigError {}

impl Config {
    /// The named configuration.
    pub fn named(name: &str) -> Option<Self> {
        NAMED.into_iter().find(|config| config.name == name)
    }

    /// Checks every parameter.
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
        Ok(self)
    }
}
