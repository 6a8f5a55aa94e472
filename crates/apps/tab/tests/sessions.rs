//! The ready sessions of the page: `sessions/declaration.json` names folders and worlds, `sessions/sessions.json` has
//! the files that the page fetches. `UPDATE_EXPECT=1 cargo test -p periplus-tab --test sessions` writes the latter.
#![allow(clippy::unwrap_used, clippy::disallowed_methods, reason = "tests look at files")]

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use periplus_os::fs;
use periplus_tab::Tab;
use serde_json::{Value, json};

/// Simulated time of each session: the first scans have arrived, and mapping and costmaps have started \[ns\].
const SESSION_END_NS: i64 = 500_000_000;

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../..").canonicalize().unwrap()
}

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("sessions")
}

fn strings(value: &Value) -> Vec<String> {
    let values = value.as_array().into_iter().flatten();
    values.map(|it| it.as_str().unwrap().to_owned()).collect()
}

/// Files below a folder, as paths from the root.
fn add_folder(folder: &str, files: &mut BTreeSet<String>) {
    for entry in
        fs::read_dir(root().join(folder)).unwrap_or_else(|error| panic!("{folder}: {error}"))
    {
        let name = entry.unwrap().file_name().into_string().unwrap();
        let path = format!("{folder}/{name}");
        if fs::is_dir(&root().join(&path)) {
            add_folder(&path, files);
        } else {
            files.insert(path);
        }
    }
}

/// A world, and the models that it and they name.
fn add_world(file: &str, files: &mut BTreeSet<String>) {
    files.insert(file.to_owned());
    let text = String::from_utf8(fs::read(root().join(file)).unwrap()).unwrap();
    for part in text.split("model://").skip(1) {
        let end = part.find(|c: char| !c.is_ascii_alphanumeric() && c != '_').unwrap_or(part.len());
        let model = format!("worlds/models/{}", &part[..end]);
        // Comments name the scheme alone.
        if end == 0 || files.contains(&format!("{model}/model.config")) {
            continue;
        }
        add_folder(&model, files);
        add_world(&format!("{model}/model.sdf"), files);
    }
}

/// The sessions with their files.
fn expanded() -> Value {
    let declared = fs::read(folder().join("declaration.json")).unwrap();
    let declared: Value = serde_json::from_slice(&declared).unwrap();
    let sessions = declared["sessions"].as_array().unwrap().iter().map(|session| {
        let mut files = BTreeSet::new();
        strings(&session["folders"]).iter().for_each(|folder| add_folder(folder, &mut files));
        strings(&session["worlds"]).iter().for_each(|world| add_world(world, &mut files));
        json!({
            "name": session["name"],
            "title": session["title"],
            "tutorial": session["tutorial"],
            "files": files,
            "options": session["options"],
        })
    });
    json!({ "sessions": sessions.collect::<Vec<_>>() })
}

#[test]
fn the_list_is_that_of_the_declaration() {
    let path = folder().join("sessions.json");
    let text = format!("{:#}\n", expanded());
    if std::env::var_os("UPDATE_EXPECT").is_some() {
        fs::write(&path, &text).unwrap();
    }
    let written = fs::read(&path).unwrap_or_default();
    assert_eq!(String::from_utf8_lossy(&written), text, "UPDATE_EXPECT=1 writes it");
}

#[test]
fn tutorials_exist() {
    for session in expanded()["sessions"].as_array().unwrap() {
        let page = format!("docs/{}.md", session["tutorial"].as_str().unwrap());
        assert!(fs::is_file(&root().join(&page)), "{page}");
    }
}

/// Each session runs with exactly its files, which are copied to a separate folder.
#[test]
fn each_session_runs_with_its_files() {
    for session in expanded()["sessions"].as_array().unwrap() {
        let name = session["name"].as_str().unwrap();
        let place =
            fs::temp_dir().join(format!("periplus-session-{name}-{}", periplus_os::process_id()));
        for file in strings(&session["files"]) {
            let target = place.join(&file);
            fs::create_dir_all(target.parent().unwrap()).unwrap();
            fs::write(&target, fs::read(root().join(&file)).unwrap()).unwrap();
        }
        let mut options = session["options"].clone();
        options["run"]["folder"] = json!(place);
        let mut tab = Tab::open_json(options.to_string().as_bytes())
            .unwrap_or_else(|error| panic!("{name}: {error}"));
        tab.step_until(SESSION_END_NS).unwrap();
        assert_eq!(tab.time_ns(), SESSION_END_NS, "{name}");
        drop(tab);
        fs::remove_dir_all(&place).unwrap();
    }
}
