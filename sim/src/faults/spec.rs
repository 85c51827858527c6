//! Which faults there are to be.

use std::str::FromStr;

use super::liar::Lie;
use super::Direction;

/// Faults of a line, parsed from text.
///
/// ```text
/// SPEC      = ITEM { "," ITEM }
/// ITEM      = CHANCE "=" P          P from 0 to 1
///           | COUNT "=" N           N a whole number
///           | "direction=" ( "to-device" | "to-host" | "both" )
///           | "liar=" ( "version" | "protocol" | "capacity" | "index" | "endless" | "credit" | "report" )
/// CHANCE    = "ber"                 each bit on the line, start and stop included, is the other way
///           | "drop" | "double" | "swap"                       each byte is lost, comes twice, comes after the next
///           | "drop-frame" | "double-frame" | "swap-frame"     the same of frames
///           | "truncate"            the end of a frame is lost, at least its last byte
///           | "babble"              up to 64 bytes of noise stand before a frame
///           | "stall"               before a frame the line stands still for `stall-ms`
/// COUNT     = "stall-ms"            of the board's time, 20 unless said
///           | "silence-after"       nothing passes behind so many bytes of a direction,
///           | "silence-ms"          for so long, or for ever
///           | "unplug-after"        the cable is pulled after so many bytes of both directions,
///           | "unplug-ms"           for so long, in the host's time; 500 unless said
///           | "seed"                1 unless said
/// ```
/// All but `unplug-…` and `liar` hold for the directions that `direction` names, both unless said.
#[derive(Clone, Debug, PartialEq)]
pub struct FaultSpec {
    /// Chance of a bit to be the other way.
    pub ber: f64,
    /// Chances of a byte to be lost, doubled, swapped with the next.
    pub bytes: Chances,
    /// The same of a frame.
    pub frames: Chances,
    /// Chance of a frame to lose its end.
    pub truncate: f64,
    /// Chance of noise before a frame.
    pub babble: f64,
    /// Chance of a pause before a frame, and its length in milliseconds of the board.
    pub stall: (f64, u64),
    /// Bytes after which nothing passes, and for how many milliseconds of the board.
    pub silence: Option<(u64, Option<u64>)>,
    /// Bytes after which the cable is pulled.
    pub unplug_after: Option<u64>,
    /// Milliseconds of the host for which it is.
    pub unplug_ms: u64,
    /// What the device lies about.
    pub lie: Option<Lie>,
    /// The only direction with faults.
    pub direction: Option<Direction>,
    /// Of the chances.
    pub seed: u64,
}

/// Chances of what can happen to bytes and to frames.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Chances {
    /// It is lost.
    pub drop: f64,
    /// It comes twice.
    pub double: f64,
    /// It comes after the next.
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
    /// What happens on the way in this direction.
    pub(super) fn of(&self, direction: Direction) -> Self {
        let seed = 2 * self.seed + u64::from(direction == Direction::ToHost);
        if self.direction.is_none_or(|only| only == direction) {
            return Self { seed, ..self.clone() };
        }
        Self { seed, ..Self::default() }
    }

    /// Frames are looked at, so bytes wait for the end of theirs.
    pub(super) fn holds_frames(&self) -> bool {
        self.frames.any() || self.truncate > 0.0 || self.babble > 0.0 || self.stall.0 > 0.0
    }
}

/// A text that is no [`FaultSpec`].
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum SpecError {
    /// An item without a value.
    #[error("\"{0}\" has no value: write name=value, with commas between")]
    NoValue(String),
    /// An unknown item.
    #[error("\"{0}\" is no fault: there are {KNOWN}")]
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
    /// A length without what it is the length of.
    #[error("\"silence-ms\" says for how long nothing passes: say \"silence-after\" as well")]
    Silence,
}

/// All items.
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

/// An item of the text.
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
        // Milliseconds of this size can be turned into clocks.
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
            ("ber", "\"ber\" has no value: write name=value, with commas between"),
            ("ber=2", "\"ber\" wants a number from 0 to 1, not \"2\""),
            ("drop=NaN", "\"drop\" wants a number from 0 to 1, not \"NaN\""),
            ("seed=-1", "\"seed\" wants a whole number below 4294967296, not \"-1\""),
            ("direction=up", "\"direction\" wants to-device, to-host or both, not \"up\""),
            ("silence-ms=5", "say \"silence-after\" as well"),
            ("gremlin=1", "\"gremlin\" is no fault: there are ber, drop,"),
            ("liar=politics", "\"liar\" wants version, protocol,"),
        ] {
            let error = text.parse::<FaultSpec>().unwrap_err().to_string();
            assert!(error.contains(sentence), "{error}");
        }
    }
}
