//! JSON in pieces: the values of objects and lists as the texts that they are.
//!
//! So numbers stay as they are written, and a file takes no memory beside its text and its points. Nesting costs no
//! stack here, because the parser skips over a value without a call for each bracket.

use std::fmt;

use serde::de::{Deserializer, Error, IgnoredAny, MapAccess, SeqAccess, Visitor};
use serde_json::value::RawValue;

use crate::failure::{one_line, Failure};

/// The values that an object has under these names. Of equal names, the last one counts. All of the text must be JSON.
pub fn fields<'a, const N: usize>(
    text: &'a str,
    names: [&'static str; N],
) -> Result<[Option<&'a str>; N], serde_json::Error> {
    let mut parser = serde_json::Deserializer::from_str(text);
    let found = parser.deserialize_map(Fields { names }).and_then(|found| parser.end().map(|()| found));
    // A text that is no JSON is told before a value that is no object.
    found.map_err(|error| serde_json::from_str::<IgnoredAny>(text).err().unwrap_or(error))
}

/// Whether a value is a list.
pub fn is_list(text: &str) -> bool {
    text.starts_with('[')
}

/// Whether a value is a number.
pub fn is_number(text: &str) -> bool {
    text.starts_with(|first: char| first == '-' || first.is_ascii_digit())
}

/// The content of a value that is a string.
pub fn string(text: &str) -> Option<String> {
    serde_json::from_str(text).ok()
}

/// The first three numbers of a list, and how many it has; `None` if the value is anything but a list of numbers.
pub fn numbers(text: &str) -> Option<([&str; 3], usize)> {
    let mut numbers = [""; 3];
    let mut count = 0;
    let mut are_numbers = is_list(text);
    if are_numbers {
        let read = each(text, |index, item| {
            are_numbers &= is_number(item);
            count = index + 1;
            if let Some(number) = numbers.get_mut(index) {
                *number = item;
            }
            Ok(())
        });
        are_numbers &= read.is_ok();
    }
    are_numbers.then_some((numbers, count))
}

/// Calls `take` with each item of a list and its index, until `take` fails.
pub fn each<'a>(text: &'a str, mut take: impl FnMut(usize, &'a str) -> Result<(), Failure>) -> Result<(), Failure> {
    let mut refusal = None;
    let items = Items { take: &mut take, refusal: &mut refusal };
    let read = serde_json::Deserializer::from_str(text).deserialize_seq(items);
    match (refusal, read) {
        (Some(failure), _) => Err(failure),
        (None, read) => read.map_err(|error| refuse(&error)),
    }
}

/// The failure of a text that is no JSON.
pub fn refuse(error: &serde_json::Error) -> Failure {
    Failure::input(format!("not JSON: {}", one_line(&error.to_string())))
}

struct Fields<const N: usize> {
    names: [&'static str; N],
}

impl<'de, const N: usize> Visitor<'de> for Fields<N> {
    type Value = [Option<&'de str>; N];

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("an object")
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Self::Value, A::Error> {
        let mut found = [None; N];
        while let Some(name) = map.next_key::<String>()? {
            match self.names.iter().position(|known| *known == name) {
                Some(index) => found[index] = Some(map.next_value::<&RawValue>()?.get()),
                None => {
                    map.next_value::<IgnoredAny>()?;
                }
            }
        }
        Ok(found)
    }
}

struct Items<'t, 'de> {
    take: &'t mut dyn FnMut(usize, &'de str) -> Result<(), Failure>,
    refusal: &'t mut Option<Failure>,
}

impl<'de> Visitor<'de> for Items<'_, 'de> {
    type Value = ();

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a list")
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<(), A::Error> {
        let mut index = 0;
        while let Some(item) = list.next_element::<&RawValue>()? {
            if let Err(failure) = (self.take)(index, item.get()) {
                *self.refusal = Some(failure);
                return Err(A::Error::custom("the item was refused"));
            }
            index += 1;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_stay_as_they_are_written() {
        let text = r#" {"a":[1.50, -0], "n\u0061me":9223372036854775808,"a":[2.0,[]] , "b":{"a":1}} "#;
        assert_eq!(fields(text, ["a", "name", "c"]).ok(), Some([Some("[2.0,[]]"), Some("9223372036854775808"), None]));
        let mut items = Vec::new();
        each("[1.50, [2,3] ,null]", |index, item| {
            items.push((index, item));
            Ok(())
        })
        .expect("a list");
        assert_eq!(items, [(0, "1.50"), (1, "[2,3]"), (2, "null")]);
        let refused = each("[1,2]", |index, _| if index == 0 { Ok(()) } else { Err(Failure::input("two")) });
        assert_eq!(refused.map_err(|failure| failure.message), Err("two".to_owned()));
    }

    #[test]
    fn all_of_a_text_must_be_json() {
        for wrong in
            ["", "{", "[]", "{} 1", r#"{"a":01}"#, r#"{"a":[1,]}"#, r#"{"a":1,}"#, r#"{"b":tru}"#, "{\"b\":\"\n\"}"]
        {
            assert!(fields(wrong, ["a"]).is_err(), "{wrong}");
        }
        let deep = format!("{{\"a\":{}{}}}", "[".repeat(100_000), "]".repeat(100_000));
        assert!(fields(&deep, ["a"]).is_ok_and(|[value]| value.is_some_and(is_list)));
    }
}
