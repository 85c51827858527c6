//! Which faults a card is to have.

use std::str::FromStr;

use super::liar::CardLie;

/// Faults of a card and of its driver, parsed from text.
///
/// ```text
/// SPEC      = ITEM { "," ITEM }
/// ITEM      = CHANCE "=" P          P from 0 to 1
///           | COUNT "=" N           N a whole number
///           | STRIKE "=" N          what happens after N bytes of both directions
///           | "liar=" ( "magic" | "stream" | "protocol" | "capacity" | "beat" | "identity" | "report" | "index" | "length" | "endless"
///                     | "status" )
/// CHANCE    = "short-read" | "short-write"                  a transfer ends early, at a beat
///           | "stall"               a transfer waits for `stall-ms` before it begins
/// STRIKE    = "eio" | "errno-512"   the transfer fails at once
///           | "timeout"             it stands still until the driver gives up on it
///           | "hang"                it never returns
///           | "vanish"              the card falls off the bus: registers read as all ones, transfers fail with ENODEV
///           | "reset"               the card is reset, and nobody is told
/// COUNT     = "times"               how often that happens, each time after so many bytes; once unless said
///           | "stall-ms"            20 unless said
///           | "timeout-ms"          after which the driver gives up on a transfer, 10,000 unless said, as XDMA's
///           | "seed"                1 unless said
/// ```
/// FUSE carries no errno from 512 on: behind it, `errno-512` and `timeout` are EIO.
#[derive(Clone, Debug, PartialEq)]
pub struct CardFaultSpec {
    /// Chance of a read to end early.
    pub short_read: f64,
    /// Chance of a write to.
    pub short_write: f64,
    /// Chance of a transfer to wait, and for how many milliseconds.
    pub stall: (f64, u64),
    /// What happens after how many bytes, and how often.
    pub strike: Option<(Strike, u64)>,
    /// How often it happens.
    pub times: u64,
    /// Milliseconds after which the driver gives up on a transfer.
    pub timeout_ms: u64,
    /// What the card lies about.
    pub lie: Option<CardLie>,
    /// Of the chances.
    pub seed: u64,
}

/// What happens once in a while.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Strike {
    /// A transfer fails with EIO.
    Eio,
    /// A transfer fails with errno 512.
    Errno512,
    /// A transfer stands still until the driver gives up.
    Timeout,
    /// A transfer never returns.
    Hang,
    /// The card is gone.
    Vanish,
    /// The card is reset.
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

/// A text that is no [`CardFaultSpec`].
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum CardSpecError {
    /// An item without a value.
    #[error("\"{0}\" has no value: write name=value, with commas between")]
    NoValue(String),
    /// An unknown item.
    #[error("\"{0}\" is no fault of a card: there are {KNOWN}")]
    Unknown(String),
    /// A value that does not fit.
    #[error("\"{name}\" wants {wanted}, not \"{value}\"")]
    Value {
        /// The item.
        name: String,
        /// What would be right.
        wanted: &'static str,
        /// What was given.
        value: String,
    },
    /// Two things that happen after so many bytes.
    #[error("\"{0}\" is the second fault that happens after so many bytes: choose one")]
    Second(String),
}

/// All items.
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
            ("stall=2", "\"stall\" wants a number from 0 to 1, not \"2\""),
            ("hang=-1", "\"hang\" wants a whole number"),
            ("eio=1,vanish=2", "\"vanish\" is the second fault"),
            ("gremlin=1", "\"gremlin\" is no fault of a card: there are short-read,"),
            ("liar=politics", "\"liar\" wants magic, stream,"),
        ] {
            let error = text.parse::<CardFaultSpec>().unwrap_err().to_string();
            assert!(error.contains(sentence), "{error}");
        }
    }
}
