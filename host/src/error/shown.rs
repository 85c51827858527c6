//! Floating-point values in messages.

use std::fmt;

/// A floating-point value as messages show it.
///
/// Values below 1e-6 and from 1e15 on are in scientific form: their plain digits would be a long row of zeros.
///
/// ```
/// use incircle::Shown;
/// assert_eq!(Shown(-0.5).to_string(), "-0.5");
/// assert_eq!(Shown(1e300).to_string(), "1e300");
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shown(pub f64);

impl fmt::Display for Shown {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self(value) = self;
        if *value == 0.0 || !value.is_finite() || (1e-6..1e15).contains(&value.abs()) {
            write!(f, "{value}")
        } else {
            write!(f, "{value:e}")
        }
    }
}
