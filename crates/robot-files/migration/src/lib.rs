//! Conversion of robot and world files of Gazebo Classic to current Gazebo (Harmonic, gz-sim 8).
//!
//! Files are edited, not rewritten: everything outside of the converted elements keeps its bytes, also comments, macros of
//! xacro and expressions such as `${radius}` in the values of plugins. [`migrate`] converts one file. The same function on
//! the expanded robot gives the topics of the bridge with their final names.
//!
//! ```
//! use periplus_migration::{MigrationContext, MigrationOutcome, migrate};
//! use periplus_resources::{MemoryHost, Resolver};
//!
//! let old = r#"<sdf version="1.6"><model name="m"><plugin name="states"
//!   filename="libgazebo_ros_joint_state_publisher.so"><joint_name>arm</joint_name></plugin></model></sdf>"#;
//! let host = MemoryHost::new();
//! let resolver = Resolver::new(&host, &[]);
//! let context = MigrationContext::new("/m.sdf".as_ref(), &host, &resolver);
//! let migrated = migrate(old, &context).expect("XML");
//! assert!(migrated.text.contains("gz::sim::systems::JointStatePublisher"));
//! assert_eq!(migrated.entries[0].outcome, MigrationOutcome::Converted);
//! assert_eq!(migrated.bridge[0].ros_topic_name, "/joint_states");
//! ```

mod bridge;
mod edits;
mod entry;
mod launch;
mod material;
mod ogre;
mod old_plugin;
mod plugin;
mod population;
mod replacement;
mod sensor;
mod source;
mod template;
mod transmission;
mod walk;
mod world;

#[cfg(test)]
mod tests;

use std::collections::BTreeMap;
use std::path::Path;

use periplus_diagnostics::{Diagnostics, SourceMap};
use periplus_plugin_specs::Family;
use periplus_resources::{Host, Resolver};

pub use bridge::{BridgeEntry, BridgeFlow, bridge_yaml, clock_bridge};
pub use entry::{ExpectedDifference, MigrationEntry, MigrationOutcome, TopicAspect};
pub use launch::{MigratedLaunch, migrate_launch, migrate_python_launch};

/// Topic name in [`ExpectedDifference`] for a difference of the motion, which all measured values show.
pub const ALL_TOPICS: &str = "/*";

/// File to convert, with its surroundings.
#[derive(Clone, Copy)]
pub struct MigrationContext<'a> {
    /// Absolute path of the file; names in reports and material scripts are relative to its folder.
    pub path: &'a Path,
    /// Files that materials name.
    pub host: &'a dyn Host,
    /// Packages and models.
    pub resolver: &'a Resolver<'a>,
    /// ROS version of plugins that exist for both, determined by the whole robot; `None`: by the file itself.
    pub ros: Option<Family>,
    /// True if the robot runs `gazebo_ros_control`, which reads `<transmission>`.
    pub has_ros_control: bool,
    /// Joints of the robot, where they are known: some plugins measured them.
    pub joints: Option<&'a BTreeMap<String, JointGeometry>>,
    /// Values of the attributes `filename` of plugins and `type` of sensors in the expanded robot, by the position of the
    /// element in this file \[bytes\]; each value once.
    pub expanded: Option<&'a BTreeMap<u32, Vec<String>>>,
}

/// Joint at the zero position of a model, and the wheel on it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct JointGeometry {
    /// Position in the frame of the model \[m\].
    pub position_m: [f64; 3],
    /// Radius of the first round collision of the child link \[m\].
    pub wheel_radius_m: Option<f64>,
}

/// Distance below which two joints are on the same side \[m\].
const MIN_DISTANCE_M: f64 = 1e-6;

impl<'a> MigrationContext<'a> {
    /// Context of a single file.
    #[must_use]
    pub fn new(path: &'a Path, host: &'a dyn Host, resolver: &'a Resolver<'a>) -> Self {
        Self {
            path,
            host,
            resolver,
            ros: None,
            has_ros_control: false,
            joints: None,
            expanded: None,
        }
    }

    /// True if a joint is to the left of another; `None` if it is unknown.
    pub(crate) fn is_left_of(&self, one: &str, other: &str) -> Option<bool> {
        let joints = self.joints?;
        let apart_m = joints.get(one)?.position_m[1] - joints.get(other)?.position_m[1];
        (apart_m.abs() > MIN_DISTANCE_M).then_some(apart_m > 0.0)
    }

    /// Distance of two joints \[m\].
    pub(crate) fn separation_m(&self, one: &str, other: &str) -> Option<f64> {
        let joints = self.joints?;
        let [a, b] = [joints.get(one)?.position_m, joints.get(other)?.position_m];
        let squares = a.iter().zip(b).map(|(a, b)| (a - b) * (a - b));
        Some(squares.sum::<f64>().sqrt()).filter(|distance| *distance > MIN_DISTANCE_M)
    }
}

/// Converted file.
#[derive(Clone, Debug)]
pub struct Migrated {
    /// New text.
    pub text: String,
    /// Converted elements, in file order.
    pub entries: Vec<MigrationEntry>,
    /// Topics for the bridge; with expressions of xacro where the file has them.
    pub bridge: Vec<BridgeEntry>,
    /// Differences of topics that the conversion causes knowingly.
    pub expected: Vec<ExpectedDifference>,
}

/// Converts the text of a robot, model or world file: URDF, xacro or SDF. `None` if it is not XML.
#[must_use]
pub fn migrate(text: &str, context: &MigrationContext<'_>) -> Option<Migrated> {
    let mut sources = SourceMap::new();
    let file = sources.add(context.path.display().to_string(), text);
    let document = periplus_xml::parse(file, &sources, &mut Diagnostics::new())?;
    walk::walk(&document, sources.file(file), context)
}
