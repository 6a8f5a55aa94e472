//! Parameters: files, mistakes, changes, advice.

use std::path::{Path, PathBuf};

use periplus_controllers::Controller;
use periplus_controllers::mppi::{CriticKind, MppiModel, MppiSetup, advice, check_costmap, create};
use periplus_costmap::Nav2Release;
use periplus_diagnostics::{Diagnostics, FileId, Origin, RenderStyle, SourceMap, render};
use periplus_params::{Given, ParamValue};
use periplus_yaml::{YamlNode, YamlValue};

use crate::world::{World, controller, setup};

struct Flat {
    name: String,
    text: String,
    name_origin: Origin,
    origin: Origin,
}

fn flatten(at: &YamlNode, prefix: &str, flat: &mut Vec<Flat>) {
    for (key, value) in at.entries().unwrap_or_default() {
        let key_text = key.text().unwrap_or_default();
        let name =
            if prefix.is_empty() { key_text.to_owned() } else { format!("{prefix}.{key_text}") };
        let text = match &value.value {
            YamlValue::Map(_) => {
                flatten(value, &name, flat);
                continue;
            }
            YamlValue::Scalar { text, .. } => text.clone(),
            YamlValue::List(list) => {
                let items: Vec<&str> = list.iter().filter_map(YamlNode::text).collect();
                format!("[{}]", items.join(", "))
            }
        };
        flat.push(Flat { name, text, name_origin: key.span.into(), origin: value.span.into() });
    }
}

/// Parameters of a file in which they are at the top level.
fn read(file: FileId, sources: &SourceMap, within: &[&str]) -> Vec<Flat> {
    let mut tree = &periplus_yaml::parse(file, sources).expect("YAML").expect("content");
    for key in within {
        let Some(inner) = tree.get(key) else { return Vec::new() };
        tree = inner;
    }
    let mut flat = Vec::new();
    flatten(tree, "", &mut flat);
    flat
}

fn given(flat: &[Flat]) -> impl Iterator<Item = Given<'_>> {
    flat.iter().map(|one| Given {
        name: &one.name,
        text: one.text.as_str().into(),
        name_origin: one.name_origin,
        origin: one.origin,
    })
}

/// Reads parameters below `FollowPath` and returns the rendered findings.
fn findings(release: Nav2Release, frequency_hz: f64, text: &str) -> (bool, String) {
    let indented: String = text.lines().map(|line| format!("  {line}\n")).collect();
    let mut sources = SourceMap::new();
    let file = sources.add("nav2.yaml", format!("FollowPath:\n{indented}"));
    let flat = read(file, &sources, &[]);
    let mut diagnostics = Diagnostics::new();
    let setup = MppiSetup { controller_frequency_hz: frequency_hz, ..setup(release) };
    let built = create(&setup, given(&flat), &mut diagnostics);
    let rendered = diagnostics.iter().map(|it| render(it, &sources, RenderStyle::Plain)).collect();
    (built.is_some(), rendered)
}

fn check_findings(release: Nav2Release, text: &str, is_built: bool, expected: &[&str]) {
    let (built, rendered) = findings(release, 20.0, text);
    assert_eq!(built, is_built, "{rendered}");
    for part in expected {
        assert!(rendered.contains(part), "`{part}` is missing in:\n{rendered}");
    }
    assert!(!expected.is_empty() || rendered.is_empty(), "{rendered}");
}

fn shared(folder: &str) -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../../shared/nav").join(folder);
    let Ok(entries) = std::fs::read_dir(&folder) else {
        println!("SKIPPED: {} is missing", folder.display());
        return Vec::new();
    };
    let mut files: Vec<PathBuf> = entries.filter_map(|entry| Some(entry.ok()?.path())).collect();
    files.sort();
    files
}

/// Every file with an MPPI controller is read without a finding; returns their number.
fn check_files(files: &[PathBuf]) -> usize {
    let mut found = 0;
    for path in files {
        let text = std::fs::read_to_string(path).unwrap();
        if !text.contains("nav2_mppi_controller") {
            continue;
        }
        let name = path.file_name().unwrap().to_string_lossy().into_owned();
        let release = match &name {
            name if name.contains("main") => Nav2Release::Main,
            name if name.contains("humble") => Nav2Release::Humble,
            _ => Nav2Release::Jazzy,
        };
        let mut sources = SourceMap::new();
        let file = sources.add(name.clone(), text);
        let flat = read(file, &sources, &["controller_server", "ros__parameters"]);
        let mut diagnostics = Diagnostics::new();
        let plugin = flat.iter().find(|one| one.text.contains("MPPIController")).expect("a plugin");
        let group = plugin.name.strip_suffix(".plugin").expect("a plugin");
        let setup = MppiSetup { group, ..setup(release) };
        let built = create(&setup, given(&flat), &mut diagnostics);
        let rendered: String =
            diagnostics.iter().map(|it| render(it, &sources, RenderStyle::Plain)).collect();
        assert_eq!(rendered, "", "{name}");
        let mut built = built.expect("a controller");
        assert_eq!(built.config().critics.len(), 8, "{name}");
        assert_eq!(built.config().model, MppiModel::DiffDrive);
        assert_eq!(built.config().params().batch_size, 2000);
        assert_eq!(built.values().number("PathAlignCritic.cost_weight"), Some(14.0));
        built.set_speed_limit(50.0, true);
        found += 1;
    }
    found
}

#[test]
fn stock_and_users_files_are_read_without_a_finding() {
    let (stock, users) = (shared("bringup"), shared("params"));
    if !stock.is_empty() {
        assert_eq!(check_files(&stock), 2);
    }
    if !users.is_empty() {
        assert_eq!(check_files(&users), 1);
    }
}

#[test]
fn every_parameter_of_the_csv_file_is_declared_with_its_default() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../../shared/nav/parameters.csv");
    let Ok(text) = std::fs::read_to_string(&path) else {
        return println!("SKIPPED: {} is missing", path.display());
    };
    let mut count = 0;
    for line in text.lines().filter(|line| line.starts_with("nav2_mppi_controller,")) {
        let columns: Vec<&str> = line.split(',').collect();
        let (file, name) = (columns[1], columns[2]);
        let table = match file {
            "trajectory_visualizer" => &periplus_controllers::mppi::params::VISUALIZER,
            "optimal_trajectory_validator" => &periplus_controllers::mppi::params::VALIDATOR,
            "motion_models" => &periplus_controllers::mppi::params::ACKERMANN,
            "critic_function" => CriticKind::Cost.table(),
            file if file.ends_with("_critic") => {
                let words: String = file.split('_').map(capitalized).collect();
                CriticKind::of_name(&words).unwrap_or_else(|| panic!("{words}")).table()
            }
            _ => &periplus_controllers::mppi::params::MPPI,
        };
        if name.contains('.') || name == "forward_preference" {
            continue;
        }
        let parameter = table.find(name).unwrap_or_else(|| panic!("{file} {name}"));
        // The newest release that has a default; Humble's that differ are tested below.
        let newest = columns[5..8].iter().rev().find(|it| !it.is_empty());
        let declared = match parameter.default {
            periplus_params::Default::Value(text) => text,
            _ => "",
        };
        if let (Some(Ok(newest)), Ok(declared)) =
            (newest.map(|it| it.parse::<f64>()), declared.parse::<f64>())
        {
            assert!((newest - declared).abs() < 1e-9, "{file} {name}: {newest} {declared}");
        }
        count += 1;
    }
    assert!(count > 100, "{count}");
}

fn capitalized(word: &str) -> String {
    let (first, rest) = word.split_at(1);
    first.to_uppercase() + rest
}

#[test]
fn defaults_follow_the_release() {
    let defaults = |release| {
        let built = controller(release, &[("critics", "ObstaclesCritic PathAngleCritic")]);
        let value = |name: &str| built.values().number(name).unwrap();
        [value("ObstaclesCritic.collision_cost"), value("PathAngleCritic.max_angle_to_furthest")]
    };
    assert_eq!(defaults(Nav2Release::Humble), [10_000.0, 1.2]);
    assert_eq!(defaults(Nav2Release::Jazzy), [100_000.0, 0.785_398]);
    assert_eq!(defaults(Nav2Release::Main), [100_000.0, 0.785_398]);
}

#[test]
fn motion_models_are_named_by_word_or_group() {
    let model = |release, params: &[(&str, &str)]| controller(release, params).config().model;
    let steered = MppiModel::Ackermann { min_turning_radius_m: 0.7, samples_curvatures: false };
    let group = [
        ("motion_model", "car"),
        ("car.plugin", "mppi::AckermannMotionModel"),
        ("car.min_turning_r", "0.7"),
    ];
    assert_eq!(model(Nav2Release::Main, &group), steered);
    let word = [("motion_model", "Ackermann"), ("AckermannConstraints.min_turning_r", "0.7")];
    assert_eq!(model(Nav2Release::Jazzy, &word), steered);
    assert_eq!(model(Nav2Release::Main, &[]), MppiModel::DiffDrive);
    assert_eq!(model(Nav2Release::Humble, &[("motion_model", "Omni")]), MppiModel::Omni);
}

#[test]
fn mistakes_are_reported_with_their_lines() {
    let critics = "critics: [\"CostCritic\"]\n";
    let check = |text: &str, is_built, expected: &[&str]| {
        check_findings(Nav2Release::Jazzy, &format!("{critics}{text}"), is_built, expected);
    };
    check("vx_max: 0.4", true, &[]);
    check(
        "vx_maxx: 0.4",
        true,
        &["no parameter `vx_maxx`", "nav2.yaml:3:3", "did you mean `vx_max`"],
    );
    check("temperature: 0.0", true, &["out-of-range", "nav2.yaml:3:16"]);
    check("batch_size: 2000.0", true, &["must be a whole number", "write `2000`"]);
    check(
        "motion_model: \"Diffdrive\"",
        false,
        &["no motion model `Diffdrive`", "did you mean `DiffDrive`", "nav2.yaml:3:"],
    );
    check(
        "CostCritc:\n  cost_weight: 1.0",
        true,
        &["no critic or component `CostCritc`", "nav2.yaml:4:"],
    );
    check(
        "GoalCritic:\n  cost_weight: 1.0",
        true,
        &["hint[unused-group]", "`GoalCritic` is not in `FollowPath.critics`"],
    );
    check("ax_min: 3.0", true, &["`FollowPath.ax_min` is positive"]);
    check(
        "model_dt: 0.04",
        false,
        &["longer than `FollowPath.model_dt` 0.04 s", "set `FollowPath.model_dt` to 0.05"],
    );
    check(
        "model_dt: 0.1",
        true,
        &["`FollowPath.model_dt` is 0.1 s, and the controller runs every 0.05 s"],
    );
    let unknown = "critics: [\"CostCritic\", \"GoalCritik\"]";
    check_findings(
        Nav2Release::Main,
        unknown,
        false,
        &["no critic `GoalCritik`", "did you mean `GoalCritic`"],
    );
    check_findings(Nav2Release::Main, "vx_max: 0.4", true, &["`FollowPath.critics` is empty"]);
    let legacy = "critics: [\"PathAlignLegacyCritic\"]";
    check_findings(Nav2Release::Jazzy, legacy, false, &["exists in Humble only"]);
    check_findings(Nav2Release::Humble, legacy, true, &[]);
}

#[test]
fn parameters_that_bound_each_other_are_explained() {
    let check = |params: &[(&str, &str)], expected: &[&str]| {
        let built = controller(Nav2Release::Jazzy, params);
        let codes: Vec<&str> =
            advice(built.config(), "FollowPath").iter().map(|it| it.code).collect();
        assert_eq!(codes, expected, "{params:?}");
    };
    check(&[], &[]);
    check(&[("vx_max", "2.0")], &["narrow-noise", "near-aim"]);
    check(
        &[("vx_max", "2.0"), ("vx_std", "0.8"), ("PathFollowCritic.offset_from_furthest", "12")],
        &[],
    );
    check(&[("ax_min", "-0.1")], &["short-horizon"]);
    check(&[("motion_model", "Ackermann"), ("wz_max", "0.5")], &["slow-turns"]);
    check(&[("vx_min", "0.0"), ("PathAngleCritic.mode", "1")], &["no-reversing"]);
}

#[test]
fn contradictions_with_the_costmap_are_reported() {
    let world = World::new(&[]);
    let codes = |params: &[(&str, &str)], is_circular: bool, radius_m: f64| {
        let built = controller(Nav2Release::Jazzy, params);
        let mut view = world.view();
        view.is_circular = is_circular;
        view.inflation = Some(periplus_costmap::InflationLaw { radius_m, scaling_per_m: 3.0 });
        let mut diagnostics = Diagnostics::new();
        check_costmap(built.config(), "FollowPath", &view, &mut diagnostics);
        diagnostics.iter().map(|it| it.code).collect::<Vec<_>>()
    };
    let outlined = [("CostCritic.consider_footprint", "true")];
    assert_eq!(codes(&[], true, 0.6), [""; 0]);
    assert_eq!(codes(&[], false, 0.6), ["ignored-footprint"]);
    assert_eq!(codes(&outlined, true, 0.6), ["no-footprint"]);
    assert_eq!(codes(&outlined, false, 0.6), [""; 0]);
    assert_eq!(codes(&outlined, false, 0.1), ["small-inflation"]);
    assert_eq!(codes(&[("vx_max", "2.0")], true, 0.6), ["small-costmap"]);
}

#[test]
fn parameters_change_by_the_rules_of_nav2() {
    let mut built = controller(Nav2Release::Main, &[("batch_size", "100")]);
    let number = |value: f64| ParamValue::Number(value);
    built.set_parameter("vx_max", number(0.8)).unwrap();
    built.set_parameter("CostCritic.cost_weight", number(2.0)).unwrap();
    built.set_parameter("batch_size", ParamValue::Integer(50)).unwrap();
    assert_eq!(built.values().number("vx_max"), Some(0.8));
    assert_eq!(built.values().number("CostCritic.cost_weight"), Some(2.0));
    let mut refusal = |name: &str, value| built.set_parameter(name, value).unwrap_err().to_string();
    let error = refusal("critics", ParamValue::Texts(Vec::new()));
    assert!(error.contains("read at the start only"), "{error}");
    let error = refusal("motion_model", ParamValue::Text("Omni".into()));
    assert!(error.contains("read at the start only"), "{error}");
    assert!(refusal("vx_maxx", number(1.0)).contains("no parameter"));
    assert!(refusal("temperature", number(-1.0)).contains("out of range"));
    built.set_speed_limit(0.4, false);
    let error = built.set_parameter("vx_max", number(1.0)).unwrap_err().to_string();
    assert_eq!(
        error,
        "Rejected dynamic update to 'vx_max': speed limit is active. Clear the speed limit first."
    );
    // Others restart the optimizer, which ends the speed limit.
    built.set_parameter("temperature", number(0.4)).unwrap();
    built.set_parameter("vx_max", number(1.0)).unwrap();
    let mut jazzy = controller(Nav2Release::Jazzy, &[("batch_size", "100")]);
    jazzy.set_speed_limit(0.4, false);
    jazzy.set_parameter("vx_max", number(1.0)).unwrap();
}

#[test]
fn parameters_of_other_components_in_the_group_are_ignored() {
    periplus_params::params! {
        /// Another component.
        #[table(SHIM, "a shim")]
        struct ShimParams {
            /// Angle.
            #[param("angular_dist_threshold", unit("rad"))]
            angle_rad: f64 = 0.785,
        }
    }
    let text = [("FollowPath.critics", "CostCritic"), ("FollowPath.angular_dist_threshold", "1.0")];
    let given = || text.iter().map(|(name, text)| Given::new(name, *text));
    let mut diagnostics = Diagnostics::new();
    let others: [&'static periplus_params::Table; 1] = [&SHIM];
    create(&MppiSetup { others: &others, ..setup(Nav2Release::Main) }, given(), &mut diagnostics)
        .unwrap();
    assert!(diagnostics.is_empty(), "{diagnostics:?}");
    create(&setup(Nav2Release::Main), given(), &mut diagnostics).unwrap();
    assert_eq!(diagnostics.iter().count(), 1);
    assert_eq!(ShimParams::default().angle_rad, 0.785);
}
