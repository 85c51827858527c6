//! An allocator that counts the bytes in use, so that tests can see whether calls leak.
#![allow(unsafe_code)] // the interface of allocators

use std::alloc::{GlobalAlloc, Layout, System};
use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};

struct Counting;

static USED: AtomicUsize = AtomicUsize::new(0);

// SAFETY: all requests go to the allocator of the system unchanged.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        let place = System.alloc(layout);
        if !place.is_null() {
            USED.fetch_add(layout.size(), Relaxed);
        }
        place
    }

    unsafe fn alloc_zeroed(&self, layout: Layout) -> *mut u8 {
        let place = System.alloc_zeroed(layout);
        if !place.is_null() {
            USED.fetch_add(layout.size(), Relaxed);
        }
        place
    }

    unsafe fn dealloc(&self, place: *mut u8, layout: Layout) {
        USED.fetch_sub(layout.size(), Relaxed);
        System.dealloc(place, layout);
    }

    unsafe fn realloc(&self, place: *mut u8, layout: Layout, size: usize) -> *mut u8 {
        let moved = System.realloc(place, layout, size);
        if !moved.is_null() {
            USED.fetch_add(size, Relaxed);
            USED.fetch_sub(layout.size(), Relaxed);
        }
        moved
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

/// The bytes that are allocated now.
#[no_mangle]
pub extern "C" fn used_bytes() -> usize {
    USED.load(Relaxed)
}
