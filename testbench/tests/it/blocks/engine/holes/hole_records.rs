//! Runs `HoleRecords` in Rust and in Verilog beside a statement of the writes of a triangle and of two free records.

use crate::rig::stepper::bundles::{flip, id};
use crate::rig::stepper::{named_ports, Stepper};
use incircle_hdl::engine::HoleRecords;
use incircle_testkit::SplitMix64;

named_ports!(HoleRecords, [infinite, job, edge_i, edge_m, edge_j], [first, second, third]);

/// A write: the record, its vertices if they are written, and the neighbours that are written.
#[derive(Debug)]
struct Wanted {
    record: u64,
    vertices: Option<[u64; 3]>,
    links: [Option<u64>; 3],
}

impl Wanted {
    fn link(record: u64, slot: u64, to: u64) -> Self {
        let links = [0, 1, 2].map(|other| (other == slot).then_some(to));
        Self { record, vertices: None, links }
    }

    fn expect(&self, block: &Stepper<HoleRecords>, port: &str) {
        block.expect(&format!("{port}_valid"), true);
        block.expect(&format!("{port}_id"), self.record);
        block.expect(&format!("{port}_vertices"), self.vertices.is_some());
        for (slot, vertex) in self.vertices.into_iter().flatten().enumerate() {
            block.expect(&format!("{port}_v{slot}"), vertex);
        }
        for (slot, link) in self.links.into_iter().enumerate() {
            block.expect(&format!("{port}_link{slot}"), link.is_some());
            if let Some(link) = link {
                block.expect(&format!("{port}_n{slot}"), link);
            }
        }
    }
}

/// An edge of a ring: its first vertex, the record outside with the slot that names the star, and the star's record.
#[derive(Clone, Copy)]
struct Edge {
    vertex: u64,
    outside: u64,
    slot: u64,
    record: u64,
}

impl Edge {
    fn random(random: &mut SplitMix64) -> Self {
        Self { vertex: id(random), outside: id(random), slot: random.below(3), record: id(random) }
    }

    fn set(self, block: &mut Stepper<HoleRecords>, port: &str) {
        let Self { vertex, outside, slot, record } = self;
        for (field, value) in [("vertex", vertex), ("outside", outside), ("slot", slot), ("record", record)] {
            block.set(&format!("{port}_{field}"), value);
        }
    }
}

/// The other side of a base: the record that is linked, and the slot there.
fn base_link(base: u64, i: Edge, j: Edge) -> (u64, u64) {
    match base {
        0 => (j.outside, j.slot),
        1 => (j.record, 0),
        _ => (i.record, 1),
    }
}

#[test]
fn hole_records_link_triangles_both_ways_and_mark_free_records() {
    let mut random = SplitMix64::new(92);
    let mut block = Stepper::new("hole_records", HoleRecords::default(), 1);
    let mut seen = [0; 4];
    for _ in 0..2_000 {
        let [i, m, j] = [0; 3].map(|_| Edge::random(&mut random));
        let (infinite, base) = (id(&mut random), random.below(3));
        let [mends, ends] = [flip(&mut random), random.once_in(4)];
        i.set(&mut block, "edge_i");
        m.set(&mut block, "edge_m");
        j.set(&mut block, "edge_j");
        block.set("infinite", infinite);
        block.set("job_base", base);
        block.set("job_mends", mends && !ends);
        block.set("job_ends", ends);
        block.settle();
        if ends {
            let free = |record| Wanted { record, vertices: Some([infinite; 3]), links: [Some(m.record); 3] };
            free(i.record).expect(&block, "first");
            free(j.record).expect(&block, "second");
            block.expect("third_valid", false);
            seen[3] += 1;
        } else {
            let (behind, slot) = base_link(base, i, j);
            let links = [i.outside, m.outside, behind].map(Some);
            let vertices = Some([j.vertex, i.vertex, m.vertex]);
            Wanted { record: m.record, vertices, links }.expect(&block, "first");
            Wanted::link(behind, slot, m.record).expect(&block, "second");
            match mends {
                true => Wanted::link(i.outside, i.slot, m.record).expect(&block, "third"),
                false => block.expect("third_valid", false),
            }
            seen[base as usize] += 1;
        }
    }
    assert!(seen.iter().all(|&count| count > 300), "{seen:?}");
}
