//! Mobile robots in one library: simulation, SLAM, localization, costmaps, TF, messages, bags, and
//! the files of robots and worlds.
//!
//! Periplus works with existing URDF, SDF, map and parameter files, and with the messages and
//! topics of ROS 2. It needs no ROS, no Gazebo and no GPU. This crate re-exports the libraries of
//! Periplus as modules; a program that needs only one depends on that crate (`periplus-slam`)
//! alone.
//!
//! | task | modules |
//! |---|---|
//! | simulate a robot | [`sim`], [`physics`], [`ros2_control`], [`sensors`], [`raycast`], [`rendering`], [`faults`] |
//! | read robots and worlds | [`loader`], [`xacro`], [`urdf`], [`sdf`], [`scene`], [`meshes`], [`resources`] |
//! | build a map | [`slam`], [`scan_matching`], [`exploration`] |
//! | localize | [`localization`], [`ekf`], [`maps`] |
//! | track objects | [`tracking`] |
//! | decide where to drive | [`costmap`], [`planners`], [`controllers`], [`behavior_tree`], [`grid`] |
//! | nodes, topics, time | [`graph`], [`msgs`], [`tf`], [`tf_ros`], [`nav_nodes`] |
//! | recordings, scores, calibration | [`bags`], [`evaluation`], [`calibration`] |
//!
//! # Tutorial
//!
//! Every step is a complete program. Longer ones, each with a check at its end, are in the folder
//! `examples` of this crate: `cargo run -p periplus --example 01_simulate`.
//!
//! ## 1. Cast rays
//!
//! A [`raycast::RaycastWorld`] returns exact distances, as a lidar without noise measures them.
//!
//! ```
//! use periplus::geometry::{DVec3, Pose};
//! use periplus::raycast::{Filter, RaycastShape, RaycastWorld, Ray, Tags};
//!
//! let mut builder = RaycastWorld::builder();
//! let pillar = RaycastShape::Cylinder { radius_m: 0.25, length_m: 2.0 };
//! builder.add_shape(&pillar, &Pose::from_xyz(2.0, 0.0, 0.0), Tags::default())?;
//! let world = builder.build(1)?;
//! let hit = world.cast(&Ray::new(DVec3::ZERO, DVec3::X), Filter::default());
//! assert!(hit.is_some_and(|hit| (hit.distance_m - 1.75).abs() < 1e-12));
//! # Ok::<(), periplus::raycast::InstanceError>(())
//! ```
//!
//! ## 2. Read a robot
//!
//! [`loader::load`] recognises and reads URDF, xacro and SDF. Files come from a
//! [`resources::Host`]: [`os::Machine`] is the disk, [`resources::MemoryHost`] is memory.
//!
//! ```
//! use periplus::loader::{LoadContext, load};
//! use periplus::resources::{MemoryHost, Resolver};
//!
//! let robot = "<robot name='cart'><link name='base_link'/></robot>";
//! let host = MemoryHost::new().with_file("/cart.urdf", robot);
//! let resolver = Resolver::new(&host, &[]);
//! let context = LoadContext {
//!     host: &host,
//!     resolver: &resolver,
//!     working_folder: "/".into(),
//!     arguments: Vec::new(),
//!     open_meshes: true,
//! };
//! let loaded = load("/cart.urdf".as_ref(), &context);
//! assert!(!loaded.diagnostics.has_errors());
//! assert_eq!(loaded.scene.expect("a robot").models[0].name, "cart");
//! ```
//!
//! ## 3. Publish and subscribe
//!
//! A [`graph::Graph`] has the nodes, topics, services, actions and parameters of ROS 2 in one
//! process. The caller advances its time, so that a run is reproducible.
//!
//! ```
//! use periplus::graph::{Graph, NodeSettings, Qos};
//! use periplus::msgs::geometry_msgs::Twist;
//!
//! let graph = Graph::new();
//! let planner = graph.node(NodeSettings::new("planner"))?;
//! let base = graph.node(NodeSettings::new("base"))?;
//! let commands = planner.publisher("/cmd_vel", Qos::reliable(10))?;
//! let mailbox = base.mailbox::<Twist>("/cmd_vel", Qos::reliable(1))?;
//! let mut twist = Twist::default();
//! twist.linear.x = 0.5;
//! commands.publish(twist);
//! assert_eq!(mailbox.latest().map(|twist| twist.linear.x), Some(0.5));
//! # Ok::<(), periplus::graph::GraphError>(())
//! ```
//!
//! ## 4. Look up transforms
//!
//! ```
//! use periplus::geometry::Pose;
//! use periplus::tf::{Buffer, StampedTransform, TransformKind};
//!
//! let mut buffer = Buffer::default();
//! let odom = StampedTransform::new("odom", "base_link", 0, Pose::from_xyz(1.0, 0.0, 0.0));
//! let laser = StampedTransform::new("base_link", "laser", 0, Pose::from_xyz(0.2, 0.0, 0.3));
//! buffer.set(&odom, "wheels", TransformKind::Fixed)?;
//! buffer.set(&laser, "robot", TransformKind::Fixed)?;
//! let found = buffer.lookup("odom", "laser", 0)?;
//! assert_eq!(found.target_from_source.translation.x, 1.2);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! ## 5. Write and read a bag
//!
//! ```
//! use periplus::bags::{QosProfile, Reader, Selection, Settings, Stamp, Topic, Writer};
//! use periplus::msgs::{Message, geometry_msgs::Twist};
//!
//! let mut bag = Writer::new(Vec::new(), Settings::new("run.mcap"))?;
//! let topic = bag.topic(Topic::of::<Twist>("/cmd_vel", &[QosProfile::reliable(10)]))?;
//! bag.write(topic, Stamp::at(20_000_000), &Twist::default().to_cdr()?)?;
//! let (bytes, _) = bag.finish()?;
//! let mut reader = Reader::open(std::io::Cursor::new(bytes))?;
//! let mut messages = reader.messages(Selection::default());
//! let message = messages.next()?.expect("the message");
//! assert_eq!(message.log_ns, 20_000_000);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # Plugins for navigation
//!
//! The servers of [`nav_nodes`] use planners ([`planners::Planner`]), controllers ([`controllers::Controller`]), behaviors
//! ([`nav_nodes::behavior_server::BehaviorPlugin`]) and tree nodes ([`behavior_tree::BehaviorNode`]) of other authors:
//! [`nav_nodes::navigation_plugins::NavigationPlugins`] registers them by the class that a parameter file names. The
//! example `09_own_planner` is complete.
//!
//! # Networks
//!
//! The crates `periplus-dds`, `periplus-rmw-zenoh` and `periplus-gz-transport` connect a graph to
//! ROS 2 and Gazebo programs, and `periplus-web` to Foxglove and browsers. They are not re-exported,
//! since DDS needs a C compiler and the others open sockets. The command `periplus` (package
//! `periplus-cli`) has all of them.

pub use periplus_bags as bags;
pub use periplus_behavior_tree as behavior_tree;
pub use periplus_calibration as calibration;
pub use periplus_controllers as controllers;
pub use periplus_costmap as costmap;
pub use periplus_crowds as crowds;
pub use periplus_diagnostics as diagnostics;
pub use periplus_ekf as ekf;
pub use periplus_environments as environments;
pub use periplus_evaluation as evaluation;
pub use periplus_exploration as exploration;
pub use periplus_faults as faults;
pub use periplus_geometry as geometry;
pub use periplus_graph as graph;
pub use periplus_grid as grid;
pub use periplus_gz_msgs as gz_msgs;
pub use periplus_images as images;
pub use periplus_loader as loader;
pub use periplus_localization as localization;
pub use periplus_maps as maps;
pub use periplus_meshes as meshes;
pub use periplus_msgs as msgs;
pub use periplus_nav_nodes as nav_nodes;
pub use periplus_os as os;
pub use periplus_params as params;
pub use periplus_physics as physics;
pub use periplus_planners as planners;
pub use periplus_raycast as raycast;
pub use periplus_rendering as rendering;
pub use periplus_resources as resources;
pub use periplus_ros2_control as ros2_control;
pub use periplus_scan_matching as scan_matching;
pub use periplus_scene as scene;
pub use periplus_sdf as sdf;
pub use periplus_sensors as sensors;
pub use periplus_sim as sim;
pub use periplus_sim_nodes as sim_nodes;
pub use periplus_slam as slam;
pub use periplus_tf as tf;
pub use periplus_tf_ros as tf_ros;
pub use periplus_tracking as tracking;
pub use periplus_urdf as urdf;
pub use periplus_xacro as xacro;
pub use periplus_xml as xml;
pub use periplus_yaml as yaml;
