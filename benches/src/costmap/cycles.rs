//! Updates while a robot drives.

use periplus_costmap::layers::StaticLayer;
use periplus_costmap::{CostmapConfig, NoTransforms, Projector, ScanGeometry};
use periplus_diagnostics::Diagnostics;
use periplus_geometry::{DVec3, Pose, Pose2, Stream};
use periplus_grid::{GridInfo, OccupancyGrid};
use periplus_params::Given;

use super::{Row, median, seconds};

pub(super) fn run() -> Vec<Row> {
    let mut rows = local();
    for side in [1000, 4000] {
        rows.extend(global(side));
    }
    rows.push(absorb());
    rows
}

fn config(given: &[(&'static str, &'static str)]) -> CostmapConfig {
    let given = given.iter().map(|(name, text)| Given::new(name, *text));
    let mut diagnostics = Diagnostics::new();
    let config = CostmapConfig::read(given, None, &mut diagnostics);
    assert!(diagnostics.is_empty(), "{:?}", diagnostics.iter().next());
    config
}

const LOCAL: &[(&str, &str)] = &[
    ("global_frame", "odom"),
    ("rolling_window", "true"),
    ("width", "3"),
    ("height", "3"),
    ("resolution", "0.05"),
    ("robot_radius", "0.22"),
    ("plugins", "obstacle_layer voxel_layer inflation_layer"),
    ("obstacle_layer.plugin", "nav2_costmap_2d::ObstacleLayer"),
    ("obstacle_layer.observation_sources", "scan"),
    ("obstacle_layer.scan.clearing", "true"),
    ("obstacle_layer.scan.max_obstacle_height", "2.0"),
    ("voxel_layer.plugin", "nav2_costmap_2d::VoxelLayer"),
    ("voxel_layer.observation_sources", "cloud"),
    ("voxel_layer.z_voxels", "16"),
    ("voxel_layer.z_resolution", "0.05"),
    ("voxel_layer.cloud.data_type", "PointCloud2"),
    ("voxel_layer.cloud.clearing", "true"),
    ("voxel_layer.cloud.max_obstacle_height", "2.0"),
    ("inflation_layer.plugin", "nav2_costmap_2d::InflationLayer"),
    ("inflation_layer.cost_scaling_factor", "3.0"),
];

/// A scan of 360 beams in a room with some things in it.
fn scan(random: &mut Stream) -> Vec<f32> {
    (0..360)
        .map(|beam| 1.2 + 0.3 * ((beam / 20) % 3) as f32 + 0.01 * random.unit() as f32)
        .collect()
}

const BEAMS: ScanGeometry = ScanGeometry {
    angle_min_rad: -std::f32::consts::PI,
    angle_increment_rad: 0.017_453_292,
    range_min_m: 0.1,
    range_max_m: 10.0,
};

/// Points of a depth camera: walls and the floor in a field of view of 87 by 58 degrees.
fn cloud(count: usize, random: &mut Stream) -> Vec<[f32; 3]> {
    let columns = ((count as f64) * 1.5).sqrt() as usize;
    (0..count)
        .map(|index| {
            let across = (index % columns) as f32 / columns as f32 - 0.5;
            let up = (index / columns) as f32 * columns as f32 / count as f32 - 0.5;
            let depth = (1.1 + 0.4 * (across * 9.0).sin().abs()).min(0.4 / (-up).max(0.01));
            let noise = 0.005 * random.unit() as f32;
            [depth + noise, 1.5 * across * depth, up * depth]
        })
        .collect()
}

/// The typical local costmap: 3 by 3 m, a scan, a voxel layer with 20,000 points.
fn local() -> Vec<Row> {
    let mut random = Stream::keyed(3, "local", 0);
    let (ranges, points) = (scan(&mut random), cloud(20_000, &mut random));
    let mut projector = Projector::default();
    let mut costmap = config(LOCAL).build();
    let mut step = 0;
    let mut updates = Vec::new();
    let whole = median(200, || {
        step += 1;
        let now_ns = step * 100_000_000;
        let robot = Pose2::new(0.01 * step as f64, 0.0, 0.001 * step as f64);
        let sensor = Pose::from(robot) * Pose::from_xyz(0.1, 0.0, 0.3);
        let insert = seconds(|| {
            if let Some(source) = costmap.source_mut("obstacle_layer", "scan") {
                let points = projector.points(BEAMS, &ranges, false);
                source.insert(now_ns, now_ns, sensor, sensor.translation, points);
            }
            if let Some(source) = costmap.source_mut("voxel_layer", "cloud") {
                source.insert(now_ns, now_ns, sensor, sensor.translation, points.iter().copied());
            }
        });
        let update = seconds(|| {
            costmap.update(now_ns, robot, &NoTransforms);
        });
        updates.push(update);
        insert + update
    });
    let update = median(updates.len(), || updates.pop().unwrap_or_default());
    let lethal = costmap.costmap().costs().iter().filter(|cost| **cost == 254).count();
    assert!(lethal > 50, "{lethal} lethal cells");
    let work = |what: &str| format!("local costmap 3 x 3 m, scan of 360 and 20,000 points: {what}");
    let row = |what: &str, seconds| Row { work: work(what), who: "Periplus".into(), seconds };
    vec![row("cycle", whole), row("of which update", update)]
}

/// A global costmap: the robot has moved, and 100 cells change.
fn global(side: usize) -> Vec<Row> {
    let config = config(&[
        ("plugins", "static_layer obstacle_layer inflation_layer"),
        ("obstacle_layer.observation_sources", "scan"),
        ("obstacle_layer.scan.clearing", "true"),
        ("obstacle_layer.scan.max_obstacle_height", "2.0"),
    ]);
    let mut costmap = config.build();
    let origin = Pose2::IDENTITY;
    let info = GridInfo { resolution_m: 0.05, width: side, height: side, origin };
    let mut map = OccupancyGrid::new(info, 0);
    let mut random = Stream::keyed(5, "global", 0);
    for cell in &mut map.cells {
        if random.unit() < 0.005 {
            *cell = 100;
        }
    }
    if let Some(layer) = costmap.find_as::<StaticLayer>("static_layer") {
        layer.set_map(map, "map").expect("a map");
    }
    let middle = side as f64 * 0.025;
    let first = seconds(|| {
        costmap.update(0, Pose2::new(middle, middle, 0.0), &NoTransforms);
    });
    let mut step = 0;
    let update = median(100, || {
        step += 1;
        let now_ns = step * 200_000_000;
        let robot = Pose2::new(middle + 0.05 * step as f64, middle, 0.0);
        let sensor = Pose::from_xyz(robot.x_m, robot.y_m, 0.2);
        // A wall ahead, seen in 100 cells.
        let points = (0..100).map(|index| [1.5, index as f32 * 0.05 - 2.5, 0.0]);
        seconds(|| {
            if let Some(source) = costmap.source_mut("obstacle_layer", "scan") {
                source.insert(now_ns, now_ns, sensor, sensor.translation, points);
            }
            costmap.update(now_ns, robot, &NoTransforms);
        })
    });
    let row = |what: &str, seconds| Row {
        work: format!("global costmap {side} x {side}: {what}"),
        who: "Periplus".into(),
        seconds,
    };
    vec![row("first update", first), row("robot moved, 100 cells change", update)]
}

/// A cloud of 300,000 points: all that one costs.
fn absorb() -> Row {
    let mut random = Stream::keyed(9, "cloud", 0);
    let points = cloud(300_000, &mut random);
    let mut costmap = config(LOCAL).build();
    let mut step = 0;
    let taken = median(30, || {
        step += 1;
        let now_ns = step * 33_000_000;
        let robot = Pose2::new(0.003 * step as f64, 0.0, 0.0);
        let sensor =
            Pose::from(robot) * Pose { translation: DVec3::new(0.1, 0.0, 0.3), ..Pose::IDENTITY };
        seconds(|| {
            if let Some(source) = costmap.source_mut("voxel_layer", "cloud") {
                source.insert(now_ns, now_ns, sensor, sensor.translation, points.iter().copied());
            }
            costmap.update(now_ns, robot, &NoTransforms);
        })
    });
    Row {
        work: "a cloud of 300,000 points: taken in, cleared, marked, inflated".into(),
        who: "Periplus".into(),
        seconds: taken,
    }
}
