//! Case files that define the behaviour of other programs, checked against this project.
//!
//! A case is a JSON file: an `id`, a `kind`, what is `given` and what to `expect`, and the
//! distributions of ROS that it `applies_to`. Each kind has a module in [`kinds`], which runs the
//! inputs as a user would, and records every [`Differences`]. A kind without a check is not
//! passed: it is [`Verdict::Unknown`].
//!
//! ```
//! use std::path::Path;
//!
//! use periplus_conformance::{Verdict, run};
//! use periplus_resources::MemoryHost;
//!
//! let case = r#"{"id": "path_expand.home", "kind": "path_expand", "title": "home",
//!     "applies_to": ["jazzy"], "given": {"pairs": [["~/a.yaml", "/home/user"]]},
//!     "expect": {"paths": ["/home/user/a.yaml"]}}"#;
//! let host = MemoryHost::new().with_file("/cases/a.json", case);
//! let report = run(Path::new("/cases"), &host)?;
//! assert_eq!(report.results[0].verdict, Verdict::Passed);
//! # Ok::<(), periplus_conformance::NoCases>(())
//! ```

mod case;
mod differences;
mod expected;
pub mod kinds;
mod reader;
mod report;
mod run;
mod used;

pub use case::Case;
pub use differences::{Differences, number, numbers};
pub use expected::Expected;
pub use kinds::{Check, Setting};
pub use reader::{CaseReader, Unreadable};
pub use report::{ConformanceReport, Tally};
pub use run::{CaseOutcome, NoCases, Verdict, run, run_text};
pub use used::Used;
