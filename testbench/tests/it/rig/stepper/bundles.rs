//! The packed structures of the engine as numbers: what stands where, lowest field first.

use incircle_testkit::SplitMix64;

/// Bits of a triangle or vertex id.
pub const ID_BITS: u32 = 15;

/// Fields, each a value and its bits, from the lowest bit up.
pub fn pack(fields: &[(u64, u32)]) -> u128 {
    let mut place = 0;
    fields.iter().fold(0, |number, (value, bits)| {
        assert!(value >> bits == 0, "{value:#x} has more than {bits} bits");
        place += bits;
        number | u128::from(*value) << (place - bits)
    })
}

/// A random id.
pub fn id(random: &mut SplitMix64) -> u64 {
    random.below(1 << ID_BITS)
}

/// A random bit.
pub fn flip(random: &mut SplitMix64) -> bool {
    random.below(2) == 1
}

fn ids(values: &[u64]) -> Vec<(u64, u32)> {
    values.iter().map(|value| (*value, ID_BITS)).collect()
}

/// A `Write` of a whole record.
pub fn record_write(id: u64, v: [u64; 3], n: [u64; 3]) -> u128 {
    let head = [(1, 1), (id, ID_BITS), (1, 1), (1, 1), (1, 1), (1, 1)];
    pack(&[&head[..], &ids(&v), &ids(&n)].concat())
}

/// A `Write` of one link.
pub fn link_write(id: u64, slot: u64, value: u64) -> u128 {
    let column = |k| (u64::from(slot == k), 1);
    let head = [(1, 1), (id, ID_BITS), (0, 1), column(0), column(1), column(2)];
    pack(&[&head[..], &ids(&[0; 3]), &ids(&[value; 3])].concat())
}

/// A visit.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Visit {
    pub owner: u64,
    pub rotates: bool,
    pub locks: bool,
    pub x: u64,
    pub after: u64,
    pub f_entry: u64,
    pub f: u64,
    pub u: u64,
}

impl Visit {
    /// A look at a record as it is stored.
    pub fn look(u: u64) -> Self {
        Self { u, ..Self::default() }
    }

    /// Every field random.
    pub fn random(random: &mut SplitMix64) -> Self {
        Self {
            owner: random.below(24),
            rotates: flip(random),
            locks: flip(random),
            x: random.below(64),
            after: random.below(64),
            f_entry: random.below(64),
            f: id(random),
            u: id(random),
        }
    }

    fn fields(self) -> [(u64, u32); 8] {
        [
            (self.owner, 5),
            (self.rotates.into(), 1),
            (self.locks.into(), 1),
            (self.x, 6),
            (self.after, 6),
            (self.f_entry, 6),
            (self.f, ID_BITS),
            (self.u, ID_BITS),
        ]
    }

    /// As a `Token`.
    pub fn token(self) -> u128 {
        pack(&self.fields())
    }

    /// As a `Bundle` of `visits` visits: this one, the second with the entry after it and its record, and the third's record. What
    /// stands there for visits that are not made does not matter.
    pub fn bundle(self, visits: u64, second_after: u64, second_u: u64, third_u: u64) -> u128 {
        let head = [(u64::from(visits > 1), 1), (u64::from(visits > 2), 1)];
        let tail = [(second_after, 6), (second_u, ID_BITS), (third_u, ID_BITS)];
        pack(&[&head[..], &self.fields(), &tail].concat())
    }

    /// The visit at the head of a `Bundle`.
    pub fn of_bundle(bundle: u128) -> Self {
        let field = |place: u32, bits: u32| (bundle >> place) as u64 & ((1 << bits) - 1);
        Self {
            owner: field(2, 5),
            rotates: field(7, 1) == 1,
            locks: field(8, 1) == 1,
            x: field(9, 6),
            after: field(15, 6),
            f_entry: field(21, 6),
            f: field(27, ID_BITS),
            u: field(42, ID_BITS),
        }
    }
}

/// What a visit found at the lock of its record.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct LockFinding {
    pub took: bool,
    pub foreign: bool,
    pub again: bool,
}

/// A `Turned`: vertices, links, slot, what was found at the lock, which vertices are infinite.
pub fn turned(v: [u64; 3], n: [u64; 3], slot: u64, lock: LockFinding, infinite: [bool; 3]) -> u128 {
    let tail = [
        (slot, 2),
        (lock.took.into(), 1),
        (lock.foreign.into(), 1),
        (lock.again.into(), 1),
        (infinite[0].into(), 1),
        (infinite[1].into(), 1),
        (infinite[2].into(), 1),
    ];
    pack(&[&ids(&v), &ids(&n), &tail[..]].concat())
}

/// A `CommitJob`.
pub fn commit_job(owner: u64, p: u64, inners: u64, locks: u64, since: u64) -> u128 {
    pack(&[(owner, 5), (p, ID_BITS), (inners, 7), (locks, 7), (since, 22)])
}

/// A `ReleaseJob`.
pub fn release_job(owner: u64, locks: u64) -> u128 {
    pack(&[(owner, 5), (locks, 7)])
}

/// What a visit found out.
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
    /// As a `Verdict`.
    pub fn verdict(self) -> u128 {
        pack(&[
            (self.conflict.into(), 1),
            (self.located.into(), 1),
            (self.falls_onto_corner.into(), 1),
            (self.is_left.into(), 1),
            (self.is_straight.into(), 1),
            (self.walk_next, ID_BITS),
        ])
    }
}

/// A boundary edge.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Edge {
    pub a: u64,
    pub u: u64,
    pub slot: u64,
    pub f: u64,
    pub after: u64,
}

impl Edge {
    /// As an `Entry`.
    pub fn entry(self) -> u128 {
        pack(&[(self.a, ID_BITS), (self.u, ID_BITS), (self.slot, 2), (self.f, ID_BITS), (self.after, 6)])
    }
}

/// How points are dealt to contexts.
#[derive(Clone, Copy, Debug, Default)]
pub struct Deal {
    pub contexts: u64,
    pub is_batch: bool,
    pub dealt_from: u64,
}

impl Deal {
    /// Both ways of dealing points to so many contexts.
    pub fn both(contexts: u64) -> [Self; 2] {
        [Self::one_mesh(contexts), Self::batch(contexts)]
    }

    /// The vertices of a context in their order, without end.
    pub fn dealt(self, context: u64) -> impl Iterator<Item = u64> {
        let Self { contexts, is_batch, dealt_from } = self;
        let alone = match context {
            _ if is_batch => 3 * context + 2..3 * context + 3,
            0 => 2..dealt_from,
            _ => 0..0,
        };
        alone.chain((dealt_from + context..).step_by(contexts as usize))
    }

    /// So many contexts that work on one mesh.
    pub fn one_mesh(contexts: u64) -> Self {
        Self { contexts, is_batch: false, dealt_from: incircle_protocol::FIRST_ROUND.into() }
    }

    /// So many jobs side by side.
    pub fn batch(contexts: u64) -> Self {
        Self { contexts, is_batch: true, dealt_from: 3 * contexts }
    }

    pub fn bits(self) -> u128 {
        u128::from(self.contexts | u64::from(self.is_batch) << 5 | self.dealt_from << 6)
    }
}
