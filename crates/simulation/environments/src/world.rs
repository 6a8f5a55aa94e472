//! Worlds of environments: the rays of their lidars, the obstacles of their robots and the free space.

use periplus_diagnostics::{Diagnostic, Diagnostics};
use periplus_geometry::{DVec3, Pose};
use periplus_raycast::{InstanceError, RaycastShape, RaycastWorld, RaycastWorldBuilder, Tags};
use periplus_rendering::{AssetLoader, RenderScene, SensedGeometry, TracedGeometry, TracedShape};
use periplus_scene::World;

use crate::free_space::FreeSpace;
use crate::obstacles::{HeightBand, Obstacles};
use crate::parameters::LidarGeometry;
use crate::robot::EnvironmentRobot;

/// World that any number of environments share.
#[derive(Clone, Debug)]
pub struct NavigationWorld {
    name: String,
    rays: RaycastWorld,
    obstacles: Obstacles,
    free_space: FreeSpace,
}

impl NavigationWorld {
    /// Prepares a world for a robot: the shapes that its lidar measures, in the scene of the simulation but without
    /// those that do not cross the plane of the beams, and the collision shapes at the heights of its body.
    ///
    /// An error of the diagnostics means that the world cannot be used: a shape is not supported, or nothing is free.
    #[must_use]
    pub fn new(
        world: &World,
        robot: &EnvironmentRobot,
        assets: &dyn AssetLoader,
        threads: usize,
    ) -> (Self, Diagnostics) {
        let params = robot.params();
        let (collisions, mut diagnostics) =
            RenderScene::new(world, SensedGeometry::Collision, assets, threads);
        let band = HeightBand { low_m: params.body_bottom_m, high_m: params.body_top_m };
        let (obstacles, more) = Obstacles::of_scene(&collisions, band);
        diagnostics.append(more);
        let height_m = params.lidar_height_m;
        let rays = match params.lidar_geometry {
            LidarGeometry::Collision => plane_rays(&collisions, height_m, threads),
            LidarGeometry::Visual => {
                let (visuals, more) =
                    RenderScene::new(world, SensedGeometry::Visual, assets, threads);
                diagnostics.append(more);
                plane_rays(&visuals, height_m, threads)
            }
        };
        let rays = rays.unwrap_or_else(|error| {
            let text = format!("the shapes of world `{}` cannot be traced: {error}", world.name);
            diagnostics.push(Diagnostic::error("world-not-traced", text));
            collisions.rays().clone()
        });
        let radius_m = robot.footprint().circumscribed_radius_m();
        let free_space = FreeSpace::new(&obstacles, radius_m);
        if free_space.is_empty() {
            let text = format!(
                "nothing is free in world `{}` for a robot with a radius of {radius_m} m",
                world.name
            );
            diagnostics.push(
                Diagnostic::error("no-free-space", text)
                    .help("make the robot smaller, or the world larger"),
            );
        }
        (Self { name: world.name.clone(), rays, obstacles, free_space }, diagnostics)
    }

    /// Returns the name.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Returns the shapes that cross the plane of the lidar.
    #[must_use]
    pub fn rays(&self) -> &RaycastWorld {
        &self.rays
    }

    /// Returns the obstacles.
    #[must_use]
    pub fn obstacles(&self) -> &Obstacles {
        &self.obstacles
    }

    /// Returns the free space.
    #[must_use]
    pub fn free_space(&self) -> &FreeSpace {
        &self.free_space
    }
}

/// Corners of a cube of two metres.
const CUBE_CORNERS_M: [[f64; 3]; 8] = [
    [-1.0, -1.0, -1.0],
    [1.0, -1.0, -1.0],
    [-1.0, 1.0, -1.0],
    [1.0, 1.0, -1.0],
    [-1.0, -1.0, 1.0],
    [1.0, -1.0, 1.0],
    [-1.0, 1.0, 1.0],
    [1.0, 1.0, 1.0],
];
/// Triangles of the cube, two for each side.
const CUBE_TRIANGLES: [[u32; 3]; 12] = [
    [0, 1, 5],
    [0, 5, 4],
    [2, 6, 7],
    [2, 7, 3],
    [0, 4, 6],
    [0, 6, 2],
    [1, 3, 7],
    [1, 7, 5],
    [0, 2, 3],
    [0, 3, 1],
    [4, 5, 7],
    [4, 7, 6],
];

/// Collects the shapes that cross a horizontal plane. Boxes are triangles, which are the fastest to trace.
fn plane_rays(
    scene: &RenderScene,
    height_m: f64,
    threads: usize,
) -> Result<RaycastWorld, InstanceError> {
    let mut builder = RaycastWorld::builder();
    for shape in scene.shapes() {
        let TracedShape { world_from_body, geometry, .. } = shape;
        match geometry {
            TracedGeometry::Shape(RaycastShape::Box { size_m }) => {
                let half_m = *size_m / 2.0;
                let corners =
                    CUBE_CORNERS_M.map(|corner| (DVec3::from(corner) * half_m).to_array());
                add_crossing(&mut builder, &corners, &CUBE_TRIANGLES, &world_from_body, height_m)?;
            }
            TracedGeometry::Triangles { positions_m, triangles } => {
                add_crossing(&mut builder, positions_m, triangles, &world_from_body, height_m)?;
            }
            TracedGeometry::Shape(form) => {
                if reaches(form, &world_from_body, height_m) {
                    builder.add_shape(form, &world_from_body, Tags::default())?;
                }
            }
            // Obstacles report it.
            TracedGeometry::Heightfield(_) => {}
        }
    }
    builder.build(threads)
}

/// Adds the triangles that cross a horizontal plane, in the frame of the world.
fn add_crossing(
    builder: &mut RaycastWorldBuilder,
    positions_m: &[[f64; 3]],
    triangles: &[[u32; 3]],
    world_from_body: &Pose,
    height_m: f64,
) -> Result<(), InstanceError> {
    let in_world = |p: &[f64; 3]| world_from_body.transform_point(DVec3::from(*p)).to_array();
    let corners: Vec<[f64; 3]> = positions_m.iter().map(in_world).collect();
    let crosses = |triangle: &&[u32; 3]| {
        let heights = triangle.map(|corner| corners[corner as usize][2]);
        heights.iter().any(|z| *z <= height_m) && heights.iter().any(|z| *z >= height_m)
    };
    let crossing: Vec<[u32; 3]> = triangles.iter().filter(crosses).copied().collect();
    if !crossing.is_empty() {
        builder.add_fixed(&corners, &crossing, &Pose::IDENTITY, Tags::default())?;
    }
    Ok(())
}

/// Returns false if a shape is above or below a horizontal plane.
fn reaches(shape: &RaycastShape, world_from_body: &Pose, height_m: f64) -> bool {
    let radius_m = match *shape {
        RaycastShape::Plane { size_m: None } => f64::INFINITY,
        RaycastShape::Plane { size_m: Some([x, y]) } => libm::hypot(x, y) / 2.0,
        RaycastShape::Box { size_m } => size_m.length() / 2.0,
        RaycastShape::Sphere { radius_m } => radius_m,
        RaycastShape::Cylinder { radius_m, length_m }
        | RaycastShape::Cone { radius_m, length_m } => libm::hypot(radius_m, length_m / 2.0),
        RaycastShape::Capsule { radius_m, length_m } => radius_m + length_m / 2.0,
        RaycastShape::Ellipsoid { radii_m } => radii_m.max_element(),
    };
    // A level plane is beside all beams.
    let axis = world_from_body.rotation * DVec3::Z;
    let is_level_plane = matches!(shape, RaycastShape::Plane { .. }) && axis.z.abs() > 1.0 - 1e-12;
    !is_level_plane && (world_from_body.translation.z - height_m).abs() <= radius_m
}
