//! The packed structures of the engine as numbers: the place of each field, lowest first.

use incircle_testkit::SplitMix64;

/// Bits of the id of a triangle or vertex.
pub const ID_BITS: u32 = 15;

/// Widths of the fields of a structure, the lowest first. The tests state them a second time, so that
/// a field that moves is noticed.
pub type Layout<const N: usize> = [u32; N];

/// Fields of a visit: `context`, `rotates`, `locks`, `entry`, `after`, `cavity_entry`, `cavity_record`, `record`.
pub const VISIT: Layout<8> = [5, 1, 1, 6, 6, 6, ID_BITS, ID_BITS];
/// Fields of a bundle: `is_pair`, `is_triple`, `context`, `rotates`, `locks`, `entry`, `after`, `cavity_entry`,
/// `cavity_record`, `record`, then `after` and `record` of the second visit and `record` of the third.
pub const BUNDLE: Layout<13> = [1, 1, 5, 1, 1, 6, 6, 6, ID_BITS, ID_BITS, 6, ID_BITS, ID_BITS];
/// Fields of a turned record: v0, v1, v2, n0, n1, n2, `slot`, `took`, `foreign`, `again`, and which vertex is infinite.
pub const TURNED: Layout<13> = [ID_BITS, ID_BITS, ID_BITS, ID_BITS, ID_BITS, ID_BITS, 2, 1, 1, 1, 1, 1, 1];
/// Fields of a verdict: `conflict`, `located`, `falls_onto_corner`, `is_left`, `is_straight`, `walk_next`.
pub const VERDICT: Layout<6> = [1, 1, 1, 1, 1, ID_BITS];
/// Fields of a write: `valid`, `id`, `vertices`, `link0`, `link1`, `link2`, v0, v1, v2, n0, n1, n2.
pub const WRITE: Layout<12> = [1, ID_BITS, 1, 1, 1, 1, ID_BITS, ID_BITS, ID_BITS, ID_BITS, ID_BITS, ID_BITS];
/// Fields of an entry: `first_vertex`, `outside_record`, `slot`, `cavity_record`, `after`.
pub const ENTRY: Layout<5> = [ID_BITS, ID_BITS, 2, ID_BITS, 6];
/// Fields of a job for the commit: `context`, `vertex`, `inners`, `locks`, `since`.
pub const COMMIT_JOB: Layout<5> = [5, ID_BITS, 7, 7, 22];
/// Fields of a job for the release: `context`, `locks`.
pub const RELEASE_JOB: Layout<2> = [5, 7];

/// Packs fields side by side, the first in the lowest bits.
pub fn pack<const N: usize>(layout: Layout<N>, fields: [u64; N]) -> u128 {
    let mut packed = 0;
    let mut offset = 0;
    for (width, field) in layout.into_iter().zip(fields) {
        assert!(field >> width == 0, "{field:#x} has more than {width} bits");
        packed |= u128::from(field) << offset;
        offset += width;
    }
    packed
}

/// Takes the fields out of a packed structure.
pub fn unpack<const N: usize>(layout: Layout<N>, packed: u128) -> [u64; N] {
    let mut offset = 0;
    layout.map(|width| {
        let field = (packed >> offset) as u64 & ((1 << width) - 1);
        offset += width;
        field
    })
}

/// Returns fields of random bits.
pub fn random_fields<const N: usize>(layout: Layout<N>, random: &mut SplitMix64) -> [u64; N] {
    layout.map(|width| random.bits(width))
}

/// Returns a random id.
pub fn id(random: &mut SplitMix64) -> u64 {
    random.below(1 << ID_BITS)
}

/// Returns a random bit.
pub fn flip(random: &mut SplitMix64) -> bool {
    random.below(2) == 1
}

/// Packs a `Write` of a whole record.
pub fn record_write(id: u64, [v0, v1, v2]: [u64; 3], [n0, n1, n2]: [u64; 3]) -> u128 {
    pack(WRITE, [1, id, 1, 1, 1, 1, v0, v1, v2, n0, n1, n2])
}

/// Packs a `Write` of one link.
pub fn link_write(id: u64, slot: u64, value: u64) -> u128 {
    let [link0, link1, link2] = [0, 1, 2].map(|column| u64::from(column == slot));
    pack(WRITE, [1, id, 0, link0, link1, link2, 0, 0, 0, value, value, value])
}

/// Packs a `Write` of some columns of a record, all zero but `v0` and `n1`. `columns` has a bit for the
/// vertices and one for each link.
pub fn column_write(id: u64, columns: u64, v0: u64, n1: u64) -> u128 {
    let [vertices, link0, link1, link2] = [0, 1, 2, 3].map(|bit| columns >> bit & 1);
    pack(WRITE, [1, id, vertices, link0, link1, link2, v0, 0, 0, 0, n1, 0])
}

/// Packs a `Bundle` of context 1 from these ring entries.
pub fn ring_bundle(entries: &[u64]) -> u128 {
    let [is_pair, is_triple] = [2, 3].map(|visits| u64::from(entries.len() >= visits));
    let [entry, entry2, entry3] = [0, 1, 2].map(|place| entries.get(place).copied().unwrap_or(0));
    pack(BUNDLE, [is_pair, is_triple, 1, 1, 0, entry, entry2, 0, 0, 0, entry3, 0, 0])
}

/// The fields of a visit.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Visit {
    pub context: u64,
    pub rotates: bool,
    pub locks: bool,
    pub entry: u64,
    pub after: u64,
    pub cavity_entry: u64,
    pub cavity_record: u64,
    pub record: u64,
}

impl Visit {
    /// Makes the visit of a walk that looks at a record as it is stored.
    pub fn look(record: u64) -> Self {
        Self { record, ..Self::default() }
    }

    /// Makes a visit with every field random.
    pub fn random(random: &mut SplitMix64) -> Self {
        Self {
            context: random.below(24),
            rotates: flip(random),
            locks: flip(random),
            entry: random.below(64),
            after: random.below(64),
            cavity_entry: random.below(64),
            cavity_record: id(random),
            record: id(random),
        }
    }

    /// Packs the visit as a `Visit`.
    pub fn packed(self) -> u128 {
        let Self { context, rotates, locks, entry, after, cavity_entry, cavity_record, record } = self;
        pack(VISIT, [context, rotates.into(), locks.into(), entry, after, cavity_entry, cavity_record, record])
    }

    /// Packs a `Bundle` of `visits` visits: this one, the second with the entry after it and its record, and the record
    /// of the third. The values for visits that are not made do not matter.
    pub fn bundle(self, visits: u64, second_after: u64, second_record: u64, third_record: u64) -> u128 {
        let [is_pair, is_triple] = [visits > 1, visits > 2].map(u64::from);
        let [context, rotates, locks, entry, after, cavity_entry, cavity_record, record] = unpack(VISIT, self.packed());
        let (after2, record2, record3) = (second_after, second_record, third_record);
        pack(
            BUNDLE,
            [
                is_pair,
                is_triple,
                context,
                rotates,
                locks,
                entry,
                after,
                cavity_entry,
                cavity_record,
                record,
                after2,
                record2,
                record3,
            ],
        )
    }

    /// Unpacks the visit at the head of a `Bundle`.
    pub fn of_bundle(bundle: u128) -> Self {
        let [_, _, context, rotates, locks, entry, after, cavity_entry, cavity_record, record, ..] =
            unpack(BUNDLE, bundle);
        Self { context, rotates: rotates == 1, locks: locks == 1, entry, after, cavity_entry, cavity_record, record }
    }
}

/// The finding of a visit at the lock of its record.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct LockFinding {
    pub took: bool,
    pub foreign: bool,
    pub again: bool,
}

/// Packs a `Turned`: vertices, links, slot, the finding at the lock, and which vertices are infinite.
pub fn turned(v: [u64; 3], n: [u64; 3], slot: u64, lock: LockFinding, infinite: [bool; 3]) -> u128 {
    let ([v0, v1, v2], [n0, n1, n2], [i0, i1, i2]) = (v, n, infinite.map(u64::from));
    let [took, foreign, again] = [lock.took, lock.foreign, lock.again].map(u64::from);
    pack(TURNED, [v0, v1, v2, n0, n1, n2, slot, took, foreign, again, i0, i1, i2])
}

/// Packs a `CommitJob` from its fields.
pub fn commit_job(context: u64, vertex: u64, inners: u64, locks: u64, since: u64) -> u128 {
    pack(COMMIT_JOB, [context, vertex, inners, locks, since])
}

/// Packs a `ReleaseJob` from its fields.
pub fn release_job(context: u64, locks: u64) -> u128 {
    pack(RELEASE_JOB, [context, locks])
}

/// The result of a visit.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Finding {
    pub conflict: bool,
    pub located: bool,
    pub falls_onto_corner: bool,
    pub is_left: bool,
    pub is_straight: bool,
    pub walk_next: u64,
}

impl Finding {
    /// Packs the result as a `Verdict`.
    pub fn verdict(self) -> u128 {
        let flags = [self.conflict, self.located, self.falls_onto_corner, self.is_left, self.is_straight];
        let [conflict, located, falls_onto_corner, is_left, is_straight] = flags.map(u64::from);
        pack(VERDICT, [conflict, located, falls_onto_corner, is_left, is_straight, self.walk_next])
    }
}

/// The fields of an entry of the ring.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Edge {
    pub first_vertex: u64,
    pub outside_record: u64,
    pub slot: u64,
    pub cavity_record: u64,
    pub after: u64,
}

impl Edge {
    /// Packs the edge as an `Entry`.
    pub fn entry(self) -> u128 {
        pack(ENTRY, [self.first_vertex, self.outside_record, self.slot, self.cavity_record, self.after])
    }
}

/// The way in which points are dealt to contexts: each of the jobs has a team of `contexts / jobs`.
#[derive(Clone, Copy, Debug, Default)]
pub struct Deal {
    pub contexts: u64,
    pub jobs: u64,
    pub dealt_from: u64,
}

impl Deal {
    pub fn new(contexts: u64, jobs: u64) -> Self {
        Self { contexts, jobs, dealt_from: 3 * jobs }
    }

    /// All ways in which this many contexts form teams.
    pub fn all(contexts: u64) -> impl Iterator<Item = Self> {
        (1..=contexts).filter(move |jobs| contexts.is_multiple_of(*jobs)).map(move |jobs| Self::new(contexts, jobs))
    }

    /// The number of vertex `place` of a job, three or later.
    fn vertex(self, job: u64, place: u64) -> u64 {
        place * self.jobs + job
    }

    /// Vertices of a context in their order, without end.
    pub fn dealt(self, context: u64) -> impl Iterator<Item = u64> {
        const FIRST_ROUND: u64 = incircle_protocol::FIRST_ROUND as u64;
        let (team, member) = (context % self.jobs, context / self.jobs);
        let size = (self.contexts / self.jobs) as usize;
        let alone = if member == 0 { 3..FIRST_ROUND } else { 0..0 };
        let third = (member == 0).then_some(3 * team + 2);
        let places = alone.chain((FIRST_ROUND + member..).step_by(size));
        third.into_iter().chain(places.map(move |place| self.vertex(team, place)))
    }

    pub fn bits(self) -> u128 {
        u128::from(self.contexts | self.jobs << 5 | self.dealt_from << 10)
    }
}
