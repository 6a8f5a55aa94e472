//! Real files against libsdformat: `PERIPLUS_SDF_ORACLE` names the answers of
//! `benches/oracles/sdf_oracle` (README there). Without it nothing is compared.
#![allow(clippy::disallowed_methods, reason = "this test reads real files")]
#![allow(clippy::print_stdout, reason = "what is skipped or differs is told")]

#[path = "corpus/compare.rs"]
mod compare;
#[path = "corpus/files.rs"]
mod files;

use std::collections::BTreeMap;

use periplus_diagnostics::{Diagnostics, RenderStyle, Severity, SourceMap, render};
use periplus_scene::Scene;
use serde_json::Value;

/// Reason for a difference from libsdformat, by the end of the file's name.
const EXCEPTIONS: &[(&str, &str)] = &[
    ("sam_bot_description/world/my_world.sdf", STATE),
    ("worlds/turtlebot3_autorace_2020.world", STATE),
    ("test/sdf/link_duplicate_sibling_collisions.sdf", SECOND),
    ("test/sdf/link_duplicate_sibling_visuals.sdf", SECOND),
    ("test/sdf/model_duplicate_joints.sdf", SECOND),
    ("test/sdf/model_duplicate_links.sdf", SECOND),
    ("test/sdf/model_invalid_canonical_link.sdf", CANONICAL),
    ("test/sdf/world_invalid_root_reference.sdf", CANONICAL),
    (
        "test/sdf/placement_frame.sdf",
        "a joint that needs an axis and has none is an error here and gets the default axis",
    ),
    ("test/sdf/inertial_invalid.sdf", "a negative mass is an error here, and 1 kg is assumed"),
    (
        "integration/merge_include_model.sdf",
        "joints to `__model__` follow the merged model, as in libsdformat 14; 12 left them behind",
    ),
    ("nested_include/test_nested_include.sdf", PARAMETERS),
];

const STATE: &str = "a saved state counts, as in Gazebo Classic; libsdformat leaves it out";
const SECOND: &str = "an error here too, but the second of a name is kept under a new one";
const CANONICAL: &str = "an error here too, but the first link is taken instead of none";
const PARAMETERS: &str = "`<experimental:params>` is told, not applied";

fn answers() -> Option<Vec<Value>> {
    let Ok(path) = std::env::var("PERIPLUS_SDF_ORACLE") else {
        println!("SKIPPED: PERIPLUS_SDF_ORACLE does not name the oracle's answers");
        return None;
    };
    let text = std::fs::read_to_string(&path).expect("the oracle's answers can be read");
    Some(text.lines().map(|line| serde_json::from_str(line).expect("JSON")).collect())
}

fn read(answer: &Value) -> (Scene, Diagnostics, SourceMap, files::Recorded) {
    let mut includes = files::Recorded::new(answer);
    let mut sources = SourceMap::new();
    let mut diagnostics = Diagnostics::new();
    let path = answer["file"].as_str().expect("a file");
    let scene = files::parse(path, &mut sources, &mut diagnostics).map(|document| {
        let mut context = periplus_sdf::SdfContext {
            sources: &mut sources,
            diagnostics: &mut diagnostics,
            includes: &mut includes,
        };
        periplus_sdf::read_document(&document, &mut context)
    });
    (scene.unwrap_or_default(), diagnostics, sources, includes)
}

/// Writes and reads again.
fn rewritten(scene: &Scene) -> (Scene, String) {
    let mut diagnostics = Diagnostics::new();
    let text = periplus_xml::write_document(&periplus_sdf::write(scene, &mut diagnostics));
    let mut sources = SourceMap::new();
    let file = sources.add("again.sdf", text.as_str());
    let document = periplus_xml::parse(file, &sources, &mut diagnostics).expect("XML");
    let mut context = periplus_sdf::SdfContext {
        sources: &mut sources,
        diagnostics: &mut diagnostics,
        includes: &mut periplus_sdf::NoIncludes,
    };
    let again = periplus_sdf::read_document(&document, &mut context);
    (again, text)
}

#[test]
fn real_files_survive_writing() {
    let Some(answers) = answers() else { return };
    let keep = std::env::var("PERIPLUS_WRITTEN").ok();
    let mut count = 0;
    for (index, answer) in answers.iter().filter(|it| it["kind"] == "sdf").enumerate() {
        let (scene, ..) = read(answer);
        let (again, text) = rewritten(&scene);
        let path = answer["file"].as_str().unwrap();
        if let Some(folder) = &keep {
            std::fs::write(format!("{folder}/{index}.sdf"), &text).expect("written");
        }
        if again != scene {
            let (ours, theirs) = (format!("{scene:#?}"), format!("{again:#?}"));
            let line = |text: &str| text.lines().map(|it| it.trim().to_owned()).collect::<Vec<_>>();
            let origins = |it: &String| !it.starts_with("start:") && !it.starts_with("end:");
            let pairs = line(&ours).into_iter().filter(origins);
            let pairs = pairs.zip(line(&theirs).into_iter().filter(origins));
            let first = pairs.filter(|(a, b)| a != b && !a.contains("Origin")).take(3);
            panic!("{path} changed: {:#?}", first.collect::<Vec<_>>());
        }
        count += 1;
    }
    println!("{count} files survive writing");
}

#[test]
fn real_files_mean_what_libsdformat_says() {
    let Some(answers) = answers() else { return };
    let verbose = std::env::var("PERIPLUS_VERBOSE").is_ok();
    let mut codes: BTreeMap<(Severity, &str), usize> = BTreeMap::new();
    let (mut compared, mut equal, mut excepted, mut other_format) = (0, 0, 0, 0);
    for answer in answers.iter().filter(|it| it["kind"] == "sdf" && it["ok"] == true) {
        let (scene, diagnostics, sources, includes) = read(answer);
        let path = answer["file"].as_str().unwrap();
        if includes.other_format {
            other_format += 1;
            continue;
        }
        for diagnostic in diagnostics.iter() {
            *codes.entry((diagnostic.severity, diagnostic.code)).or_default() += 1;
            if verbose {
                println!("{}", render(diagnostic, &sources, RenderStyle::Plain));
            }
        }
        let mut differences = compare::Differences::default();
        compare::scene(&scene, answer, &mut differences);
        compared += 1;
        if differences.found.is_empty() {
            equal += 1;
        } else if let Some((_, reason)) = EXCEPTIONS.iter().find(|(end, _)| path.ends_with(end)) {
            excepted += 1;
            println!("EXCEPTED {path}: {reason}");
        } else {
            println!("DIFFERENT {path}");
            for difference in differences.found.iter().take(8) {
                println!("    {difference}");
            }
            for diagnostic in diagnostics.iter().filter(|it| it.severity == Severity::Error).take(3)
            {
                println!("    we say: {}", diagnostic.message);
            }
        }
    }
    for ((severity, code), count) in codes {
        println!("{count:6} {} {code}", severity.name());
    }
    println!(
        "{compared} files compared: {equal} equal, {excepted} excepted; \
         {other_format} include other formats"
    );
    assert_eq!(equal + excepted, compared);
}
