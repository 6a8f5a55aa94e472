//! A world with a robot, and the path that the robot drives.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use periplus_geometry::{DVec3, Pose2, Stream};
use periplus_loader::LoadContext;
use periplus_os::Machine;
use periplus_raycast::{Filter, Ray};
use periplus_rendering::{RenderScene, SensedGeometry};
use periplus_resources::Resolver;
use periplus_sim::{AssetFiles, Composition, PlacementPose, RobotPlacement, compose};

use crate::floor::Floor;

/// A world of ours.
pub(crate) struct Venue {
    pub(crate) name: &'static str,
    file: &'static str,
    start: [f64; 3],
    /// Bounds of the world: minimum x and y, maximum x and y \[m\].
    pub(crate) bounds_m: [f64; 4],
    tour: Tour,
}

enum Tour {
    /// To random positions, up to a total path length \[m\].
    Wander(f64),
    /// From point to point; with odd seeds in the opposite direction.
    Around(&'static [[f64; 2]]),
}

pub(crate) const VENUES: [Venue; 5] = [
    Venue {
        name: "closed_room",
        file: "worlds/closed_room.world",
        start: [0.0, 0.0, 0.0],
        bounds_m: [-6.0, -6.0, 8.0, 8.0],
        tour: Tour::Wander(30.0),
    },
    Venue {
        name: "house",
        file: "worlds/house.sdf",
        start: [0.0, 0.0, 0.0],
        bounds_m: [-7.0, -6.0, 7.0, 6.0],
        tour: Tour::Wander(80.0),
    },
    Venue {
        name: "warehouse",
        file: "worlds/warehouse.sdf",
        start: [-10.0, -2.5, 0.0],
        bounds_m: [-16.0, -11.0, 16.0, 11.0],
        tour: Tour::Wander(150.0),
    },
    Venue {
        name: "corridor_loop",
        file: "worlds/corridor_loop.sdf",
        start: [5.0, 0.0, 0.0],
        bounds_m: [-2.0, -2.0, 32.0, 22.0],
        tour: Tour::Around(&[
            [15.0, 0.0],
            [30.0, 0.0],
            [30.0, 10.0],
            [30.0, 20.0],
            [15.0, 20.0],
            [0.0, 20.0],
            [0.0, 10.0],
            [0.0, 0.0],
            [15.0, 0.0],
        ]),
    },
    Venue {
        name: "glass_hall",
        file: "worlds/glass_hall.sdf",
        start: [2.0, 2.0, 0.0],
        bounds_m: [-4.0, -7.0, 31.0, 19.0],
        tour: Tour::Wander(100.0),
    },
];

const ROBOT: &str = "robots/kbot/urdf/kbot.urdf.xacro";
/// Relative error of the wheel radius that odometry assumes, one standard deviation.
const RADIUS_ERROR: f64 = 0.01;
const TRACK_ERROR: f64 = 0.03;
/// Middle of the laser as seen from the base: ahead and up \[m\].
pub(crate) const LASER_M: [f64; 2] = [0.065, 0.075];

/// A world with a robot, and the path that the robot drives.
pub(crate) struct Stage {
    pub(crate) composition: Composition,
    pub(crate) files: Arc<AssetFiles>,
    /// Surfaces that a lidar measures, without the robot.
    scene: RenderScene,
    pub(crate) bounds_m: [f64; 4],
    /// Goals in their order \[m\].
    pub(crate) way: Vec<[f64; 2]>,
}

impl Stage {
    pub(crate) fn set(venue: &Venue, seed: u64) -> Result<Self, String> {
        let mut stream = Stream::keyed(seed, venue.name, 0);
        let mut times = |sigma: f64| format!("{:.5}", 1.0 + sigma * stream.normal());
        let arguments = [
            ("laser_rate", "10".to_owned()),
            ("laser_beams", "720".to_owned()),
            ("odometry", "encoder".to_owned()),
            ("radius_times", times(RADIUS_ERROR)),
            ("track_times", times(TRACK_ERROR)),
        ];
        let [x, y, mut yaw] = venue.start;
        let is_turned = matches!(venue.tour, Tour::Around(_)) && seed % 2 == 1;
        if is_turned {
            yaw += std::f64::consts::PI;
        }
        let robot = RobotPlacement {
            file: PathBuf::from(ROBOT),
            arguments: arguments.map(|(name, value)| (name.to_owned(), value)).to_vec(),
            pose: PlacementPose::OnGround([x, y, yaw]),
            ..RobotPlacement::default()
        };
        let resolver = Resolver::new(&Machine, &[]);
        let setting = LoadContext {
            host: &Machine,
            resolver: &resolver,
            working_folder: std::env::current_dir().map_err(|why| why.to_string())?,
            arguments: Vec::new(),
            open_meshes: false,
        };
        let mut composition = compose(Path::new(venue.file), &[robot], &setting);
        if composition.has_errors() {
            return Err(format!("{} or {ROBOT} has errors", venue.file));
        }
        // Movable models are made static: a wall that moves has no true position.
        let standing = composition.members.iter_mut().filter(|it| it.description.is_none());
        standing.for_each(|it| it.model.is_static = true);
        let files = Arc::new(AssetFiles::default());
        let mut world = composition.world.clone();
        for member in composition.members.iter().filter(|it| it.description.is_none()) {
            let mut model = member.model.clone();
            model.parent_from_model = member.world_from_model;
            world.models.push(model);
        }
        let (scene, _) = RenderScene::new(&world, SensedGeometry::Collision, &*files, 1);
        let mut stage =
            Self { composition, files, scene, bounds_m: venue.bounds_m, way: Vec::new() };
        let floor = Floor::of(&stage);
        stage.way = match &venue.tour {
            Tour::Wander(length_m) => floor.wander([x, y], *length_m, &mut stream),
            Tour::Around(places) => {
                let mut places: Vec<[f64; 2]> = places.to_vec();
                if is_turned {
                    places.reverse();
                    // The last one lies ahead of the start, which now lies behind.
                    places.remove(0);
                    places.push([28.0, 0.0]);
                }
                // Real robots do not drive exactly along the middle.
                let mut aside = || 0.25 * (2.0 * stream.unit() - 1.0);
                places.iter().map(|[x, y]| [x + aside(), y + aside()]).collect()
            }
        };
        Ok(stage)
    }

    /// The first thing on a line in the plane \[m\], as a lidar would measure it.
    pub(crate) fn cast(&self, [x, y, z]: [f64; 3], angle_rad: f64, most_m: f64) -> Option<f64> {
        let direction = DVec3::new(angle_rad.cos(), angle_rad.sin(), 0.0);
        let ray = Ray { max_m: most_m, ..Ray::new(DVec3::new(x, y, z), direction) };
        self.scene.rays().cast(&ray, Filter::default()).map(|hit| hit.distance_m)
    }
}

/// Position of the laser for a pose of the base.
pub(crate) fn laser(world_from_base: Pose2) -> [f64; 3] {
    let (x, y) = world_from_base.transform_point(LASER_M[0], 0.0);
    [x, y, LASER_M[1]]
}
