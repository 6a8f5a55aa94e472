//! Publishers of a costmap.

use std::collections::BTreeMap;

use periplus_costmap::filters::{BinaryFilter, SpeedFilter};
use periplus_costmap::layers::VoxelLayer;
use periplus_costmap::tables::{
    BinaryFilterParams, CostmapParams, SpeedFilterParams, VoxelLayerParams,
};
use periplus_costmap::{
    CellWindow, Costmap, CostmapConfig, CostmapMessage, LayerKind, LayeredCostmap, PublicationState,
};
use periplus_graph::{GraphError, Node, Publisher, Qos};
use periplus_msgs::std_msgs::Header;
use periplus_msgs::{geometry_msgs, map_msgs, nav_msgs, nav2_msgs, sensor_msgs, std_msgs};

use crate::costmap_2d::clouds::cloud;
use crate::costmap_2d::messages::{occupancy_grid, occupancy_update, polygon, raw, raw_update};
use crate::costmap_2d::topics::resolve;

/// QoS of grids in Nav2.
const GRID_QOS: Qos = Qos::latched(1);

/// The four topics of a grid.
struct GridPort {
    publication: PublicationState,
    full: Publisher<nav_msgs::OccupancyGrid>,
    full_raw: Publisher<nav2_msgs::Costmap>,
    updates: Publisher<map_msgs::OccupancyGridUpdate>,
    updates_raw: Publisher<nav2_msgs::CostmapUpdate>,
    /// True if a subscriber missed updates and needs a full grid.
    is_behind: bool,
}

impl GridPort {
    fn new(node: &Node, topic: &str) -> Result<Self, GraphError> {
        Ok(Self {
            publication: PublicationState::new(),
            full: node.publisher(topic, GRID_QOS)?,
            full_raw: node.publisher(&format!("{topic}_raw"), GRID_QOS)?,
            updates: node.publisher(&format!("{topic}_updates"), GRID_QOS)?,
            updates_raw: node.publisher(&format!("{topic}_raw_updates"), GRID_QOS)?,
            is_behind: false,
        })
    }

    fn publish(&mut self, costmap: &Costmap, layer: &str, about: &About<'_>) {
        let is_heard = self.full.is_heard() || self.full_raw.is_heard();
        if is_heard && self.is_behind {
            self.publication.request_full();
        }
        let About { frame, now_ns, .. } = *about;
        match self.publication.next(costmap.info(), about.always_full) {
            CostmapMessage::Nothing => {}
            CostmapMessage::Full => {
                // The first grid is latched for late subscribers.
                self.full.publish(occupancy_grid(costmap, frame, now_ns, about.z_m));
                self.full_raw.publish(raw(costmap, frame, now_ns, layer));
                self.is_behind = false;
            }
            CostmapMessage::Update(window) => {
                if self.updates.is_heard() {
                    self.updates.publish(occupancy_update(costmap, &window, frame, now_ns));
                }
                if self.updates_raw.is_heard() {
                    self.updates_raw.publish(raw_update(costmap, &window, frame, now_ns));
                }
                self.is_behind |= !is_heard;
            }
        }
    }
}

/// Header data of all messages of an update.
struct About<'a> {
    frame: &'a str,
    now_ns: i64,
    always_full: bool,
    z_m: f64,
}

/// Publishers of a costmap.
pub(crate) struct Outputs {
    master: GridPort,
    layers: BTreeMap<String, GridPort>,
    footprint: Publisher<geometry_msgs::PolygonStamped>,
    voxels: BTreeMap<String, Publisher<nav2_msgs::VoxelGrid>>,
    ends: BTreeMap<String, Publisher<sensor_msgs::PointCloud2>>,
    limits: BTreeMap<String, Publisher<nav2_msgs::SpeedLimit>>,
    states: BTreeMap<String, Publisher<std_msgs::Bool>>,
}

impl Outputs {
    /// Requests full grids in the next publication, after cells changed outside an update.
    pub(crate) fn request_full(&mut self) {
        self.master.publication.request_full();
        for layer in self.layers.values_mut() {
            layer.publication.request_full();
        }
    }

    pub(crate) fn new(node: &Node, config: &CostmapConfig) -> Result<Self, GraphError> {
        let namespace = node.names().namespace().to_owned();
        let mut outputs = Self {
            master: GridPort::new(node, "costmap")?,
            layers: BTreeMap::new(),
            footprint: node.publisher("published_footprint", Qos::reliable(10))?,
            voxels: BTreeMap::new(),
            ends: BTreeMap::new(),
            limits: BTreeMap::new(),
            states: BTreeMap::new(),
        };
        for layer in config.layers.iter().chain(&config.filters) {
            let name = layer.name.clone();
            let topic = |topic: &str| resolve(topic, &namespace, config.compat);
            let has_grid = matches!(
                layer.kind,
                LayerKind::Static
                    | LayerKind::Obstacle
                    | LayerKind::Voxel
                    | LayerKind::Range
                    | LayerKind::Container
            );
            if has_grid && config.compat.publishes_layers() {
                outputs.layers.insert(name.clone(), GridPort::new(node, &name)?);
            }
            match layer.kind {
                LayerKind::Voxel => {
                    if VoxelLayerParams::from_values(&layer.values).publish_voxel_map {
                        let voxels = node.publisher("voxel_grid", Qos::latched(1))?;
                        outputs.voxels.insert(name.clone(), voxels);
                    }
                    let ends = node.publisher("clearing_endpoints", Qos::latched(1))?;
                    outputs.ends.insert(name, ends);
                }
                LayerKind::Speed => {
                    let params = SpeedFilterParams::from_values(&layer.values);
                    let limits =
                        node.publisher(&topic(&params.speed_limit_topic), Qos::reliable(10))?;
                    outputs.limits.insert(name, limits);
                }
                LayerKind::Binary => {
                    let params = BinaryFilterParams::from_values(&layer.values);
                    let states =
                        node.publisher(&topic(&params.binary_state_topic), Qos::reliable(10))?;
                    outputs.states.insert(name, states);
                }
                _ => {}
            }
        }
        Ok(outputs)
    }

    /// Before an update: enables the recording of ray ends if there are subscribers.
    pub(crate) fn prepare(&self, costmap: &mut LayeredCostmap) {
        for (name, ends) in &self.ends {
            if let Some(layer) = costmap.find_as::<VoxelLayer>(name) {
                layer.record_clearing_ends(ends.is_heard());
            }
        }
    }

    /// After an update: adds the changed window.
    pub(crate) fn changed(&mut self, window: CellWindow) {
        self.master.publication.changed(window);
        for port in self.layers.values_mut() {
            port.publication.changed(window);
        }
    }

    /// Publishes voxels, speed limits and filter states, after every update.
    pub(crate) fn publish_each(&mut self, costmap: &mut LayeredCostmap, now_ns: i64) {
        let frame = costmap.frame().global_frame.clone();
        for (name, voxels) in &self.voxels {
            let Some(layer) = costmap.find_as::<VoxelLayer>(name) else { continue };
            if voxels.is_heard() {
                voxels.publish(voxel_grid(layer, &frame, now_ns));
            }
        }
        for (name, ends) in &self.ends {
            let Some(layer) = costmap.find_as::<VoxelLayer>(name) else { continue };
            if ends.is_heard() {
                ends.publish(cloud(layer.clearing_ends(), Header::at(now_ns, &frame)));
            }
        }
        for (name, limits) in &self.limits {
            let Some(filter) = costmap.find_as::<SpeedFilter>(name) else { continue };
            if let Some(limit) = filter.take_limit() {
                limits.publish(nav2_msgs::SpeedLimit {
                    header: Header::at(now_ns, &frame),
                    percentage: limit.is_percentage,
                    speed_limit: limit.limit,
                });
            }
        }
        for (name, states) in &self.states {
            let Some(filter) = costmap.find_as::<BinaryFilter>(name) else { continue };
            if let Some(state) = filter.take_state() {
                states.publish(std_msgs::Bool { data: state });
            }
        }
    }

    /// Publishes grids and footprint, at the publication rate.
    pub(crate) fn publish_grids(
        &mut self,
        costmap: &LayeredCostmap,
        params: &CostmapParams,
        outline: &[[f64; 2]],
        now_ns: i64,
    ) {
        let about = About {
            frame: &costmap.frame().global_frame,
            now_ns,
            always_full: params.always_send_full_costmap,
            z_m: params.map_vis_z_m,
        };
        self.footprint.publish(polygon(outline, about.frame, now_ns));
        self.master.publish(costmap.costmap(), "master", &about);
        for layer in costmap.layers().iter().filter(|layer| layer.is_enabled()) {
            let Some(port) = self.layers.get_mut(layer.name()) else { continue };
            if let Some(grid) = layer.grid().filter(|grid| !grid.info().is_empty()) {
                port.publish(grid, layer.name(), &about);
            }
        }
    }
}

fn voxel_grid(layer: &VoxelLayer, frame: &str, now_ns: i64) -> nav2_msgs::VoxelGrid {
    let voxels = layer.voxels();
    let info = voxels.info();
    nav2_msgs::VoxelGrid {
        header: Header::at(now_ns, frame),
        data: voxels.columns().to_vec(),
        origin: geometry_msgs::Point32 {
            x: info.origin.x_m as f32,
            y: info.origin.y_m as f32,
            z: layer.origin_z_m() as f32,
        },
        resolutions: geometry_msgs::Vector3 {
            x: info.resolution_m,
            y: info.resolution_m,
            z: layer.z_resolution_m(),
        },
        size_x: info.width as u32,
        size_y: info.height as u32,
        size_z: voxels.height(),
    }
}
