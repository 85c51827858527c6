//! The text that says which faults a serial line has.

use std::str::FromStr;

use super::liar::Lie;
use super::Direction;

/// Faults of a serial line, parsed from text.
///
/// ```text
/// SPEC      = ITEM { "," ITEM }
/// ITEM      = CHANCE "=" P          P from 0 to 1
///           | COUNT "=" N           N a whole number
///           | "direction=" ( "to-device" | "to-host" | "both" )
///           | "liar=" ( "version" | "protocol" | "capacity" | "index" | "endless" | "credit" | "report" )
/// CHANCE    = "ber"                 each bit on the line, start and stop bits included, is flipped
///           | "drop" | "double" | "swap"                       each byte is lost, comes twice, comes after the next
///           | "drop-frame" | "double-frame" | "swap-frame"     the same for frames
///           | "truncate"            the end of a frame is lost, at least its last byte
///           | "babble"              up to 64 bytes of noise precede a frame
///           | "stall"               the line stands still for `stall-ms` before a frame
/// COUNT     = "stall-ms"            milliseconds of the board; default 20
///           | "silence-after"       nothing passes after N bytes of a direction,
///           | "silence-ms"          for N milliseconds of the board; default for ever
///           | "unplug-after"        the cable is pulled after N bytes of both directions together,
///           | "unplug-ms"           for N milliseconds of the host; default 500
///           | "seed"                seed of the random generator; default 1
/// ```
/// All items but `unplug-…` and `liar` hold for the directions that `direction` names; the default is both.
#[derive(Clone, Debug, PartialEq)]
pub struct FaultSpec {
    /// Chance that a bit on the line is flipped.
    pub ber: f64,
    /// Chances that a byte is lost, doubled, or swapped with the next.
    pub bytes: Chances,
    /// Chances that a frame is lost, doubled, or swapped with the next.
    pub frames: Chances,
    /// Chance that a frame loses its end.
    pub truncate: f64,
    /// Chance that noise precedes a frame.
    pub babble: f64,
    /// Chance that the line pauses before a frame, and the length of the pause in milliseconds of the board.
    pub stall: (f64, u64),
    /// Number of bytes after which nothing passes, and for how many milliseconds of the board; `None` means for ever.
    pub silence: Option<(u64, Option<u64>)>,
    /// Number of bytes after which the cable is pulled.
    pub unplug_after: Option<u64>,
    /// Milliseconds of the host for which the cable stays out.
    pub unplug_ms: u64,
    /// The lie that the device tells.
    pub lie: Option<Lie>,
    /// The only direction with faults; `None` means both.
    pub direction: Option<Direction>,
    /// Seed of the random generator.
    pub seed: u64,
}

/// Chances of the faults that can happen to a byte or to a frame.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Chances {
    /// Chance that the byte or frame is lost.
    pub drop: f64,
    /// Chance that the byte or frame comes twice.
    pub double: f64,
    /// Chance that the byte or frame comes after the next one.
    pub swap: f64,
}

impl Chances {
    fn any(self) -> bool {
        self.drop > 0.0 || self.double > 0.0 || self.swap > 0.0
    }
}

impl Default for FaultSpec {
    fn default() -> Self {
        Self {
            ber: 0.0,
            bytes: Chances::default(),
            frames: Chances::default(),
            truncate: 0.0,
            babble: 0.0,
            stall: (0.0, 20),
            silence: None,
            unplug_after: None,
            unplug_ms: 500,
            lie: None,
            direction: None,
            seed: 1,
        }
    }
}

impl FaultSpec {
    /// The faults of one direction. Each direction has a seed of its own, so that the two sequences of chances differ.
    pub(super) fn of(&self, direction: Direction) -> Self {
        let seed = 2 * self.seed + u64::from(direction == Direction::ToHost);
        if self.direction.is_none_or(|only| only == direction) {
            return Self { seed, ..self.clone() };
        }
        Self { seed, ..Self::default() }
    }

    /// Whether some fault concerns frames. Bytes then wait for the end of their frame.
    pub(super) fn holds_frames(&self) -> bool {
        self.frames.any() || self.truncate > 0.0 || self.babble > 0.0 || self.stall.0 > 0.0
    }
}

/// The reason why a text is no [`FaultSpec`].
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum SpecError {
    /// An item of the text has no value.
    #[error("\"{0}\" has no value: write name=value, and commas between items")]
    NoValue(String),
    /// An item of the text is unknown.
    #[error("\"{0}\" is not a fault: choose from {KNOWN}")]
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
    /// `silence-ms` was given without `silence-after`.
    #[error("\"silence-ms\" needs a beginning of the silence: give \"silence-after\" as well")]
    Silence,
}

/// Names of all items, for messages.
const KNOWN: &str =
    "ber, drop, double, swap, drop-frame, double-frame, swap-frame, truncate, babble, stall, stall-ms, \
                     silence-after, silence-ms, unplug-after, unplug-ms, direction, liar, seed";

impl FromStr for FaultSpec {
    type Err = SpecError;

    fn from_str(text: &str) -> Result<Self, SpecError> {
        let mut spec = Self::default();
        let mut silence_ms = None;
        for item in text.split(',').map(str::trim).filter(|item| !item.is_empty()) {
            let (name, value) = item.split_once('=').ok_or_else(|| SpecError::NoValue(item.to_owned()))?;
            let field = Field { name, value };
            match name {
                "ber" => spec.ber = field.chance()?,
                "drop" => spec.bytes.drop = field.chance()?,
                "double" => spec.bytes.double = field.chance()?,
                "swap" => spec.bytes.swap = field.chance()?,
                "drop-frame" => spec.frames.drop = field.chance()?,
                "double-frame" => spec.frames.double = field.chance()?,
                "swap-frame" => spec.frames.swap = field.chance()?,
                "truncate" => spec.truncate = field.chance()?,
                "babble" => spec.babble = field.chance()?,
                "stall" => spec.stall.0 = field.chance()?,
                "stall-ms" => spec.stall.1 = field.number()?,
                "silence-after" => spec.silence = Some((field.number()?, None)),
                "silence-ms" => silence_ms = Some(field.number()?),
                "unplug-after" => spec.unplug_after = Some(field.number()?),
                "unplug-ms" => spec.unplug_ms = field.number()?,
                "seed" => spec.seed = field.number()? & u64::from(u32::MAX),
                "direction" => spec.direction = field.direction()?,
                "liar" => spec.lie = Some(Lie::named(value).ok_or_else(|| field.wants(Lie::NAMES))?),
                _ => return Err(SpecError::Unknown(name.to_owned())),
            }
        }
        if let Some(length) = silence_ms {
            spec.silence.as_mut().ok_or(SpecError::Silence)?.1 = Some(length);
        }
        Ok(spec)
    }
}

/// An item of the text, split at its `=`.
struct Field<'a> {
    name: &'a str,
    value: &'a str,
}

impl Field<'_> {
    fn wants(&self, wanted: &'static str) -> SpecError {
        SpecError::Value { name: self.name.to_owned(), wanted, value: self.value.to_owned() }
    }

    fn chance(&self) -> Result<f64, SpecError> {
        let parsed = self.value.parse::<f64>().ok().filter(|chance| (0.0..=1.0).contains(chance));
        parsed.ok_or_else(|| self.wants("a number from 0 to 1"))
    }

    fn number(&self) -> Result<u64, SpecError> {
        // Thirty-two bits of milliseconds can be converted to nanoseconds and clocks without overflow.
        let parsed = self.value.parse::<u32>().map(u64::from);
        parsed.map_err(|_| self.wants("a whole number below 4294967296"))
    }

    fn direction(&self) -> Result<Option<Direction>, SpecError> {
        match self.value {
            "to-device" => Ok(Some(Direction::ToDevice)),
            "to-host" => Ok(Some(Direction::ToHost)),
            "both" => Ok(None),
            _ => Err(self.wants("to-device, to-host or both")),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn items_are_read() {
        let spec: FaultSpec = "ber=1e-5, drop-frame=0.01,seed=3,direction=to-host,silence-after=99".parse().unwrap();
        assert_eq!((spec.ber, spec.frames.drop, spec.seed), (1e-5, 0.01, 3));
        assert_eq!((spec.direction, spec.silence), (Some(Direction::ToHost), Some((99, None))));
        assert_eq!(spec.of(Direction::ToDevice), FaultSpec { seed: 6, ..FaultSpec::default() });
        assert_eq!(spec.of(Direction::ToHost).ber, 1e-5);
        let spec: FaultSpec = "silence-ms=7,silence-after=9,liar=index,unplug-after=1000".parse().unwrap();
        assert_eq!((spec.silence, spec.lie), (Some((9, Some(7))), Some(Lie::Index)));
        assert_eq!((spec.unplug_after, spec.unplug_ms), (Some(1000), 500));
        assert_eq!("".parse(), Ok(FaultSpec::default()));
    }

    #[test]
    fn what_is_no_fault_is_refused_with_a_reason() {
        for (text, sentence) in [
            ("ber", "\"ber\" has no value: write name=value, and commas between items"),
            ("ber=2", "\"ber\" must be a number from 0 to 1, not \"2\""),
            ("drop=NaN", "\"drop\" must be a number from 0 to 1, not \"NaN\""),
            ("seed=-1", "\"seed\" must be a whole number below 4294967296, not \"-1\""),
            ("direction=up", "\"direction\" must be to-device, to-host or both, not \"up\""),
            ("silence-ms=5", "give \"silence-after\" as well"),
            ("gremlin=1", "\"gremlin\" is not a fault: choose from ber, drop,"),
            ("liar=politics", "\"liar\" must be version, protocol,"),
        ] {
            let error = text.parse::<FaultSpec>().unwrap_err().to_string();
            assert!(error.contains(sentence), "{error}");
        }
    }
}
