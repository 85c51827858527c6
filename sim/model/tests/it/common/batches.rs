//! The meshes of the jobs of a batch, separated from the memory that the jobs share.

use super::mesh_check::{canonical, records_of};
use incircle_model::CommandModel;
use incircle_protocol::{clear_word, command_word, infinite_vertex, Clear, Config, Layout, Meshes, Opcode};

/// The `Clear` for a batch of `jobs` jobs on this many contexts, in teams of equal size.
pub fn teams_word(contexts: u32, jobs: u32) -> u32 {
    Clear { contexts, meshes: Meshes::SideBySide(jobs), tag: 0 }.word()
}

/// The points of each job, from the points of a batch in the order in which they are sent.
pub fn own_points(points: &[u32], jobs: u32) -> Vec<Vec<u32>> {
    let mut own = vec![Vec::new(); jobs as usize];
    for (id, point) in (0..).zip(points) {
        own[job_of(id, jobs) as usize].push(*point);
    }
    own
}

/// Checks that every job of a batch has the mesh that it has on its own, by the model by commands.
///
/// # Errors
/// The first job with another mesh, or the first fault of a record.
pub fn check_single_meshes(records: &[[u32; 3]], points: &[u32], jobs: u32, config: Config) -> Result<(), String> {
    let apart = taken_apart(records, jobs, config)?;
    for (job, (records, own)) in apart.iter().zip(own_points(points, jobs)).enumerate() {
        let mut alone = CommandModel::new(16, config.points, config.ring).expect("a model that can be built");
        alone.send(&[clear_word(1), command_word(Opcode::Insert), own.len() as u32]);
        alone.send(&own);
        let right = canonical(&records_of(alone.mesh(), config.points), &own, config.points)?;
        if canonical(records, &own, config.points)? != right {
            return Err(format!("another mesh of job {job} of {jobs}, {own:x?}"));
        }
    }
    Ok(())
}

/// Number of the job that a vertex belongs to.
pub fn job_of(vertex: u32, jobs: u32) -> u32 {
    match vertex.checked_sub(3 * jobs) {
        None => vertex / 3,
        Some(place) => place % jobs,
    }
}

/// Number of a vertex within its job.
fn place_of(vertex: u32, jobs: u32) -> u32 {
    match vertex.checked_sub(3 * jobs) {
        None => vertex % 3,
        Some(place) => 3 + place / jobs,
    }
}

/// The records of each job as if the job had been the only one on a device of this configuration: with ids of its own,
/// in the order of the shared ids.
///
/// # Errors
/// A record with vertices of two jobs, or a neighbour in another job.
pub fn taken_apart(records: &[[u32; 3]], jobs: u32, config: Config) -> Result<Vec<Vec<[u32; 3]>>, String> {
    let layout = Layout::of(16, config.points);
    let infinite = infinite_vertex(config.points);
    let mut apart = vec![Vec::new(); jobs as usize];
    let mut places = Vec::with_capacity(records.len());
    for (id, words) in records.iter().enumerate() {
        let (v, _) = layout.record_from_words(words);
        let jobs_of_vertices: Vec<u32> = v.iter().filter(|&&v| v != infinite).map(|&v| job_of(v, jobs)).collect();
        if jobs_of_vertices.windows(2).any(|pair| pair[0] != pair[1]) || jobs_of_vertices.len() < 2 {
            return Err(format!("record {id} has vertices of the jobs {jobs_of_vertices:?}"));
        }
        let job: &mut Vec<_> = &mut apart[jobs_of_vertices[0] as usize];
        places.push((jobs_of_vertices[0], job.len() as u32));
        job.push(*words);
    }
    for (job, records) in (0..).zip(&mut apart) {
        for words in records {
            let locked = words[0] >> 31 != 0;
            let (v, n) = layout.record_from_words(words);
            if n.iter().any(|&n| places.get(n as usize).is_none_or(|place| place.0 != job)) {
                return Err(format!("a record of job {job} leads to {n:?}"));
            }
            let v = v.map(|v| if v == infinite { v } else { place_of(v, jobs) });
            let [a, b, c, ..] = layout.record_to_words(v, n.map(|n| places[n as usize].1), locked);
            *words = [a, b, c];
        }
    }
    Ok(apart)
}
