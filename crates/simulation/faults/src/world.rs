//! Faults of wheels, surfaces and models.

use periplus_diagnostics::{Diagnostic, Diagnostics};
use periplus_geometry::{Pose, Pose2};
use periplus_sim::{InsertionSource, ModelInsertion, Search, Simulation};

use crate::kinds::FaultKind;
use crate::read::InjectedFault;

/// A fault of the world and its state.
pub(crate) struct WorldFault {
    fault: InjectedFault,
    state: WorldFaultState,
}

#[derive(Clone, Debug, PartialEq)]
enum WorldFaultState {
    Waiting,
    /// Active, with the name of its model and the pose to which it returns.
    Active(Option<String>, Option<Pose>),
    Over,
}

impl WorldFault {
    pub(crate) fn new(fault: InjectedFault) -> Self {
        Self { fault, state: WorldFaultState::Waiting }
    }

    /// Starts or ends the fault if its time has come; returns true if it has.
    pub(crate) fn update(
        &mut self,
        simulation: &mut Simulation,
        findings: &mut Diagnostics,
    ) -> bool {
        let before = self.state.clone();
        let now_s = simulation.time_ns() as f64 * 1e-9;
        match &self.state {
            WorldFaultState::Waiting if now_s >= self.fault.from_s => {
                self.state = match start(&self.fault.kind, simulation) {
                    Ok((model, pose)) => WorldFaultState::Active(model, pose),
                    Err(reason) => {
                        let word = self.fault.kind.word();
                        findings.push(
                            Diagnostic::error("fault-failed", format!("`{word}`: {reason}"))
                                .at(self.fault.origin),
                        );
                        WorldFaultState::Over
                    }
                };
            }
            WorldFaultState::Active(model, pose) if now_s >= self.fault.until_s => {
                end(&self.fault.kind, simulation, model.as_deref(), *pose);
                self.state = WorldFaultState::Over;
            }
            _ => {}
        }
        self.state != before
    }
}

type Started = (Option<String>, Option<Pose>);

/// Starts a fault; returns the model that it inserted or moved, and the pose before.
fn start(kind: &FaultKind, simulation: &mut Simulation) -> Result<Started, String> {
    let robot = simulation.robot_name().map(str::to_owned);
    let robot = || robot.clone().ok_or_else(|| "there is no robot".to_owned());
    match kind {
        FaultKind::WheelSlip(it) => {
            let robot = robot()?;
            for link in &it.links {
                if !simulation.limit_friction(&robot, Some(link), Some(it.friction_ratio)) {
                    return Err(no_friction(simulation, &robot, Some(link)));
                }
            }
        }
        FaultKind::LowFriction(it) => {
            let robot = robot()?;
            if !simulation.limit_friction(&robot, None, Some(it.friction_ratio)) {
                return Err(no_friction(simulation, &robot, None));
            }
        }
        FaultKind::StuckWheel(it) => {
            let robot = robot()?;
            for joint in &it.joints {
                if !simulation.set_joint_seized(&robot, joint, true) {
                    let joints = simulation.joint_names(&robot).join(", ");
                    return Err(format!(
                        "`{robot}` has no joint `{joint}` that moves; it has {joints}"
                    ));
                }
            }
        }
        FaultKind::Kidnap(it) => {
            let robot = robot()?;
            move_model(simulation, &robot, &it.pose)?;
        }
        FaultKind::MovedModel(it) => {
            let before = move_model(simulation, &it.model, &it.pose)?;
            return Ok((Some(it.model.clone()), Some(before)));
        }
        FaultKind::Box(it) => {
            let size_m = [it.size_m[0], it.size_m[1], it.size_m[2]];
            let model = insert_box(simulation, &it.name, pose2(&it.pose, 0.0), size_m)?;
            return Ok((Some(model), None));
        }
        FaultKind::ClosedDoor(it) => {
            let ([x, y], [to_x, to_y]) =
                ([it.left_m[0], it.left_m[1]], [it.right_m[0], it.right_m[1]]);
            let (along_x, along_y) = (to_x - x, to_y - y);
            let yaw_rad = libm::atan2(along_y, along_x);
            let middle = Pose2::new(x + along_x / 2.0, y + along_y / 2.0, yaw_rad);
            let size_m = [libm::hypot(along_x, along_y), it.thickness_m, it.height_m];
            let model = insert_box(simulation, &it.name, middle, size_m)?;
            return Ok((Some(model), None));
        }
        _ => {}
    }
    Ok((None, None))
}

fn end(kind: &FaultKind, simulation: &mut Simulation, model: Option<&str>, before: Option<Pose>) {
    let robot = simulation.robot_name().unwrap_or_default().to_owned();
    match kind {
        FaultKind::WheelSlip(it) => {
            for link in &it.links {
                simulation.limit_friction(&robot, Some(link), None);
            }
        }
        FaultKind::LowFriction(_) => {
            simulation.limit_friction(&robot, None, None);
        }
        FaultKind::StuckWheel(it) => {
            for joint in &it.joints {
                simulation.set_joint_seized(&robot, joint, false);
            }
        }
        FaultKind::MovedModel(it) => {
            if let Some(before) = before {
                simulation.set_pose(&it.model, before);
            }
        }
        FaultKind::Box(_) | FaultKind::ClosedDoor(_) => {
            if let Some(model) = model {
                simulation.delete(model);
            }
        }
        _ => {}
    }
}

/// Reason that no friction was limited.
fn no_friction(simulation: &Simulation, robot: &str, link: Option<&str>) -> String {
    let links = simulation.link_names(robot).join(", ");
    let what = link.map_or("no link".to_owned(), |link| format!("no link `{link}`"));
    format!(
        "`{robot}` has {what} with contacts (its links are {links}); slip also needs the motion `rigid`"
    )
}

fn pose2(numbers: &[f64], default_yaw_rad: f64) -> Pose2 {
    let number = |index: usize| numbers.get(index).copied();
    let yaw_rad = number(2).unwrap_or(default_yaw_rad);
    Pose2::new(number(0).unwrap_or(0.0), number(1).unwrap_or(0.0), yaw_rad)
}

/// Moves a model in the plane, with its height; returns its pose before.
fn move_model(simulation: &mut Simulation, model: &str, to: &[f64]) -> Result<Pose, String> {
    let Some(before) = simulation.model_pose(model) else {
        let models: Vec<&str> = simulation.models().collect();
        return Err(format!("there is no model `{model}`; the world has {}", models.join(", ")));
    };
    let planar = pose2(to, Pose2::from(before).yaw_rad);
    let mut target = Pose::from(planar);
    target.translation.z = before.translation.z;
    if simulation.set_pose(model, target) {
        Ok(before)
    } else {
        Err(format!("`{model}` cannot be moved to {to:?}"))
    }
}

/// Inserts a box that stands on the floor and does not move; returns its name in the world.
fn insert_box(
    simulation: &mut Simulation,
    name: &str,
    world_from_box: Pose2,
    [x_m, y_m, z_m]: [f64; 3],
) -> Result<String, String> {
    let size = format!("{x_m} {y_m} {z_m}");
    let geometry = format!("<geometry><box><size>{size}</size></box></geometry>");
    let text = format!(
        "<sdf version='1.9'><model name='{name}'><static>true</static><link name='body'>\
         <collision name='body'>{geometry}</collision>\
         <visual name='body'>{geometry}<material><diffuse>0.8 0.4 0.1 1</diffuse></material></visual>\
         </link></model></sdf>"
    );
    let mut pose = Pose::from(world_from_box);
    pose.translation.z = z_m / 2.0;
    let insertion = ModelInsertion {
        from: InsertionSource::Text(&text, "a fault"),
        name,
        may_rename: true,
        namespace: "",
        world_from_here: pose,
        with_frames: false,
    };
    let inserted = insertion.bring(simulation, &Search::default());
    inserted.map(|result| result.name).map_err(|error| error.to_string())
}
