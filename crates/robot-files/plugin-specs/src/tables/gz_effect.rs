//! Systems of current Gazebo that act on bodies.

use periplus_params::{NamedEntity, Parameter, flag, group, integer, number, numbers, text};

use super::system;
use crate::PluginSpec;

const fn link(name: &'static str, doc: &'static str) -> Parameter {
    text(name, doc).naming(NamedEntity::Link)
}

const fn topic(name: &'static str, doc: &'static str) -> Parameter {
    text(name, doc).naming(NamedEntity::Topic)
}

const fn damping(name: &'static str) -> Parameter {
    number(name, "", "Coefficient of added mass or damping, named after the axes.").or("0")
}

pub(super) static PLUGINS: &[PluginSpec] = &[
    system!(
        "gz-sim-detachable-joint-system",
        ["DetachableJoint"],
        Effect,
        Simulated,
        "Attaches two models until a message detaches them.",
        [
            link("parent_link", "The link of this model.").required(),
            text("child_model", "The other model.").required(),
            text("child_link", "The link of the other model.").required(),
            topic("topic", "Older name of `detach_topic`."),
            topic("detach_topic", "Topic that detaches."),
            topic("attach_topic", "Topic that attaches again."),
            topic("output_topic", "Topic of the state."),
            text("suppress_child_warning", "If true, a missing model is ignored."),
        ]
    ),
    system!(
        "gz-sim-wheel-slip-system",
        ["WheelSlip"],
        Effect,
        Kept,
        "Simulates wheel slip in proportion to the load.",
        [group("wheel", "A wheel's link, radius, load and compliances.").repeated()]
    ),
    system!(
        "gz-sim-thruster-system",
        ["Thruster"],
        Effect,
        Kept,
        "Pushes a boat by a propeller.",
        [
            text("namespace", "Prefix of the topics."),
            topic("topic", "Topic of commands."),
            text("joint_name", "The propeller's joint.").required().naming(NamedEntity::Joint),
            flag("use_angvel_cmd", "If true, commands are speeds instead of thrusts.").or("false"),
            number("fluid_density", "kg/m^3", "Density of the water.").or("1000").above(0.0),
            number("propeller_diameter", "m", "Diameter.").or("0.02").above(0.0),
            number("thrust_coefficient", "", "Thrust against speed.").or("1"),
            flag("velocity_control", "If true, the joint turns without gains.").or("false"),
            number("p_gain", "", "Gain of the controller.").or("0.1"),
            number("i_gain", "", "Gain of the controller.").or("0"),
            number("d_gain", "", "Gain of the controller.").or("0"),
            number("max_thrust_cmd", "N", "Maximum thrust.").or("1000"),
            number("min_thrust_cmd", "N", "Minimum thrust.").or("-1000"),
            number("wake_fraction", "", "Fraction of the speed that the hull takes.").or("0.2"),
            number("alpha_1", "", "Constant part of the thrust coefficient.").or("1"),
            number("alpha_2", "", "Part of the coefficient that grows with the advance ratio.")
                .or("0"),
            number("deadband", "N", "Commands below are ignored.").or("0").min(0.0),
        ]
    ),
    system!(
        "gz-sim-buoyancy-system",
        ["Buoyancy"],
        Effect,
        Kept,
        "Simulates buoyancy of links.",
        [
            number("uniform_fluid_density", "kg/m^3", "Density of the water everywhere.")
                .or("1000"),
            group("graded_buoyancy", "Densities by height."),
            text("enable", "A model that floats (default: all).").repeated(),
        ]
    ),
    system!(
        "gz-sim-buoyancy-engine-system",
        ["BuoyancyEngine"],
        Effect,
        Kept,
        "Pumps a bladder to rise or sink.",
        [
            link("link_name", "The bladder's link.").required(),
            text("namespace", "Prefix of the topics."),
            number("min_volume", "m^3", "Minimum.").or("0.00003"),
            number("neutral_volume", "m^3", "Volume at which the model is neutral.").or("0.0003"),
            number("default_volume", "m^3", "Initial value.").or("0.0003"),
            number("max_volume", "m^3", "Maximum.").or("0.00099"),
            number("max_inflation_rate", "m^3/s", "Maximum rate of change.").or("0.000003"),
            number("fluid_density", "kg/m^3", "Density of the water.").or("1000"),
            number("surface", "m", "Height of the surface."),
        ]
    ),
    system!(
        "gz-sim-hydrodynamics-system",
        ["Hydrodynamics"],
        Effect,
        Kept,
        "Simulates hydrodynamic drag of a link.",
        [
            link("link_name", "The link.").required(),
            text("namespace", "Prefix of the topics."),
            number("water_density", "kg/m^3", "Density of the water.").or("998"),
            numbers("default_current", "m/s", "Current of the water.").or("0 0 0"),
            flag("disable_coriolis", "If true, Coriolis forces are left out.").or("false"),
            flag("disable_added_mass", "If true, added mass is left out.").or("false"),
            text("lookup_current_x", "Column of the current."),
            text("lookup_current_y", "Column of the current."),
            text("lookup_current_z", "Column of the current."),
            damping("xDotU"),
            damping("yDotV"),
            damping("zDotW"),
            damping("kDotP"),
            damping("mDotQ"),
            damping("nDotR"),
            damping("xU"),
            damping("xUU"),
            damping("xUabsU"),
            damping("yV"),
            damping("yVV"),
            damping("yVabsV"),
            damping("zW"),
            damping("zWW"),
            damping("zWabsW"),
            damping("kP"),
            damping("kPP"),
            damping("kPabsP"),
            damping("mQ"),
            damping("mQQ"),
            damping("mQabsQ"),
            damping("nR"),
            damping("nRR"),
            damping("nRabsR"),
        ]
    )
    .open(),
    system!(
        "gz-sim-lift-drag-system",
        ["LiftDrag"],
        Effect,
        Kept,
        "Simulates lift and drag of a link.",
        [
            link("link_name", "The link.").required(),
            number("air_density", "kg/m^3", "Density of the air or water.").or("1.2041"),
            number("area", "m^2", "Area of the wing.").or("1"),
            number("a0", "rad", "Angle without lift.").or("0"),
            number("cla", "1/rad", "Slope of the lift.").or("1"),
            number("cda", "1/rad", "Slope of the drag.").or("0.01"),
            number("cma", "1/rad", "Slope of the moment.").or("0"),
            number("cla_stall", "1/rad", "Slope of the lift after the stall.").or("0"),
            number("cda_stall", "1/rad", "Slope of the drag after the stall.").or("1"),
            number("cma_stall", "1/rad", "Slope of the moment after the stall.").or("0"),
            number("alpha_stall", "rad", "Angle of the stall.").or("1.570796"),
            numbers("cp", "m", "Point at which the forces act.").or("0 0 0"),
            numbers("forward", "", "Direction of flight.").or("1 0 0"),
            numbers("upward", "", "Direction of lift.").or("0 0 1"),
            flag("radial_symmetry", "If true, the upward direction follows the flow.").or("false"),
            text("control_joint_name", "The joint of the flap.").naming(NamedEntity::Joint),
            number("control_joint_rad_to_cl", "1/rad", "Lift of the flap.").or("1"),
            number("cm_delta", "", "Moment of the flap.").or("0"),
        ]
    ),
    system!(
        "gz-sim-advanced-lift-drag-system",
        ["AdvancedLiftDrag"],
        Effect,
        Kept,
        "Simulates lift and drag of an aircraft from stability derivatives.",
        []
    )
    .open(),
    system!(
        "gz-sim-linearbatteryplugin-system",
        ["LinearBatteryPlugin"],
        Effect,
        Kept,
        "Drains and charges a battery.",
        [
            text("battery_name", "Name of the battery.").required(),
            number("voltage", "V", "Initial value.").required(),
            number("open_circuit_voltage_constant_coef", "V", "Voltage when full."),
            number("open_circuit_voltage_linear_coef", "V", "Voltage lost until empty."),
            number("initial_charge", "A h", "Initial charge (default: full).").min(0.0),
            number("capacity", "A h", "Capacity when full.").min(0.0),
            number("resistance", "ohm", "Internal resistance.").min(0.0),
            number("smooth_current_tau", "s", "Time constant of the smoothed current.").above(0.0),
            flag("fix_issue_225", "If true, charge is counted in hours."),
            number("power_load", "W", "Drawn all the time.").min(0.0),
            flag("start_draining", "If true, it drains from the start.").or("false"),
            flag("start_on_motion", "If true, it drains from the first motion.").or("false"),
            topic("power_draining_topic", "Topic that starts it.").repeated(),
            topic("stop_power_draining_topic", "Topic that stops it.").repeated(),
            flag("enable_recharge", "If true, it can be charged.").or("false"),
            flag("recharge_by_topic", "If true, charging is by topic instead of service.")
                .or("false"),
            number("charging_time", "h", "Time from empty to full.").above(0.0),
            number("soc_rate", "Hz", "Messages per second.").min(0.0),
            number("soc_threshold", "", "Charge fraction at which drones return.").within(0.0, 1.0),
            flag("invert_current_sign", "If true, a drawn current is negative.").or("false"),
        ]
    ),
    system!(
        "gz-sim-wind-effects-system",
        ["WindEffects"],
        Effect,
        Kept,
        "Applies wind forces to links.",
        [
            group("horizontal", "Strength and direction of gusts."),
            group("vertical", "Rising and sinking gusts."),
            text("force_approximation_scaling_factor", "Force per mass and speed."),
        ]
    ),
    system!(
        "gz-sim-apply-link-wrench-system",
        ["ApplyLinkWrench"],
        Effect,
        Simulated,
        "Applies forces to links.",
        [
            group("persistent", "A force that acts from the start.").repeated(),
            flag("verbose", "If true, it logs its activity.").or("true"),
        ]
    ),
    system!(
        "gz-sim-particle-emitter-system",
        ["ParticleEmitter"],
        Effect,
        Kept,
        "Runs emitters of smoke and dust.",
        [flag("allow_renaming", "If true, a name in use is changed.").or("false")]
    ),
    system!(
        "gz-sim-particle-emitter2-system",
        ["ParticleEmitter2"],
        Effect,
        Kept,
        "Older emitters.",
        []
    )
    .open(),
    system!(
        "gz-sim-follow-actor-system",
        ["FollowActor"],
        Effect,
        Kept,
        "Makes an actor follow a model.",
        [
            text("target", "The model.").required(),
            number("min_distance", "m", "Distance at which it stops.").or("1.2"),
            number("max_distance", "m", "Distance beyond which it stops following.").or("4"),
            number("velocity", "m/s", "Walking speed.").or("0.8"),
            text("animation", "Walking speed."),
            number("animation_x_vel", "m/s", "Speed that fits the animation.").or("2"),
        ]
    ),
    system!(
        "gz-sim-elevator-system",
        ["Elevator"],
        Effect,
        Kept,
        "Drives an elevator to a floor.",
        [
            number("update_rate", "Hz", "Gain of the controller.").or("10"),
            text("floor_link_prefix", "Prefix of the names of floors.").or("floor_"),
            text("door_joint_prefix", "Prefix of the names of doors.").or("door_"),
            text("cabin_joint", "Joint of the lift.").or("lift").naming(NamedEntity::Joint),
            topic("cmd_topic", "Topic of commands."),
            topic("state_topic", "Topic of the state."),
            number("state_publish_rate", "Hz", "Rate of the published state.").or("5"),
            number("open_door_wait_duration", "s", "Time for which doors stay open.").or("5"),
        ]
    ),
    system!(
        "gz-sim-lookup-wheel-slip-system",
        ["LookupWheelSlip"],
        Effect,
        Kept,
        "Simulates wheel slip from a map of the floor.",
        []
    )
    .open(),
    system!(
        "gz-sim-dynamic-detachable-joint-system",
        ["DynamicDetachableJoint"],
        Effect,
        Kept,
        "Attaches and detaches models on command.",
        []
    )
    .open(),
    system!(
        "gz-sim-spacecraft-thruster-model-system",
        ["SpacecraftThrusterModel"],
        Effect,
        Kept,
        "Pushes a spacecraft.",
        []
    )
    .open(),
    system!(
        "gz-sim-lens-flare-system",
        ["LensFlare"],
        Effect,
        Kept,
        "Adds lens flares to a camera.",
        [
            number("scale", "", "Scale.").or("1"),
            numbers("color", "", "Red, green, blue.").or("1.4 1.2 1"),
            integer("occlusion_steps", "Number of steps of the occlusion test.").or("10"),
            text("light_name", "The light."),
        ]
    ),
];
