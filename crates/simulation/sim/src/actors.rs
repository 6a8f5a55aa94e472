//! Actors of a world: people that follow a script of waypoints, seen by all sensors and without contacts.

mod figure;
mod script;

use std::sync::Arc;

use periplus_crowds::{ActorMotion, ActorScript};
use periplus_diagnostics::{Diagnostic, Diagnostics};
use periplus_geometry::Pose;
use periplus_rendering::is_label_plugin;
use periplus_scene::{Actor, Model};
use periplus_sim_nodes::{FigureId, Views};

use self::figure::FIGURE_LINK_COUNT;
pub(crate) use self::figure::{figure_links, figure_poses};

/// Height of a first waypoint from which on the origin of the skin is taken to be at the hip, as that of the walking
/// person of Fuel, and not on the floor \[m\].
const MIN_HIP_ORIGIN_M: f64 = 0.5;

/// Height of such an origin above the floor \[m\].
const HIP_ORIGIN_M: f64 = 1.0;

/// Actor in a running world.
#[derive(Debug)]
pub(crate) struct RunningActor {
    name: String,
    script: ActorScript,
    /// Pose of the actor, to which its waypoints add.
    waypoint_from_actor: Pose,
    /// Its origin above the soles of the figure \[m\]; none without a skin.
    origin_m: Option<f64>,
    /// Poses of the links that it has itself.
    actor_from_links: Vec<Pose>,
    figure: FigureId,
}

impl RunningActor {
    /// Adds an actor to the scenes of the sensors, and reports its parts that are not simulated.
    pub(crate) fn new(actor: &Actor, views: &mut Views, findings: &mut Diagnostics) -> Self {
        let script = script::read(actor, findings);
        report(actor, findings);
        let has_skin = actor.extra.iter().any(|element| element.local_name() == "skin");
        let mut model = Model::new(actor.name.clone());
        if has_skin {
            model.links = figure_links(&actor.name);
        }
        model.links.extend(actor.links.iter().cloned());
        // The label of the actor is that of its figure.
        model.plugins = actor.plugins.iter().filter(|it| is_label_plugin(it)).cloned().collect();
        let start = script
            .motion_at(0.0)
            .map_or(actor.world_from_actor, |motion| motion.pose * actor.world_from_actor);
        let is_at_hip = start.translation.z >= MIN_HIP_ORIGIN_M;
        Self {
            name: actor.name.clone(),
            script,
            waypoint_from_actor: actor.world_from_actor,
            origin_m: has_skin.then_some(if is_at_hip { HIP_ORIGIN_M } else { 0.0 }),
            actor_from_links: actor.links.iter().map(|link| link.model_from_link).collect(),
            figure: views.add_figure(Arc::new(model)),
        }
    }

    /// Name of the actor.
    pub(crate) fn name(&self) -> &str {
        &self.name
    }

    /// Pose of the actor at a time \[ns\].
    pub(crate) fn world_from_actor(&self, time_ns: i64) -> Pose {
        self.motion(time_ns).pose
    }

    /// Motion of the actor, at rest at its pose without a trajectory.
    fn motion(&self, time_ns: i64) -> ActorMotion {
        #[expect(clippy::cast_precision_loss, reason = "simulated times are below 2^53 ns")]
        let time_s = time_ns as f64 * 1e-9;
        match self.script.motion_at(time_s) {
            Some(motion) => ActorMotion { pose: motion.pose * self.waypoint_from_actor, ..motion },
            None => {
                ActorMotion { pose: self.waypoint_from_actor, walked_m: 0.0, speed_m_per_s: 0.0 }
            }
        }
    }

    /// Moves the actor to its pose at a time \[ns\].
    pub(crate) fn place(&self, time_ns: i64, views: &mut Views) {
        let motion = self.motion(time_ns);
        let mut poses = Vec::with_capacity(FIGURE_LINK_COUNT + self.actor_from_links.len());
        if let Some(origin_m) = self.origin_m {
            let world_from_soles = motion.pose * Pose::from_xyz(0.0, 0.0, -origin_m);
            poses.extend(figure_poses(world_from_soles, motion.walked_m, motion.speed_m_per_s));
        }
        poses.extend(self.actor_from_links.iter().map(|link| motion.pose * *link));
        views.set_figure(self.figure, time_ns, &poses);
    }
}

/// Reports the parts of an actor that are not simulated.
fn report(actor: &Actor, findings: &mut Diagnostics) {
    let name = &actor.name;
    if let Some(skin) = actor.extra.iter().find(|element| element.local_name() == "skin") {
        findings.push(
            Diagnostic::hint(
                "actor-figure",
                format!("the actor `{name}` is a figure of simple shapes, 1.75 m tall"),
            )
            .at(skin.origin)
            .note("skins and their animations are not rendered; the legs swing with the walked distance"),
        );
    }
    for plugin in actor.plugins.iter().filter(|plugin| !is_label_plugin(plugin)) {
        findings.push(
            Diagnostic::warning(
                "actor-plugin-ignored",
                format!("the plugin `{}` of the actor `{name}` is not executed", plugin.name),
            )
            .at(plugin.origin)
            .help("give the actor a <script> with a <trajectory>"),
        );
    }
    for sensor in actor.links.iter().flat_map(|link| &link.sensors) {
        findings.push(
            Diagnostic::warning(
                "actor-sensor-ignored",
                format!("the sensor `{}` of the actor `{name}` does not measure", sensor.name),
            )
            .at(sensor.origin)
            .help("put the sensor on a model"),
        );
    }
}
