"""The exceptions of the package. Each text is one sentence, with the numbers and what to do."""

from __future__ import annotations


class Error(Exception):
    """The base of all exceptions of the package."""


class InputError(Error, ValueError):
    """The points cannot be used as they are: a wrong shape, a value that is not finite, or one out of range."""


class NumberTypeError(Error, TypeError):
    """The points have a type of numbers that cannot be taken exactly."""


class ChoiceError(Error, ValueError):
    """A choice is impossible, such as 0 threads."""


class DeviceNotFoundError(Error, OSError):
    """There is no device at the address, or it cannot be opened."""


class LinkError(Error, OSError):
    """Words did not get through between the host and the device."""


class DeviceError(Error, RuntimeError):
    """The device gave an answer that no sound device gives, or reported a failure."""


class DeviceTimeoutError(Error, TimeoutError):
    """The device did not answer in time."""


class CapacityError(Error, ValueError):
    """There are more points than indices allow."""


class OutOfMemoryError(Error, MemoryError):
    """There is not enough memory for the most that the job may need. This is found before the job begins."""


class Cancelled(Error):
    """The function that hears of the progress ended the job."""


class UnknownPointError(Error, IndexError):
    """No living point of a `Triangulation` has the index."""


class VerifyError(Error, ValueError):
    """The mesh is not the canonical one of its points."""
