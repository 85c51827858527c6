//! The engine of the npm package `incircle`, compiled to WebAssembly.
//!
//! JavaScript calls the exported functions through `js/engine.js` and nothing else does. They take and return plain
//! numbers, so the package needs no generator of bindings. Points go in through one buffer (`border`), and lists come
//! out as addresses that JavaScript copies from. File by file: `border` holds buffers, lists and messages; `batch`
//! triangulates a set; `ties` finds the edges that the tie rule decided; `constrain` forces edges into a mesh; `living`
//! keeps meshes that change; `memory` counts the bytes that are allocated. With the feature `core`, for the page,
//! `core_at_work` runs the model of the core clock by clock.

mod batch;
mod border;
mod constrain;
#[cfg(feature = "core")]
mod core_at_work;
// The library deals points to contexts in the same way. It does not compile for the web, but this file of it does.
#[cfg(feature = "core")]
#[allow(dead_code)]
#[path = "../../src/job/deal.rs"]
mod deal;
mod living;
mod memory;
mod ties;
