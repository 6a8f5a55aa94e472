//! Behavior trees in the XML of BehaviorTree.CPP, versions 3 and 4.
//!
//! [`TreeFiles`] reads and checks XML with its includes; [`NodeRegistry`] has the nodes by name; a
//! [`BehaviorTree`] is ticked with the caller's time. Faults are found at load, with file, line and column:
//! unknown nodes and ports, literals of the wrong type, entries with two types, scripts that cannot be parsed.
//!
//! ```
//! use periplus_behavior_tree::{Blackboard, NodeRegistry, NodeStatus, TreeFiles, nav2};
//!
//! let xml = r#"<root BTCPP_format="4"><BehaviorTree ID="Main">
//!   <RecoveryNode number_of_retries="2">
//!     <ScriptCondition code="attempts >= 2"/>
//!     <Script code="attempts += 1"/>
//!   </RecoveryNode>
//! </BehaviorTree></root>"#;
//! let mut registry = NodeRegistry::new();
//! nav2::register(&mut registry, nav2::Nav2NodeRules::MAIN);
//! let files = TreeFiles::parse("main.xml", xml, &registry);
//! let mut tree = files.tree("", &registry, Blackboard::new()).unwrap();
//! tree.blackboard_mut().set("attempts", 0_i64).unwrap();
//! assert_eq!(tree.tick(0, &mut ()), Ok(NodeStatus::Success));
//! assert_eq!(tree.blackboard().get("attempts").unwrap().as_i64(), Some(2));
//! ```
//!
//! Depth, number of nodes, includes, scripts and entries are bounded.

mod action;
mod blackboard;
mod build;
mod check;
mod control;
mod decorator;
mod document;
mod model;
pub mod nav2;
mod node;
mod registry;
mod script;
mod status;
mod tree;
mod value;

pub use blackboard::{Blackboard, EntryError, MAX_BLACKBOARD_ENTRIES};
pub use build::{MAX_TREE_DEPTH, MAX_TREE_NODES};
pub use document::{
    IncludedTree, MAX_INCLUDE_COUNT, MAX_INCLUDE_DEPTH, TreeFiles, TreeFormat, TreeInclude,
    TreeIncludeError,
};
pub use model::{NodeKind, NodeModel, PortDirection, PortModel};
pub use node::{BehaviorNode, NodeRun, PathGeometry, TreeContext, TreeError};
pub use registry::NodeRegistry;
pub use script::{
    MAX_SCRIPT_BYTES, MAX_SCRIPT_DEPTH, MAX_SCRIPT_TEXT_BYTES, MAX_SCRIPT_TOKEN_COUNT, Script,
    ScriptEnums, ScriptError,
};
pub use status::NodeStatus;
pub use tree::{
    BehaviorTree, MAX_STATUS_CHANGE_COUNT, MAX_WAKE_UP_COUNT, StatusChange, TreeNodeInfo,
};
pub use value::{PortType, TreeObject, TreeValue, parse_bool};
