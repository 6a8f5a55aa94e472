//! Ranges of lidar beams that pass through glass and are reflected by mirrors.
//!
//! The lidars of the simulation measure every surface as a diffuse one. For the models that are named here a beam
//! continues behind its hit, or in the direction of the reflection: r = d - 2 (d · n) n for the direction d and the
//! normal n.

use periplus_geometry::{DVec3, Pose};
use periplus_raycast::Ray;
use periplus_rendering::{SensedGeometry, filter};
use periplus_scene::{Model, SensorKind};

use crate::Simulation;

/// Maximum number of panes and mirrors on the path of a beam.
const MAX_SURFACE_COUNT: usize = 16;

/// Distance of the next surface from one that a beam passes \[m\].
const NEXT_SURFACE_M: f64 = 1e-4;

/// Effect of the surface of a model on a beam.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum OpticalSurface {
    /// The surface is measured.
    Diffuse,
    /// The beam passes in the same direction.
    Glass,
    /// The beam is reflected; the lidar measures the length of the whole path.
    Mirror,
}

/// A beam of a lidar at its first surface and with glass and mirrors.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OpticalRange {
    /// Range to the first surface \[m\].
    pub first_m: f64,
    /// Length of the path to the surface that is measured \[m\]; infinite without one.
    pub measured_m: f64,
}

impl Simulation {
    /// Follows the beams of the sensor that publishes a topic, at these angles in the plane of its frame \[rad\].
    /// `surface` names what a beam does at a model. `None` in place of a beam that meets only diffuse surfaces; an
    /// empty list if no sensor publishes the topic.
    pub fn optical_ranges(
        &mut self,
        topic: &str,
        angles_rad: &[f64],
        surface: &dyn Fn(&str) -> OpticalSurface,
    ) -> Vec<Option<OpticalRange>> {
        let mounts = self.sensor_mounts();
        let mount = mounts.into_iter().find(|(_, mount)| mount.topic == topic);
        let Some((robot, mount)) = mount.map(|(name, mount)| (name.to_owned(), mount)) else {
            return Vec::new();
        };
        let Some(link) = self.motion.link_state(mount.link) else { return Vec::new() };
        let world_from_data = link.world_from_link * mount.link_from_data;
        let geometry = self.geometry_of(&robot);
        let scene = self.views.at(geometry, self.time_ns, &self.motion);
        let follow = |angle_rad: &f64| {
            let (sin, cos) = libm::sincos(*angle_rad);
            let direction = world_from_data.rotation * DVec3::new(cos, sin, 0.0);
            follow_beam(scene, world_from_data, direction, &robot, surface)
        };
        angles_rad.iter().map(follow).collect()
    }

    /// Returns what the first lidar of a model senses: GPU lidars visuals, others collisions, as in Gazebo.
    fn geometry_of(&self, model: &str) -> SensedGeometry {
        let member = self.place_of(model).map(|place| &self.running[place].member.model);
        match member.and_then(is_rendered) {
            Some(true) => SensedGeometry::Visual,
            _ => SensedGeometry::Collision,
        }
    }
}

/// Returns true if the first lidar of a model is a GPU lidar.
fn is_rendered(model: &Model) -> Option<bool> {
    let sensors = model.links.iter().flat_map(|link| &link.sensors);
    let lidar = sensors.into_iter().find(|it| matches!(it.kind, SensorKind::Lidar(_)));
    let own = lidar.map(|sensor| sensor.type_name.starts_with("gpu"));
    own.or_else(|| model.models.iter().find_map(is_rendered))
}

fn follow_beam(
    scene: &periplus_rendering::RenderScene,
    world_from_data: Pose,
    direction: DVec3,
    robot: &str,
    surface: &dyn Fn(&str) -> OpticalSurface,
) -> Option<OpticalRange> {
    let mut ray = Ray::new(world_from_data.translation, direction);
    let (mut path_m, mut first_m) = (0.0, None);
    for _ in 0..MAX_SURFACE_COUNT {
        let Some(hit) = scene.rays().cast(&ray, filter(u32::MAX, None)) else {
            return first_m.map(|first_m| OpticalRange { first_m, measured_m: f64::INFINITY });
        };
        let model = scene.surface(&hit).model;
        // A lidar does not sense its own model.
        let kind = if model == robot { OpticalSurface::Glass } else { surface(model) };
        if kind == OpticalSurface::Diffuse {
            return first_m
                .map(|first_m| OpticalRange { first_m, measured_m: path_m + hit.distance_m });
        }
        if model != robot {
            first_m.get_or_insert(path_m + hit.distance_m);
        }
        match kind {
            OpticalSurface::Mirror => {
                let at = ray.at(hit.distance_m);
                let reflected = ray.direction - hit.normal * (2.0 * ray.direction.dot(hit.normal));
                path_m += hit.distance_m;
                ray = Ray { min_m: NEXT_SURFACE_M, ..Ray::new(at, reflected) };
            }
            _ => ray.min_m = hit.distance_m + NEXT_SURFACE_M,
        }
    }
    first_m.map(|first_m| OpticalRange { first_m, measured_m: f64::INFINITY })
}
