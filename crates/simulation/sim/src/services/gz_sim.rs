//! Services of Harmonic, with the types of `ros_gz_bridge`.
//!
//! Semantics of the fields: gz-sim's `SimulationRunner` and `UserCommands`.

use periplus_graph::{GraphError, Mailbox, Node, Qos};
use periplus_msgs::ros_gz_interfaces::{
    ControlWorld, ControlWorldResponse, DeleteEntity, DeleteEntityResponse, Entity, EntityFactory,
    Light, SetEntityPose, SetEntityPoseResponse, SpawnEntity, SpawnEntityResponse, WorldControl,
};
use periplus_sim_nodes::gz_topic;

use super::convert::BAD_POSE;
use super::convert::pose;
use super::pause_state::PauseState;
use super::reading::{Search, Source};
use super::service_aliases::ServiceAliases;
use super::spawn::{SpawnPose, SpawnRequest, Spawned, copy, delete, lights, spawn};
use super::{RejectionLog, entity, light};
use crate::Simulation;

pub(super) struct GzSimServices {
    control: ServiceAliases<ControlWorld>,
    create: ServiceAliases<SpawnEntity>,
    remove: ServiceAliases<DeleteEntity>,
    set_pose: ServiceAliases<SetEntityPose>,
    lights: Mailbox<Light>,
}

/// Returns `/world/<name>/<what>` as a valid ROS name.
pub(super) fn name_of(world: &str, what: &str) -> String {
    gz_topic(&format!("/world/{world}/{what}"))
}

impl GzSimServices {
    pub(super) fn new(node: &Node, world: &str) -> Result<Self, GraphError> {
        let name = |what| name_of(world, what);
        Ok(Self {
            control: ServiceAliases::new(node, [name("control").as_str()])?,
            create: ServiceAliases::new(
                node,
                [name("create").as_str(), name("create/blocking").as_str()],
            )?,
            remove: ServiceAliases::new(
                node,
                [name("remove").as_str(), name("remove/blocking").as_str()],
            )?,
            set_pose: ServiceAliases::new(
                node,
                [name("set_pose").as_str(), name("set_pose/blocking").as_str()],
            )?,
            lights: node.mailbox(&name("light_config"), Qos::reliable(10))?,
        })
    }

    pub(super) fn serve(
        &self,
        simulation: &mut Simulation,
        search: &Search,
        tempo: &mut PauseState,
        log: &mut RejectionLog,
    ) {
        self.create.answer(|asked| {
            let done = create(simulation, search, &asked.entity_factory);
            let done = done.map(|spawned| log.notes("create", &spawned.notes));
            SpawnEntityResponse { success: log.note("create", done) }
        });
        self.remove.answer(|asked| {
            let done = remove(simulation, &asked.entity);
            DeleteEntityResponse { success: log.note("remove", done) }
        });
        self.set_pose.answer(|asked| {
            let done = pose(&asked.pose).ok_or_else(|| BAD_POSE.to_owned()).and_then(|pose| {
                let found = entity::find(simulation, named(&asked.entity)?)?;
                simulation.place(found, pose);
                Ok(())
            });
            SetEntityPoseResponse { success: log.note("set_pose", done) }
        });
        for message in self.lights.drain() {
            log.note("light_config", light::configure(simulation, &message));
        }
        self.control.answer(|asked| {
            control(simulation, tempo, &asked.world_control);
            ControlWorldResponse { success: true }
        });
    }
}

/// Pauses, steps, resets. A reset comes first, so that steps count from the new start.
pub(super) fn control(simulation: &mut Simulation, tempo: &mut PauseState, asked: &WorldControl) {
    if asked.seed != 0 {
        simulation.set_seed(asked.seed.into());
    }
    let reset = &asked.reset;
    if reset.all || (reset.time_only && reset.model_only) {
        simulation.reset();
    } else if reset.model_only {
        simulation.reset_models();
    } else if reset.time_only {
        simulation.reset_time();
    }
    let now_ns = simulation.time_ns();
    let steps = match asked.multi_step {
        0 => u32::from(asked.step),
        steps => steps,
    };
    let to_ns = asked.run_to_sim_time.ns();
    // Only a paused world can be stepped; a running one continues.
    if !asked.pause {
        tempo.set_paused(false);
    } else if steps == 0 || !tempo.is_stepping() {
        tempo.set_paused(true);
    }
    if asked.pause && steps > 0 {
        tempo.add_steps(steps, simulation.step_ns(), now_ns);
    }
    if to_ns > 0 {
        tempo.run_to(to_ns, now_ns);
    }
}

pub(super) fn create(
    simulation: &mut Simulation,
    search: &Search,
    asked: &EntityFactory,
) -> Result<Spawned, String> {
    let frame_from_model = pose(&asked.pose).ok_or(BAD_POSE)?;
    let frame = entity::frame(simulation, &asked.relative_to)?;
    let world_from_model = frame.pose * frame_from_model;
    let sources = [&asked.sdf, &asked.sdf_filename, &asked.clone_name];
    let given = sources.iter().filter(|source| !source.is_empty()).count();
    if given != 1 {
        return Err("set exactly one of `sdf`, `sdf_filename` and `clone_name`".into());
    }
    let wish = SpawnRequest {
        source: if asked.sdf.is_empty() {
            Source::File(&asked.sdf_filename)
        } else {
            Source::Text(&asked.sdf, "")
        },
        name: &asked.name,
        may_rename: asked.allow_renaming,
        namespace: "",
        with_frames: true,
        standing: SpawnPose::At(world_from_model),
    };
    if asked.clone_name.is_empty() {
        spawn(simulation, search, &wish).map_err(|error| error.to_string())
    } else {
        copy(simulation, &asked.clone_name, &wish, world_from_model)
    }
}

pub(super) fn remove(simulation: &mut Simulation, asked: &Entity) -> Result<(), String> {
    let name = named(asked)?;
    match asked.r#type {
        Entity::LIGHT => simulation
            .delete_light(name)
            .then_some(())
            .ok_or_else(|| format!("there is no light `{name}` ({})", lights(simulation))),
        Entity::MODEL if simulation.delete(name) => Ok(()),
        Entity::MODEL => Err(entity::unknown(simulation, name)),
        Entity::NONE => delete(simulation, name),
        _ => Err("only models and lights can be removed".into()),
    }
}

/// Returns the name of an entity; ids are not supported.
fn named(entity: &Entity) -> Result<&str, String> {
    if entity.name.is_empty() {
        return Err("set the name of the entity: ids are not supported".into());
    }
    Ok(&entity.name)
}
