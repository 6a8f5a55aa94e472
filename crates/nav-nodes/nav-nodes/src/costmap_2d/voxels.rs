//! Voxels as markers and point clouds.
//!
//! Source: `nav2_costmap_2d/src/costmap_2d_markers.cpp`, `costmap_2d_cloud.cpp`.

use periplus_costmap::MAX_VOXEL_COUNT;
use periplus_graph::{Actor, Graph, GraphError, Node, NodeSettings, Publisher, Qos};
use periplus_msgs::sensor_msgs::{PointCloud2, PointField};
use periplus_msgs::std_msgs::{ColorRGBA, Header};
use periplus_msgs::visualization_msgs::Marker;
use periplus_msgs::{geometry_msgs, nav2_msgs};

/// Returns the centres of the marked or of the unknown voxels of a message \[m\].
fn centres(grid: &nav2_msgs::VoxelGrid, are_marked: bool) -> Vec<[f64; 3]> {
    let (width, height) = (grid.size_x as usize, grid.size_z.min(MAX_VOXEL_COUNT));
    let sides = &grid.resolutions;
    let mut centres = Vec::new();
    for (index, column) in grid.data.iter().enumerate().filter(|_| width > 0) {
        let (x, y) = ((index % width) as f64, (index / width) as f64);
        for z in 0..height {
            // Both bits of a marked voxel are set, only the lower one of an unknown voxel.
            let (low, high) = (column >> z & 1 == 1, column >> (16 + z) & 1 == 1);
            if low && high == are_marked {
                centres.push([
                    f64::from(grid.origin.x) + (x + 0.5) * sides.x,
                    f64::from(grid.origin.y) + (y + 0.5) * sides.y,
                    f64::from(grid.origin.z) + (f64::from(z) + 0.5) * sides.z,
                ]);
            }
        }
    }
    centres
}

/// Node `nav2_costmap_2d_markers`: marked voxels as cubes on `visualization_marker`.
pub struct VoxelMarkers {
    _actor: Actor<Publisher<Marker>>,
}

impl VoxelMarkers {
    /// Creates the node in a namespace; it subscribes to `voxel_grid` there.
    /// # Errors
    /// When a topic exists with another type.
    pub fn new(graph: &Graph, namespace: &str) -> Result<Self, GraphError> {
        Self::at(graph.node(NodeSettings::new("costmap_2d_marker").namespace(namespace))?)
    }

    /// Creates it on an existing node.
    /// # Errors
    /// When a topic exists with another type.
    pub fn at(node: Node) -> Result<Self, GraphError> {
        let markers = node.publisher("visualization_marker", Qos::reliable(1))?;
        let mut actor = node.actor(markers);
        let namespace = node.names().namespace().to_owned();
        actor.subscribe::<nav2_msgs::VoxelGrid>(
            "voxel_grid",
            Qos::reliable(10),
            move |markers, grid, _| {
                if markers.is_heard() {
                    markers.publish(marker(&grid, &namespace));
                }
            },
        )?;
        Ok(Self { _actor: actor })
    }
}

fn marker(grid: &nav2_msgs::VoxelGrid, namespace: &str) -> Marker {
    let point = |[x, y, z]: [f64; 3]| geometry_msgs::Point { x, y, z };
    Marker {
        header: Header::clone(&grid.header),
        ns: namespace.to_owned(),
        id: 0,
        r#type: Marker::CUBE_LIST,
        action: Marker::ADD,
        pose: geometry_msgs::Pose {
            orientation: geometry_msgs::Quaternion { w: 1.0, ..Default::default() },
            ..Default::default()
        },
        scale: grid.resolutions.clone(),
        color: ColorRGBA { r: 1.0, g: 0.0, b: 0.0, a: 1.0 },
        points: centres(grid, true).into_iter().map(point).collect(),
        ..Default::default()
    }
}

/// Node `nav2_costmap_2d_cloud`: marked voxels on `voxel_marked_cloud`, unknown ones on
/// `voxel_unknown_cloud`.
pub struct VoxelCloud {
    _actor: Actor<[Publisher<PointCloud2>; 2]>,
}

impl VoxelCloud {
    /// Creates the node in a namespace; it subscribes to `voxel_grid` there.
    /// # Errors
    /// When a topic exists with another type.
    pub fn new(graph: &Graph, namespace: &str) -> Result<Self, GraphError> {
        Self::at(graph.node(NodeSettings::new("costmap_2d_cloud").namespace(namespace))?)
    }

    /// Creates it on an existing node.
    /// # Errors
    /// When a topic exists with another type.
    pub fn at(node: Node) -> Result<Self, GraphError> {
        let marked = node.publisher("voxel_marked_cloud", Qos::reliable(1))?;
        let unknown = node.publisher("voxel_unknown_cloud", Qos::reliable(1))?;
        let mut actor = node.actor([marked, unknown]);
        actor.subscribe::<nav2_msgs::VoxelGrid>(
            "voxel_grid",
            Qos::reliable(10),
            |clouds, grid, _| {
                let [marked, unknown] = clouds;
                if marked.is_heard() {
                    marked.publish(cloud(&grid, true, [255, 0, 0]));
                }
                if unknown.is_heard() {
                    unknown.publish(cloud(&grid, false, [0, 0, 255]));
                }
            },
        )?;
        Ok(Self { _actor: actor })
    }
}

/// Bytes of a point: three coordinates and three colours.
const STEP: u32 = 15;

fn cloud(grid: &nav2_msgs::VoxelGrid, are_marked: bool, colour: [u8; 3]) -> PointCloud2 {
    let centres = centres(grid, are_marked);
    let mut data = Vec::with_capacity(centres.len() * STEP as usize);
    for centre in &centres {
        for number in centre {
            data.extend_from_slice(&(*number as f32).to_le_bytes());
        }
        data.extend_from_slice(&colour);
    }
    let field = |name: &str, offset, datatype| PointField {
        name: name.to_owned(),
        offset,
        datatype,
        count: 1,
    };
    let number = PointField::FLOAT32;
    let byte = PointField::UINT8;
    PointCloud2 {
        header: Header::clone(&grid.header),
        height: 1,
        width: centres.len() as u32,
        fields: vec![
            field("x", 0, number),
            field("y", 4, number),
            field("z", 8, number),
            field("r", 12, byte),
            field("g", 13, byte),
            field("b", 14, byte),
        ],
        is_bigendian: false,
        point_step: STEP,
        row_step: STEP * centres.len() as u32,
        data,
        is_dense: true,
    }
}
