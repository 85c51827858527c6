//! `.edge` and `.neigh` of Shewchuk's Triangle, which can only be written.
//!
//! Sources: <https://www.cs.cmu.edu/~quake/triangle.edge.html>, <https://www.cs.cmu.edu/~quake/triangle.neigh.html>.

use std::io::{self, Write};

use incircle::constraints::Pieces;
use incircle::Mesh;

/// Writes all edges of the triangles, sorted, as rows `id a b marker`. The marker of a free edge is 0, that of a piece
/// one more than the smallest number of its constraints. Where a piece has several, a comment lists their numbers.
pub fn write_edges(triangles: &[[u32; 3]], pieces: &Pieces, out: &mut dyn Write) -> io::Result<()> {
    let sides = triangles.iter().flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]]);
    let mut edges: Vec<[u32; 2]> = sides.map(|[a, b]| [a.min(b), a.max(b)]).chain(pieces.edges().to_vec()).collect();
    edges.sort_unstable();
    edges.dedup();
    writeln!(out, "{} 1", edges.len())?;
    for (id, &[a, b]) in edges.iter().enumerate() {
        match pieces.of_edge([a, b]) {
            [] => writeln!(out, "{id} {a} {b} 0")?,
            [only] => writeln!(out, "{id} {a} {b} {}", u64::from(*only) + 1)?,
            [first, ..] => {
                let all: Vec<String> = pieces.of_edge([a, b]).iter().map(u32::to_string).collect();
                writeln!(out, "{id} {a} {b} {} # constraints {}", u64::from(*first) + 1, all.join(" "))?;
            }
        }
    }
    Ok(())
}

/// Writes the neighbours of each triangle as rows `id n0 n1 n2`, each opposite the vertex of its place, and -1 where
/// there is none.
pub fn write_neighbors(triangles: &[[u32; 3]], out: &mut dyn Write) -> io::Result<()> {
    let mesh = Mesh::<incircle::Point>::new(Vec::new(), triangles.to_vec(), Vec::new(), Vec::new());
    writeln!(out, "{} 3", triangles.len())?;
    for (id, neighbors) in mesh.neighbors().iter().enumerate() {
        let [a, b, c] = neighbors.map(|neighbor| neighbor.map_or(-1, i64::from));
        writeln!(out, "{id} {a} {b} {c}")?;
    }
    Ok(())
}
