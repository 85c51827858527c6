//! WKT, well-known text: `POINT (x y)` and `MULTIPOINT ((x y), (x y))`, and in plans lines and polygons, which can only
//! be read.
//!
//! A file holds any number of geometries, one after the other, also in a `GEOMETRYCOLLECTION`. Letters may be small or
//! capital; `Z`, `M` and `ZM` stand behind the name of the geometry or not at all; `SRID=4326;` before a geometry, as
//! PostGIS writes it, is ignored, and so is an `EMPTY` geometry. Every position of a `LINESTRING` or `POLYGON` is a
//! point; where only points are wanted, these are refused, and all others always. The numbers are taken as they are
//! written. Libraries for WKT make doubles of the numbers, so this module uses none.
//!
//! Source: OGC 06-103r4, "Simple feature access, part 1", chapter 7.

use crate::failure::{quoted, Failure};
use crate::formats::plan::PlanTable;
use crate::memory::Memory;
use crate::points::PointTable;
use crate::text;

/// Reads the points of all geometries.
pub fn read_points(bytes: &[u8], memory: Memory) -> Result<PointTable, Failure> {
    read(bytes, PlanTable::new(memory, true)).map(|plan| plan.table)
}

/// Reads the points and the constraints of all geometries.
pub fn read_plan(bytes: &[u8], memory: Memory) -> Result<PlanTable, Failure> {
    read(bytes, PlanTable::new(memory, false))
}

fn read(bytes: &[u8], mut plan: PlanTable) -> Result<PlanTable, Failure> {
    let bytes = text::without_mark(bytes)?;
    let mut tokens = Tokens { all: bytes, at: 0 };
    // The number of collections that are open.
    let mut depth = 0usize;
    while let Some(word) = tokens.next() {
        match word {
            b")" if depth > 0 => {
                depth -= 1;
                continue_list(&mut tokens, depth)?;
            }
            _ if word.eq_ignore_ascii_case(b"GEOMETRYCOLLECTION") => {
                if open(&mut tokens)?.is_some() {
                    depth += 1;
                } else {
                    continue_list(&mut tokens, depth)?;
                }
            }
            _ => {
                read_geometry(&mut tokens, word, &mut plan)?;
                continue_list(&mut tokens, depth)?;
            }
        }
    }
    if depth > 0 {
        return Err(tokens.unexpected("')' or another geometry of the collection"));
    }
    plan.complete()
}

/// The meaning of the numbers that a point has behind x and y.
#[derive(Clone, Copy, PartialEq)]
enum Dimensions {
    /// No letter is given, so a third number is z.
    Unsaid,
    /// A measure, which is not read.
    Measure,
    /// A z, and perhaps a measure.
    Height,
}

/// Takes the comma between two geometries of a collection, behind which another one must stand. Outside a collection
/// nothing stands between two geometries.
fn continue_list(tokens: &mut Tokens<'_>, depth: usize) -> Result<(), Failure> {
    if depth == 0 || tokens.peek() == Some(b")") {
        return Ok(());
    }
    tokens.expect(b",", "',' or ')'")?;
    if tokens.peek() == Some(b")") {
        return Err(tokens.unexpected("another geometry of the collection"));
    }
    Ok(())
}

/// Takes the letters behind the name of a geometry, and the opening parenthesis; `None` for an empty geometry.
fn open(tokens: &mut Tokens<'_>) -> Result<Option<Dimensions>, Failure> {
    let mut dimensions = Dimensions::Unsaid;
    for (letters, meaning) in [("ZM", Dimensions::Height), ("Z", Dimensions::Height), ("M", Dimensions::Measure)] {
        if tokens.take_word(letters) {
            dimensions = meaning;
            break;
        }
    }
    if tokens.take_word("EMPTY") {
        return Ok(None);
    }
    tokens.expect(b"(", "'(' or EMPTY")?;
    Ok(Some(dimensions))
}

/// Reads one geometry, whose first word has been taken.
fn read_geometry<'a>(tokens: &mut Tokens<'a>, mut word: &'a [u8], plan: &mut PlanTable) -> Result<(), Failure> {
    if word.eq_ignore_ascii_case(b"SRID") {
        tokens.expect(b"=", "'=' and a number")?;
        tokens.next();
        tokens.expect(b";", "';' behind the number of the SRID")?;
        word = tokens.next().unwrap_or_default();
    }
    // Some programs join the letters to the name: POINTZ.
    let name = word.to_ascii_uppercase();
    let (name, attached) = match name.as_slice() {
        [name @ .., b'Z', b'M'] | [name @ .., b'Z'] => (name, Dimensions::Height),
        [name @ .., b'M'] => (name, Dimensions::Measure),
        name => (name, Dimensions::Unsaid),
    };
    let is_line = LINES.contains(&name);
    if name != b"POINT" && name != b"MULTIPOINT" && (!is_line || plan.takes_only_points()) {
        let (row, word) = (tokens.row(), quoted(word));
        return Err(Failure::input(match plan.takes_only_points() {
            true => format!(
                "row {row}: {word} is neither POINT nor MULTIPOINT nor a collection of them: other geometries are no \
                 points"
            ),
            false => format!("row {row}: {word} is no geometry of points, lines or polygons"),
        }));
    }
    let Some(dimensions) = open(tokens)? else {
        return Ok(());
    };
    let dimensions = if attached == Dimensions::Unsaid { dimensions } else { attached };
    match name {
        b"POINT" => {
            read_point(tokens, dimensions, &mut plan.table)?;
            tokens.expect(b")", "')' behind the numbers of the point")
        }
        b"MULTIPOINT" => read_multiple(tokens, dimensions, &mut plan.table),
        name => read_lines(name, tokens, dimensions, plan),
    }
}

/// The names of the geometries that have constraints.
const LINES: [&[u8]; 4] = [b"LINESTRING", b"MULTILINESTRING", b"POLYGON", b"MULTIPOLYGON"];

/// Reads what is between the parentheses of a geometry of lines or polygons, and the closing one.
fn read_lines(
    name: &[u8],
    tokens: &mut Tokens<'_>,
    dimensions: Dimensions,
    plan: &mut PlanTable,
) -> Result<(), Failure> {
    let inner: &[u8] = match name {
        b"MULTILINESTRING" => b"LINESTRING",
        b"POLYGON" => b"RING",
        b"MULTIPOLYGON" => b"POLYGON",
        _ => return read_chain(name, tokens, dimensions, plan),
    };
    if name == b"POLYGON" {
        plan.begin_polygon();
    }
    loop {
        if !tokens.take_word("EMPTY") {
            tokens.expect(b"(", "'(' or EMPTY")?;
            read_lines(inner, tokens, dimensions, plan)?;
        }
        if !tokens.take(b",") {
            return tokens.expect(b")", "',' or ')'");
        }
    }
}

/// Reads the points of a line or ring, and the closing parenthesis.
fn read_chain(
    name: &[u8],
    tokens: &mut Tokens<'_>,
    dimensions: Dimensions,
    plan: &mut PlanTable,
) -> Result<(), Failure> {
    let first = plan.table.len();
    loop {
        read_point(tokens, dimensions, &mut plan.table)?;
        if !tokens.take(b",") {
            break;
        }
    }
    tokens.expect(b")", "',' or ')'")?;
    // Counting the rows up to each ring would take quadratic time, so only a message does.
    let what = || format!("row {}", tokens.row());
    if name == b"RING" {
        plan.add_ring(first, what)
    } else {
        plan.add_line(first, what)
    }
}

/// Reads the points of a `MULTIPOINT` and the closing parenthesis.
fn read_multiple(tokens: &mut Tokens<'_>, dimensions: Dimensions, table: &mut PointTable) -> Result<(), Failure> {
    loop {
        // Each point has parentheses of its own, or none.
        if tokens.take(b"(") {
            read_point(tokens, dimensions, table)?;
            tokens.expect(b")", "')' behind the numbers of the point")?;
        } else if !tokens.take_word("EMPTY") {
            read_point(tokens, dimensions, table)?;
        }
        if !tokens.take(b",") {
            return tokens.expect(b")", "',' or ')'");
        }
    }
}

/// Reads two to four numbers.
fn read_point(tokens: &mut Tokens<'_>, dimensions: Dimensions, table: &mut PointTable) -> Result<(), Failure> {
    let mut numbers = [&b""[..]; 4];
    let mut count = 0;
    for number in &mut numbers {
        match tokens.peek() {
            Some(word) if !word.first().is_some_and(is_sign) => *number = word,
            _ => break,
        }
        tokens.next();
        count += 1;
    }
    if count < 2 {
        let row = tokens.row();
        return Err(Failure::input(format!("row {row}: a point needs two numbers or more, but this one has {count}")));
    }
    // The table names points by their numbers; counting the rows up to each point would take quadratic time.
    table.push([numbers[0], numbers[1]], 0)?;
    // A point that the letter Z promises a height needs one.
    let has_height = dimensions == Dimensions::Height || count > 2 && dimensions == Dimensions::Unsaid;
    table.push_height(has_height.then_some(numbers[2]), 0)
}

/// Whether a byte is a token by itself.
fn is_sign(byte: &u8) -> bool {
    b"(),;=".contains(byte)
}

/// The words, numbers and signs of a text.
struct Tokens<'a> {
    all: &'a [u8],
    at: usize,
}

impl<'a> Tokens<'a> {
    /// The next token without taking it; `None` at the end.
    fn peek(&mut self) -> Option<&'a [u8]> {
        let rest = self.all.get(self.at..)?.trim_ascii_start();
        self.at = self.all.len() - rest.len();
        let len = match rest.first() {
            None => return None,
            Some(byte) if is_sign(byte) => 1,
            Some(_) => rest.iter().position(|byte| is_sign(byte) || byte.is_ascii_whitespace()).unwrap_or(rest.len()),
        };
        Some(&rest[..len])
    }

    /// Takes the next token.
    fn next(&mut self) -> Option<&'a [u8]> {
        let token = self.peek()?;
        self.at += token.len();
        Some(token)
    }

    /// Takes the next token if it is this sign.
    fn take(&mut self, sign: &[u8]) -> bool {
        let is_next = self.peek() == Some(sign);
        self.at += if is_next { sign.len() } else { 0 };
        is_next
    }

    /// Takes the next token if it is this word, in small or capital letters.
    fn take_word(&mut self, word: &str) -> bool {
        let is_next = self.peek().is_some_and(|token| token.eq_ignore_ascii_case(word.as_bytes()));
        self.at += if is_next { word.len() } else { 0 };
        is_next
    }

    /// Takes the next token, which must be this sign.
    fn expect(&mut self, sign: &[u8], what: &str) -> Result<(), Failure> {
        if self.take(sign) {
            return Ok(());
        }
        Err(self.unexpected(what))
    }

    /// The failure of a token that is not what the grammar wants.
    fn unexpected(&mut self, what: &str) -> Failure {
        let found = self.peek().map_or_else(|| "the end of the file".to_owned(), quoted);
        Failure::input(format!("row {}: expected {what}, but found {found}", self.row()))
    }

    /// The row of the next token, counted from 1.
    fn row(&self) -> usize {
        let before = self.all.get(..self.at).unwrap_or_default();
        1 + memchr::memchr_iter(b'\n', before).count()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_spellings_are_read() {
        let text = b"POINT(1 2)\nSRID=4326;point z (3 4.50 -5e0)\nMULTIPOINT ((-1 2), EMPTY, (3 4 9))\n\
                     MultiPointZM(5 6 7 8,9 10 11 12) POINT EMPTY\nGEOMETRYCOLLECTION M (POINT M (1 1 1),\n \
                     GEOMETRYCOLLECTION EMPTY, GEOMETRYCOLLECTION (MULTIPOINT(2 3)))\n";
        let table = read_points(text, Memory::ENDLESS).expect("well-known text");
        let found: Vec<[f64; 2]> = table.doubles().to_vec();
        let expected = [[1., 2.], [3., 4.5], [-1., 2.], [3., 4.], [5., 6.], [9., 10.], [1., 1.], [2., 3.]];
        assert_eq!(found, expected);
        assert!(read_points(b"", Memory::ENDLESS).expect("no points").is_empty());
        assert!(read_points(b"POINT EMPTY", Memory::ENDLESS).expect("no points").is_empty());
    }

    #[test]
    fn heights_are_kept_and_measures_are_not() {
        let heights = |text: &str| read_points(text.as_bytes(), Memory::ENDLESS).expect("points").heights().to_vec();
        assert_eq!(heights("POINT (1 2 3) POINT Z (4 5 6) POINTZM (1 2 7 9)"), [3.0, 6.0, 7.0]);
        assert!(heights("POINT M (1 2 3)").is_empty());
        assert!(heights("POINTM (1 2 3)").is_empty());
    }

    #[test]
    fn wrong_texts_are_refused_with_their_row() {
        for (text, part) in [
            ("POINT (1 2)\nLINESTRING (1 2, 3 4)", "row 2: 'LINESTRING' is neither POINT"),
            ("POINT (1)", "row 1: a point needs two numbers or more, but this one has 1"),
            ("POINT (1 2", "row 1: expected ')' behind the numbers of the point, but found the end of the file"),
            ("POINT 1 2", "row 1: expected '(' or EMPTY, but found '1'"),
            ("POINT (1 2 3 4 5)", "behind the numbers of the point, but found '5'"),
            ("POINT (1 x)", "point 1, y: 'x' is not a number"),
            ("MULTIPOINT (1 2; 3 4)", "but found ';'"),
            ("GEOMETRYCOLLECTION (POINT (1 2)", "expected ',' or ')'"),
            ("GEOMETRYCOLLECTION (", "another geometry of the collection"),
            ("GEOMETRYCOLLECTION (POINT (1 2),)", "row 1: expected another geometry of the collection"),
            ("SRID=4326 POINT (1 2)", "expected ';'"),
            (")", "row 1: ')' is neither"),
            ("POINT (nan 1)", "not a finite number"),
            ("POINT (1 2 x)", "point 1, z: 'x' is not a number"),
            ("POINT Z (1 2)", "point 1, z: the value is missing"),
        ] {
            let failure = read_points(text.as_bytes(), Memory::ENDLESS).expect_err(text);
            assert!(failure.message.contains(part), "{text}: {failure}");
        }
    }
}
