//! `robot_state_publisher`: its rate, and the frames of robots.

use periplus_graph::{Graph, Mailbox, NodeSettings, Qos};
use periplus_msgs::sensor_msgs::JointState;
use periplus_msgs::std_msgs::Header;
use periplus_msgs::tf2_msgs::TFMessage;
use periplus_sim_nodes::states::{RobotStateParams, RobotStatePublisher};
use serde_json::{Map, Value, json};

use super::Setting;
use crate::{Case, CaseReader, Differences, Unreadable, number, numbers};

/// A robot with one joint, for cases about the rate.
const ONE_JOINT: &str = r#"<robot name="robot">
  <link name="base"/><link name="wheel"/>
  <joint name="turn" type="continuous">
    <parent link="base"/><child link="wheel"/><axis xyz="0 0 1"/>
  </joint>
</robot>"#;

/// Joint states of a time.
struct Told {
    stamp_ns: i64,
    positions: Vec<(String, f64)>,
}

/// Transforms published for joint states: a robot (`urdf`; by default one with the joint `turn`)
/// and its joint states, as `stamps` or as `joint_states` with `stamp`, `name` and `position`.
pub(super) fn check(
    case: &Case,
    _distro: &str,
    _setting: &Setting<'_>,
    differences: &mut Differences,
) -> Result<(), Unreadable> {
    let (given, expect) = (case.given(), case.expect());
    let usual = RobotStateParams::default();
    let given_number =
        |name: &str, usual: f64| given.find(name).map_or(Ok(usual), |it| it.number());
    let options = RobotStateParams {
        publish_frequency_hz: given_number("publish_frequency", usual.publish_frequency_hz)?,
        ignore_timestamp: given.find("ignore_timestamp").map_or(Ok(false), |it| it.truth())?,
        frame_prefix: given.find("frame_prefix").map_or(Ok(""), |it| it.text())?.to_owned(),
        ..usual
    };
    let urdf = given.find_any(&["urdf", "robot_description"]);
    let urdf = urdf.map_or(Ok(ONE_JOINT), |it| it.text())?;
    let states = match given.find("joint_states") {
        Some(states) => states.each(state)?,
        None => {
            let stamps = given.find("stamps").map_or(Ok(Vec::new()), |it| it.numbers())?;
            let told = |stamp_s: f64| Told {
                stamp_ns: nanoseconds(stamp_s),
                positions: vec![("turn".into(), 0.5)],
            };
            stamps.into_iter().map(told).collect()
        }
    };
    let named = match run(urdf, options, &states) {
        Ok((fixed, moving)) => {
            let published: Vec<bool> = moving.iter().map(Option::is_some).collect();
            let last = moving.iter().rev().flatten().next();
            let each: Vec<Value> =
                moving.iter().map(|it| it.as_ref().map_or(Value::Null, transforms)).collect();
            vec![
                (&["accepted", "valid"][..], json!(true)),
                (&["published"], json!(published)),
                (&["static", "tf_static", "fixed"], transforms(&fixed)),
                (&["tf", "moving"], last.map_or(json!({}), transforms)),
                (&["tf_after_each"], Value::Array(each)),
            ]
        }
        Err(_) if expect.has("accepted") || expect.has("valid") => {
            vec![(&["accepted", "valid"][..], json!(false))]
        }
        Err(why) => {
            differences.push(why);
            return Ok(());
        }
    };
    differences.compare_members(&named, &expect);
    Ok(())
}

fn nanoseconds(seconds: f64) -> i64 {
    (seconds * 1e9).round() as i64
}

fn state(given: &CaseReader<'_>) -> Result<Told, Unreadable> {
    let names = given.get_any(&["name", "names"])?.each(|it| Ok(it.text()?.to_owned()))?;
    let positions = given.get_any(&["position", "positions"])?.numbers()?;
    if names.len() != positions.len() {
        return Err(given.unreadable("one with a position for each name"));
    }
    let stamp_ns = nanoseconds(given.get("stamp")?.number()?);
    Ok(Told { stamp_ns, positions: names.into_iter().zip(positions).collect() })
}

/// Transforms by the child's frame: its parent, shift and turn.
fn transforms(message: &TFMessage) -> Value {
    let mut all = Map::new();
    for one in &message.transforms {
        let (shift, turn) = (&one.transform.translation, &one.transform.rotation);
        let value = json!({
            "parent": one.header.frame_id,
            "translation": numbers([shift.x, shift.y, shift.z]),
            "rotation": numbers([turn.x, turn.y, turn.z, turn.w]),
            "stamp": number(one.header.stamp.ns() as f64 / 1e9),
        });
        all.insert(one.child_frame_id.clone(), value);
    }
    Value::Object(all)
}

/// The fixed transforms, and those after each state; none where nothing was published.
type Frames = (TFMessage, Vec<Option<TFMessage>>);

fn run(urdf: &str, options: RobotStateParams, states: &[Told]) -> Result<Frames, String> {
    let words = |error: periplus_graph::GraphError| error.to_string();
    let graph = Graph::new();
    let node = graph.node(NodeSettings::new("robot_state_publisher")).map_err(words)?;
    let _publisher =
        RobotStatePublisher::of_urdf(node, urdf, options).map_err(|error| error.to_string())?;
    let user = graph.node(NodeSettings::new("user")).map_err(words)?;
    let publisher =
        user.publisher::<JointState>("/joint_states", Qos::reliable(10)).map_err(words)?;
    let frames: Mailbox<TFMessage> = user.mailbox("/tf", Qos::reliable(100)).map_err(words)?;
    let fixed: Mailbox<TFMessage> = user.mailbox("/tf_static", Qos::latched(1)).map_err(words)?;
    let mut moving = Vec::new();
    for Told { stamp_ns, positions } in states {
        graph.advance_to(*stamp_ns);
        publisher.publish(JointState {
            header: Header::at(*stamp_ns, ""),
            name: positions.iter().map(|(name, _)| name.clone()).collect(),
            position: positions.iter().map(|(_, position)| *position).collect(),
            ..JointState::default()
        });
        graph.settle();
        moving.push(frames.drain().into_iter().next_back().map(|message| (*message).clone()));
    }
    let fixed = fixed.latest().map_or_else(TFMessage::default, |message| (*message).clone());
    Ok((fixed, moving))
}
