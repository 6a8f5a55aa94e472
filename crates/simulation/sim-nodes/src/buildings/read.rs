//! Doors and lifts in the files of models.

use periplus_diagnostics::{Diagnostic, Diagnostics, Origin};
use periplus_plugin_specs::{PluginSite, interpret, model_sites};
use periplus_scene::{Axis, Model, World};
use periplus_xml::Element;

use super::cabin::CabinBox;
use super::motion::MotionLimits;

/// Name of a joint that is none.
const NO_JOINT: &str = "empty_joint";

/// BuildingFloor of a building.
#[derive(Clone, Debug, PartialEq)]
pub struct BuildingFloor {
    /// Its name, such as `L1`.
    pub name: String,
    /// Height of its surface in the world \[m\].
    pub elevation_m: f64,
}

/// Doors and lifts of a world.
#[derive(Clone, Debug, Default)]
pub(super) struct BuildingPlan {
    pub(super) doors: Vec<DoorSpec>,
    pub(super) lifts: Vec<LiftSpec>,
}

/// Door.
#[derive(Clone, Debug)]
pub(super) struct DoorSpec {
    /// Its name, that of its model.
    pub(super) name: String,
    pub(super) leaves: Vec<LeafSpec>,
    pub(super) limits: MotionLimits,
    /// Distance from a position within which a leaf is there \[m or rad\].
    pub(super) tolerance: f64,
    /// True if requests on topics move it; false for doors of lifts.
    pub(super) is_on_topics: bool,
}

/// Leaf of a door.
#[derive(Clone, Debug)]
pub(super) struct LeafSpec {
    pub(super) joint: JointName,
    /// \[m or rad\]
    pub(super) closed: f64,
    /// \[m or rad\]
    pub(super) open: f64,
}

/// Joint by the names of its outermost model and in that.
#[derive(Clone, Debug)]
pub(super) struct JointName {
    pub(super) model: String,
    pub(super) joint: String,
}

/// Lift.
#[derive(Clone, Debug)]
pub(super) struct LiftSpec {
    /// Its name, that of its model.
    pub(super) name: String,
    pub(super) cabin_joint: JointName,
    /// Height of the cabin where its joint is at zero \[m\].
    pub(super) base_m: f64,
    pub(super) cabin: Option<CabinBox>,
    pub(super) stops: Vec<LiftStop>,
    /// Index of the stop at the start.
    pub(super) first: usize,
    pub(super) limits: MotionLimits,
    pub(super) tolerance: f64,
}

/// Stop of a lift.
#[derive(Clone, Debug)]
pub(super) struct LiftStop {
    pub(super) floor: BuildingFloor,
    /// Indices of its doors in the plan.
    pub(super) doors: Vec<usize>,
}

/// Component of a model with its position in the file.
struct Component<'a> {
    element: &'a Element,
    site: &'a PluginSite<'a>,
    root: &'a Model,
}

/// Reads the components of models. Invalid ones are reported and omitted.
pub(super) fn read(
    world: &World,
    models: &[&Model],
    diagnostics: &mut Diagnostics,
) -> BuildingPlan {
    let mut plan = BuildingPlan::default();
    let mut lifts = Vec::new();
    for &root in models {
        let sites = model_sites(world, root);
        for site in &sites {
            let plugin = interpret(site.plugin, &site.context, &mut Diagnostics::new());
            if plugin.is_none_or(|plugin| plugin.known.id != "register_component") {
                continue;
            }
            for element in site.plugin.content.iter().filter(|it| it.name == "component") {
                let component = Component { element, site, root };
                match element.value("name") {
                    Some("Door") => match component.door() {
                        Ok(door) => plan.doors.push(door),
                        Err(why) => component.refuse(&why, diagnostics),
                    },
                    Some("Lift") => match component.lift() {
                        Ok(lift) => lifts.push((lift, element.origin)),
                        Err(why) => component.refuse(&why, diagnostics),
                    },
                    _ => {}
                }
            }
        }
    }
    for ((mut lift, doors), origin) in lifts {
        for (stop, names) in lift.stops.iter_mut().zip(doors) {
            for name in names {
                match plan.doors.iter().position(|door| door.name == name) {
                    Some(door) => stop.doors.push(door),
                    None => diagnostics.push(unknown_door(&lift.name, &name, origin)),
                }
            }
        }
        plan.lifts.push(lift);
    }
    plan
}

fn unknown_door(lift: &str, door: &str, origin: Origin) -> Diagnostic {
    let message = format!("the lift `{lift}` names the door `{door}`, which does not exist");
    Diagnostic::error("lift-door-missing", message)
        .at(origin)
        .note("the lift runs without it")
        .help("the name of a door is that of its model, which needs a component `Door`")
}

impl Component<'_> {
    fn refuse(&self, why: &str, diagnostics: &mut Diagnostics) {
        let name = self.element.value("name").unwrap_or_default();
        let message = format!("the component `{name}` of `{}` does nothing: {why}", self.name());
        diagnostics.push(Diagnostic::error("component-refused", message).at(self.element.origin));
    }

    /// Model of the plugin.
    fn model(&self) -> &Model {
        self.site.context.model.unwrap_or(self.root)
    }

    fn name(&self) -> &str {
        &self.model().name
    }

    /// Number of a child element.
    fn number(&self, name: &str, default: f64) -> Result<f64, String> {
        let Some(child) = self.element.child(name) else { return Ok(default) };
        let text = child.text();
        let number = text.parse::<f64>().ok().filter(|it| it.is_finite() && *it >= 0.0);
        number.ok_or_else(|| {
            format!("`<{name}>` must be a number that is not negative, not `{text}`")
        })
    }

    fn limits(&self, part: &str) -> Result<(MotionLimits, f64), String> {
        let limits = MotionLimits {
            speed: self.number(&format!("v_max_{part}"), 0.2)?,
            acceleration: self.number(&format!("a_nom_{part}"), 0.08)?,
            max_acceleration: self.number(&format!("a_max_{part}"), 0.2)?,
        };
        Ok((limits, self.number(&format!("dx_min_{part}"), 0.01)?))
    }

    /// Joint of the model, or of the outermost model, by its name.
    fn joint(&self, name: &str) -> Result<(JointName, &Axis), String> {
        let scope = scope_of(self.root, self.model()).unwrap_or_default();
        let own = self.model().joint(name).map(|joint| (joint, format!("{scope}{name}")));
        let found = own.or_else(|| self.root.joint(name).map(|joint| (joint, name.to_owned())));
        let Some((joint, scoped)) = found else {
            return Err(format!("there is no joint `{name}` in its model"));
        };
        let axis = joint.axis.as_ref().ok_or_else(|| format!("the joint `{name}` is fixed"))?;
        Ok((JointName { model: self.root.name.clone(), joint: scoped }, axis))
    }

    fn door(&self) -> Result<DoorSpec, String> {
        let joints = self.element.child("door").ok_or("it has no `<door>`")?;
        let mut leaves = Vec::new();
        for (attribute, is_left) in [("right_joint_name", false), ("left_joint_name", true)] {
            let name = joints.value(attribute).unwrap_or_default();
            if name.is_empty() || name == NO_JOINT {
                continue;
            }
            let (joint, axis) = self.joint(name)?;
            if !(axis.lower.is_finite() && axis.upper.is_finite()) {
                return Err(format!(
                    "the joint `{name}` needs limits: where it is closed and open"
                ));
            }
            let (low, high) = (axis.lower, axis.upper);
            let (closed, open) = if is_left { (high, low) } else { (low, high) };
            leaves.push(LeafSpec { joint, closed, open });
        }
        if leaves.is_empty() {
            return Err("it needs a `left_joint_name` or a `right_joint_name`".into());
        }
        let (limits, tolerance) = self.limits("door")?;
        let on_topics = self.element.child("ros_interface").map(|it| it.text().into_owned());
        let is_on_topics = matches!(on_topics.as_deref(), Some("true" | "1"));
        Ok(DoorSpec { name: self.name().to_owned(), leaves, limits, tolerance, is_on_topics })
    }

    /// The lift, and the names of the doors of each stop.
    fn lift(&self) -> Result<(LiftSpec, Vec<Vec<String>>), String> {
        let joint =
            self.element.child("cabin_joint_name").ok_or("it has no `<cabin_joint_name>`")?;
        let (cabin_joint, _) = self.joint(&joint.text())?;
        let (mut stops, mut doors) = (Vec::new(), Vec::new());
        for floor in self.element.named("floor") {
            let name = floor.value("name").filter(|name| !name.is_empty());
            let name = name.ok_or("a `<floor>` has no `name`")?;
            let elevation = floor.value("elevation").and_then(|text| text.trim().parse().ok());
            let elevation_m = elevation
                .filter(|it: &f64| it.is_finite())
                .ok_or_else(|| format!("the floor `{name}` has no `elevation` in metres"))?;
            let floor_doors = floor.named("door_pair").flat_map(|pair| {
                ["cabin_door", "shaft_door"].into_iter().filter_map(|it| pair.value(it))
            });
            doors.push(floor_doors.map(str::to_owned).collect());
            let floor = BuildingFloor { name: name.to_owned(), elevation_m };
            stops.push(LiftStop { floor, doors: Vec::new() });
        }
        if stops.is_empty() {
            return Err("it has no `<floor>`".into());
        }
        let initial = self.element.child("initial_floor").map(|it| it.text());
        let first = initial.and_then(|name| stops.iter().position(|it| it.floor.name == *name));
        let (limits, tolerance) = self.limits("cabin")?;
        let lift = LiftSpec {
            name: self.name().to_owned(),
            cabin_joint,
            base_m: self.root.parent_from_model.translation.z,
            cabin: CabinBox::of(self.model()),
            stops,
            first: first.unwrap_or_default(),
            limits,
            tolerance,
        };
        Ok((lift, doors))
    }
}

/// Prefix of names of a nested model in the outermost one; empty for that itself.
fn scope_of(root: &Model, model: &Model) -> Option<String> {
    if std::ptr::eq(root, model) {
        return Some(String::new());
    }
    root.models.iter().find_map(|nested| {
        let inner = scope_of(nested, model)?;
        Some(format!("{}::{inner}", nested.name))
    })
}
