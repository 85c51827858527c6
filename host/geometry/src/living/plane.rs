//! The triangles of a mesh that changes, with ghost triangles, so that every edge has two sides.

use alloc::vec::Vec;

use crate::pages;

/// The infinite vertex, which lies beyond every hull edge.
pub const INFINITE: u32 = u32::MAX;
/// Marks the end of the list of free triangles.
const NONE: u32 = u32::MAX;
/// The next and the last of the three slots of a triangle, counter-clockwise.
pub const NEXT: [usize; 3] = [1, 2, 0];
pub const LAST: [usize; 3] = [2, 0, 1];

/// One side of an edge: a triangle, and the slot of the vertex opposite the edge.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Side(u32);

impl Side {
    #[inline(always)]
    pub fn new(triangle: u32, slot: usize) -> Self {
        // There are at most 2^30 - 4 triangles, because there are at most `MAX_POINTS` points.
        Self(triangle << 2 | slot as u32)
    }

    #[inline(always)]
    pub fn triangle(self) -> u32 {
        self.0 >> 2
    }

    #[inline(always)]
    pub fn slot(self) -> usize {
        // The slot is below 3; the remainder tells the compiler so.
        (self.0 & 3) as usize % 3
    }

    /// The number of the side: four times that of the triangle, plus the slot.
    #[inline(always)]
    pub fn number(self) -> usize {
        self.0 as usize
    }

    /// The next side of the same triangle, counter-clockwise.
    #[inline(always)]
    pub fn next(self) -> Self {
        Self::new(self.triangle(), NEXT[self.slot()])
    }

    /// The last side of the same triangle, counter-clockwise.
    #[inline(always)]
    pub fn last(self) -> Self {
        Self::new(self.triangle(), LAST[self.slot()])
    }
}

/// Three vertices, counter-clockwise, and behind the edge opposite each the other side of that edge. A free triangle
/// has three infinite vertices.
#[derive(Clone, Copy, Debug)]
pub struct Triangle {
    pub vertices: [u32; 3],
    pub across: [Side; 3],
}

impl Triangle {
    /// The slot of a vertex, or 0 if the triangle does not have it.
    #[inline(always)]
    pub fn slot_of(&self, vertex: u32) -> usize {
        let [_, second, third] = self.vertices;
        usize::from(second == vertex) + 2 * usize::from(third == vertex)
    }

    /// The slot of the infinite vertex of a ghost triangle.
    #[inline(always)]
    pub fn infinite_slot(&self) -> Option<usize> {
        let slot = self.slot_of(INFINITE);
        (self.vertices[slot] == INFINITE).then_some(slot)
    }

    fn is_free(&self) -> bool {
        self.vertices == [INFINITE; 3]
    }
}

/// The triangles, in places that are used again.
#[derive(Clone, Debug)]
pub struct Plane {
    triangles: Vec<Triangle>,
    /// The first free triangle; each holds the number of the next in its first side.
    free: u32,
    count: usize,
    /// Some ghost triangle, while there are triangles.
    pub ghost: u32,
}

impl Default for Plane {
    fn default() -> Self {
        Self { triangles: Vec::new(), free: NONE, count: 0, ghost: 0 }
    }
}

impl Plane {
    /// The number of triangles, ghost triangles included.
    pub fn len(&self) -> usize {
        self.count
    }

    /// The number after those of all triangles, free ones included.
    pub fn end(&self) -> u32 {
        self.triangles.len() as u32
    }

    /// Makes room for triangles.
    pub fn reserve(&mut self, more: usize) {
        if self.triangles.capacity() - self.triangles.len() < more {
            grow(&mut self.triangles, more);
        }
    }

    /// The bytes that the triangles take.
    pub fn bytes(&self) -> usize {
        size_of::<Triangle>() * self.triangles.capacity()
    }

    /// All triangles with their numbers, ghost triangles included.
    pub fn iter(&self) -> impl Iterator<Item = (u32, &Triangle)> + '_ {
        (0..).zip(&self.triangles).filter(|(_, triangle)| !triangle.is_free())
    }

    #[inline(always)]
    pub fn get(&self, triangle: u32) -> &Triangle {
        &self.triangles[triangle as usize]
    }

    #[inline(always)]
    pub fn set(&mut self, triangle: u32, vertices: [u32; 3], across: [Side; 3]) {
        self.triangles[triangle as usize] = Triangle { vertices, across };
    }

    /// A triangle to be set.
    pub fn allocate(&mut self) -> u32 {
        self.count += 1;
        if self.free != NONE {
            let triangle = self.free;
            self.free = self.get(triangle).across[0].0;
            return triangle;
        }
        make_room(&mut self.triangles);
        self.triangles.push(Triangle { vertices: [INFINITE; 3], across: [Side(0); 3] });
        (self.triangles.len() - 1) as u32
    }

    pub fn release(&mut self, triangle: u32) {
        self.count -= 1;
        self.set(triangle, [INFINITE; 3], [Side(self.free); 3]);
        self.free = triangle;
    }

    /// Releases all triangles.
    pub fn clear(&mut self) {
        let capacity = core::mem::take(&mut self.triangles);
        *self = Self { triangles: capacity, ..Self::default() };
        self.triangles.clear();
    }

    /// The other side of the same edge.
    #[inline(always)]
    pub fn across(&self, side: Side) -> Side {
        self.get(side.triangle()).across[side.slot()]
    }

    /// The vertex opposite the edge.
    #[inline(always)]
    pub fn apex(&self, side: Side) -> u32 {
        self.get(side.triangle()).vertices[side.slot()]
    }

    /// Both ends of the edge, with the triangle to the left.
    #[inline(always)]
    pub fn ends(&self, side: Side) -> [u32; 2] {
        let (vertices, slot) = (self.get(side.triangle()).vertices, side.slot());
        [vertices[NEXT[slot]], vertices[LAST[slot]]]
    }

    /// Makes two sides those of one edge.
    #[inline(always)]
    pub fn link(&mut self, one: Side, other: Side) {
        self.triangles[one.triangle() as usize].across[one.slot()] = other;
        self.triangles[other.triangle() as usize].across[other.slot()] = one;
    }

    /// The ends of the hull edge of a ghost triangle, with the hull to the left. `slot` is that of the infinite vertex.
    #[inline(always)]
    pub fn hull_edge(&self, ghost: u32, slot: usize) -> [u32; 2] {
        let vertices = self.get(ghost).vertices;
        [vertices[LAST[slot]], vertices[NEXT[slot]]]
    }

    /// The ghost triangle of the next hull edge, counter-clockwise.
    pub fn next_ghost(&self, ghost: u32) -> u32 {
        let triangle = self.get(ghost);
        triangle.across[LAST[triangle.slot_of(INFINITE)]].triangle()
    }

    /// The ghost triangle of the hull edge before, counter-clockwise.
    pub fn last_ghost(&self, ghost: u32) -> u32 {
        let triangle = self.get(ghost);
        triangle.across[NEXT[triangle.slot_of(INFINITE)]].triangle()
    }
}

/// Makes room for one more item. A list grows by a quarter and not to its double, so that little memory lies idle, and
/// lies in large pages.
pub fn make_room<T: Copy>(list: &mut Vec<T>) {
    if list.len() == list.capacity() {
        grow(list, list.len() / 4 + 16);
    }
}

/// Makes room for more items, in large pages.
pub fn grow<T: Copy>(list: &mut Vec<T>, more: usize) {
    let mut longer = pages::with_room(list.len() + more);
    longer.extend_from_slice(list);
    *list = longer;
}
