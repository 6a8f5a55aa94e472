//! The bytes and hashes of others; see `data/make.py` for where they come from.
#![allow(clippy::unwrap_used, reason = "helpers of tests may unwrap as tests do")]

use std::collections::BTreeMap;

use periplus_diagnostics::{Diagnostics, SourceMap};
use periplus_interfaces::{Dialect, TypeName, parse};
use periplus_msgs::{
    DynamicMessage, Encapsulation, Format, Message, Service as _, TypeRegistry, decode, encode,
};
use serde_json::Value;

const FORMATS: [(&str, Format); 3] = [
    ("le", Format::Cdr(Encapsulation::LittleEndian)),
    ("be", Format::Cdr(Encapsulation::BigEndian)),
    ("ros1", Format::Ros1),
];

/// What rosbags made of each type.
fn oracle() -> BTreeMap<String, Value> {
    let lines = include_str!("data/oracle.jsonl").lines();
    let parse = |line| serde_json::from_str::<Value>(line).unwrap();
    lines.map(parse).map(|one| (one["type"].as_str().unwrap().to_owned(), one)).collect()
}

/// Each type with its hash and who says so.
fn hashes() -> BTreeMap<&'static str, (&'static str, &'static str)> {
    let read = |line: &'static str| {
        let [name, hash, source] = line.split('\t').collect::<Vec<_>>()[..] else {
            panic!("{line}")
        };
        (name, (hash, source))
    };
    include_str!("data/hashes.tsv").lines().map(read).collect()
}

fn base64(text: &str) -> Vec<u8> {
    const ALPHABET: &[u8] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let mut bytes = Vec::new();
    let (mut held, mut bits) = (0_u32, 0);
    for character in text.bytes().filter(|&b| b != b'=') {
        let six = ALPHABET.iter().position(|&b| b == character).unwrap();
        held = held << 6 | u32::try_from(six).unwrap();
        bits += 6;
        if bits >= 8 {
            bits -= 8;
            bytes.push((held >> bits & 0xff) as u8);
        }
    }
    bytes
}

#[test]
fn rosbags_makes_the_same_bytes() {
    fn check<T: Message>(oracle: &BTreeMap<String, Value>) -> usize {
        let Some(one) = oracle.get(T::TYPE_NAME) else { return 0 };
        let json = &one["json"];
        let value = T::from_json(json).unwrap_or_else(|e| panic!("{}: {e}", T::TYPE_NAME));
        for (key, format) in FORMATS {
            let theirs = base64(one[key].as_str().unwrap());
            let mut ours = Vec::new();
            encode(&value, format, &mut ours).unwrap();
            assert_eq!(ours, theirs, "{} {key}", T::TYPE_NAME);
            let back: T = decode(format, &theirs).unwrap();
            assert_eq!(&back.to_json(), json, "{} {key}", T::TYPE_NAME);
        }
        1
    }
    let oracle = oracle();
    let mut compared = 0;
    macro_rules! all {
        ($($package:ident::$name:ident)*) => {
            $(compared += check::<periplus_msgs::$package::$name>(&oracle);)*
        };
    }
    periplus_msgs::every_message!(all);
    assert_eq!(compared, oracle.len());
    assert!(compared > 300, "{compared}");
}

#[test]
fn what_is_made_at_run_time_is_the_same_as_what_is_compiled() {
    fn check<T: Message>(oracle: &BTreeMap<String, Value>) {
        let layout = TypeRegistry::builtin().layout(T::TYPE_NAME).unwrap();
        let mut values = vec![T::default()];
        values.extend(oracle.get(T::TYPE_NAME).map(|one| T::from_json(&one["json"]).unwrap()));
        let blank = DynamicMessage::blank(layout);
        assert_eq!(blank.to_json(), T::default().to_json(), "{}", T::TYPE_NAME);
        for value in values {
            for (_, format) in FORMATS {
                let mut bytes = Vec::new();
                encode(&value, format, &mut bytes).unwrap();
                let dynamic = DynamicMessage::decode(layout, format, &bytes).unwrap();
                let mut again = Vec::new();
                dynamic.encode(format, &mut again).unwrap();
                assert_eq!(again, bytes, "{}", T::TYPE_NAME);
                assert_eq!(dynamic.to_json(), value.to_json(), "{}", T::TYPE_NAME);
            }
        }
    }
    let oracle = oracle();
    macro_rules! all {
        ($($package:ident::$name:ident)*) => {
            $(check::<periplus_msgs::$package::$name>(&oracle);)*
        };
    }
    periplus_msgs::every_message!(all);
}

#[test]
fn type_hashes_are_the_published_ones() {
    let published = hashes();
    let types = TypeRegistry::builtin();
    let mut counts = BTreeMap::new();
    for (name, (hash, source)) in &published {
        let ours = types.hash(name).unwrap_or_else(|| panic!("{name} is missing"));
        assert_eq!(&ours, hash, "{name}, as {source} has it");
        *counts.entry(*source).or_insert(0) += 1;
    }
    assert!(counts["jazzy"] > 240, "{counts:?}");
    macro_rules! messages {
        ($($package:ident::$name:ident)*) => {
            $({
                type T = periplus_msgs::$package::$name;
                assert_eq!(types.hash(T::TYPE_NAME).as_deref(), Some(T::TYPE_HASH));
            })*
        };
    }
    periplus_msgs::every_message!(messages);
    macro_rules! services {
        ($($package:ident::$name:ident)*) => {
            $({
                type T = periplus_msgs::$package::$name;
                assert_eq!(types.hash(T::TYPE_NAME).as_deref(), Some(T::TYPE_HASH));
            })*
        };
    }
    periplus_msgs::every_service!(services);
}

/// Read off a running ROS 2 Jazzy: `ros2 topic info -v`.
#[test]
fn type_hashes_are_those_of_a_running_system() {
    for (name, hash) in [
        (
            "sensor_msgs/msg/LaserScan",
            "64c191398013af96509d518dac71d5164f9382553fce5c1f8cca5be7924bd828",
        ),
        (
            "sensor_msgs/msg/PointCloud2",
            "9198cabf7da3796ae6fe19c4cb3bdd3525492988c70522628af5daa124bae2b5",
        ),
        (
            "nav_msgs/msg/OccupancyGrid",
            "8d348150c12913a31ee0ec170fbf25089e4745d17035792a1ba94d6f0bc0cfc7",
        ),
        (
            "tf2_msgs/msg/TFMessage",
            "e369d0f05a23ae52508854b66f6aa0437f3449d652e8cbf22d5abe85d020f087",
        ),
        (
            "nav_msgs/msg/Odometry",
            "3cc97dc7fb7502f8714462c526d369e35b603cfc34d946e3f2eda2766dfec6e0",
        ),
        (
            "rosgraph_msgs/msg/Clock",
            "692f7a66e93a3c83e71765d033b60349ba68023a8c689a79e48078bcb5c58564",
        ),
        (
            "geometry_msgs/msg/Twist",
            "9c45bf16fe0983d80e3cfe750d6835843d265a9a6c46bd2e609fcddde6fb8d2a",
        ),
        ("std_msgs/msg/String", "df668c740482bbd48fb39d76a70dfd4bd59db1288021743503259e948f6b1a18"),
        (
            "std_srvs/srv/Trigger",
            "eeff2cd6fa5ad9d27cdf4dec64818317839b62f212a91e6b5304b634b2062c5f",
        ),
    ] {
        let ours = TypeRegistry::builtin().hash(name).unwrap();
        assert_eq!(ours, format!("RIHS01_{hash}"), "{name}");
    }
}

/// Read off code that rosidl made for Jazzy from `gazebo_msgs` (`*__description.c`), as it stands in
/// public workspaces.
#[test]
fn type_hashes_of_gazebo_are_the_published_ones() {
    for (name, hash) in [
        ("msg/ContactsState", "1dc585e627c16551e50102b983ec513212ef81bad3b9e9f2423f549df190a40c"),
        (
            "msg/ODEJointProperties",
            "dfa26a3a153c0ec6b22b49d4bef17b492dd4c65611322c10ff10cf8b34ff16f7",
        ),
        ("msg/ODEPhysics", "ac82f81db143d0eaae55db4c4445a1e02a768e473f2e7210a65ab5ba0a581714"),
        (
            "msg/PerformanceMetrics",
            "78a23a97ca2832491a26a73da2397fe2a470892704574f1f930c8a4a8b2ce456",
        ),
        (
            "msg/SensorPerformanceMetric",
            "2fb085a53ec05154b793411cc83d0120da95292c8f3b22ee1e402aa44d9846b6",
        ),
        ("msg/WheelSlip", "71875111e6e10937ba5cd6a6509bbcb5e2f8bc9c53b9aee9adbd0e407c94963d"),
        (
            "srv/ApplyJointEffort",
            "3e94edd0b2942718ab07ae1b6ca5caefd2d2948d756265ea142fe4244e5e706a",
        ),
        ("srv/BodyRequest", "c002b6c9051ae255d44bd75c1f745cce9f9f5eb239a650506a134c1ce4fdd54b"),
        ("srv/DeleteEntity", "81b2eed68ee3a93de5a70a0915b57c51dbed9518da77ca5f0abc47222f1f44a2"),
        ("srv/DeleteLight", "bfa8291779696b74f42c72fee0cb40f2b88252ec8cf6203ae05e78532c3a6533"),
        ("srv/DeleteModel", "cb5cfe8e226608046ebe3ccf4f3415e7934f94feb657c214b1d23546128fdb31"),
        (
            "srv/GetLightProperties",
            "a91ed19680b3e792983c2c33b0dd066cef0667ee325d9bd2e41c8a268c84458a",
        ),
        ("srv/GetModelList", "7b19089b52e4e5b9db3fd84042f59e90becb14aa2e7bcd3db378994bcea42257"),
        (
            "srv/GetModelProperties",
            "49525097678f4c00f1d0b1f79649f4b212403225dce6e70b959ce52b7336a23f",
        ),
        (
            "srv/GetPhysicsProperties",
            "209d805dac6540877d312c21b6b3594913bdb97e337728e82581b6f7eb9c65ae",
        ),
        ("srv/JointRequest", "4d05b05dc0795a90eb94ac31bb829a01bd0e0f6a52636fbacf4e87ff90c4943d"),
        (
            "srv/SetLightProperties",
            "0f9f2e73a54e9e372274608c302437a4a044c6d489712b1f71af88e8ac9bb529",
        ),
        (
            "srv/SetModelConfiguration",
            "bce01736373da06cc4795d5146131d75b63651e090d01db89f7bea6f5ec5eaa7",
        ),
        (
            "srv/SetPhysicsProperties",
            "116ec8100c5ea11fae2cf4354ac9d396afae545cef9dcdd071b76836e878e5cf",
        ),
    ] {
        let ours = TypeRegistry::builtin().hash(&format!("gazebo_msgs/{name}")).unwrap();
        assert_eq!(ours, format!("RIHS01_{hash}"), "{name}");
    }
}

/// The hashes that the build of `test_msgs` 2.0.3 for ROS 2 Jazzy (PyPI `ros-test-msgs`) publishes
/// for its Fibonacci action, and for all that an action implies.
#[test]
fn type_hashes_of_an_action_are_the_published_ones() {
    let mut sources = SourceMap::new();
    let mut diagnostics = Diagnostics::new();
    let text = "int32 order\n---\nint32[] sequence\n---\nint32[] sequence\n";
    let file = sources.add("Fibonacci.action", text);
    let name = TypeName::read("test_msgs/action/Fibonacci").unwrap();
    let action = parse(&name, file, &sources, Dialect::Ros2, &mut diagnostics).unwrap();
    let mut registry = TypeRegistry::builtin_texts();
    registry.add(action);
    let types = TypeRegistry::new(registry, &mut diagnostics);
    assert!(diagnostics.is_empty(), "{diagnostics:?}");
    for (suffix, hash) in [
        ("", "be9273e3557225044b4a040811112491f7079326e3a573f83258b0b4c30bd069"),
        ("_Feedback", "7d1110f2efa019ad5ad8ad2244db98d862f39dc9fae8c976814b0065fa2f32d5"),
        ("_FeedbackMessage", "37487bae8cea358366b97003c1ef1ca7ce7c08df36f9e8cca496624226aee64e"),
        ("_GetResult", "5d30fdeb21d20e117aa5f36c7b4f0b6874f1a8cf7a9c038d58f1156c5737b209"),
        ("_GetResult_Event", "fe0aa5843ef10550a9b322aeeccd5b11e78bca05b3571cf6999c51bff30c1e23"),
        ("_GetResult_Request", "c65e93c4c4328d7f1abd6ace83dba8e5fa0f32de76b4d2c96b5c655d94803b92"),
        ("_GetResult_Response", "ef88159d47a3d21d9bf4bec690cf668939d9542db28a9cfd77dbcd97eaf1add2"),
        ("_Goal", "e58ef5a8f4f039ab522a740823547c460b1d5aed8031c8b7825d33d345d90df8"),
        ("_Result", "0774b095467813c6904d475498b5486b7ebd4cda6a4569f97e8de8c862689049"),
        ("_SendGoal", "d807633803e38e164276573cd97e9fbd71e109c290bbf4cc312a0a1c9da7bbd9"),
        ("_SendGoal_Event", "a20e708c6aae7a99d1eb0e930a0916f596bb5bae93a342a61752e13135be2c44"),
        ("_SendGoal_Request", "dfe75c73dc2c090cbc8fd8c45039bfa279d16aa6aadd348f812c6adad26e669e"),
        ("_SendGoal_Response", "1e7e84f7edf1fb020d9e51c7842bceef4cbdbd847f354125f3227cf4f314a683"),
    ] {
        let ours = types.hash(&format!("{name}{suffix}")).unwrap();
        assert_eq!(ours, format!("RIHS01_{hash}"), "{name}{suffix}");
    }
}
