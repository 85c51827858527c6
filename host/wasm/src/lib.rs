//! The engine of the npm package `incircle`, compiled to WebAssembly.
//!
//! JavaScript calls the exported functions through `js/engine.js` and nothing else does. They take and return plain
//! numbers, so the package needs no generator of bindings. Points go in through one buffer (`border`), and lists come
//! out as addresses that JavaScript copies from. File by file: `border` holds buffers, lists and messages; `batch`
//! triangulates a set; `ties` finds the edges that the tie rule decided; `constrain` forces edges into a mesh; `living`
//! keeps meshes that change; `memory` counts the bytes that are allocated. The feature `page` adds what the page needs:
//! `plane` is the mesh that follows the mouse, `light` draws it, and `core_at_work` runs the model of the core clock by
//! clock, both on the points of `grid`.

mod batch;
mod border;
mod constrain;
#[cfg(feature = "page")]
mod core_at_work;
// The library deals points to contexts in the same way. It does not compile for the web, but this file of it does.
#[cfg(feature = "page")]
#[allow(dead_code)]
#[path = "../../src/job/deal.rs"]
mod deal;
#[cfg(feature = "page")]
mod grid;
#[cfg(feature = "page")]
mod light;
mod living;
mod memory;
#[cfg(feature = "page")]
mod plane;
mod ties;
