//! A binding to Verilator: translation of Verilog at build time, and models with ports by name at run time.
//!
//! The crate has two halves, one for each feature:
//! - `build`, for a `build.rs`: `build::Builder` takes Verilog texts, runs Verilator and the C++ compiler, and links
//!   any number of models statically into the crate;
//! - `run`, for the program: [`Model`] is one instance of such a model. [`include_models!`] brings the descriptions
//!   that the build script left into scope.
//!
//! ```text
//! // build.rs
//! Builder::new().model(ModelSource::new("counter", "counter", text)).compile();
//! // the crate
//! mod models { verilated::include_models!(); }
//! let mut model = Model::new(models::counter());
//! ```
//!
//! The binding works with Verilator 5.006 and newer.

#[cfg(any(feature = "build", test))]
pub mod build;
#[cfg(feature = "run")]
mod description;
#[cfg(feature = "run")]
mod model;
#[cfg(feature = "run")]
mod trace;

#[cfg(feature = "run")]
pub use description::{Direction, ModelDescription, Port, PortError, PortId};
#[cfg(feature = "run")]
pub use model::Model;
#[cfg(feature = "run")]
pub use trace::TraceError;

/// Brings the models that the build script compiled into the current module: a function for each model that returns its
/// [`ModelDescription`], and `find(name)`, which finds a model by name.
#[macro_export]
macro_rules! include_models {
    () => {
        include!(concat!(env!("OUT_DIR"), "/verilated_models.rs"));
    };
}
