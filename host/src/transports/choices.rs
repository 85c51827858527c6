//! Addresses with choices behind a question mark: `name?key=value&key=value`.

use std::ops::RangeInclusive;

/// An address, split into a name and its choices.
pub(crate) struct Choices<'a> {
    /// Text before the question mark.
    pub(crate) name: &'a str,
    items: &'a str,
}

impl<'a> Choices<'a> {
    /// Splits an address at its question mark.
    pub(crate) fn of(text: &'a str) -> Self {
        let (name, items) = text.split_once('?').unwrap_or((text, ""));
        Self { name, items }
    }

    /// The choices in the order of the text. A key without `=` has an empty value.
    ///
    /// # Errors
    /// A sentence that does not repeat the address, if a key stands twice: nobody can say which value was meant.
    pub(crate) fn items(&self) -> Result<Vec<Choice<'a>>, String> {
        let mut choices: Vec<Choice<'a>> = Vec::new();
        for item in self.items.split('&').filter(|item| !item.is_empty()) {
            let (key, value) = item.split_once('=').unwrap_or((item, ""));
            if choices.iter().any(|choice| choice.key == key) {
                return Err(format!("\"{key}\" stands twice: give it once"));
            }
            choices.push(Choice { key, value });
        }
        Ok(choices)
    }
}

/// A key with its value.
#[derive(Clone, Copy)]
pub(crate) struct Choice<'a> {
    pub(crate) key: &'a str,
    pub(crate) value: &'a str,
}

impl Choice<'_> {
    /// The value as a number in this range.
    ///
    /// # Errors
    /// A sentence that does not repeat the address.
    pub(crate) fn number(self, range: RangeInclusive<u32>) -> Result<u32, String> {
        let Self { key, value } = self;
        let parsed = value.parse().ok().filter(|number| range.contains(number));
        let (least, most) = range.into_inner();
        parsed.ok_or_else(|| format!("\"{key}\" must be a whole number from {least} to {most}, not \"{value}\""))
    }

    /// Whether the value is `yes`, and not `no`.
    ///
    /// # Errors
    /// A sentence that does not repeat the address, for any other value.
    pub(crate) fn yes(self) -> Result<bool, String> {
        match self.value {
            "yes" => Ok(true),
            "no" => Ok(false),
            other => Err(format!("\"{}\" must be \"yes\" or \"no\", not \"{other}\"", self.key)),
        }
    }

    /// The sentence of an error for a key that is not one of `known`.
    pub(crate) fn unknown(self, known: &[&str]) -> String {
        let known: Vec<String> = known.iter().map(|key| format!("\"{key}\"")).collect();
        let are = if known.len() == 1 { "is" } else { "are" };
        format!("\"{}\" is unknown; {} {are} known", self.key, known.join(" and "))
    }
}
