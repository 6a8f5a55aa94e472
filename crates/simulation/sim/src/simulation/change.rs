//! Changes of a running world.

use std::sync::Arc;

use periplus_diagnostics::Diagnostics;
use periplus_geometry::{DVec3, Pose};
use periplus_scene as scene;

use super::{RunningModel, Simulation, all};
use crate::services::Entity;

impl Simulation {
    /// Sets the pose of a model or link, at rest.
    pub(crate) fn place(&mut self, entity: Entity, world_from_entity: Pose) {
        match entity {
            Entity::Model(model) => {
                let running = self.running.iter().find(|running| running.model == model);
                let name = running.map(|running| running.member.name.clone());
                if self.motion.set_pose(model, world_from_entity) {
                    self.requested_poses.extend(name.map(|name| (name, world_from_entity)));
                }
            }
            Entity::Link(link) => {
                self.motion.set_link_pose(link, world_from_entity);
            }
        }
        self.views.invalidate();
    }

    /// Resets time to zero; models keep their poses.
    pub(crate) fn reset_time(&mut self) {
        if let Some(people) = &mut self.people {
            people.shift_time(-self.time_ns);
        }
        self.time_ns = 0;
        self.graph.jump_to(0);
        self.place_actors();
        self.views.invalidate();
        self.restart_devices();
    }

    /// Restarts devices at the current time. After a change of the seed they are rebuilt, since they
    /// get their noise streams when they are built.
    pub(super) fn restart_devices(&mut self) {
        if std::mem::take(&mut self.has_new_seed) {
            self.remake_devices();
        }
        let time_ns = self.time_ns;
        all(&mut self.world_devices, &mut self.running).for_each(|device| device.reset(time_ns));
    }

    /// Sets the velocities of a model as one rigid piece: of its frame's origin \[m/s\] and about it
    /// \[rad/s\], in world axes. Returns false for an unknown or immovable model, or a number that is not
    /// finite.
    pub fn set_velocity(&mut self, name: &str, linear_m_s: DVec3, angular_rad_s: DVec3) -> bool {
        let Some(place) = self.place_of(name) else { return false };
        let model = self.running[place].model;
        self.motion.set_model_velocity(model, linear_m_s, angular_rad_s)
    }

    /// Sets another seed of all noise, from the next reset on.
    pub fn set_seed(&mut self, seed: u64) {
        self.has_new_seed |= self.options.seed != seed;
        self.options.seed = seed;
    }

    fn remake_devices(&mut self) {
        let mut running = std::mem::take(&mut self.running);
        // Remove their nodes first, so that the names are unused.
        running.iter_mut().for_each(|running| running.devices.clear());
        let seed = self.options.seed;
        for running in &mut running {
            // Their problems were reported when they were built first.
            let mut findings = Diagnostics::new();
            let RunningModel { member, model, .. } = &*running;
            running.devices = self.devices_of(member, *model, &self.motion, seed, &mut findings);
            (running.build, running.seed) = (self.next_build(), seed);
        }
        self.running = running;
    }

    /// Returns the step \[s\].
    #[expect(clippy::cast_precision_loss, reason = "a step is far below 2^53 ns")]
    pub(crate) fn step_s(&self) -> f64 {
        self.step_ns as f64 * 1e-9
    }

    /// Sets gravity \[m/s²\].
    pub(crate) fn set_gravity(&mut self, gravity_m_s2: DVec3) {
        self.motion.set_gravity(gravity_m_s2);
        Arc::make_mut(&mut self.scene).gravity_m_s2 = gravity_m_s2;
    }

    /// Returns the physics settings.
    pub(crate) fn physics(&self) -> scene::Physics {
        let profiles = &self.scene.physics;
        let used = profiles.iter().find(|physics| physics.default).or(profiles.first());
        used.cloned().unwrap_or_default()
    }

    /// Returns the physics settings, mutably.
    pub(crate) fn physics_mut(&mut self) -> &mut scene::Physics {
        let profiles = &mut Arc::make_mut(&mut self.scene).physics;
        if profiles.is_empty() {
            profiles.push(scene::Physics::default());
        }
        let used = profiles.iter().position(|physics| physics.default).unwrap_or(0);
        &mut profiles[used]
    }

    /// Returns the centre of mass of a link, `model::link`, in its frame \[m\]; its origin if
    /// unknown.
    pub(crate) fn centre_of_mass(&self, link: &str) -> DVec3 {
        let centre = link.split_once("::").and_then(|(model, link)| {
            let member = &self.running[self.place_of(model)?].member;
            Some(member.model.link(link)?.inertial.link_from_inertial.translation)
        });
        centre.unwrap_or(DVec3::ZERO)
    }

    /// Adds a light to the world.
    pub(crate) fn add_light(&mut self, light: scene::Light) {
        self.views.set_light(&light);
        Arc::make_mut(&mut self.scene).lights.push(light);
    }

    /// Removes a light. Returns false for an unknown name.
    pub(crate) fn delete_light(&mut self, name: &str) -> bool {
        let lights = &mut Arc::make_mut(&mut self.scene).lights;
        let Some(place) = lights.iter().position(|light| light.name == name) else { return false };
        lights.remove(place);
        self.views.remove_light(name);
        true
    }

    /// Updates a changed light in the scenes. One on a link is `model::link::light`.
    pub(crate) fn show_light(&mut self, name: &str) {
        if let Some(light) = self.scene.lights.iter().find(|light| light.name == name) {
            self.views.set_light(light);
            return;
        }
        let Some((model, rest)) = name.split_once("::") else { return };
        let Some((link, name)) = rest.split_once("::") else { return };
        let Some(place) = self.place_of(model) else { return };
        let running = &self.running[place];
        let Some(id) = self.motion.find_link(running.model, link) else { return };
        let lights = running.member.model.lights();
        let mut lights = lights.filter(|(on, light)| on.name == link && light.name == name);
        if let Some((_, light)) = lights.next() {
            self.views.set_light_on(id, light, &self.motion);
        }
    }

    /// Returns all active lights, with current `world_from_light`: those of the world and those on
    /// links.
    #[must_use]
    pub fn lights(&self) -> Vec<(Pose, scene::Light)> {
        let of_world = self.scene.lights.iter();
        let mut lights: Vec<(Pose, scene::Light)> =
            of_world.map(|light| (light.parent_from_light, light.clone())).collect();
        for running in &self.running {
            for (link, light) in running.member.model.lights() {
                let link = self.motion.find_link(running.model, &link.name);
                let Some(state) = link.and_then(|link| self.motion.link_state(link)) else {
                    continue;
                };
                lights.push((state.world_from_link * light.parent_from_light, light.clone()));
            }
        }
        lights.retain(|(_, light)| light.is_on);
        lights
    }
}
