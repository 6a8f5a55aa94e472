//! Plugins that come with Gazebo Classic 11 itself.

use periplus_params::{NamedEntity, Parameter, Table, group, number, text};

use crate::{Family, PluginSpec, Role, Support};

const fn classic(
    id: &'static str,
    role: Role,
    doc: &'static str,
    parameters: &'static [Parameter],
) -> PluginSpec {
    let table = Table { name: id, doc, parameters };
    PluginSpec::new(Family::Classic, id, role, Support::Kept, table)
}

const fn joint(name: &'static str) -> Parameter {
    text(name, "The joint of a wheel.").required().naming(NamedEntity::Joint)
}

pub(super) static PLUGINS: &[PluginSpec] = &[
    classic(
        "DiffDrivePlugin",
        Role::Drive,
        "Drives wheels on the left and on the right by Gazebo topics.",
        &[
            joint("left_joint"),
            joint("right_joint"),
            number("torque", "N m", "Maximum torque of a wheel.").min(0.0),
        ],
    ),
    classic(
        "SkidSteerDrivePlugin",
        Role::Drive,
        "Drives two wheels on the left and two on the right by Gazebo topics.",
        &[
            joint("left_front"),
            joint("left_rear"),
            joint("right_front"),
            joint("right_rear"),
            number("MaxForce", "N m", "Maximum torque of a wheel.").min(0.0),
        ],
    ),
    classic(
        "JointControlPlugin",
        Role::Control,
        "Drives joints by gains and targets.",
        &[group("controller", "A joint, its target and its gains.").repeated()],
    ),
    classic("ContactPlugin", Role::Sensor, "An example that prints contacts.", &[]).open(),
    classic("RayPlugin", Role::Sensor, "An example that reads a `ray` sensor.", &[]).open(),
    classic("GpuRayPlugin", Role::Sensor, "An example that reads a `gpu_ray` sensor.", &[]).open(),
    classic("CameraPlugin", Role::Sensor, "An example that reads a `camera` sensor.", &[]).open(),
    classic("DepthCameraPlugin", Role::Sensor, "An example that reads a `depth` sensor.", &[])
        .open(),
    classic("RaySensorNoisePlugin", Role::Sensor, "Adds noise to a `ray` sensor.", &[]).open(),
    classic("ImuSensorPlugin", Role::Sensor, "An example that reads an `imu` sensor.", &[]).open(),
    classic("PressurePlugin", Role::Sensor, "Publishes pressures of contacts.", &[]).open(),
    classic("ReflectancePlugin", Role::Sensor, "Gives a visual a map of reflectances.", &[]).open(),
    classic("SonarPlugin", Role::Sensor, "An example that reads a `sonar` sensor.", &[]).open(),
    classic("TouchPlugin", Role::Sensor, "Publishes a message on contact.", &[]).open(),
    classic("LinearBatteryPlugin", Role::Effect, "Drains a battery.", &[]).open(),
    classic("LiftDragPlugin", Role::Effect, "Simulates lift and drag of a link.", &[]).open(),
    classic("BuoyancyPlugin", Role::Effect, "Simulates buoyancy of links.", &[]).open(),
    classic("WindPlugin", Role::Effect, "Simulates wind.", &[]).open(),
    classic("WheelSlipPlugin", Role::Effect, "Simulates wheel slip.", &[]).open(),
    classic("WheelTrackedVehiclePlugin", Role::Drive, "Drives tracks made of wheels.", &[]).open(),
    classic("SimpleTrackedVehiclePlugin", Role::Drive, "Drives tracks.", &[]).open(),
    classic("TrackedVehiclePlugin", Role::Drive, "Drives tracks.", &[]).open(),
    classic("CartDemoPlugin", Role::Drive, "An example that drives a cart.", &[]).open(),
    classic("VehiclePlugin", Role::Drive, "Drives a car by Gazebo topics.", &[]).open(),
    classic("GimbalSmall2dPlugin", Role::Control, "Turns a gimbal.", &[]).open(),
    classic("JointTrajectoryPlugin", Role::Control, "An example that moves joints.", &[]).open(),
    classic("InitialVelocityPlugin", Role::Effect, "Starts links in motion.", &[]).open(),
    classic("PlaneDemoPlugin", Role::Effect, "Flies an example plane.", &[]).open(),
    classic("CessnaPlugin", Role::Control, "Flies a Cessna.", &[]).open(),
    classic("ActorPlugin", Role::Effect, "Makes an actor wander.", &[]).open(),
    classic(
        "FollowerPlugin",
        Role::Drive,
        "Follows an object in the image of a `depth` sensor.",
        &[],
    )
    .open(),
    classic("RandomVelocityPlugin", Role::Effect, "Moves a link at random.", &[]).open(),
    classic("ElevatorPlugin", Role::Effect, "Drives an elevator.", &[]).open(),
    classic("HarnessPlugin", Role::Effect, "Lowers a model on a rope.", &[]).open(),
    classic("TransporterPlugin", Role::Effect, "Teleports models between pads.", &[]).open(),
    classic("BreakableJointPlugin", Role::Effect, "Breaks a joint under load.", &[]).open(),
    classic("AttachLightPlugin", Role::Effect, "Fixes a light to a link.", &[]).open(),
    classic("BlinkVisualPlugin", Role::Effect, "Makes a visual blink.", &[]).open(),
    classic("FlashLightPlugin", Role::Effect, "Makes lights flash.", &[]).open(),
    classic("LedPlugin", Role::Effect, "Makes visuals flash.", &[]).open(),
    classic("HydraDemoPlugin", Role::Control, "Moves a model by a Razer Hydra.", &[]).open(),
    classic("KeysToJointsPlugin", Role::Control, "Moves joints by keys.", &[]).open(),
    classic("KeysToCmdVelPlugin", Role::Control, "Drives by keys.", &[]).open(),
    classic("SimEventsPlugin", Role::World, "Publishes events in regions.", &[]).open(),
    classic("StopWorldPlugin", Role::World, "Stops the simulation.", &[]).open(),
    classic("MudPlugin", Role::Effect, "Adds drag to models in mud.", &[]).open(),
    classic("VariableGearboxPlugin", Role::Effect, "Varies a gear's ratio.", &[]).open(),
    classic("ArduCopterPlugin", Role::Control, "Flies with ArduPilot.", &[]).open(),
    classic("ArrangePlugin", Role::World, "Arranges models.", &[]).open(),
    classic("StaticMapPlugin", Role::World, "Shows a map as the floor.", &[]).open(),
    classic("RubblePlugin", Role::World, "Strews rubble.", &[]).open(),
    classic("MisalignmentPlugin", Role::State, "Publishes the alignment of two frames.", &[])
        .open(),
    classic("JointEventSource", Role::World, "Publishes a message when joints move.", &[]).open(),
];
