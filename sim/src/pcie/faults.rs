//! The text that says which faults a card has.

use std::str::FromStr;

use super::liar::CardLie;

/// Faults of a card and of its driver, parsed from text.
///
/// ```text
/// SPEC      = ITEM { "," ITEM }
/// ITEM      = CHANCE "=" P          P from 0 to 1
///           | COUNT "=" N           N a whole number
///           | STRIKE "=" N          the fault strikes after N bytes of both directions together
///           | "liar=" ( "magic" | "stream" | "protocol" | "capacity" | "beat" | "identity" | "report" | "index"
///                     | "length" | "endless" | "status" )
/// CHANCE    = "short-read" | "short-write"                  a transfer ends early, at a beat
///           | "stall"               a transfer waits for `stall-ms` before it begins
/// STRIKE    = "eio" | "errno-512"   the transfer fails at once
///           | "timeout"             the transfer stands still until the driver ends it
///           | "hang"                the transfer never returns
///           | "vanish"              the card falls off the bus: registers read as all ones, transfers fail with ENODEV
///           | "reset"               the card is reset, and no program is told
/// COUNT     = "times"               number of strikes, each after another N bytes; default 1
///           | "stall-ms"            default 20
///           | "timeout-ms"          time after which the driver ends a transfer; default 10,000, as in XDMA
///           | "seed"                default 1
/// ```
/// FUSE carries no error number from 512 on: through FUSE, `errno-512` and `timeout` become EIO.
#[derive(Clone, Debug, PartialEq)]
pub struct CardFaultSpec {
    /// Chance that a read ends early.
    pub short_read: f64,
    /// Chance that a write ends early.
    pub short_write: f64,
    /// Chance that a transfer waits before it begins, and for how many milliseconds.
    pub stall: (f64, u64),
    /// The fault that strikes after a number of bytes, and that number.
    pub strike: Option<(Strike, u64)>,
    /// Number of times that it strikes.
    pub times: u64,
    /// Milliseconds after which the driver ends a transfer that stands still.
    pub timeout_ms: u64,
    /// The lie that the card tells.
    pub lie: Option<CardLie>,
    /// Seed of the random generator.
    pub seed: u64,
}

/// A fault that strikes after a number of bytes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Strike {
    /// The transfer fails with EIO.
    Eio,
    /// The transfer fails with errno 512.
    Errno512,
    /// The transfer stands still until the driver ends it.
    Timeout,
    /// The transfer never returns.
    Hang,
    /// The card vanishes from the bus.
    Vanish,
    /// The card is reset without notice.
    Reset,
}

impl Strike {
    const ALL: [(Self, &'static str); 6] = [
        (Self::Eio, "eio"),
        (Self::Errno512, "errno-512"),
        (Self::Timeout, "timeout"),
        (Self::Hang, "hang"),
        (Self::Vanish, "vanish"),
        (Self::Reset, "reset"),
    ];

    fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|strike| strike.1 == name).map(|strike| strike.0)
    }
}

impl Default for CardFaultSpec {
    fn default() -> Self {
        Self {
            short_read: 0.0,
            short_write: 0.0,
            stall: (0.0, 20),
            strike: None,
            times: 1,
            timeout_ms: 10_000,
            lie: None,
            seed: 1,
        }
    }
}

/// The reason why a text is no [`CardFaultSpec`].
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum CardSpecError {
    /// An item of the text has no value.
    #[error("\"{0}\" has no value: write name=value, and commas between items")]
    NoValue(String),
    /// An item of the text is unknown.
    #[error("\"{0}\" is not a fault of a card: choose from {KNOWN}")]
    Unknown(String),
    /// A value is out of range or malformed.
    #[error("\"{name}\" must be {wanted}, not \"{value}\"")]
    Value {
        /// Name of the item.
        name: String,
        /// Description of a value that would be right.
        wanted: &'static str,
        /// The value in the text.
        value: String,
    },
    /// The text has a second fault that strikes after a number of bytes.
    #[error("\"{0}\" is the second fault that strikes after a number of bytes: choose one of the two")]
    Second(String),
}

/// Names of all items, for messages.
const KNOWN: &str = "short-read, short-write, stall, stall-ms, eio, errno-512, timeout, hang, vanish, reset, times, \
                     timeout-ms, liar, seed";

impl FromStr for CardFaultSpec {
    type Err = CardSpecError;

    fn from_str(text: &str) -> Result<Self, CardSpecError> {
        let mut spec = Self::default();
        for item in text.split(',').map(str::trim).filter(|item| !item.is_empty()) {
            let (name, value) = item.split_once('=').ok_or_else(|| CardSpecError::NoValue(item.to_owned()))?;
            let wants = |wanted| CardSpecError::Value { name: name.to_owned(), wanted, value: value.to_owned() };
            let chance = || {
                let parsed = value.parse::<f64>().ok().filter(|chance| (0.0..=1.0).contains(chance));
                parsed.ok_or_else(|| wants("a number from 0 to 1"))
            };
            let number = || value.parse::<u32>().map(u64::from).map_err(|_| wants("a whole number below 4294967296"));
            match (name, Strike::named(name)) {
                (_, Some(_)) if spec.strike.is_some() => return Err(CardSpecError::Second(name.to_owned())),
                (_, Some(strike)) => spec.strike = Some((strike, number()?)),
                ("short-read", _) => spec.short_read = chance()?,
                ("short-write", _) => spec.short_write = chance()?,
                ("stall", _) => spec.stall.0 = chance()?,
                ("stall-ms", _) => spec.stall.1 = number()?,
                ("times", _) => spec.times = number()?,
                ("timeout-ms", _) => spec.timeout_ms = number()?,
                ("seed", _) => spec.seed = number()?,
                ("liar", _) => spec.lie = Some(CardLie::named(value).ok_or_else(|| wants(CardLie::NAMES))?),
                _ => return Err(CardSpecError::Unknown(name.to_owned())),
            }
        }
        Ok(spec)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn items_are_read() {
        let spec: CardFaultSpec = "short-read=0.5, eio=4096,times=2,timeout-ms=300,seed=3,liar=index".parse().unwrap();
        assert_eq!((spec.short_read, spec.strike, spec.times), (0.5, Some((Strike::Eio, 4096)), 2));
        assert_eq!((spec.timeout_ms, spec.seed, spec.lie), (300, 3, Some(CardLie::Index)));
        for (strike, name) in Strike::ALL {
            assert_eq!(format!("{name}=7").parse::<CardFaultSpec>().unwrap().strike, Some((strike, 7)));
        }
        assert_eq!("".parse(), Ok(CardFaultSpec::default()));
    }

    #[test]
    fn what_is_no_fault_is_refused_with_a_reason() {
        for (text, sentence) in [
            ("eio", "\"eio\" has no value: write name=value"),
            ("stall=2", "\"stall\" must be a number from 0 to 1, not \"2\""),
            ("hang=-1", "\"hang\" must be a whole number"),
            ("eio=1,vanish=2", "\"vanish\" is the second fault"),
            ("gremlin=1", "\"gremlin\" is not a fault of a card: choose from short-read,"),
            ("liar=politics", "\"liar\" must be magic, stream,"),
        ] {
            let error = text.parse::<CardFaultSpec>().unwrap_err().to_string();
            assert!(error.contains(sentence), "{error}");
        }
    }
}
