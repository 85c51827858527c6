//! Statuses, and the text of the last error.
#![allow(unsafe_code)] // functions that C calls

use std::cell::RefCell;
use std::ffi::c_char;
use std::panic::{catch_unwind, AssertUnwindSafe};

use incircle::{living, ConstrainedError, Error, ErrorKind};

use crate::border::fill;

/// The number of this interface. It changes when a program must be compiled again.
pub const INCIRCLE_ABI: u32 = 1;

/// The call did what it says.
pub const INCIRCLE_OK: i32 = 0;
/// A pointer is null or not aligned where that is not allowed, or a number that stands for a type is none.
pub const INCIRCLE_ARGUMENT: i32 = 1;
/// The points cannot be used as they are.
pub const INCIRCLE_INPUT: i32 = 2;
/// A choice is impossible, such as threads for a device.
pub const INCIRCLE_CHOICE: i32 = 3;
/// There is no device at the address, or it cannot be opened.
pub const INCIRCLE_DEVICE_NOT_FOUND: i32 = 4;
/// Words did not get through between the host and the device.
pub const INCIRCLE_LINK: i32 = 5;
/// The device gave an answer that no sound device gives.
pub const INCIRCLE_DEVICE: i32 = 6;
/// The device did not answer in time.
pub const INCIRCLE_TIMEOUT: i32 = 7;
/// There are more points than indices allow.
pub const INCIRCLE_CAPACITY: i32 = 8;
/// The function that hears of the progress ended the job.
pub const INCIRCLE_CANCELLED: i32 = 9;
/// There is not enough memory.
pub const INCIRCLE_MEMORY: i32 = 10;
/// No living point has the index.
pub const INCIRCLE_INDEX: i32 = 11;
/// The buffer is too small. The count says how many items it needs.
pub const INCIRCLE_BUFFER: i32 = 12;
/// The mesh is not the canonical one of its points.
pub const INCIRCLE_WRONG_MESH: i32 = 13;
/// The library has a defect: please report it.
pub const INCIRCLE_DEFECT: i32 = 14;

/// Why a call failed.
pub(crate) struct Failure {
    pub(crate) status: i32,
    pub(crate) text: String,
}

pub(crate) type Outcome<T = ()> = Result<T, Failure>;

impl Failure {
    pub(crate) fn new(status: i32, text: impl Into<String>) -> Self {
        Self { status, text: text.into() }
    }
}

impl From<Error> for Failure {
    fn from(error: Error) -> Self {
        let status = match error.kind() {
            ErrorKind::BadInput => INCIRCLE_INPUT,
            ErrorKind::BadChoice => INCIRCLE_CHOICE,
            ErrorKind::DeviceNotFound => INCIRCLE_DEVICE_NOT_FOUND,
            ErrorKind::Link => INCIRCLE_LINK,
            ErrorKind::Timeout => INCIRCLE_TIMEOUT,
            ErrorKind::Capacity => INCIRCLE_CAPACITY,
            ErrorKind::Cancelled => INCIRCLE_CANCELLED,
            _ => INCIRCLE_DEVICE,
        };
        Self::new(status, error.to_string())
    }
}

impl From<ConstrainedError> for Failure {
    fn from(error: ConstrainedError) -> Self {
        match error {
            ConstrainedError::Job(error) => error.into(),
            error => Self::new(INCIRCLE_INPUT, error.to_string()),
        }
    }
}

impl From<living::Error> for Failure {
    fn from(error: living::Error) -> Self {
        let status = match error {
            living::Error::Deleted { .. } | living::Error::Unknown { .. } => INCIRCLE_INDEX,
            living::Error::TooManyPoints | living::Error::IndicesUsedUp => INCIRCLE_CAPACITY,
            _ => INCIRCLE_INPUT,
        };
        Self::new(status, error.to_string())
    }
}

thread_local! {
    /// The text of the last error of this thread.
    static LAST: RefCell<String> = const { RefCell::new(String::new()) };
}

/// Does the work of a call. A failure is noted with its text, and a panic ends here.
pub(crate) fn guarded(work: impl FnOnce() -> Outcome) -> i32 {
    let defect = |_| Err(Failure::new(INCIRCLE_DEFECT, "the library has a defect: please report what led to it"));
    match catch_unwind(AssertUnwindSafe(work)).unwrap_or_else(defect) {
        Ok(()) => INCIRCLE_OK,
        Err(Failure { status, text }) => {
            // In a thread that ends, a destructor of C++ may call when the text is gone. The status must do then.
            let _ = LAST.try_with(|last| last.replace(text));
            status
        }
    }
}

/// The number of the interface of the library that is loaded: compare it with `INCIRCLE_ABI`.
#[no_mangle]
pub extern "C" fn incircle_abi() -> u32 {
    INCIRCLE_ABI
}

/// Writes the sentence about the last call that failed in this thread, with a zero at its end, and cuts it off if the
/// buffer is too small. Returns how many bytes the whole sentence needs, the zero included. `text` may be null if
/// `room` is 0.
///
/// # Safety
/// `text` points to `room` bytes that may be written.
#[no_mangle]
pub unsafe extern "C" fn incircle_error(text: *mut c_char, room: usize) -> usize {
    let said = LAST.try_with(|last| {
        let last = last.borrow();
        let cut = last.as_bytes().iter().take(room.saturating_sub(1));
        if room > 0 && !text.is_null() {
            let bytes: Vec<c_char> = cut.map(|&byte| byte as c_char).chain([0]).collect();
            // SAFETY: there are at most `room` bytes, which the caller lets us write.
            unsafe { fill(&bytes, text) };
        }
        last.len() + 1
    });
    said.unwrap_or_else(|_| {
        if room > 0 && !text.is_null() {
            // SAFETY: the caller lets us write a byte.
            unsafe { fill(&[0], text) };
        }
        1
    })
}
