//! Sessions from files, checks and mapping, as the page calls them.
#![allow(clippy::unwrap_used, clippy::disallowed_methods, reason = "tests look at files")]

use std::path::{Path, PathBuf};

use periplus_os::fs;
use periplus_tab::Tab;
use periplus_tab::calls::TabCalls;
use serde_json::{Value, json};

/// Folder that is removed at the end of the test.
struct Folder(PathBuf);

impl Folder {
    fn new(name: &str) -> Self {
        let name = format!("periplus-tab-{name}-{}", periplus_os::process_id());
        let folder = fs::temp_dir().join(name);
        fs::create_dir_all(&folder).unwrap();
        Self(fs::canonicalize(&folder).unwrap())
    }

    fn write(&self, name: &str, content: impl AsRef<[u8]>) -> PathBuf {
        let path = self.0.join(name);
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        fs::write(&path, content).unwrap();
        path
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.0);
    }
}

fn call(calls: &mut TabCalls, call: &Value) -> Result<Value, String> {
    let answer =
        calls.answer(call.to_string().as_bytes(), None).map_err(|error| error.to_string())?;
    Ok(serde_json::from_slice(&answer).expect("an answer in JSON"))
}

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../..")
}

#[test]
fn findings_are_those_of_the_file() {
    let folder = Folder::new("check");
    let file =
        folder.write("cart.urdf", "<robot name='cart'><link name='a'/><lnk name='b'/></robot>");
    let answer =
        call(&mut TabCalls::default(), &json!({"check": {"files": [file], "strict": true}}))
            .unwrap();
    let report = &answer["report"];
    assert_eq!(report["ok"], json!(false));
    let findings = report["files"][0]["findings"].as_array().unwrap();
    let codes: Vec<&str> = findings.iter().map(|it| it["code"].as_str().unwrap()).collect();
    assert_eq!(codes, ["unknown-element", "massless-link"]);
    let text = answer["text"].as_str().unwrap();
    assert!(text.contains("cart.urdf:1:") && !text.contains('\u{1b}'), "{text}");
}

#[test]
fn a_package_is_unpacked_and_its_robot_runs() {
    let folder = Folder::new("package");
    let mut archive =
        tar::Builder::new(flate2::write::GzEncoder::new(Vec::new(), flate2::Compression::fast()));
    archive.append_dir_all("kbot", root().join("robots/kbot")).unwrap();
    let archive = archive.into_inner().unwrap().finish().unwrap();
    let archive = folder.write("kbot.tar.gz", archive);
    let mut calls = TabCalls::default();
    let unpacked =
        call(&mut calls, &json!({"unpack": {"archive": archive, "folder": folder.0}})).unwrap();
    assert_eq!(unpacked["left_out"], json!([]));
    assert!(fs::is_file(&folder.0.join("kbot/meshes/laser.stl")));
    // The mesh is `package://kbot/meshes/laser.stl`.
    let robot = json!({"file": "kbot/urdf/kbot.urdf.xacro", "arguments": {"laser_mesh": "true"}});
    let options = json!({"run": {"folder": folder.0, "robots": [robot], "headless": true}});
    let mut tab = Tab::open_json(options.to_string().as_bytes()).unwrap();
    tab.step_until(100_000_000).unwrap();
    assert_eq!(tab.time_ns(), 100_000_000);
}

fn refusal(run: Value) -> String {
    let options = json!({ "run": run }).to_string();
    Tab::open_json(options.as_bytes()).unwrap_err().to_string()
}

#[test]
fn refusals_say_what_to_do() {
    let folder = Folder::new("refusals");
    folder.write("worlds/room.sdf", "<sdf version='1.6'><world name='room'/></sdf>");
    let here = &folder.0;
    let nothing = refusal(json!({ "folder": here }));
    assert!(nothing.contains("give `world`, `robots`, or both"), "{nothing}");
    let name = refusal(json!({ "folder": here, "world": "rom" }));
    assert!(name.contains("no world `rom`: there are room"), "{name}");
    let pose = json!([{"file": "a.urdf", "pose": [1.0]}]);
    let pose = refusal(json!({ "folder": here, "robots": pose }));
    assert!(pose.contains("has 1 numbers; give x, y, yaw"), "{pose}");
    let step = refusal(json!({ "folder": here, "world": "room", "step_s": 9.0 }));
    assert!(step.contains("`step_s` is 9"), "{step}");
    let unknown = refusal(json!({ "wrld": "room" }));
    assert!(unknown.contains("unknown field `wrld`"), "{unknown}");
    let both = Tab::open_json(br#"{"demo": {}, "run": {}}"#).unwrap_err().to_string();
    assert!(both.contains("not both"), "{both}");
}

#[test]
fn a_world_is_found_by_its_name() {
    let folder = Folder::new("name");
    folder.write("worlds/room.sdf", "<sdf version='1.6'><world name='room'/></sdf>");
    let options = json!({ "run": { "folder": folder.0, "world": "room", "headless": true } });
    let mut tab = Tab::open_json(options.to_string().as_bytes()).unwrap();
    tab.step_until(10_000_000).unwrap();
    assert_eq!(tab.time_ns(), 10_000_000);
}

/// Drive along the x axis between two walls, with a wall at the end: the scanner sees its distance.
fn carmen_log(scans: usize) -> String {
    let mut text = String::new();
    for number in 0..scans {
        let x = 0.2 * number as f64;
        let ranges: Vec<String> = (0..181)
            .map(|beam| {
                let angle = f64::from(beam - 90).to_radians();
                let (sin, cos) = libm::sincos(angle);
                let side = if sin.abs() > 1e-9 { 2.0 / sin.abs() } else { f64::INFINITY };
                let end = if cos > 1e-9 { (10.0 - x) / cos } else { f64::INFINITY };
                format!("{:.2}", side.min(end))
            })
            .collect();
        let ranges = ranges.join(" ");
        text += &format!("FLASER 181 {ranges} {x} 0 0 {x} 0 0 {number} host {number}\n");
    }
    text
}

#[test]
fn a_log_is_mapped_in_slices() {
    let folder = Folder::new("map");
    let log = folder.write("drive.log", carmen_log(20));
    let out = folder.0.join("map");
    let mut calls = TabCalls::default();
    let open =
        json!({"map_open": {"log": log, "out": out, "session_out": out.join("map.session")}});
    call(&mut calls, &open).unwrap();
    let early = call(&mut calls, &json!({"map_write": {}})).unwrap_err();
    assert!(early.contains("not complete"), "{early}");
    let step = json!({"map_step": {"budget_ms": 0.0}});
    let first = call(&mut calls, &step).unwrap();
    assert_eq!((&first["phase"], &first["scans"]), (&json!("mapping"), &json!(1)));
    let picture = calls.answer(json!({"map_preview": {}}).to_string().as_bytes(), None).unwrap();
    assert!(picture.starts_with(b"\x89PNG"));
    let mut phases = vec!["mapping".to_owned()];
    let mut last = first;
    while last["phase"] != "complete" {
        last = call(&mut calls, &step).unwrap();
        let phase = last["phase"].as_str().unwrap();
        if phases.last().is_none_or(|before| before != phase) {
            phases.push(phase.to_owned());
        }
    }
    assert_eq!(phases, ["mapping", "finishing", "complete"]);
    assert_eq!((&last["fraction"], &last["scans_total"]), (&json!(1.0), &json!(20)));
    let written = call(&mut calls, &json!({"map_write": {}})).unwrap();
    assert_eq!(written["failure"], Value::Null);
    for file in ["map.pgm", "map.yaml", "trajectory.txt", "trajectory.png", "map.session"] {
        assert!(fs::is_file(&out.join(file)), "{file}");
    }
    call(&mut calls, &json!({"map_close": {}})).unwrap();
    let closed = call(&mut calls, &step).unwrap_err();
    assert!(closed.contains("`map_open` starts it"), "{closed}");
}

#[test]
fn a_log_that_cannot_be_mapped_gives_the_reason() {
    let folder = Folder::new("no-map");
    let log = folder.write("empty.log", "# nothing\n");
    let open = |log: &Path| json!({"map_open": {"log": log, "out": "/never"}});
    let empty = call(&mut TabCalls::default(), &open(&log)).unwrap_err();
    assert!(empty.contains("empty.log"), "{empty}");
    let missing = call(&mut TabCalls::default(), &open(&folder.0.join("a.log"))).unwrap_err();
    assert!(missing.contains("a.log"), "{missing}");
    let method = json!({"map_open": {"log": log, "out": "/never", "method": "gmaping"}});
    let method = call(&mut TabCalls::default(), &method).unwrap_err();
    assert!(method.contains("`gmaping` is no method"), "{method}");
}
