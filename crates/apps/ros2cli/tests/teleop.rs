//! Keys and the resulting velocities of `teleop_twist_keyboard`, if case files are available.
#![allow(clippy::disallowed_methods, reason = "tests read their cases")]
#![allow(clippy::unwrap_used, reason = "a test fails on missing data")]

use std::fs;
use std::path::Path;

use periplus_ros2cli::teleop::Keyboard;
use serde_json::Value;

#[test]
fn keys_do_what_the_peer_does() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../../shared/cases");
    let Ok(entries) = fs::read_dir(&folder) else {
        println!("SKIPPED: no cases in {}", folder.display());
        return;
    };
    let mut paths: Vec<_> = entries.map(|entry| entry.unwrap().path()).collect();
    paths.retain(|path| path.file_name().unwrap().to_string_lossy().starts_with("teleop_"));
    paths.sort();
    if paths.is_empty() {
        println!("SKIPPED: no cases of teleop in {}", folder.display());
    }
    for path in paths {
        let case: Value = serde_json::from_str(&fs::read_to_string(&path).unwrap()).unwrap();
        assert_eq!(case["kind"], "teleop_keys", "{}", path.display());
        check(&case);
    }
}

fn check(case: &Value) {
    let (given, id) = (&case["given"], &case["id"]);
    let number = |value: &Value| value.as_f64().unwrap();
    let mut keyboard = Keyboard {
        speed_m_s: number(&given["speed"]),
        turn_rad_s: number(&given["turn"]),
        ..Keyboard::default()
    };
    let tolerance = case["tolerance"].as_f64().unwrap_or(1e-6);
    let keys = given["keys"].as_array().unwrap();
    let twists = case["expect"]["twists"].as_array().unwrap();
    assert_eq!(keys.len(), twists.len(), "{id}");
    for (index, (key, twist)) in keys.iter().zip(twists).enumerate() {
        keyboard.press(key.as_str().unwrap().chars().next().unwrap());
        let velocity = keyboard.velocity();
        let wanted = twist["linear"].as_array().unwrap().iter().chain([&twist["angular_z"]]);
        let got = velocity.linear_m_s.iter().chain([&velocity.angular_z_rad_s]);
        for (got, wanted) in got.zip(wanted) {
            let near = (got - number(wanted)).abs() <= tolerance;
            assert!(near, "{id}: {key} ({index}): {velocity:?}, expected {twist}");
        }
    }
}
