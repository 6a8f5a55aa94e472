//! The tutorial's robot between a cube and a sphere, with the costmaps of the tutorial's parameter file.
#![allow(dead_code, reason = "a test and examples share it, and each uses a part")]

use std::path::Path;
use std::sync::Arc;

use periplus_costmap::CostmapConfig;
use periplus_diagnostics::{Diagnostics, SourceMap};
use periplus_nav_nodes::costmap_2d::CostmapNode;

use periplus_graph::{LifecycleNode, Mailbox, Node, NodeSettings, Publisher, Qos};
use periplus_loader::LoadContext;
use periplus_msgs::Service;
use periplus_msgs::geometry_msgs::{Pose, Quaternion, Transform, TransformStamped, Vector3};
use periplus_msgs::nav_msgs::{MapMetaData, OccupancyGrid, Odometry};
use periplus_msgs::rcl_interfaces::{
    Parameter, ParameterType, ParameterValue, SetParameters, SetParametersRequest,
};
use periplus_msgs::std_msgs::Header;
use periplus_msgs::tf2_msgs::TFMessage;
use periplus_os::Machine;
use periplus_resources::Resolver;
use periplus_sim::{
    AssetFiles, Options, PhysicsMode, RobotPlacement, Search, Services, Simulation, compose,
};

/// The parameters that the tutorial about footprints ships for its robot.
const NAV2: &str = "/../../../../shared/corpus/navigation2_tutorials@humble/sam_bot_description/config/\
                    nav2_params.yaml";

/// A short form of it, if that file is not available.
const SHORT: &str = "
local_costmap: {local_costmap: {ros__parameters: {
  update_frequency: 5.0, publish_frequency: 2.0, global_frame: odom, robot_base_frame: base_link,
  rolling_window: true, width: 3, height: 3, resolution: 0.05,
  plugins: [voxel_layer, inflation_layer],
  inflation_layer: {plugin: 'nav2_costmap_2d::InflationLayer', cost_scaling_factor: 3.0},
  voxel_layer: {plugin: 'nav2_costmap_2d::VoxelLayer', z_resolution: 0.05, z_voxels: 16,
    observation_sources: scan, scan: {max_obstacle_height: 2.0, clearing: true}}}}}
global_costmap: {global_costmap: {ros__parameters: {
  update_frequency: 1.0, global_frame: map, robot_base_frame: base_link, robot_radius: 0.3,
  resolution: 0.05, plugins: [static_layer, obstacle_layer, inflation_layer],
  static_layer: {plugin: 'nav2_costmap_2d::StaticLayer'},
  inflation_layer: {plugin: 'nav2_costmap_2d::InflationLayer', cost_scaling_factor: 3.0},
  obstacle_layer: {plugin: 'nav2_costmap_2d::ObstacleLayer',
    observation_sources: scan, scan: {max_obstacle_height: 2.0, clearing: true}}}}}
";

fn own(path: &str) -> String {
    format!("{}/../../../{path}", env!("CARGO_MANIFEST_DIR"))
}

/// The costmaps, and the obstacle layer of each.
pub(crate) const LAYERS: [(&str, &str); 2] =
    [("local_costmap", "voxel_layer"), ("global_costmap", "obstacle_layer")];

/// A run.
pub(crate) struct Run {
    pub(crate) simulation: Simulation,
    services: Services,
    pub(crate) user: Node,
    pub(crate) costmaps: [LifecycleNode<CostmapNode>; 2],
    odometry: Mailbox<Odometry>,
    frames: Publisher<TFMessage>,
    _map: (Publisher<TFMessage>, Publisher<OccupancyGrid>),
}

impl Run {
    /// sam_bot between the cube and the sphere; `map` is where `odom` is, and holds nothing.
    pub(crate) fn new(mode: PhysicsMode) -> Self {
        let resolver = Resolver::new(&Machine, &[own("robots").into(), own("worlds").into()]);
        let setting = LoadContext {
            host: &Machine,
            resolver: &resolver,
            working_folder: own("").into(),
            arguments: Vec::new(),
            open_meshes: true,
        };
        let file = own("robots/sam_bot/urdf/sam_bot.urdf.xacro").into();
        let robot = RobotPlacement { file, ..RobotPlacement::default() };
        let world = own("worlds/cube_and_sphere.sdf");
        let mut composition = compose(Path::new(&world), &[robot], &setting);
        let files = Arc::new(AssetFiles::default());
        let options = Options { mode, ..Options::default() };
        let simulation = Simulation::new(&mut composition, files, options);
        assert!(!composition.has_errors());
        let services = Services::new(&simulation, Search::default()).unwrap();
        let graph = simulation.graph();
        let user = graph.node(NodeSettings::new("user")).unwrap();
        let frames = user.publisher("/tf_static", Qos::latched(1)).unwrap();
        let rotation = Quaternion { w: 1.0, ..Quaternion::default() };
        frames.publish(TFMessage {
            transforms: vec![TransformStamped {
                header: Header { frame_id: "map".into(), ..Header::default() },
                child_frame_id: "odom".into(),
                transform: Transform { rotation, ..Transform::default() },
            }],
        });
        let maps = user.publisher("/map", Qos::latched(1)).unwrap();
        let mut info =
            MapMetaData { resolution: 0.05, width: 160, height: 160, ..MapMetaData::default() };
        (info.origin.position.x, info.origin.position.y) = (-4.0, -4.0);
        let header = Header { frame_id: "map".into(), ..Header::default() };
        maps.publish(OccupancyGrid { header, info, data: vec![0; 160 * 160] });
        let text = std::fs::read_to_string([env!("CARGO_MANIFEST_DIR"), NAV2].concat());
        let text = text.unwrap_or_else(|_| {
            println!("SKIPPED: the file of the tutorial is not there; a short form of it is used");
            SHORT.to_owned()
        });
        let mut sources = SourceMap::new();
        let file = sources.add("nav2_params.yaml", text);
        let tree = periplus_yaml::parse(file, &sources).unwrap().unwrap();
        let costmaps = LAYERS.map(|(name, _)| {
            let mut diagnostics = Diagnostics::new();
            let config = CostmapConfig::read_yaml(&tree, name, None, &mut diagnostics);
            assert!(!diagnostics.has_errors());
            CostmapNode::new(graph, name, config).unwrap()
        });
        costmaps.iter().for_each(LifecycleNode::start);
        let odometry = user.mailbox("/demo/odom", Qos::reliable(10)).unwrap();
        let moving = user.publisher("/tf", Qos::reliable(10)).unwrap();
        let _map = (frames, maps);
        Self { simulation, services, user, costmaps, odometry, frames: moving, _map }
    }

    /// Advances simulated time.
    pub(crate) fn go_on(&mut self, milliseconds: i64) {
        let until_ns = self.simulation.time_ns() + milliseconds * 1_000_000;
        while self.simulation.time_ns() < until_ns {
            self.services.serve(&mut self.simulation);
            self.simulation.step_until(until_ns.min(self.services.until_ns())).unwrap();
            self.place();
        }
    }

    /// Publishes the pose of the robot by odometry, as the filter of the tutorial does.
    fn place(&self) {
        let transforms = self.odometry.drain().into_iter().map(|odometry| {
            let Pose { position, orientation } = odometry.pose.pose.clone();
            let translation = Vector3 { x: position.x, y: position.y, z: position.z };
            TransformStamped {
                header: odometry.header.clone(),
                child_frame_id: odometry.child_frame_id.clone(),
                transform: Transform { translation, rotation: orientation },
            }
        });
        let transforms: Vec<_> = transforms.collect();
        if !transforms.is_empty() {
            self.frames.publish(TFMessage { transforms });
        }
    }

    pub(crate) fn call<S: Service>(&mut self, name: &str, request: S::Request) -> Arc<S::Response> {
        let answer = self.user.client::<S>(name).unwrap().call(request);
        self.services.serve(&mut self.simulation);
        self.go_on(1000);
        answer.take().expect("an answer").unwrap()
    }

    /// Lets infinite ranges clear, as the costmaps advise: the floor is open, and beams through removed
    /// obstacles have no hit.
    pub(crate) fn let_infinite_ranges_clear(&mut self) {
        for (name, layer) in LAYERS {
            let value = ParameterValue {
                r#type: ParameterType::PARAMETER_BOOL,
                bool_value: true,
                ..ParameterValue::default()
            };
            let parameters = vec![Parameter { name: format!("{layer}.scan.inf_is_valid"), value }];
            let service = format!("/{name}/{name}/set_parameters");
            let set = self.call::<SetParameters>(&service, SetParametersRequest { parameters });
            assert!(set.results[0].successful, "{}", set.results[0].reason);
        }
    }

    /// Costs at a position, in both costmaps.
    pub(crate) fn costs(&self, x_m: f64, y_m: f64) -> [u8; 2] {
        self.costmaps.each_ref().map(|node| node.with(|it| it.inspect(x_m, y_m)).unwrap().cost)
    }

    /// Largest costs near a position, in both costmaps.
    pub(crate) fn largest(&self, x_m: f64, y_m: f64) -> [u8; 2] {
        let around = [-0.1, -0.05, 0.0, 0.05, 0.1];
        let near = around.iter().flat_map(|dx| around.map(|dy| (x_m + dx, y_m + dy)));
        let all: Vec<[u8; 2]> = near.map(|(x_m, y_m)| self.costs(x_m, y_m)).collect();
        [0, 1].map(|which| all.iter().map(|costs| costs[which]).max().unwrap_or_default())
    }
}
