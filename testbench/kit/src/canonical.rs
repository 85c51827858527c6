//! Checks a mesh as it comes from a device: everything that holds for every mesh, and its canonical form.

use std::collections::{HashMap, HashSet};

/// A record as a device stores it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct StoredRecord {
    /// Vertices by order of arrival, counter-clockwise.
    pub vertices: [u32; 3],
    /// Ids of the records across the edges opposite the vertices.
    pub links: [u32; 3],
    /// True if the lock bit is set.
    pub is_locked: bool,
}

/// A mesh without ids: point words stand in place of vertices.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Canonical {
    /// Finite triangles, counter-clockwise, each from its smallest word on, sorted.
    pub triangles: Vec<[u32; 3]>,
    /// Edges with a ghost triangle behind them, as the ghost sees them, sorted.
    pub hull: Vec<[u32; 2]>,
}

/// Returns the canonical form of a mesh, or the first thing that is wrong with it.
///
/// `points` are all points that arrived, in their order. For `n` distinct points there must be `2 n - 2` records. No
/// lock bit may be set. Every directed edge must be there once and linked to its reverse. Every vertex must be used,
/// and of equal points exactly one.
pub fn canonical(
    records: impl ExactSizeIterator<Item = StoredRecord>,
    points: &[u32],
    infinite: u32,
) -> Result<Canonical, String> {
    let distinct: HashSet<u32> = points.iter().copied().collect();
    if records.len() + 2 != 2 * distinct.len() {
        return Err(format!("{} records for {} points", records.len(), distinct.len()));
    }
    let mut meshes = Vec::with_capacity(records.len());
    for (id, record) in records.enumerate() {
        if record.is_locked {
            return Err(format!("record {id} is locked"));
        }
        let v = record.vertices;
        if v.iter().any(|&v| v != infinite && v as usize >= points.len()) {
            return Err(format!("record {id} has the vertices {v:?}"));
        }
        meshes.push((v, record.links));
    }
    check_links(&meshes)?;
    let used: HashSet<u32> = meshes.iter().flat_map(|(v, _)| *v).filter(|&v| v != infinite).collect();
    let found: HashSet<u32> = used.iter().map(|&v| points[v as usize]).collect();
    if used.len() != found.len() || found != distinct {
        return Err(format!("{} vertices at {} of {} places", used.len(), found.len(), distinct.len()));
    }
    Ok(without_ids(&meshes, points, infinite))
}

/// A record: its vertices and its links.
type Record = ([u32; 3], [u32; 3]);

/// Checks that every directed edge is there once, and that every link leads to the record with the reverse edge.
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

#[cfg(test)]
mod tests {
    use super::*;

    const INFINITE: u32 = 9;
    const POINTS: [u32; 3] = [0, 1, 0x1_0000];

    /// One triangle and its three ghost triangles.
    fn triangle() -> [StoredRecord; 4] {
        let record = |vertices, links| StoredRecord { vertices, links, is_locked: false };
        [
            record([0, 1, 2], [1, 2, 3]),
            record([2, 1, INFINITE], [3, 2, 0]),
            record([0, 2, INFINITE], [1, 3, 0]),
            record([1, 0, INFINITE], [2, 1, 0]),
        ]
    }

    #[test]
    fn a_sound_mesh_has_a_canonical_form_and_each_fault_is_told() {
        let check = |records: [StoredRecord; 4]| canonical(records.into_iter(), &POINTS, INFINITE);
        let sound = check(triangle()).expect("a sound mesh");
        assert_eq!((sound.triangles, sound.hull.len()), (vec![POINTS], 3));
        let faulty = |change: fn(&mut [StoredRecord; 4])| {
            let mut records = triangle();
            change(&mut records);
            check(records).expect_err("a fault")
        };
        assert!(faulty(|records| records[2].is_locked = true).contains("locked"));
        assert!(faulty(|records| records[0].links = [1, 3, 2]).contains("link"));
        assert!(faulty(|records| records[0].vertices = [0, 1, 3]).contains("vertices"));
        assert!(faulty(|records| records[1] = records[2]).contains("edge"));
        assert!(canonical(triangle()[..3].iter().copied(), &POINTS, INFINITE).is_err());
        assert!(canonical(triangle().into_iter(), &[0, 1, 1], INFINITE).is_err());
    }
}
