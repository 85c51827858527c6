//! The engine of the npm package `incircle`, compiled to WebAssembly.
//!
//! JavaScript calls the exported functions through `js/engine.js` and nothing else does. They take and return plain
//! numbers, so the package needs no generator of bindings. Points go in through one buffer (`border`), and lists come
//! out as addresses that JavaScript copies from. File by file: `border` holds buffers, lists and messages; `batch`
//! triangulates a set; `constrain` forces edges into a mesh; `living` keeps meshes that change;
//! `memory` counts the bytes that are allocated.

mod batch;
mod border;
mod constrain;
mod living;
mod memory;
