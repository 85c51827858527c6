//! The drawing of the rows as bars.

use std::fmt::Write as _;

use super::row::Row;

/// Height of a bar, and width of the names and of the longest bar, in pixels.
const BAR: usize = 16;
const NAMES: usize = 240;
const LONGEST: f64 = 360.0;

/// A column of bars: its name, the length of a bar, and the number beside the bar.
type Column = (&'static str, fn(&Row) -> f64, fn(&Row) -> f64);

const DRAWN: [Column; 2] = [
    ("triangles walked per insertion (bars: square root)", |row| row.walk.sqrt(), |row| row.walk),
    ("ns per point in all", |row| row.total_ns, |row| row.total_ns),
];

/// The pixel at which a column begins.
const fn left(column: usize) -> usize {
    NAMES + column * (LONGEST as usize + 80)
}

/// Adds words to the drawing. Writing to a string cannot fail.
fn say(text: &mut String, x: usize, y: usize, words: &str) {
    let _ = writeln!(text, "<text x=\"{x}\" y=\"{y}\">{words}</text>");
}

/// Draws bars for each set: walk steps on the left, total nanoseconds on the right.
pub fn draw(rows: &[Row]) -> String {
    let groups: Vec<&[Row]> = rows.chunk_by(|one, other| one.set == other.set && one.asked == other.asked).collect();
    let (width, height) = (left(DRAWN.len()), BAR * (rows.len() + 2 * groups.len() + 2));
    let mut text = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" font-family=\"sans-serif\" \
         font-size=\"12\">\n<rect width=\"100%\" height=\"100%\" fill=\"#fdfcf9\"/>\n"
    );
    let mut y = BAR;
    for (column, (name, ..)) in DRAWN.iter().enumerate() {
        say(&mut text, left(column), y, name);
    }
    for group in groups {
        y += 2 * BAR;
        let title = group.first().map_or_else(String::new, |row| format!("{}, {} points", row.set, row.points));
        say(&mut text, 8, y, &title);
        for row in group {
            y += BAR;
            say(&mut text, 16, y, row.order.name());
            draw_bars(&mut text, row, rows, y);
        }
    }
    text + "</svg>\n"
}

/// Draws the bars of one row. The length of a bar is in proportion to the longest bar of its column.
fn draw_bars(text: &mut String, row: &Row, rows: &[Row], y: usize) {
    for (column, (_, length, number)) in DRAWN.iter().enumerate() {
        let longest = rows.iter().map(length).fold(f64::MIN_POSITIVE, f64::max);
        let (x, bar) = (left(column), LONGEST * length(row) / longest);
        let (top, thick) = (y - BAR + 5, BAR - 4);
        let _ = writeln!(text, "<rect x=\"{x}\" y=\"{top}\" width=\"{bar:.1}\" height=\"{thick}\" fill=\"#2a8c98\"/>");
        say(text, x + bar as usize + 4, y, &format!("{:.1}", number(row)));
    }
}
