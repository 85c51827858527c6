//! The border to C: everything that reads or writes memory of the caller.
#![allow(unsafe_code)] // pointers of the caller

use std::ffi::{c_char, c_void, CStr};

use incircle::MAX_POINTS;
use incircle_geometry::pages::has_room;

use crate::status::{Failure, Outcome, INCIRCLE_ARGUMENT, INCIRCLE_BUFFER, INCIRCLE_CAPACITY, INCIRCLE_MEMORY};

/// The failure for a pointer that is null or not aligned.
fn bad(name: &str) -> Failure {
    Failure::new(INCIRCLE_ARGUMENT, format!("the pointer `{name}` is null or not aligned: give the address of an item"))
}

/// The item that a pointer of the caller points to.
///
/// # Safety
/// A pointer that is not null points to an item that nobody else changes meanwhile.
pub unsafe fn shared<'a, T>(pointer: *const T, name: &str) -> Outcome<&'a T> {
    if !pointer.is_aligned() {
        return Err(bad(name));
    }
    // SAFETY: the pointer is aligned, and the caller promises the rest.
    unsafe { pointer.as_ref() }.ok_or_else(|| bad(name))
}

/// The item that a pointer of the caller points to, to be changed.
///
/// # Safety
/// A pointer that is not null points to an item that nobody else uses meanwhile.
pub unsafe fn exclusive<'a, T>(pointer: *mut T, name: &str) -> Outcome<&'a mut T> {
    if !pointer.is_aligned() {
        return Err(bad(name));
    }
    // SAFETY: the pointer is aligned, and the caller promises the rest.
    unsafe { pointer.as_mut() }.ok_or_else(|| bad(name))
}

/// Copies `count` items of the caller. Nothing is read if there are none.
///
/// # Safety
/// A pointer that is not null points to `count` items.
pub unsafe fn copied<T: Copy>(pointer: *const c_void, count: usize, name: &str) -> Outcome<Vec<T>> {
    let pointer = pointer.cast::<T>();
    if count > MAX_POINTS {
        let text = format!("{count} points are more than the {MAX_POINTS} that indices allow: cut the set into parts");
        return Err(Failure::new(INCIRCLE_CAPACITY, text));
    }
    let mut list = Vec::new();
    if count == 0 {
        return Ok(list);
    }
    if pointer.is_null() || !pointer.is_aligned() {
        return Err(bad(name));
    }
    list.try_reserve_exact(count).map_err(|_| no_memory(count * size_of::<T>()))?;
    // SAFETY: the pointer is neither null nor misaligned, and the caller promises the items. They have fewer bytes than
    // half of the address space, because there are at most `MAX_POINTS`.
    list.extend_from_slice(unsafe { std::slice::from_raw_parts(pointer, count) });
    Ok(list)
}

/// One place of the caller: two coordinates.
///
/// # Safety
/// A pointer that is not null points to two coordinates.
pub unsafe fn place<P: Copy>(pointer: *const c_void) -> Outcome<P> {
    // SAFETY: the caller promises two coordinates.
    unsafe { copied::<P>(pointer, 1, "place") }?.pop().ok_or_else(|| bad("place"))
}

/// The text at a pointer; `None` if it is null.
///
/// # Safety
/// A pointer that is not null points to bytes that end with a zero.
pub unsafe fn text<'a>(pointer: *const c_char, name: &str) -> Outcome<Option<&'a str>> {
    if pointer.is_null() {
        return Ok(None);
    }
    // SAFETY: the pointer is not null, and the caller promises the rest.
    let text = unsafe { CStr::from_ptr(pointer) }.to_str();
    text.map(Some).map_err(|_| Failure::new(INCIRCLE_ARGUMENT, format!("the text `{name}` is not UTF-8")))
}

/// Writes a list to a buffer.
///
/// # Safety
/// The buffer is aligned and has room for the list.
pub unsafe fn fill<T: Copy>(list: &[T], buffer: *mut T) {
    // SAFETY: the caller promises the room, and a list of ours does not overlap memory of theirs.
    unsafe { std::ptr::copy_nonoverlapping(list.as_ptr(), buffer, list.len()) };
}

/// Gives a list to the caller: its length, and the items if there is a buffer.
///
/// # Safety
/// A buffer that is not null has room for `room` items, and `count` may be written.
pub unsafe fn give<T: Copy>(list: &[T], buffer: *mut T, room: usize, count: *mut usize) -> Outcome {
    // SAFETY: the caller promises that the count may be written.
    *unsafe { exclusive(count, "count") }? = list.len();
    if buffer.is_null() {
        return Ok(());
    }
    if !buffer.is_aligned() {
        return Err(bad("buffer"));
    }
    if list.len() > room {
        let text = format!("the buffer has room for {room} items, but there are {}: give a larger one", list.len());
        return Err(Failure::new(INCIRCLE_BUFFER, text));
    }
    // SAFETY: the buffer has room for `room` items.
    unsafe { fill(list, buffer) };
    Ok(())
}

/// Looks whether there are `bytes` bytes of memory. The library takes memory without a way to refuse, so this is asked
/// before.
pub fn look_for_memory(bytes: usize) -> Outcome {
    has_room(bytes).then_some(()).ok_or_else(|| no_memory(bytes))
}

fn no_memory(bytes: usize) -> Failure {
    Failure::new(INCIRCLE_MEMORY, format!("there is no memory for {bytes} bytes: use fewer points, or free some"))
}
