//! The published ranking of orders beside our measurements.
//!
//! Schrijvers, van Bommel, Buchin, *Delaunay triangulations on the word RAM*, EuroCG 2012, published the total time
//! over the five distributions, with 2^22 points on a Xeon of 2009. Only the ranking can be compared, because the
//! machine, the program and the share of the points in a round are different.

use std::fmt::Write as _;

use incircle_testkit::Distribution;

use super::row::Row;

/// Orders with their published microseconds per point, fastest first. The times of BrioDC are means over the five
/// distributions of the published table.
const PUBLISHED: [(&str, f64); 13] = [
    ("brio-hilbert", 1.51),
    ("brio-sierpinski", 1.52),
    ("brio-peano", 1.57),
    ("brio-squarified-hilbert", 1.57),
    ("brio-squarified-peano", 1.58),
    ("brio-median-hilbert", 1.89),
    ("brio-hilbert-yx", 1.95),
    ("brio-adaptive-hilbert", 2.01),
    ("brio-adaptive-peano", 2.17),
    ("brio-squarified-adaptive-hilbert", 2.71),
    ("brio-squarified-adaptive-peano", 2.78),
    ("briodc-log-u", 26.30),
    ("briodc-linear", 27.86),
];
/// Published times that differ by less than this factor count as equal.
const APART: f64 = 1.05;

/// A published order that was measured.
struct Ranked {
    name: &'static str,
    published: f64,
    /// Measured nanoseconds per point, averaged over the distributions.
    measured: f64,
}

/// For each number of points, lists the published orders with the times measured here, and counts the pairs that rank
/// alike. The text is empty if there is no pair.
pub fn ranking(rows: &[Row]) -> String {
    let mut text = String::new();
    let mut asked: Vec<usize> = rows.iter().map(|row| row.asked).collect();
    asked.sort_unstable();
    asked.dedup();
    for n in asked {
        let of_n: Vec<&Row> = rows.iter().filter(|row| row.asked == n).collect();
        let ranked = ranked(&of_n);
        let pairs = pairs_apart(&ranked);
        if pairs.is_empty() {
            continue;
        }
        let (same, other): (Vec<_>, Vec<_>) = pairs.iter().partition(|(fast, slow)| fast.measured < slow.measured);
        // Writing to a string cannot fail.
        let _ = writeln!(
            text,
            "published ranking (Schrijvers, van Bommel, Buchin 2012), {n} points, the literature's distributions among \
             the rows: of {} more than 5 % apart there, {} come in the same order here",
            pairs_of(pairs.len()),
            same.len()
        );
        for Ranked { name, published, measured } in &ranked {
            let _ = writeln!(text, "  {name:<36}{published:>9.2} µs there{measured:>9.1} ns here");
        }
        for (fast, slow) in other {
            let _ = writeln!(text, "  not so: {} before {}", fast.name, slow.name);
        }
    }
    text
}

/// The number of pairs with its noun.
fn pairs_of(count: usize) -> String {
    if count == 1 {
        "1 pair".to_owned()
    } else {
        format!("{count} pairs")
    }
}

/// The published orders among these rows, in the published ranking.
fn ranked(rows: &[&Row]) -> Vec<Ranked> {
    let measured = |name: &str| {
        let is_meant = |row: &&&Row| row.order.name() == name && Distribution::LITERATURE.contains(&row.set);
        let times: Vec<f64> = rows.iter().filter(is_meant).map(|row| row.total_ns).collect();
        (!times.is_empty()).then(|| times.iter().sum::<f64>() / times.len() as f64)
    };
    let of =
        |&(name, published): &(&'static str, f64)| measured(name).map(|measured| Ranked { name, published, measured });
    PUBLISHED.iter().filter_map(of).collect()
}

/// The pairs whose first order is clearly faster than the second by the published times.
fn pairs_apart(ranked: &[Ranked]) -> Vec<(&Ranked, &Ranked)> {
    let behind = |place: usize| ranked.iter().skip(place + 1);
    let pairs = ranked.iter().enumerate().flat_map(|(place, fast)| behind(place).map(move |slow| (fast, slow)));
    pairs.filter(|(fast, slow)| slow.published > APART * fast.published).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::order::Order;

    fn row(set: Distribution, name: &str, total_ns: f64) -> Row {
        let order = Order::named(name).expect("a published order is one of ours");
        Row {
            set,
            asked: 100,
            points: 100,
            order,
            order_ns: 1.0,
            total_ns,
            walk: 1.0,
            tests: 1.0,
            cavity: 1.0,
            cycles: None,
        }
    }

    #[test]
    fn all_published_orders_are_ours_and_sorted() {
        assert!(PUBLISHED.iter().all(|(name, _)| Order::named(name).is_some()));
        assert!(PUBLISHED.is_sorted_by(|one, other| one.1 <= other.1));
    }

    #[test]
    fn pairs_are_counted_over_all_distributions() {
        let rows = [
            row(Distribution::Uniform, "brio-hilbert", 300.0),
            row(Distribution::Uniform, "brio-sierpinski", 100.0),
            row(Distribution::Uniform, "briodc-linear", 200.0),
            row(Distribution::Line, "brio-hilbert", 100.0),
            row(Distribution::Line, "brio-sierpinski", 400.0),
            row(Distribution::Line, "briodc-linear", 220.0),
            row(Distribution::Parabola, "brio-hilbert", 9000.0),
        ];
        let text = ranking(&rows);
        assert!(text.contains("of 2 pairs more than 5 % apart there, 1 come in the same order"), "{text}");
        assert!(text.contains("not so: brio-sierpinski before briodc-linear"), "{text}");
        assert!(text.contains("200.0 ns here") && text.contains("210.0 ns here"), "{text}");
        assert_eq!(ranking(&rows[..1]), "");
    }
}
