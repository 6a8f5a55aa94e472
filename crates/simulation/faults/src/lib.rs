//! Faults of sensors, messages, wheels and worlds in a simulation.
//!
//! [`read_list`] reads faults from YAML, each with its parameters as [`FaultKind::tables`] declares them. A
//! [`FaultInjector`] applies them to a running simulation: it intercepts messages between publishers and subscribers,
//! and changes wheels, surfaces and models. Each fault has a separate random stream, keyed by the seed, the fault and
//! the time, so that the same run has the same faults, and one fault does not change the random numbers of another.
//!
//! ```
//! use periplus_diagnostics::{Diagnostics, SourceMap};
//!
//! let (mut sources, mut diagnostics) = (SourceMap::new(), Diagnostics::new());
//! let file = sources.add("faults.yaml", "- latency: {topic: /scan, mean: 0.2, from: 5}");
//! let tree = periplus_yaml::parse(file, &sources).unwrap().unwrap();
//! let faults = periplus_faults::read_list(&tree, &mut diagnostics);
//! assert_eq!((faults[0].from_s, faults[0].until_s), (5.0, f64::INFINITY));
//! ```

mod injector;
mod kinds;
mod messages;
pub mod models;
mod read;
mod section;
mod stamps;
mod world;

pub use injector::{FAULT_TOPIC, FaultInjector};
pub use kinds::{
    BiasParams, BlockedSectorParams, BoxParams, ClockJumpParams, ClosedDoorParams, DropoutParams,
    DuplicateParams, FaultKind, FaultWindowParams, GlassParams, GyroDriftParams, KidnapParams,
    LatencyParams, LowFrictionParams, MirrorParams, MovedModelParams, NoiseParams,
    PacketLossParams, ReorderParams, StuckReadingsParams, StuckWheelParams, WheelSlipParams,
};
pub use read::{InjectedFault, read_fault, read_list};
pub use section::{flat_text, read_section};
pub use stamps::{has_header, header_stamp_ns};
