//! Robots that do not follow their commands, with the reasons.

/// Part of the robot's name in the table, part of the fault or end of that name, and the reason.
pub(crate) type Known = (&'static str, &'static str, &'static str);

pub(crate) const KNOWN: &[Known] = &[
    (
        "gazebo_models/pioneer",
        "",
        "its drive is Gazebo Classic's own and listens to Gazebo's transport, not to ROS",
    ),
    ("set_model_state_test_p2dx", "", "the same pioneer2dx"),
    ("conveyor.sdf::conveyor", "", "a belt, not a robot; it takes no Twist and is not run yet"),
    (
        "_effort.xacro.urdf::",
        "(Kinematic)",
        "its controller commands efforts, which have no effect without physics",
    ),
    (
        "tunnel.sdf::vehicle (Rigid)",
        "falls",
        "the tunnel is fetched from Fuel; without it there is nothing to stand on",
    ),
    (
        "/model-1_4",
        "stood",
        "in SDF 1.4 an axis is in the model's frame, so these wheels turn about the vertical; the \
         same text as 1.8 drives",
    ),
];

/// The reason for a fault of a robot, if it is known.
pub(crate) fn reason(robot: &str, fault: &str) -> Option<Known> {
    let fits = |who: &str, what: &str| {
        robot.contains(who) && (fault.contains(what) || !what.is_empty() && robot.ends_with(what))
    };
    KNOWN.iter().find(|(who, what, _)| fits(who, what)).copied()
}
