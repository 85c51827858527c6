//! Room for long lists, in large pages where the system has them.
//!
//! Lists are read and written all over, in the order of the input along the curve and back. In pages of 4 kB nearly
//! every such access first has to find its page; in pages of 2 MB the processor knows them all, and the system hands
//! out far fewer.

use alloc::vec::Vec;

use bytemuck::Zeroable;

/// Bytes from which on a list is worth large pages: two of them.
const LARGE: usize = 4 << 20;

/// An empty list with room for so many items.
pub fn with_room<T>(count: usize) -> Vec<T> {
    let list = Vec::with_capacity(count);
    if size_of::<T>() * list.capacity() >= LARGE {
        advise(&list);
    }
    list
}

/// A list of so many zeros, which the system gives as they are needed: to whichever thread needs them first.
pub fn zeros<T: Zeroable>(count: usize) -> Vec<T> {
    let list = bytemuck::try_zeroed_vec(count).unwrap_or_else(|()| {
        // There is no memory, and the standard library says so in its own way.
        let mut list = Vec::with_capacity(count);
        list.resize_with(count, T::zeroed);
        list
    });
    if size_of::<T>() * count >= LARGE {
        advise(&list);
    }
    list
}

/// Asks for large pages for the room of a list. Where they cannot be had, nothing happens: it is a matter of speed
/// only.
#[cfg(all(target_os = "linux", feature = "std"))]
#[allow(unsafe_code)] // a system call that no safe library offers for a `Vec`
fn advise<T>(list: &Vec<T>) {
    const PAGE: usize = 4096;
    let begin = list.as_ptr().addr().next_multiple_of(PAGE);
    let end = (list.as_ptr().addr() + size_of::<T>() * list.capacity()) / PAGE * PAGE;
    if begin < end {
        // SAFETY: the whole pages between belong to this list alone, and the advice changes nothing of what is in them.
        unsafe { libc::madvise(list.as_ptr().with_addr(begin).cast_mut().cast(), end - begin, libc::MADV_HUGEPAGE) };
    }
}

/// Other systems choose by themselves, and without `std` there may be no system to ask.
#[cfg(not(all(target_os = "linux", feature = "std")))]
fn advise<T>(_: &Vec<T>) {}
