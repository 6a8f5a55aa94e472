//! Parameter sweeps: runs of a scenario over a grid of parameters and seeds, with one table of results.
//!
//! [`SweepPlan::make`] turns a [`SweepRequest`] into jobs. A job is one run of the scenario with values of parameters
//! and a seed; its key is the SHA-256 of everything that the run depends on. [`run_job`] runs a job on a copy of the
//! scenario's files, wherever that copy is, and [`SweepFolder`] keeps its result under the key, so that a sweep
//! continues where it ended. [`SweepTable::assemble`] makes the table in the order of the jobs: it is the same to the
//! byte whatever ran them. [`LocalPool`] runs jobs in processes of this machine.
//!
//! ```
//! use periplus_sweeps::ParameterRange;
//!
//! let range: ParameterRange = "inflation_radius=0.3:0.8:6".parse()?;
//! assert_eq!(range.values(), ["0.3", "0.4", "0.5", "0.6", "0.7", "0.8"]);
//! # Ok::<(), periplus_sweeps::RangeError>(())
//! ```

mod error;
mod folder;
mod inputs;
mod job;
mod names;
mod overview;
mod parquet;
mod plan;
mod pool;
mod range;
mod result;
mod slurm;
mod statistics;
mod table;

pub use error::SweepError;
pub use folder::SweepFolder;
pub use inputs::{InputFile, SweepInputs};
pub use job::{JobFailure, run_job};
pub use names::ParameterTarget;
pub use overview::overview_svg;
pub use parquet::write_parquet;
pub use plan::{SweepJob, SweepPlan, SweepRequest};
pub use pool::{JobEnd, LocalPool};
pub use range::{MAX_RUNS, ParameterRange, RangeError, grid};
pub use result::{JobAssertion, JobResult};
pub use slurm::slurm_script;
pub use statistics::{MetricStatistics, PointStatistics, statistics};
pub use table::{Column, ColumnValues, SweepTable};
