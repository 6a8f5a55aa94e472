//! Plugins of Open-RMF's simulations: `rmf_building_sim_gz_plugins` and `rmf_robot_sim_gz_plugins` of
//! `rmf_simulation` 2.4.

use periplus_params::{choice, flag, group, number, text};

use super::system;
use crate::PluginSpec;
use crate::known::{listens, publishes};

pub(super) static PLUGINS: &[PluginSpec] = &[
    system!(
        "register_component",
        ["register_component"],
        Effect,
        Simulated,
        "Makes a model a door or a lift, and gives a world chargers.",
        [group(
            "component",
            "`Door` with its joints, `Lift` with its floors and doors, or `Chargers`.",
        )
        .repeated()]
    ),
    system!("door", ["door"], World, BuiltIn, "Moves the doors of a world.", [])
        .topics(&[listens("/door_requests"), publishes("/door_states")]),
    system!("lift", ["lift"], World, BuiltIn, "Moves the lifts of a world.", [])
        .topics(&[listens("/lift_requests"), publishes("/lift_states")]),
    system!(
        "slotcar",
        ["slotcar"],
        Drive,
        Simulated,
        "Drives a robot along the paths of a fleet adapter.",
        [
            choice("steering", &["diff_drive", "ackermann"], "Steering.").or("diff_drive"),
            number("nominal_drive_speed", "m/s", "Speed.").or("0.5").above(0.0),
            number("nominal_drive_acceleration", "m/s^2", "Acceleration.").or("0.05").above(0.0),
            number("max_drive_acceleration", "m/s^2", "Largest deceleration.").or("0.1").above(0.0),
            number("nominal_turn_speed", "rad/s", "Turn rate.").or("0.3927").above(0.0),
            number("nominal_turn_acceleration", "rad/s^2", "Acceleration of turns.")
                .or("0.3142")
                .above(0.0),
            number("max_turn_acceleration", "rad/s^2", "Largest deceleration of turns.")
                .or("3.1416")
                .above(0.0),
            number("min_turning_radius", "m", "Radius of turns with Ackermann steering."),
            number("turning_right_angle_mul_offset", "", "Factor of that radius.").or("1"),
            number("tire_radius", "m", "Radius of the wheels; not used.").or("0.1"),
            number("base_width", "m", "Distance of the wheels; not used.").or("0.52"),
            number("stop_distance", "m", "Distance ahead at which others stop the robot.")
                .or("1")
                .min(0.0),
            number("stop_radius", "m", "Radius there.").or("1").min(0.0),
            flag("reversible", "If true, the robot drives backwards, too.").or("true"),
            number("nominal_voltage", "V", "Voltage of the battery.").or("12").above(0.0),
            number("nominal_capacity", "A h", "Capacity of the battery.").or("24").above(0.0),
            number("charging_current", "A", "Current at a charger.").or("2").min(0.0),
            number("mass", "kg", "Mass, for the battery.").or("20").min(0.0),
            number("inertia", "kg m^2", "Inertia about the vertical axis, for the battery.")
                .or("10")
                .min(0.0),
            number("friction_coefficient", "", "Rolling friction, for the battery.")
                .or("0.3")
                .min(0.0),
            number("nominal_power", "W", "Power of the electronics.").or("10").min(0.0),
            text("charger_waypoint", "Name of a charger; not used."),
        ]
    )
    // All slotcars publish on `/robot_state`.
    .topics(&[
        listens("/robot_path_requests"),
        listens("/robot_pause_requests"),
        listens("/robot_mode_requests"),
    ])
    .open(),
    system!(
        "readonly",
        ["readonly"],
        State,
        Kept,
        "Reports the path of a robot that others drive.",
        []
    )
    .open(),
    system!(
        "TeleportDispenser",
        ["teleport_dispenser"],
        Effect,
        Kept,
        "Puts an object on a robot.",
        []
    )
    .open(),
    system!(
        "TeleportIngestor",
        ["teleport_ingestor"],
        Effect,
        Kept,
        "Takes an object from a robot.",
        []
    )
    .open(),
    system!("crowd_simulator", ["crowd_simulation"], World, Kept, "Moves people by Menge.", [])
        .open(),
];
