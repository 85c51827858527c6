//! The check of a mesh as it comes from a device: everything that holds of every mesh, and its canonical form.

use incircle_model::Mesh;
use incircle_protocol::{infinite_vertex, Layout};
use std::collections::{HashMap, HashSet};

/// A mesh without ids: point words in place of vertices.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Canonical {
    /// Finite triangles, counter-clockwise, the smallest word first, in order.
    pub triangles: Vec<[u32; 3]>,
    /// Edges with a ghost behind them, as the ghost sees them, in order.
    pub hull: Vec<[u32; 2]>,
}

/// The words of all records of the model by commands.
pub fn records_of(mesh: &Mesh, capacity: u32) -> Vec<[u32; 3]> {
    let layout = Layout::of(16, capacity);
    let words = |record: &incircle_model::Record| {
        let [a, b, c, ..] = layout.record_to_words(record.v, record.n, false);
        [a, b, c]
    };
    mesh.records().iter().map(words).collect()
}

/// The canonical form of a mesh, or the first thing that is wrong with it.
///
/// `points` are all that arrived, in their order. Records must be `2 n - 2` for `n` distinct points, no lock bit may be set, every
/// directed edge must be there once and linked to its reverse, every vertex must be used, and of equal points one only.
pub fn canonical(records: &[[u32; 3]], points: &[u32], capacity: u32) -> Result<Canonical, String> {
    let infinite = infinite_vertex(capacity);
    let layout = Layout::of(16, capacity);
    let distinct: HashSet<u32> = points.iter().copied().collect();
    if records.len() != 2 * distinct.len() - 2 {
        return Err(format!("{} records for {} points", records.len(), distinct.len()));
    }
    let mut meshes = Vec::with_capacity(records.len());
    for (id, words) in records.iter().enumerate() {
        if words[0] >> 31 != 0 {
            return Err(format!("record {id} is locked"));
        }
        let (v, n) = layout.record_from_words(words);
        if v.iter().any(|&v| v != infinite && v as usize >= points.len()) {
            return Err(format!("record {id} has the vertices {v:?}"));
        }
        meshes.push((v, n));
    }
    check_links(&meshes)?;
    let used: HashSet<u32> = meshes.iter().flat_map(|(v, _)| *v).filter(|&v| v != infinite).collect();
    let found: HashSet<u32> = used.iter().map(|&v| points[v as usize]).collect();
    if used.len() != found.len() || found != distinct {
        return Err(format!("{} vertices at {} of {} places", used.len(), found.len(), distinct.len()));
    }
    Ok(without_ids(&meshes, points, infinite))
}

/// A record: vertices and links.
type Record = ([u32; 3], [u32; 3]);

/// Every directed edge once, and every link to the record with the reverse edge.
fn check_links(records: &[Record]) -> Result<(), String> {
    let mut across = HashMap::with_capacity(3 * records.len());
    for (id, (v, _)) in records.iter().enumerate() {
        for k in 0..3 {
            let edge = (v[(k + 1) % 3], v[(k + 2) % 3]);
            if let Some(other) = across.insert(edge, id as u32) {
                return Err(format!("the edge {edge:?} is in the records {other} and {id}"));
            }
        }
    }
    for (id, (v, n)) in records.iter().enumerate() {
        for k in 0..3 {
            let edge = (v[(k + 2) % 3], v[(k + 1) % 3]);
            if across.get(&edge) != Some(&n[k]) {
                return Err(format!("link {k} of record {id} leads to {}, not {:?}", n[k], across.get(&edge)));
            }
        }
    }
    Ok(())
}

fn without_ids(records: &[Record], points: &[u32], infinite: u32) -> Canonical {
    let at = |v: u32| points[v as usize];
    let mut mesh = Canonical { triangles: Vec::with_capacity(records.len()), hull: Vec::new() };
    for &(v, _) in records {
        match v.iter().position(|&v| v == infinite) {
            Some(k) => mesh.hull.push([at(v[(k + 1) % 3]), at(v[(k + 2) % 3])]),
            None => {
                let mut corners = v.map(at);
                let lowest = (0..3).min_by_key(|&k| corners[k]).unwrap_or(0);
                corners.rotate_left(lowest);
                mesh.triangles.push(corners);
            }
        }
    }
    mesh.triangles.sort_unstable();
    mesh.hull.sort_unstable();
    mesh
}
