//! The commit: Rust, Verilog and a list of all it must do agree clock by clock. The list is written down beforehand, from the whole
//! ring; the block sees one entry at a time.

mod block_ports;
mod stepper;

use incircle_cli::generate::SplitMix64;
use incircle_hdl::engine::Commit;
use stepper::bundles::{link_write, record_write, Edge};
use stepper::{named_ports, Cell, Stepper, Wave};

named_ports!(
    Commit,
    [reset, starts, p, records, inner_count, entry, inner_id],
    [entry_pointer, inner_pointer, takes_fresh, ends, write],
    clock
);

/// A finished ring, as the cavity hands it over.
struct Ring {
    /// Entries by number; the ring starts at 0.
    entries: Vec<Edge>,
    inner: Vec<u64>,
    p: u64,
    records: u64,
}

/// What happens in one clock of a commit.
#[derive(Clone, Copy, Debug, Default)]
struct Act {
    ends: bool,
    takes_fresh: bool,
    /// The write that is made at its edge, and seen in the next clock.
    makes: Option<u128>,
}

impl Ring {
    /// A ring of this many edges, linked in a random order; edges of one cavity triangle stand side by side, as in a cavity, or
    /// anywhere.
    fn random(edges: usize, random: &mut SplitMix64) -> Self {
        let mut order: Vec<u64> = (1..edges as u64).collect();
        random.shuffle(&mut order);
        order.insert(0, 0);
        let few = random.below(2) == 1;
        let mut f = random.below(1 << 15);
        let mut entries = vec![Edge::default(); edges];
        for (place, entry) in order.iter().enumerate() {
            if random.below(3) != 0 {
                f = random.below(if few { 4 } else { 1 << 15 });
            }
            entries[*entry as usize] = Edge {
                a: random.below(1 << 15),
                u: random.below(1 << 15),
                slot: random.below(3),
                f,
                after: order[(place + 1) % edges],
            };
        }
        Self {
            entries,
            inner: (0..random.below(9)).map(|_| random.below(1 << 15)).collect(),
            p: random.below(1 << 15),
            records: random.below((1 << 15) - 64),
        }
    }

    fn in_order(&self) -> Vec<Edge> {
        let mut ring = vec![self.entries[0]];
        while ring[ring.len() - 1].after != 0 {
            ring.push(self.entries[ring[ring.len() - 1].after as usize]);
        }
        ring
    }

    /// Ids of the records, in order, and which of them are new.
    fn ids(&self, ring: &[Edge]) -> Vec<(u64, bool)> {
        let mut spare = self.inner.iter();
        let mut fresh = self.records..;
        let mut ids = vec![(ring[0].f, false)];
        for pair in ring.windows(2) {
            let f = pair[1].f;
            let is_taken = f == pair[0].f || f == ring[0].f;
            let inner = is_taken.then(|| spare.next().copied());
            ids.push(match inner {
                None => (f, false),
                Some(Some(id)) => (id, false),
                Some(None) => (fresh.next().expect("ids without end"), true),
            });
        }
        ids
    }

    /// Every clock, from the first with `starts` to that of `ends`.
    fn acts(&self) -> Vec<Act> {
        let ring = self.in_order();
        let ids = self.ids(&ring);
        let edges = ring.len();
        let record = |place: usize| {
            let (next, before) = ((place + 1) % edges, (place + edges - 1) % edges);
            record_write(
                ids[place].0,
                [self.p, ring[place].a, ring[next].a],
                [ring[place].u, ids[next].0, ids[before].0],
            )
        };
        // Two clocks fetch; the first entry is passed over until the last one's id is known.
        let mut acts = vec![Act::default(); 2];
        for (place, edge) in ring.iter().enumerate() {
            acts.push(Act {
                takes_fresh: ids.get(place + 1).is_some_and(|(_, is_new)| *is_new),
                makes: (place > 0).then(|| record(place)),
                ends: false,
            });
            if ids[place].0 != edge.f {
                acts.push(Act { makes: Some(link_write(edge.u, edge.slot, ids[place].0)), ..Act::default() });
            }
        }
        acts.push(Act { ends: true, takes_fresh: false, makes: Some(record(0)) });
        acts
    }
}

/// The commit, the list and the inner triangles it reads, and the write that the next clock shows.
struct CommitRig {
    block: Stepper<Commit>,
    made: Option<u128>,
    records: u64,
    /// A commit is past its first clock.
    is_under_way: bool,
}

impl CommitRig {
    fn new() -> Self {
        let mut rig =
            Self { block: Stepper::new("commit", Commit::default(), 1), made: None, records: 0, is_under_way: false };
        rig.reset();
        rig
    }

    /// A clock of reset, in which nothing is compared.
    fn reset(&mut self) {
        self.block.set("reset", true);
        self.block.settle();
        self.block.edge();
        self.block.set("reset", false);
        self.made = None;
        self.is_under_way = false;
    }

    /// One clock, in which the block must do this.
    fn clock(&mut self, starts: bool, ring: &Ring, act: Act) {
        let block = &mut self.block;
        block.set("starts", starts);
        block.set("p", ring.p);
        block.set("records", self.records);
        block.set("inner_count", ring.inner.len() as u64);
        // Pointers are registers, so they stand before what they point to.
        block.settle();
        let entry = block.get("entry_pointer") as usize;
        let inner_bits = if self.is_under_way { 0x3f } else { 0 };
        let inner = block.get_masked("inner_pointer", inner_bits) as usize;
        block.set("entry", ring.entries.get(entry).map_or(0, |edge| edge.entry()));
        block.set("inner_id", ring.inner.get(inner).copied().unwrap_or(0));
        block.settle();
        block.expect("ends", act.ends);
        block.expect("takes_fresh", act.takes_fresh);
        match self.made {
            Some(write) => block.expect("write", write),
            None => block.expect_masked("write", 1, 0u128),
        }
        if !starts {
            block.expect("entry_pointer", 0u128);
        }
        block.edge();
        self.made = act.makes;
        self.is_under_way = starts && !act.ends;
        self.records += u64::from(act.takes_fresh);
    }

    /// That many clocks of a commit.
    fn commit(&mut self, ring: &Ring, clocks: usize) {
        self.records = ring.records;
        for act in ring.acts().into_iter().take(clocks) {
            self.clock(true, ring, act);
        }
    }
}

#[test]
fn commit_writes_the_star_of_any_ring() {
    let mut random = SplitMix64::new(1);
    let mut rig = CommitRig::new();
    let mut longest = 0;
    for round in 0..250 {
        let edges = match round % 5 {
            0 => 3,
            1 => 64,
            _ => 3 + random.below(20) as usize,
        };
        let ring = Ring::random(edges, &mut random);
        let acts = ring.acts();
        let links = acts.len() - edges - 3;
        assert_eq!(acts.iter().filter(|act| act.makes.is_some()).count(), edges + links);
        longest = longest.max(acts.len());
        if random.below(6) == 0 {
            rig.commit(&ring, random.below(acts.len() as u64) as usize);
            rig.reset();
        } else {
            rig.commit(&ring, acts.len());
        }
        for _ in 0..[0, 0, 1, 5][random.below(4) as usize] {
            rig.clock(false, &ring, Act::default());
        }
    }
    assert!(
        longest > 64 + 3 + 20 && rig.block.clocks() > 4000,
        "longest commit {longest} of {} clocks",
        rig.block.clocks()
    );
}

/// The cavity of two triangles 0 and 1 becomes the star of four: two old ids, two new ones.
#[test]
fn commit_shows_the_wave_of_its_header() {
    let edge = |a, u, f, after| Edge { a, u, slot: 1, f, after };
    let ring = Ring {
        entries: vec![edge(1, 5, 0, 1), edge(2, 6, 1, 2), edge(3, 7, 1, 3), edge(4, 8, 0, 0)],
        inner: vec![],
        p: 9,
        records: 10,
    };
    let mut rig = CommitRig::new();
    let mut wave = Wave::default();
    rig.records = ring.records;
    let idle = (false, Act::default());
    let acts = ring.acts().into_iter().map(|act| (true, act));
    for (starts, act) in [idle].into_iter().chain(acts).chain([idle, idle]) {
        let write = rig.made;
        rig.clock(starts, &ring, act);
        let id = |write: u128| Cell::Number(write >> 1 & 0x7fff);
        wave.take(&[
            ("starts", Cell::Bit(starts)),
            ("takes_fresh", Cell::Bit(act.takes_fresh)),
            ("ends", Cell::Bit(act.ends)),
            ("write.valid", Cell::Bit(write.is_some())),
            ("write.vertices", Cell::Bit(write.is_some_and(|write| write >> 16 & 1 == 1))),
            ("write.id", write.map_or(Cell::Open, id)),
        ]);
    }
    wave.assert_drawn_in(include_str!("../../hdl/src/engine/commit.rs"));
}
