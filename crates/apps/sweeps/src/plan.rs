//! Plan of a sweep: its jobs with their keys, and the files that they read.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

use periplus_diagnostics::plain_words;
use periplus_os::FileLog;
use periplus_scenarios::{EventAction, Scenario, ScenarioInspection, ScenarioRunOptions, inspect};
use periplus_session::{files, terminal};
use serde::{Deserialize, Serialize};

use crate::error::SweepError;
use crate::folder::SweepFolder;
use crate::inputs::{SweepInputs, relative, sha256};
use crate::names::{ParameterTarget, find};
use crate::range::MAX_RUNS;

/// Version of plans, keys and results.
pub(crate) const FORMAT: u32 = 1;

/// Version of the program.
pub(crate) const VERSION: &str = env!("CARGO_PKG_VERSION");

/// Wish of a user for a sweep.
#[derive(Clone, Debug, Default)]
pub struct SweepRequest {
    /// Scenario file.
    pub scenario: PathBuf,
    /// Values of variables for all runs.
    pub set: Vec<(String, String)>,
    /// Names of the parameters.
    pub names: Vec<String>,
    /// Points of the sweep: values of the parameters.
    pub points: Vec<Vec<String>>,
    /// First seed (default: that of the scenario).
    pub first_seed: Option<u64>,
    /// Number of seeds of each point.
    pub seed_count: usize,
    /// Folders to search for packages, models and meshes.
    pub search_folders: Vec<PathBuf>,
}

/// A job: a run of the scenario.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct SweepJob {
    /// SHA-256 of everything that the run depends on.
    pub key: String,
    /// Values of the swept parameters, as texts.
    pub values: Vec<String>,
    /// Seed.
    pub seed: u64,
    /// Values of variables.
    pub set: Vec<(String, String)>,
    /// Parameters of nodes: full name of the node, parameter, value.
    pub parameters: Vec<[String; 3]>,
    /// Number of its list of files in the plan.
    pub file_list: usize,
}

/// Plan of a sweep.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct SweepPlan {
    /// Version of the format.
    pub format: u32,
    /// Version of the program.
    pub version: String,
    /// Name of the scenario.
    pub name: String,
    /// Scenario file, as the user wrote it.
    pub scenario: PathBuf,
    /// Absolute path of the scenario file.
    pub scenario_file: PathBuf,
    /// Working folder, absolute.
    pub working_folder: PathBuf,
    /// Folders to search for packages, models and meshes, absolute.
    pub search_folders: Vec<PathBuf>,
    /// Names of the parameters, as the user wrote them.
    pub names: Vec<String>,
    /// Variables or parameters of nodes that the names set.
    pub targets: Vec<ParameterTarget>,
    /// Files of all jobs.
    pub inputs: SweepInputs,
    /// Lists of files: numbers in `inputs.files`.
    pub file_lists: Vec<Vec<usize>>,
    /// Jobs in the order of the table: the points in their order, and the seeds of each.
    pub jobs: Vec<SweepJob>,
}

impl SweepPlan {
    /// Makes a plan: reads the scenario, finds the parameters, checks all values, and copies the files that the runs
    /// read to the folder of the sweep.
    ///
    /// # Errors
    /// Mistakes of the scenario, unknown names, values that a node refuses, and files that cannot be read or written.
    pub fn make(request: &SweepRequest, folder: &SweepFolder) -> Result<Self, SweepError> {
        let run_count = request.points.len().checked_mul(request.seed_count);
        if run_count.is_none_or(|count| count > MAX_RUNS || count == 0) {
            let (points, seeds) = (request.points.len(), request.seed_count);
            return Err(SweepError::Usage(format!(
                "{points} points with {seeds} seeds each: a sweep has 1 to {MAX_RUNS} runs"
            )));
        }
        let mut planner = Planner::start(request)?;
        let targets = planner.targets()?;
        let mut settings = Vec::with_capacity(request.points.len());
        for point in &request.points {
            settings.push(planner.setting(&targets, point)?);
        }
        let log = planner.whole_log();
        let (inputs, contents) = SweepInputs::of_log(log)?;
        folder.create()?;
        inputs.write_tree(&folder.tree(&inputs), &contents)?;
        let (file_lists, list_of_point) = planner.file_lists(&settings, &inputs);
        let working_folder = terminal::working_folder();
        let mut plan = Self {
            format: FORMAT,
            version: VERSION.to_owned(),
            name: planner.base.name.clone(),
            scenario: request.scenario.clone(),
            scenario_file: periplus_os::plain(&request.scenario),
            search_folders: request
                .search_folders
                .iter()
                .map(|it| working_folder.join(it))
                .collect(),
            working_folder,
            names: request.names.clone(),
            targets,
            inputs,
            file_lists,
            jobs: Vec::new(),
        };
        let first = request.first_seed.unwrap_or(planner.base.params.seed.unsigned_abs());
        let each = request.points.iter().zip(settings).zip(list_of_point);
        for ((values, setting), file_list) in each {
            for number in 0..request.seed_count as u64 {
                let mut job = SweepJob {
                    key: String::new(),
                    values: values.clone(),
                    seed: first.wrapping_add(number),
                    set: setting.set.clone(),
                    parameters: setting.parameters.clone(),
                    file_list,
                };
                job.key = plan.key(&job);
                plan.jobs.push(job);
            }
        }
        Ok(plan)
    }

    /// Key of a job: the SHA-256 of a text with the version, the files and their contents, the environment variables,
    /// the values and the seed.
    fn key(&self, job: &SweepJob) -> String {
        let mut text = format!("periplus sweep {}\nversion {}\n", self.format, self.version);
        let folder = self.scenario_file.parent().unwrap_or(Path::new(""));
        text.push_str(&format!("scenario {}\n", relative(&self.scenario_file, folder)));
        for number in &self.file_lists[job.file_list] {
            let file = &self.inputs.files[*number];
            text.push_str(&format!("file {} {}\n", file.sha256, relative(&file.path, folder)));
        }
        for (name, value) in self.inputs.plain_variables() {
            text.push_str(&format!("environment {name:?} {value:?}\n"));
        }
        let set: BTreeMap<_, _> = job.set.iter().cloned().collect();
        for (name, value) in set {
            text.push_str(&format!("variable {name:?} {value:?}\n"));
        }
        let parameters: BTreeSet<_> = job.parameters.iter().collect();
        for [node, name, value] in parameters {
            text.push_str(&format!("parameter {node:?} {name:?} {value:?}\n"));
        }
        text.push_str(&format!("seed {}\n", job.seed));
        sha256(text.as_bytes())
    }

    /// Name of the plan: it changes with every job.
    #[must_use]
    pub fn id(&self) -> String {
        let keys: Vec<&str> = self.jobs.iter().map(|job| job.key.as_str()).collect();
        sha256(keys.join("\n").as_bytes())[..12].to_owned()
    }

    /// Reads a plan from JSON.
    ///
    /// # Errors
    /// A text that is no plan, or the plan of another version of the program.
    pub fn from_json(text: &str) -> Result<Self, SweepError> {
        let plan: Self = serde_json::from_str(text).map_err(|error| {
            SweepError::Failed(format!("this is not the plan of a sweep: {error}"))
        })?;
        if plan.format != FORMAT || plan.version != VERSION {
            return Err(SweepError::Failed(format!(
                "the plan is of Periplus {}, and this is {VERSION}: the versions must be equal on all machines",
                plan.version
            )));
        }
        let is_whole = plan.jobs.iter().all(|job| job.file_list < plan.file_lists.len())
            && plan.file_lists.iter().flatten().all(|number| *number < plan.inputs.files.len());
        if !is_whole {
            return Err(SweepError::Failed("the plan of the sweep is damaged".to_owned()));
        }
        Ok(plan)
    }

    /// JSON of the plan.
    #[must_use]
    pub fn to_json(&self) -> String {
        let text = serde_json::to_string(self);
        debug_assert!(text.is_ok(), "a plan is plain data");
        text.unwrap_or_default()
    }
}

/// Values of one point for the scenario.
#[derive(Clone, Debug, Default)]
struct Setting {
    /// Variables, with those of all runs.
    set: Vec<(String, String)>,
    parameters: Vec<[String; 3]>,
    /// Numbers of the logs with its files.
    logs: BTreeSet<usize>,
}

/// Scenario that is inspected while a plan is made.
struct Planner<'a> {
    request: &'a SweepRequest,
    text: String,
    base: Scenario,
    inspection: ScenarioInspection,
    /// Logs of file accesses; the first is that of the scenario without swept values.
    logs: Vec<FileLog>,
    /// Log of a value of a variable.
    log_of_value: BTreeMap<(String, String), usize>,
    /// Values of parameters of nodes that were checked: node, parameter, value.
    checked: BTreeSet<[String; 3]>,
}

impl<'a> Planner<'a> {
    fn start(request: &'a SweepRequest) -> Result<Self, SweepError> {
        FileLog::start();
        let started = files::text(&request.scenario).map_err(SweepError::from).and_then(|text| {
            let base = Scenario::read(&request.scenario, text.clone(), &request.set)?;
            let inspection = inspect(&base, &options(request))?;
            Ok((text, base, inspection))
        });
        let log = FileLog::take();
        let (text, base, inspection) = started?;
        Ok(Self {
            request,
            text,
            base,
            inspection,
            logs: vec![log],
            log_of_value: BTreeMap::new(),
            checked: BTreeSet::new(),
        })
    }

    fn targets(&self) -> Result<Vec<ParameterTarget>, SweepError> {
        let nodes = self.inspection.parameters();
        let found = self.request.names.iter().map(|name| find(name, &self.base.variables, &nodes));
        found.collect::<Result<_, _>>().map_err(SweepError::Usage)
    }

    fn setting(
        &mut self,
        targets: &[ParameterTarget],
        point: &[String],
    ) -> Result<Setting, SweepError> {
        if point.len() != targets.len() {
            let (has, needs) = (point.len(), targets.len());
            return Err(SweepError::Usage(format!(
                "a point has {has} values; there are {needs} parameters"
            )));
        }
        let mut setting = Setting { set: self.request.set.clone(), ..Setting::default() };
        setting.logs.insert(0);
        for (target, value) in targets.iter().zip(point) {
            match target {
                ParameterTarget::Variable(name) => {
                    setting.logs.insert(self.log_of(name, value)?);
                    setting.set.retain(|(other, _)| other != name);
                    setting.set.push((name.clone(), value.clone()));
                }
                ParameterTarget::Parameters(all) => {
                    for (node, parameter) in all {
                        self.check(node, parameter, value)?;
                        setting.parameters.push([node.clone(), parameter.clone(), value.clone()]);
                    }
                }
            }
        }
        Scenario::read(&self.request.scenario, self.text.clone(), &setting.set)?;
        Ok(setting)
    }

    /// Number of the log of a value of a variable. A scenario that names the same files is not started again.
    fn log_of(&mut self, name: &str, value: &str) -> Result<usize, SweepError> {
        let key = (name.to_owned(), value.to_owned());
        if let Some(number) = self.log_of_value.get(&key) {
            return Ok(*number);
        }
        let mut set = self.request.set.clone();
        set.retain(|(other, _)| other != name);
        set.push(key.clone());
        let scenario = Scenario::read(&self.request.scenario, self.text.clone(), &set)?;
        let number = if file_names(&scenario) == file_names(&self.base) {
            0
        } else {
            FileLog::start();
            let inspected = inspect(&scenario, &options(self.request));
            let log = FileLog::take();
            inspected.map_err(|error| SweepError::Failed(format!("`{name}={value}`: {error}")))?;
            self.logs.push(log);
            self.logs.len() - 1
        };
        self.log_of_value.insert(key, number);
        Ok(number)
    }

    /// Checks a value for a parameter of a node, once.
    fn check(&mut self, node: &str, parameter: &str, value: &str) -> Result<(), SweepError> {
        let key = [node, parameter, value].map(str::to_owned);
        if self.checked.contains(&key) {
            return Ok(());
        }
        self.inspection.check(node, parameter, value).map_err(|reason| {
            let node = node.trim_start_matches('/');
            SweepError::Usage(format!("`{node}.{parameter}={value}`: {reason}"))
        })?;
        self.checked.insert(key);
        Ok(())
    }

    fn whole_log(&self) -> FileLog {
        let mut whole = FileLog::default();
        for log in &self.logs {
            whole.extend(log.clone());
        }
        whole
    }

    /// Different lists of files, and the number of the list of each point.
    fn file_lists(
        &self,
        settings: &[Setting],
        inputs: &SweepInputs,
    ) -> (Vec<Vec<usize>>, Vec<usize>) {
        let mut lists: Vec<Vec<usize>> = Vec::new();
        let mut number_of: BTreeMap<&BTreeSet<usize>, usize> = BTreeMap::new();
        let mut of_point = Vec::with_capacity(settings.len());
        for setting in settings {
            let number = *number_of.entry(&setting.logs).or_insert_with(|| {
                let is_used = |path: &PathBuf| {
                    setting.logs.iter().any(|it| self.logs[*it].read.contains(path))
                };
                let all = inputs.files.iter().enumerate();
                lists.push(
                    all.filter(|(_, file)| is_used(&file.path)).map(|(number, _)| number).collect(),
                );
                lists.len() - 1
            });
            of_point.push(number);
        }
        (lists, of_point)
    }
}

fn options(request: &SweepRequest) -> ScenarioRunOptions {
    let search = terminal::search(&request.search_folders);
    ScenarioRunOptions { threads: 1, search, ..ScenarioRunOptions::default() }
}

/// Parts of a scenario that decide which files it reads.
fn file_names(scenario: &Scenario) -> String {
    let spawned = scenario.events.iter().filter_map(|event| match &event.action {
        EventAction::Spawn(spawn) => Some(&spawn.file),
        _ => None,
    });
    let spawned: Vec<&String> = spawned.collect();
    let (world, robot, nodes) = (&scenario.params.world, &scenario.robot, &scenario.nodes);
    format!("{world:?} {robot:?} {nodes:?} {:?} {spawned:?}", scenario.parameters)
}

/// Values of points from JSON: a list of mappings with the same names.
///
/// # Errors
/// Another content.
pub(crate) fn read_points(text: &str) -> Result<(Vec<String>, Vec<Vec<String>>), SweepError> {
    let usage = "the points are a JSON list such as [{\"loss\": 0.1}, {\"loss\": 0.2}]";
    let bad = |reason: String| SweepError::Usage(format!("{reason}; {usage}"));
    let all: Vec<BTreeMap<String, serde_json::Value>> =
        serde_json::from_str(text).map_err(|error| bad(plain_json(&error)))?;
    let names: Vec<String> = all.first().map(|it| it.keys().cloned().collect()).unwrap_or_default();
    let mut points = Vec::with_capacity(all.len());
    for (index, point) in all.iter().enumerate() {
        if !point.keys().eq(names.iter()) {
            return Err(bad(format!(
                "point {} has other parameters than the first one",
                index + 1
            )));
        }
        let text = |value: &serde_json::Value| match value {
            serde_json::Value::String(text) => text.clone(),
            other => other.to_string(),
        };
        points.push(point.values().map(text).collect());
    }
    Ok((names, points))
}

fn plain_json(error: &serde_json::Error) -> String {
    let reason = error.to_string();
    match error.io_error_kind() {
        Some(kind) => plain_words(&std::io::Error::from(kind)),
        None => reason,
    }
}

impl SweepRequest {
    /// Sets the points from JSON: a list of mappings from the names of parameters to values.
    ///
    /// # Errors
    /// Another content.
    pub fn with_points(self, json: &str) -> Result<Self, SweepError> {
        let (names, points) = read_points(json)?;
        Ok(Self { names, points, ..self })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_are_mappings_with_the_same_names() {
        let (names, points) =
            read_points(r#"[{"a": 1, "b": "x"}, {"b": true, "a": 0.5}]"#).unwrap();
        assert_eq!(names, ["a", "b"]);
        assert_eq!(points, [["1", "x"], ["0.5", "true"]]);
        assert!(
            read_points(r#"[{"a": 1}, {"b": 2}]"#).unwrap_err().to_string().contains("point 2")
        );
        assert!(read_points("{}").unwrap_err().to_string().contains("JSON list"));
    }
}
