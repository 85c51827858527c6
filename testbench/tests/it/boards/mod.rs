//! The tops of the boards, and what belongs to one board alone.

mod acorn;
mod tops;
