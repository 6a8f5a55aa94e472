//! `tf static`.

use std::time::Duration;

use periplus_geometry::{DQuat, Rpy, quaternion_from_rpy};
use periplus_graph::{NodeSettings, Qos};
use periplus_msgs::builtin_interfaces::Time;
use periplus_msgs::geometry_msgs::{Quaternion, Transform, TransformStamped, Vector3};
use periplus_msgs::std_msgs::Header;
use periplus_msgs::tf2_msgs::TFMessage;
use periplus_os::{sleep, unix_ns};

use crate::failure::endless;
use crate::{Failure, Outcome, Session};

/// Polling period of the interrupt flag.
const POLL_PERIOD: Duration = Duration::from_millis(20);

/// Static transform.
#[derive(Clone, Debug, PartialEq)]
pub struct Broadcast {
    /// Parent frame.
    pub parent: String,
    /// Child frame.
    pub child: String,
    /// Origin of the child in the parent \[m\].
    pub translation: [f64; 3],
    /// Orientation of the child in the parent: x, y, z, w.
    pub rotation: [f64; 4],
}

/// Parses the arguments of `static_transform_publisher`: `--x 1 --yaw 0.5 --frame-id a
/// --child-frame-id b`, or the deprecated forms `x y z yaw pitch roll a b` and `x y z qx qy qz qw a
/// b`.
///
/// # Errors
/// A usage error that names the argument.
pub fn read_broadcast(words: &[String]) -> Outcome<Broadcast> {
    let usage = |wrong: String| Failure::Usage(wrong);
    let mut given: Vec<(&str, f64)> = Vec::new();
    let (mut parent, mut child) = (None, None);
    let mut plain: Vec<&str> = Vec::new();
    let mut rest = words.iter().map(String::as_str);
    while let Some(word) = rest.next() {
        let Some(name) = word.strip_prefix("--") else {
            plain.push(word);
            continue;
        };
        let mut value = || rest.next().ok_or_else(|| usage(format!("`{word}` needs a value")));
        match name {
            "x" | "y" | "z" | "qx" | "qy" | "qz" | "qw" | "roll" | "pitch" | "yaw" => {
                given.push((name, number(word, value()?)?));
            }
            "frame-id" => parent = Some(value()?),
            "child-frame-id" => child = Some(value()?),
            _ => return Err(usage(format!("unknown option `{word}`"))),
        }
    }
    let names: &[&str] = match plain.len() {
        0 => &[],
        8 => &["x", "y", "z", "yaw", "pitch", "roll"],
        9 => &["x", "y", "z", "qx", "qy", "qz", "qw"],
        count => {
            return Err(usage(format!(
                "got {count} positional arguments; give `--frame-id PARENT --child-frame-id \
                 CHILD --x X --y Y --z Z --yaw YAW`, or `X Y Z YAW PITCH ROLL PARENT CHILD`"
            )));
        }
    };
    if !names.is_empty() {
        if !given.is_empty() || parent.is_some() || child.is_some() {
            return Err(usage("use either options or positional arguments, not both".into()));
        }
        for (name, word) in names.iter().zip(&plain) {
            given.push((name, number(name, word)?));
        }
        (parent, child) = (plain.get(names.len()).copied(), plain.last().copied());
    }
    let (Some(parent), Some(child)) = (parent, child) else {
        return Err(usage("give both frames: `--frame-id PARENT --child-frame-id CHILD`".into()));
    };
    if parent.is_empty() || child.is_empty() || parent == child {
        return Err(usage("the frames must have different, non-empty names".into()));
    }
    let has = |names: &[&str]| given.iter().any(|(name, _)| names.contains(name));
    if has(&["qx", "qy", "qz", "qw"]) && has(&["roll", "pitch", "yaw"]) {
        return Err(usage("give the rotation as angles or as a quaternion, not both".into()));
    }
    let get = |name: &str, usual: f64| {
        given.iter().rev().find(|(given, _)| *given == name).map_or(usual, |(_, value)| *value)
    };
    let rotation = if has(&["qx", "qy", "qz", "qw"]) {
        [get("qx", 0.0), get("qy", 0.0), get("qz", 0.0), get("qw", 1.0)]
    } else {
        let rpy = Rpy { roll: get("roll", 0.0), pitch: get("pitch", 0.0), yaw: get("yaw", 0.0) };
        quaternion_from_rpy(rpy).to_array()
    };
    let length = DQuat::from_array(rotation).length();
    if (length * length - 1.0).abs() >= 0.01 {
        return Err(usage(format!(
            "the quaternion {rotation:?} has length {length:.3}; it must be 1, or tf2 drops it"
        )));
    }
    Ok(Broadcast {
        parent: parent.to_owned(),
        child: child.to_owned(),
        translation: [get("x", 0.0), get("y", 0.0), get("z", 0.0)],
        rotation,
    })
}

fn number(name: &str, word: &str) -> Outcome<f64> {
    let number = word.parse::<f64>().ok().filter(|number| number.is_finite());
    number.ok_or_else(|| Failure::Usage(format!("`{name}` takes a number, not `{word}`")))
}

/// Publishes a static transform until interrupted, also to late subscribers.
///
/// # Errors
/// When the name of the node is invalid.
pub fn broadcast(session: &mut Session<'_>, broadcast: &Broadcast) -> Outcome {
    let graph = session.network.graph();
    let node = graph.node(NodeSettings::new("static_transform_publisher"))?;
    let publisher = node.publisher::<TFMessage>("/tf_static", Qos::latched(1))?;
    let ([x, y, z], [qx, qy, qz, qw]) = (broadcast.translation, broadcast.rotation);
    publisher.publish(TFMessage {
        transforms: vec![TransformStamped {
            header: Header { stamp: Time::of_ns(unix_ns()), frame_id: broadcast.parent.clone() },
            child_frame_id: broadcast.child.clone(),
            transform: Transform {
                translation: Vector3 { x, y, z },
                rotation: Quaternion { x: qx, y: qy, z: qz, w: qw },
            },
        }],
    });
    session.say(&format!(
        "Spinning until stopped - publishing transform\ntranslation: ('{x:.6}', '{y:.6}', \
         '{z:.6}')\nrotation: ('{qx:.6}', '{qy:.6}', '{qz:.6}', '{qw:.6}')\nfrom '{}' to '{}'",
        broadcast.parent, broadcast.child
    ));
    endless(wait(session))
}

fn wait(session: &Session<'_>) -> Outcome {
    loop {
        session.check_interrupted()?;
        sleep(POLL_PERIOD);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(words: &str) -> Outcome<Broadcast> {
        let words: Vec<String> = words.split_whitespace().map(str::to_owned).collect();
        read_broadcast(&words)
    }

    #[test]
    fn all_three_forms_say_the_same() {
        let named = read("--x 1 --z 0.5 --qz 1 --qw 0 --frame-id a --child-frame-id b").unwrap();
        assert_eq!((named.translation, named.rotation), ([1.0, 0.0, 0.5], [0.0, 0.0, 1.0, 0.0]));
        assert_eq!(read("1 0 0.5 0 0 1 0 a b").unwrap(), named);
        let turned = read("1 0 0.5 3.141592653589793 0 0 a b").unwrap();
        assert!((turned.rotation[2] - 1.0).abs() < 1e-12);
    }

    #[test]
    fn what_makes_no_sense_is_told() {
        for wrong in [
            "--x 1",
            "--x",
            "--x one --frame-id a --child-frame-id b",
            "--yaw 1 --qw 1 --frame-id a --child-frame-id b",
            "--qz 1 --frame-id a --child-frame-id b",
            "--frame-id a --child-frame-id a",
            "1 2 3 a b",
            "--what 1",
        ] {
            assert!(matches!(read(wrong), Err(Failure::Usage(_))), "{wrong}");
        }
    }
}
