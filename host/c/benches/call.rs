//! Measures the calls of C beside the library itself, in interleaved pairs on the same points, and compares the
//! triangles. Prints a row for each set: medians of processor time in milliseconds, and medians of the ratios of
//! neighbouring runs, of processor time and of time on the clock.
//!
//!     cargo bench --locked        # in host/c
#![allow(unsafe_code)] // calls of the interface, and the processor's time

use std::ffi::c_void;
use std::hint::black_box;
use std::num::NonZeroU32;
use std::ptr::{null_mut, NonNull};
use std::time::Instant;

use incircle::Device;
use incircle_c::{
    incircle_mesh, incircle_mesh_free, incircle_mesh_triangles, incircle_options, incircle_triangulate, INCIRCLE_F64,
    INCIRCLE_OK,
};
use incircle_testkit::SplitMix64;

const POINTS: usize = 1_000_000;
const PAIRS: usize = 15;

/// Seconds on the clock, and of the processor.
#[derive(Clone, Copy)]
struct Took {
    clock: f64,
    processor: f64,
}

/// The seconds that all threads of the program have used the processor.
fn processor_seconds() -> f64 {
    let mut time = libc::timespec { tv_sec: 0, tv_nsec: 0 };
    // SAFETY: the structure may be written.
    let status = unsafe { libc::clock_gettime(libc::CLOCK_PROCESS_CPUTIME_ID, &mut time) };
    assert_eq!(status, 0, "the system tells the time of the processor");
    time.tv_sec as f64 + time.tv_nsec as f64 * 1e-9
}

fn timed<T>(work: impl FnOnce() -> T) -> (Took, T) {
    let (clock, processor) = (Instant::now(), processor_seconds());
    let made = work();
    (Took { clock: clock.elapsed().as_secs_f64(), processor: processor_seconds() - processor }, made)
}

/// A mesh that C has made.
struct Handle(NonNull<incircle_mesh>);

impl Handle {
    fn made(points: &[[f64; 2]], threads: u32) -> Self {
        let size = size_of::<incircle_options>();
        let options = incircle_options { size, backend: std::ptr::null(), threads, progress: None, user: null_mut() };
        let mut mesh = null_mut();
        let start = black_box(points.as_ptr().cast::<c_void>());
        // SAFETY: the pointers are those of a list, of options and of a place for the mesh.
        let status = unsafe { incircle_triangulate(start, points.len(), INCIRCLE_F64, &options, &mut mesh) };
        assert_eq!(status, INCIRCLE_OK);
        Self(NonNull::new(mesh).expect("a mesh"))
    }

    /// Copies the triangles to a buffer of the caller.
    fn triangles(&self, buffer: &mut Vec<[u32; 3]>) {
        let mut count = 0;
        buffer.clear();
        // SAFETY: the mesh is not freed, and the buffer has the room that is told.
        unsafe {
            incircle_mesh_triangles(self.0.as_ptr(), null_mut(), 0, &mut count);
            buffer.reserve(count);
            let status = incircle_mesh_triangles(self.0.as_ptr(), buffer.as_mut_ptr(), buffer.capacity(), &mut count);
            assert_eq!(status, INCIRCLE_OK);
            buffer.set_len(count);
        }
    }
}

impl Drop for Handle {
    fn drop(&mut self) {
        // SAFETY: the mesh is freed once.
        unsafe { incircle_mesh_free(self.0.as_ptr()) }
    }
}

/// Random points between 0 and 1.
fn points(count: usize) -> Vec<[f64; 2]> {
    let mut random = SplitMix64::new(1);
    (0..count).map(|_| [random.unit(), random.unit()]).collect()
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}

fn row(name: &str, points: &[[f64; 2]], threads: u32, copies: bool) {
    let mut pairs = Vec::new();
    let mut buffer = Vec::new();
    // The first pair warms up.
    for turn in 0..=PAIRS {
        let mut by_c = || {
            timed(|| {
                let mesh = Handle::made(points, threads);
                if copies {
                    mesh.triangles(&mut buffer);
                }
                mesh
            })
        };
        let by_library = || {
            timed(|| {
                let mut device = Device::cpu(NonZeroU32::new(threads));
                device.session().and_then(|mut session| session.triangulate(points)).expect("a mesh").mesh
            })
        };
        let ((ours, handle), (library, mesh)) = if turn % 2 == 0 {
            let ours = by_c();
            (ours, by_library())
        } else {
            let library = by_library();
            (by_c(), library)
        };
        if turn == 0 {
            handle.triangles(&mut buffer);
            assert!(buffer == mesh.triangles, "the triangles differ");
        } else {
            pairs.push((ours, library));
        }
    }
    let of = |value: fn(&(Took, Took)) -> f64| median(pairs.iter().map(value).collect());
    println!(
        "| {name} | {:.0} | {:.0} | {:.3} | {:.3} |",
        of(|pair| pair.0.processor * 1e3),
        of(|pair| pair.1.processor * 1e3),
        of(|pair| pair.0.processor / pair.1.processor),
        of(|pair| pair.0.clock / pair.1.clock),
    );
}

fn main() {
    let points = points(POINTS);
    println!("| what | from C, ms | the library, ms | ratio | ratio on the clock |\n|---|---:|---:|---:|---:|");
    for (threads, name) in [(1, "one thread"), (0, "all threads")] {
        row(&format!("the call, {name}"), &points, threads, false);
        row(&format!("the call and a copy of the triangles, {name}"), &points, threads, true);
    }
}
