//! The data that crosses the border between JavaScript and the engine: points and indices in, lists and messages out.
//!
//! A module of WebAssembly has one thread here, so one set of buffers is enough. JavaScript asks for room, writes to
//! the address that it gets, calls a function, copies the lists, and drops them with [`forget`].
#![allow(unsafe_code)] // names of functions that JavaScript calls

use std::cell::RefCell;
use std::fmt::Display;

/// Points in the buffer, as JavaScript writes them.
pub type Points = Vec<[f64; 2]>;

/// Indicates to JavaScript that a call failed and that [`message`] says why.
pub const FAILED: f64 = -2.0;

#[derive(Default)]
struct Border {
    points: Points,
    places: Points,
    indices: Vec<u32>,
    lists: Vec<Vec<u32>>,
    message: String,
}

thread_local! {
    static BORDER: RefCell<Border> = RefCell::default();
}

/// A vector of this many zeros, or `None` if there is no memory for it.
fn zeros<T: Clone + Default>(count: usize) -> Option<Vec<T>> {
    let mut list = Vec::new();
    list.try_reserve_exact(count).ok()?;
    list.resize(count, T::default());
    Some(list)
}

/// Makes room for `count` points, and returns the address to which x and y of each are to be written. The address is 0
/// if there is no memory for them.
#[no_mangle]
pub extern "C" fn room_for_points(count: usize) -> usize {
    BORDER.with_borrow_mut(|border| {
        border.points = Vec::new();
        let Some(points) = zeros(count) else { return 0 };
        border.points = points;
        border.points.as_ptr() as usize
    })
}

/// Makes room for `count` places that are no points of the set, and returns the address to which x and y of each are to
/// be written, or 0.
#[no_mangle]
pub extern "C" fn room_for_places(count: usize) -> usize {
    BORDER.with_borrow_mut(|border| {
        border.places = Vec::new();
        let Some(places) = zeros(count) else { return 0 };
        border.places = places;
        border.places.as_ptr() as usize
    })
}

/// Makes room for `count` indices, and returns the address to which they are to be written, or 0.
#[no_mangle]
pub extern "C" fn room_for_indices(count: usize) -> usize {
    BORDER.with_borrow_mut(|border| {
        border.indices = Vec::new();
        let Some(indices) = zeros(count) else { return 0 };
        border.indices = indices;
        border.indices.as_ptr() as usize
    })
}

/// The address of a list of the last call.
#[no_mangle]
pub extern "C" fn list(number: usize) -> usize {
    BORDER.with_borrow(|border| border.lists.get(number).map_or(0, |list| list.as_ptr() as usize))
}

/// The number of items of a list of the last call.
#[no_mangle]
pub extern "C" fn list_length(number: usize) -> usize {
    BORDER.with_borrow(|border| border.lists.get(number).map_or(0, Vec::len))
}

/// The address of the last message, in UTF-8.
#[no_mangle]
pub extern "C" fn message() -> usize {
    BORDER.with_borrow(|border| border.message.as_ptr() as usize)
}

/// The number of bytes of the last message.
#[no_mangle]
pub extern "C" fn message_length() -> usize {
    BORDER.with_borrow(|border| border.message.len())
}

/// Drops all buffers, lists and messages.
#[no_mangle]
pub extern "C" fn forget() {
    BORDER.set(Border::default());
}

/// Takes the points that JavaScript has written.
pub fn points() -> Points {
    BORDER.with_borrow_mut(|border| std::mem::take(&mut border.points))
}

/// Takes the places that JavaScript has written.
pub fn places() -> Points {
    BORDER.with_borrow_mut(|border| std::mem::take(&mut border.places))
}

/// Takes the indices that JavaScript has written.
pub fn indices() -> Vec<u32> {
    BORDER.with_borrow_mut(|border| std::mem::take(&mut border.indices))
}

/// Keeps lists until JavaScript has copied them.
pub fn give(lists: Vec<Vec<u32>>) {
    BORDER.with_borrow_mut(|border| border.lists = lists);
}

/// The number for JavaScript, or [`FAILED`] with the error kept as message.
pub fn told<E: Display>(result: Result<f64, E>) -> f64 {
    result.unwrap_or_else(|error| {
        BORDER.with_borrow_mut(|border| border.message = error.to_string());
        FAILED
    })
}
