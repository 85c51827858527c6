//! A microcontroller that drives a board with the incircle core: it triangulates the points in its flash and prints the
//! canonical mesh over semihosting, as rows `a,b,c`.
//!
//! Lines that begin with `#` are for people: the points, the time and the deepest stack. The script `run` beside this
//! package runs the program in QEMU.
#![no_std]
#![no_main]

mod chip;

use core::fmt::Write;
use core::panic::PanicInfo;

use chip::{Semihosting, Ticks, Uart};
use incircle_embedded::{records_needed, Buffers, Device, Point};

/// The points, as rows `x,y`.
const ROWS: &[u8] = include_bytes!(env!("INCIRCLE_POINTS"));
/// Most points that this program has room for.
const ROOM: usize = 1024;
/// Milliseconds that the job may take.
const PATIENCE: u32 = 30_000;

/// The lists of the job, which are static so that the stack tells what the driver needs.
struct Lists {
    points: [Point; ROOM],
    order: [u16; ROOM],
    records: [[u16; 3]; records_needed(ROOM)],
}

impl Lists {
    const EMPTY: Self = Self { points: [[0; 2]; ROOM], order: [0; ROOM], records: [[0; 3]; records_needed(ROOM)] };
}

/// Reads rows of two numbers, and returns how many there were.
fn read(rows: &[u8], points: &mut [Point]) -> usize {
    let mut count = 0;
    for (row, point) in rows.split(|&byte| byte == b'\n').filter(|row| !row.is_empty()).zip(points) {
        for (number, place) in row.split(|&byte| byte == b',').zip(point) {
            let digits = number.iter().filter(|byte| byte.is_ascii_digit());
            *place = digits.fold(0, |value: u16, byte| value.wrapping_mul(10).wrapping_add(u16::from(byte - b'0')));
        }
        count += 1;
    }
    count
}

fn job(lists: &mut Lists) -> Result<(), core::fmt::Error> {
    let mut out = Semihosting::new();
    let count = read(ROWS, &mut lists.points);
    let points = lists.points.get(..count).unwrap_or_default();
    let started = Ticks.count();
    let mut device = Device::new(Uart::new(), Ticks);
    let buffers = Buffers { order: &mut lists.order, records: &mut lists.records };
    match device.triangulate(points, buffers, PATIENCE) {
        Ok(mesh) => {
            for [a, b, c] in mesh.triangles() {
                writeln!(out, "{a},{b},{c}")?;
            }
            let hull = mesh.hull().count();
            writeln!(out, "# {count} points, {} triangles, {hull} points on the hull", mesh.triangles().len())?;
            writeln!(out, "# {} ms of the microcontroller's clock", Ticks.count().wrapping_sub(started))
        }
        Err(error) => writeln!(out, "# {error}"),
    }
}

/// The program behind the reset.
fn main() -> ! {
    chip::start_clock();
    chip::paint_stack();
    chip::with_lists(|lists| {
        // A failed print is a failed comparison.
        let _ = job(lists);
    });
    let mut out = Semihosting::new();
    let _ = writeln!(out, "# {} bytes of stack", chip::deepest_stack());
    drop(out);
    chip::exit()
}

#[panic_handler]
fn panic(_: &PanicInfo<'_>) -> ! {
    chip::exit()
}
