//! Whose fault an error is.

/// What kind of error it is, for exit codes and for callers that only want to know whose fault it was.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum ErrorKind {
    /// The points cannot be used as they are.
    BadInput,
    /// A choice that does not exist, such as 32 coordinate bits, or more contexts than the device has.
    BadChoice,
    /// There is no device at the address, or it may not be opened.
    DeviceNotFound,
    /// Words did not get through.
    Link,
    /// The device answered nonsense or reported a failure.
    Device,
    /// The device did not answer in time.
    Timeout,
    /// More points, or wider coordinates, than the device holds.
    Capacity,
    /// The progress listener ended the job.
    Cancelled,
}
