//! Calls of a used triangulator allocate nothing.

use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;

use incircle_geometry::cpu::Triangulator;
use incircle_geometry::{Mesh, Point};
use incircle_testkit::SplitMix64;

/// The allocator of the system, with a count of its calls.
struct Counting;

thread_local! {
    /// The calls of this thread. The thread that waits for the test allocates as well, at any time.
    static CALLS: Cell<usize> = const { Cell::new(0) };
}

/// Counts a call.
fn count() {
    CALLS.set(CALLS.get() + 1);
}

#[allow(unsafe_code)] // the trait of an allocator is unsafe
                      // SAFETY: every call goes to the allocator of the system, unchanged.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        count();
        unsafe { System.alloc(layout) }
    }

    unsafe fn alloc_zeroed(&self, layout: Layout) -> *mut u8 {
        count();
        unsafe { System.alloc_zeroed(layout) }
    }

    unsafe fn realloc(&self, place: *mut u8, layout: Layout, size: usize) -> *mut u8 {
        count();
        unsafe { System.realloc(place, layout, size) }
    }

    unsafe fn dealloc(&self, place: *mut u8, layout: Layout) {
        unsafe { System.dealloc(place, layout) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

/// Sets that differ in all that decides about memory: even ones, lattices with many ties, points of few places,
/// points on a line, points on a circle, which all lie on the hull, and a crowd beside a far point.
fn sets(count: usize) -> Vec<Vec<Point>> {
    let mut random = SplitMix64::new(91);
    let side = count.isqrt() as u32;
    let circle = |k: usize| {
        let angle = k as f64 / count as f64 * std::f64::consts::TAU;
        Point::new((1e9 + 9e8 * angle.cos()) as u32, (1e9 + 9e8 * angle.sin()) as u32)
    };
    let mut crowd: Vec<Point> = random.points(count, 1 << 9);
    crowd[count / 2] = Point::new(u32::MAX, u32::MAX);
    let wide = random.points(count, 1 << 30);
    vec![
        random.points(count, 3),
        (0..count as u32).map(|k| Point::new(k, 2 * k)).collect(),
        random.points(count, 1 << 16),
        (0..side * side).map(|k| Point::new(k % side, k / side)).collect(),
        wide,
        (0..count).map(circle).collect(),
        crowd,
        random.points(count / 2, 1 << 16),
    ]
}

#[test]
fn a_second_set_of_the_same_size_allocates_nothing() {
    for count in [40, 1000, 30_000] {
        let (first, sets) = (SplitMix64::new(92).points::<Point>(count, 1 << 16), sets(count));
        let (mut triangulator, mut mesh) = (Triangulator::new(), Mesh::default());
        triangulator.triangulate_into(&first, &mut mesh).expect("few points");
        for (place, points) in sets.iter().enumerate() {
            let before = CALLS.get();
            triangulator.triangulate_into(points, &mut mesh).expect("few points");
            assert_eq!(CALLS.get(), before, "set {place} of {count} points");
        }
    }
}
