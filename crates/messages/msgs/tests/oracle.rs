//! Comparison with the bytes and hashes of other implementations; `data/make.py` lists their
//! sources.
#![allow(clippy::unwrap_used, reason = "helpers of tests may unwrap as tests do")]
#![allow(clippy::disallowed_methods, reason = "the tests read the interfaces of this tree")]

use std::collections::BTreeMap;

use periplus_diagnostics::{Diagnostics, SourceMap};
use periplus_msgs::{
    DynamicMessage, Encapsulation, Format, Message, Service as _, TypeRegistry, decode, encode,
};
use periplus_rosidl::{InterfaceDialect, TypeName, parse};
use serde_json::Value;

const FORMATS: [(&str, Format); 3] = [
    ("le", Format::Cdr(Encapsulation::LittleEndian)),
    ("be", Format::Cdr(Encapsulation::BigEndian)),
    ("ros1", Format::Ros1),
];

/// Results of rosbags for each type.
fn oracle() -> BTreeMap<String, Value> {
    let lines = include_str!("data/oracle.jsonl").lines();
    let parse = |line| serde_json::from_str::<Value>(line).unwrap();
    lines.map(parse).map(|one| (one["type"].as_str().unwrap().to_owned(), one)).collect()
}

/// Type with its hash and the source of the hash.
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

/// Hashes of the types that have another form in another distribution.
#[test]
fn type_hashes_of_other_releases_are_those_of_rosbags() {
    let mut compared = 0;
    for release in ["humble", "main"] {
        let mut registry = TypeRegistry::builtin_texts();
        let (mut sources, mut diagnostics) = (SourceMap::new(), Diagnostics::new());
        let folder = format!("{}/interfaces_{release}", env!("CARGO_MANIFEST_DIR"));
        for line in include_str!("data/variants.tsv").lines() {
            let [of, name, _] = line.split('\t').collect::<Vec<_>>()[..] else { panic!("{line}") };
            if of != release {
                continue;
            }
            let kind = name.split('/').nth(1).unwrap();
            // A part of a service or action is in the text of the whole.
            let part = name.rsplit_once('_').filter(|_| kind != "msg");
            let stem = part.map_or(name, |(stem, _)| stem);
            let text = std::fs::read_to_string(format!("{folder}/{stem}.{kind}")).unwrap();
            let file = sources.add(stem, text);
            let stem = TypeName::read(stem).unwrap();
            let form =
                parse(&stem, file, &sources, InterfaceDialect::Ros2, &mut diagnostics).unwrap();
            registry.add(form);
        }
        for line in include_str!("data/variants.tsv").lines() {
            let [of, name, hash] = line.split('\t').collect::<Vec<_>>()[..] else {
                panic!("{line}")
            };
            if of == release {
                let ours = registry.hash(&TypeName::read(name).unwrap());
                assert_eq!(ours.as_deref(), Some(hash), "{name} of {release}");
                compared += 1;
            }
        }
        assert!(diagnostics.is_empty(), "{diagnostics:?}");
    }
    assert!(compared > 100, "{compared}");
    // The compiled constants come from the same texts.
    let line = |release: &str, name: &str| {
        let start = format!("{release}\t{name}\t");
        include_str!("data/variants.tsv").lines().find_map(|line| line.strip_prefix(&start))
    };
    use periplus_msgs::{nav2_msgs_humble, nav2_msgs_main};
    for (release, name, hash) in [
        ("humble", "Goal", nav2_msgs_humble::FollowPathGoal::TYPE_HASH),
        ("humble", "Result", nav2_msgs_humble::FollowPathResult::TYPE_HASH),
        ("main", "Goal", nav2_msgs_main::FollowPathGoal::TYPE_HASH),
        ("main", "Feedback", nav2_msgs_main::FollowPathFeedback::TYPE_HASH),
    ] {
        assert_eq!(line(release, &format!("nav2_msgs/action/FollowPath_{name}")), Some(hash));
    }
}

/// Read off a running ROS 2 Jazzy (`ros2 topic info -v`), and off code that rosidl made for Iron and
/// later, as found in public workspaces (`*__description.c`).
#[test]
fn type_hashes_are_those_of_running_and_built_systems() {
    let types = TypeRegistry::builtin();
    let lines = include_str!("data/published.tsv").lines();
    for line in lines {
        let [name, hash, source] = line.split('\t').collect::<Vec<_>>()[..] else {
            panic!("{line} has not three columns");
        };
        assert_eq!(types.hash(name).as_deref(), Some(hash), "{name}, as {source} has it");
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
    let action = parse(&name, file, &sources, InterfaceDialect::Ros2, &mut diagnostics).unwrap();
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
