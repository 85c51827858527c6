//! The records of the model as words, and the check of a mesh in words.

use incircle_model::Mesh;
use incircle_protocol::{infinite_vertex, Layout};
use incircle_testkit::{Canonical, StoredRecord};

/// The words of all records of the model by commands.
pub fn records_of(mesh: &Mesh, capacity: u32) -> Vec<[u32; 3]> {
    let layout = Layout::of(16, capacity);
    let words = |record: &incircle_model::Record| {
        let [a, b, c, ..] = layout.record_to_words(record.v, record.n, false);
        [a, b, c]
    };
    mesh.records().iter().map(words).collect()
}

/// The canonical form of a mesh from the words of its records, or the first fault that is found in it.
///
/// # Errors
/// The errors of [`incircle_testkit::canonical`].
pub fn canonical(records: &[[u32; 3]], points: &[u32], capacity: u32) -> Result<Canonical, String> {
    let layout = Layout::of(16, capacity);
    let stored = records.iter().map(|words| {
        let (vertices, links) = layout.record_from_words(words);
        StoredRecord { vertices, links, is_locked: words[0] >> 31 != 0 }
    });
    incircle_testkit::canonical(stored, points, infinite_vertex(capacity))
}
