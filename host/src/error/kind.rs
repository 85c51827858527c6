//! Kinds of errors, for exit codes.

/// The kind of an error: whose fault it is, and so who can do something about it.
///
/// Use the kind for exit codes, and wherever a program only decides between "ask the user" and "try another device".
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum ErrorKind {
    /// The points cannot be used as they are: correct or quantise them.
    BadInput,
    /// A choice is impossible, such as 32 coordinate bits, or more contexts than the device has.
    BadChoice,
    /// There is no device at the address, or it cannot be opened.
    DeviceNotFound,
    /// Words did not get through between the host and the device.
    Link,
    /// The device gave an answer that no sound device gives, or reported a failure.
    Device,
    /// The device did not answer in time.
    Timeout,
    /// There are more points than a job may have, or the memory of the device is full.
    Capacity,
    /// The progress listener ended the job.
    Cancelled,
}
