//! Robots of a simulation.

use periplus_geometry::Pose;

use super::Simulation;

/// Robot of a simulation.
#[derive(Clone, Debug, PartialEq)]
pub struct SimulatedRobot {
    /// Name of its model in the world.
    pub name: String,
    /// Namespace of its nodes; `/` is none.
    pub namespace: String,
    /// Pose in the world.
    pub world_from_robot: Pose,
    /// Radius about its frame, seen from above \[m\]; `None` if its collisions do not define one.
    pub radius_m: Option<f64>,
}

impl Simulation {
    /// Returns the robots: all models with a description, or else the first movable one.
    #[must_use]
    pub fn robots(&self) -> Vec<SimulatedRobot> {
        let described = self.running.iter().filter(|running| running.member.description.is_some());
        let mut models: Vec<_> = described.collect();
        if models.is_empty() {
            models.extend(self.robot());
        }
        let robots = models.into_iter().filter_map(|running| {
            Some(SimulatedRobot {
                name: running.member.name.clone(),
                namespace: running.member.namespace.clone(),
                world_from_robot: self.motion.model_pose(running.model)?,
                radius_m: crate::default_world::radius_m(&running.member.model, Pose::IDENTITY),
            })
        });
        robots.collect()
    }
}
