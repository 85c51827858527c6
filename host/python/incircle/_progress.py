"""The progress of a job, for functions and for bars of tqdm."""

from __future__ import annotations

from typing import Any, Callable, Protocol, Union, cast

from ._errors import ChoiceError

Listener = Callable[[str, int, int], Any]
"""A function of the stage, the items that are done, and the items of the stage in all."""


class Bar(Protocol):
    """What is used of a bar of tqdm."""

    n: Any
    total: Any

    def set_description(self, desc: str | None = None, refresh: bool | None = True) -> None: ...

    def refresh(self) -> Any: ...


Progress = Union[Listener, Bar]


def listener(progress: Progress | None) -> Listener | None:
    """A function for the library, of what the caller gave."""
    if progress is None:
        return None
    # A bar of tqdm can be called in some of its forms, so this comes first.
    if hasattr(progress, "set_description") and hasattr(progress, "refresh"):
        return _to(cast(Bar, progress))
    if callable(progress):
        return progress
    raise ChoiceError(
        f"progress is a {type(progress).__name__}: give a function of the stage, the items done and all items, "
        "or a bar of tqdm"
    )


def _to(bar: Bar) -> Listener:
    def tell(stage: str, done: int, total: int) -> None:
        bar.set_description(stage, refresh=False)
        bar.total, bar.n = total, done
        bar.refresh()

    return tell
