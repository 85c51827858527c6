//! Memory for long lists, in large pages where the system has them.
//!
//! The CPU triangulator reads and writes its lists in scattered order. In pages of 4 kB nearly every such access misses
//! the processor's table of pages. Pages of 2 MB all fit that table, and the system has far fewer of them to hand out.

use alloc::vec::Vec;
use core::hint::black_box;

use bytemuck::Zeroable;

/// Lists of at least this many bytes, two large pages, ask for large pages.
const LARGE: usize = 4 << 20;

/// Makes an empty list with room for `count` items.
pub fn with_room<T>(count: usize) -> Vec<T> {
    let list = Vec::with_capacity(count);
    if size_of::<T>() * list.capacity() >= LARGE {
        advise(&list);
    }
    list
}

/// Whether `bytes` more bytes of memory can be had. They are given back at once.
///
/// This crate takes memory without a way to refuse, and a program that runs out of memory ends. A caller that must not
/// end asks before a job.
///
/// ```
/// assert!(incircle_geometry::pages::has_room(1 << 10));
/// assert!(!incircle_geometry::pages::has_room(usize::MAX));
/// ```
pub fn has_room(bytes: usize) -> bool {
    let mut room = Vec::<u8>::new();
    let has_room = room.try_reserve_exact(bytes).is_ok();
    // The compiler may leave out memory that nobody looks at.
    black_box(room.as_ptr());
    has_room
}

/// Makes a list of `count` zeros.
///
/// The system provides each page when a thread first touches it, so an untouched end of the list costs nothing.
pub fn zeros<T: Zeroable>(count: usize) -> Vec<T> {
    let list = bytemuck::try_zeroed_vec(count).unwrap_or_else(|()| {
        // There is not enough memory. The standard library then ends the program with its usual message.
        let mut list = Vec::with_capacity(count);
        list.resize_with(count, T::zeroed);
        list
    });
    if size_of::<T>() * count >= LARGE {
        advise(&list);
    }
    list
}

/// Asks for large pages for the memory of a list. A refusal is ignored, because large pages only affect speed.
#[cfg(all(target_os = "linux", feature = "std"))]
#[allow(unsafe_code)] // a system call that no safe library offers for a `Vec`
fn advise<T>(list: &Vec<T>) {
    const PAGE: usize = 4096;
    let begin = list.as_ptr().addr().next_multiple_of(PAGE);
    let end = (list.as_ptr().addr() + size_of::<T>() * list.capacity()) / PAGE * PAGE;
    if begin < end {
        // SAFETY: the whole pages between `begin` and `end` belong to this list alone, and the advice
        // leaves their contents unchanged.
        unsafe { libc::madvise(list.as_ptr().with_addr(begin).cast_mut().cast(), end - begin, libc::MADV_HUGEPAGE) };
    }
}

/// Does nothing: other systems choose their pages themselves, and without `std` there may be no system to ask.
#[cfg(not(all(target_os = "linux", feature = "std")))]
fn advise<T>(_: &Vec<T>) {}
