//! Every robot and world of the corpus for Gazebo Harmonic: converted, loaded by libsdformat, compared in a run.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use serde_json::Value;

use crate::parallel::for_all;
use crate::step::{Failed, build_native, copy_folder, root, run, timed};

/// Kinds of files in the index of the corpus.
const KINDS: [&str; 4] = ["xacro", "urdf", "sdf", "world"];

/// Arguments without a default, by a part of the file name.
const ARGUMENTS: [(&str, &[&str]); 1] =
    [("andino_gz_classic.xacro", &["use_gazebo_ros_control:=false"])];

/// Options of `cargo xtask migration`.
#[derive(Debug, clap::Args)]
pub(crate) struct Options {
    /// Only files whose paths contain this
    only: Option<String>,
    /// Leave out the comparison runs
    #[arg(long)]
    no_compare: bool,
    /// Program to test, in place of a release build
    #[arg(long, value_name = "FILE")]
    program: Option<PathBuf>,
    /// Files at a time
    #[arg(long, default_value_t = 2)]
    jobs: usize,
}

/// Result of one file.
struct Trial {
    file: PathBuf,
    report: Option<Value>,
    /// Findings of a file that was not converted.
    log: String,
}

/// Converts all files, asks libsdformat about the results, and prints the counts.
pub(crate) fn run_all(options: &Options) -> Result<(), Failed> {
    let Ok(corpus) = root().join("../shared/corpus").canonicalize() else {
        println!("SKIPPED: there is no ../shared/corpus to convert");
        return Ok(());
    };
    let program = match &options.program {
        Some(program) => program.clone(),
        None => build_native()?,
    };
    let folder = root().join("target/migration");
    let work = Work { corpus, folder, program };
    let files = work.listed(options.only.as_deref())?;
    // Reports of an earlier run would be counted as of this one.
    let _ = fs::remove_dir_all(work.folder.join("out"));
    println!("{} files", files.len());
    let new = work.folder.join("corpus");
    work.link(&work.corpus)?;
    work.link(&new)?;
    let trials = for_all(&files, options.jobs, |file| work.convert(file, options.no_compare));
    work.replace(&trials, &new)?;
    let oracle = work.folder.join("bin/sdf_oracle");
    let built = timed("libsdformat: build the oracle", || work.build());
    let loads = match built {
        Ok(()) => Some(work.judge(&trials, &new, &oracle)?),
        Err(error) => {
            println!("SKIPPED: libsdformat does not judge: {}", error.0);
            None
        }
    };
    count(&trials, loads.as_ref(), &work.corpus)
}

struct Work {
    corpus: PathBuf,
    folder: PathBuf,
    program: PathBuf,
}

impl Work {
    fn listed(&self, only: Option<&str>) -> Result<Vec<PathBuf>, Failed> {
        let index = self.corpus.join("INDEX.csv");
        let text = fs::read_to_string(&index)
            .map_err(|error| Failed(format!("cannot read {}: {error}", index.display())))?;
        let rows = text.lines().skip(1).filter_map(|row| {
            let mut cells = row.split(',');
            Some((cells.next()?, cells.next()?))
        });
        Ok(rows
            .filter(|(file, kind)| {
                KINDS.contains(kind) && only.is_none_or(|part| file.contains(part))
            })
            .map(|(file, _)| self.corpus.join(file))
            .collect())
    }

    /// Folder of the repository that a file of the corpus, or of a copy of it, comes from.
    fn repository(&self, file: &Path, corpus: &Path) -> PathBuf {
        let inside = file.strip_prefix(corpus).unwrap_or(file);
        inside.components().next().map_or_else(|| corpus.to_owned(), |first| corpus.join(first))
    }

    fn periplus(&self, file: &Path, corpus: &Path) -> Command {
        let mut command = Command::new(&self.program);
        command.arg("convert").arg(file).arg("--resource-path").arg(self.repository(file, corpus));
        let shown = file.display().to_string();
        for (_, arguments) in ARGUMENTS.iter().filter(|(name, _)| shown.contains(name)) {
            command.args(*arguments);
        }
        command.arg("--resource-path").arg(corpus.join("gazebo_models"));
        command.arg("--resource-path").arg(self.packages(corpus));
        command
    }

    /// Folder of packages whose folders have other names in the corpus: the PR2 asks for the package `xacro`.
    fn packages(&self, corpus: &Path) -> PathBuf {
        let side = if corpus == self.corpus { "old" } else { "new" };
        self.folder.join("packages").join(side)
    }

    /// Links the packages of [`Work::packages`].
    fn link(&self, corpus: &Path) -> Result<(), Failed> {
        let folder = self.packages(corpus);
        let failed = |error: std::io::Error| Failed(format!("{}: {error}", folder.display()));
        let _ = fs::remove_dir_all(&folder);
        fs::create_dir_all(&folder).map_err(failed)?;
        #[cfg(unix)]
        std::os::unix::fs::symlink(corpus.join("xacro_tests"), folder.join("xacro"))
            .map_err(failed)?;
        Ok(())
    }

    fn convert(&self, file: &Path, no_compare: bool) -> Trial {
        let inside = file.strip_prefix(&self.corpus).unwrap_or(file);
        let out = self.folder.join("out").join(inside);
        let mut command = self.periplus(file, &self.corpus);
        command.args(["--to", "harmonic", "--json", "--out"]).arg(&out);
        if no_compare {
            command.arg("--no-compare");
        }
        let output = command.output();
        let (report, log) = match output {
            Ok(output) => (
                serde_json::from_slice(&output.stdout).ok(),
                String::from_utf8_lossy(&output.stderr).into_owned(),
            ),
            Err(error) => (None, error.to_string()),
        };
        Trial { file: file.to_owned(), report, log }
    }

    /// A copy of the corpus with the new files in place of the old ones.
    fn replace(&self, trials: &[Trial], new: &Path) -> Result<(), Failed> {
        let failed = |error: std::io::Error| Failed(format!("{}: {error}", new.display()));
        copy_folder(&self.corpus, new, |_| true).map_err(failed)?;
        for trial in trials.iter().filter(|trial| is_converted(trial)) {
            let inside = trial.file.strip_prefix(&self.corpus).unwrap_or(&trial.file);
            let out = self.folder.join("out").join(inside);
            let Some(report) = &trial.report else { continue };
            for file in report["files"].as_array().into_iter().flatten() {
                let (Some(path), Some(old)) = (file["path"].as_str(), file["replaces"].as_str())
                else {
                    continue;
                };
                let Ok(inside) = Path::new(old).strip_prefix(&self.corpus) else { continue };
                fs::copy(out.join(path), new.join(inside)).map_err(failed)?;
            }
        }
        Ok(())
    }

    fn build(&self) -> Result<(), Failed> {
        let build = root().join("benches/oracles/build.sh");
        let help = "install libsdformat-dev and liburdfdom-dev";
        run(Command::new("sh").arg(build).arg(self.folder.join("bin")), help)
    }

    /// Errors of libsdformat for the old and the new files, by the old file.
    fn judge(
        &self,
        trials: &[Trial],
        new: &Path,
        oracle: &Path,
    ) -> Result<BTreeMap<PathBuf, [Option<String>; 2]>, Failed> {
        let converted: Vec<&Trial> = trials.iter().filter(|trial| is_converted(trial)).collect();
        let mut errors: BTreeMap<PathBuf, [Option<String>; 2]> = BTreeMap::new();
        for (side, corpus) in [(0, self.corpus.as_path()), (1, new)] {
            let mut jobs = String::new();
            let mut of_job: BTreeMap<String, PathBuf> = BTreeMap::new();
            for (number, trial) in converted.iter().enumerate() {
                let inside = trial.file.strip_prefix(&self.corpus).unwrap_or(&trial.file);
                let file = corpus.join(inside);
                let extension = file.extension().and_then(|it| it.to_str()).unwrap_or_default();
                let job = if matches!(extension, "sdf" | "world" | "model") {
                    file.display().to_string()
                } else {
                    let urdf = self.folder.join(format!("urdf/{side}-{number}.urdf"));
                    if !self.expand(&file, corpus, &urdf) {
                        continue;
                    }
                    format!("{}\t{}", urdf.display(), file.display())
                };
                let name = job.split('\t').next().unwrap_or_default().to_owned();
                of_job.insert(name, trial.file.clone());
                jobs.push_str(&job);
                jobs.push('\n');
            }
            for answer in self.ask(oracle, &jobs, corpus)? {
                let Some(file) = answer["file"].as_str().and_then(|file| of_job.get(file)) else {
                    continue;
                };
                let entry = errors.entry(file.clone()).or_default();
                let first = answer["errors"][0]["message"].as_str();
                let message = answer["crash"].as_str().or(first).unwrap_or("not loaded");
                if answer["root_ok"] != Value::Bool(true) {
                    entry[side] = Some(message.to_owned());
                }
            }
        }
        Ok(errors)
    }

    /// Expands xacro; false for a file that is only for inclusion.
    fn expand(&self, file: &Path, corpus: &Path, urdf: &Path) -> bool {
        if let Some(folder) = urdf.parent() {
            let _ = fs::create_dir_all(folder);
        }
        let mut command = self.periplus(file, corpus);
        command.args(["--to", "urdf", "--output"]).arg(urdf);
        let status = command.stderr(Stdio::null()).stdout(Stdio::null()).status();
        let has_link = fs::read_to_string(urdf).is_ok_and(|text| text.contains("<link "));
        status.is_ok_and(|status| status.success()) && has_link
    }

    fn ask(&self, oracle: &Path, jobs: &str, corpus: &Path) -> Result<Vec<Value>, Failed> {
        let failed = |error: std::io::Error| Failed(format!("{}: {error}", oracle.display()));
        let input = self.folder.join("sdf.jobs");
        fs::write(&input, jobs).map_err(failed)?;
        let folders = [
            corpus.join("gazebo_models"),
            corpus.join("sdformat14_tests/test/integration/model"),
            root().join("benches/oracles/models"),
        ];
        let folders: Vec<String> =
            folders.iter().map(|folder| folder.display().to_string()).collect();
        let output = Command::new(oracle)
            .env("PERIPLUS_ORACLE_ROOT", corpus)
            .env("PERIPLUS_ORACLE_PATH", folders.join(":"))
            .stdin(fs::File::open(&input).map_err(failed)?)
            .stderr(Stdio::null())
            .output()
            .map_err(failed)?;
        let text = String::from_utf8_lossy(&output.stdout).into_owned();
        Ok(text.lines().filter_map(|line| serde_json::from_str(line).ok()).collect())
    }
}

fn is_converted(trial: &Trial) -> bool {
    trial.report.as_ref().is_some_and(|report| report["is_current"] == Value::Bool(false))
}

/// Prints the counts and what is not explained.
fn count(
    trials: &[Trial],
    loads: Option<&BTreeMap<PathBuf, [Option<String>; 2]>>,
    corpus: &Path,
) -> Result<(), Failed> {
    let shown = |file: &Path| file.strip_prefix(corpus).unwrap_or(file).display().to_string();
    let unread: Vec<&Trial> = trials.iter().filter(|trial| trial.report.is_none()).collect();
    let converted: Vec<&Trial> = trials.iter().filter(|trial| is_converted(trial)).collect();
    println!("files: {}", trials.len());
    println!("  cannot be read or are for inclusion only: {}", unread.len());
    for trial in &unread {
        println!("    {}: {}", shown(&trial.file), trial.log.lines().next().unwrap_or_default());
    }
    println!("  have nothing of Gazebo Classic: {}", trials.len() - unread.len() - converted.len());
    println!("  converted: {}", converted.len());
    let mut outcomes: BTreeMap<String, usize> = BTreeMap::new();
    let mut missing: BTreeMap<String, usize> = BTreeMap::new();
    let mut elements = BTreeSet::new();
    for element in converted.iter().flat_map(|trial| entries(trial)) {
        // Files are included by several robots.
        if !elements
            .insert(format!("{}:{}:{}", element["file"], element["line"], element["column"]))
        {
            continue;
        }
        let outcome = element["outcome"].as_str().unwrap_or_default();
        *outcomes.entry(outcome.to_owned()).or_default() += 1;
        if outcome == "no_counterpart" {
            *missing.entry(element["old"].as_str().unwrap_or_default().to_owned()).or_default() +=
                1;
        }
    }
    for (outcome, count) in &outcomes {
        println!("    elements {outcome}: {count}");
    }
    for (old, count) in &missing {
        println!("      {old}: {count}");
    }
    let mut faults = Vec::new();
    if let Some(loads) = loads {
        let mut counts = [0; 3];
        for (file, [old, new]) in loads {
            match (old, new) {
                (_, None) => counts[0] += 1,
                (Some(_), Some(error)) => {
                    counts[1] += 1;
                    println!("    old and new fail in libsdformat: {}: {error}", shown(file));
                }
                (None, Some(error)) => {
                    counts[2] += 1;
                    faults.push(format!("{}: libsdformat: {error}", shown(file)));
                }
            }
        }
        println!("  asked libsdformat 12: {}", loads.len());
        println!("    load without error: {}", counts[0]);
        println!("    fail, as the old file does: {}", counts[1]);
        println!("    fail, the old file loads: {}", counts[2]);
    }
    let mut verdicts: BTreeMap<&str, usize> = BTreeMap::new();
    let mut topics: BTreeMap<&str, usize> = BTreeMap::new();
    let mut reasons: BTreeMap<String, usize> = BTreeMap::new();
    // By type: topics whose values are equal, and those whose values differ for a reason.
    let mut values: BTreeMap<String, [usize; 2]> = BTreeMap::new();
    for trial in &converted {
        let Some(report) = &trial.report else { continue };
        let comparison = &report["comparison"];
        let verdict = comparison["verdict"].as_str().unwrap_or("not run");
        *verdicts.entry(verdict).or_default() += 1;
        for topic in comparison["topics"].as_array().into_iter().flatten() {
            *topics.entry(topic["verdict"].as_str().unwrap_or_default()).or_default() += 1;
            let kind = topic["types"][0].as_str().unwrap_or_default();
            let differs = |difference: &Value| {
                ["values", "presence", "type"]
                    .contains(&difference["aspect"].as_str().unwrap_or_default())
            };
            let differences = topic["differences"].as_array();
            let has_other_values = differences.into_iter().flatten().any(differs);
            values.entry(kind.to_owned()).or_default()[usize::from(has_other_values)] += 1;
            for difference in topic["differences"].as_array().into_iter().flatten() {
                let name = shown(&trial.file);
                let words =
                    format!("{} {}: {}", topic["topic"], difference["aspect"], difference["text"]);
                match difference["reason"].as_str() {
                    None => faults.push(format!("{name}: {words}")),
                    Some(reason) => {
                        let reason = reason.split(':').next().unwrap_or(reason);
                        let short = format!("{kind} {}: {reason}", difference["aspect"]);
                        *reasons.entry(short).or_default() += 1;
                    }
                }
            }
        }
        for difference in comparison["differences"].as_array().into_iter().flatten() {
            if difference["reason"].is_null() {
                faults.push(format!("{}: {}", shown(&trial.file), difference["text"]));
            }
        }
        if comparison["state"] == "not_run" {
            *reasons.entry(format!("not run: {}", comparison["reason"])).or_default() += 1;
        }
    }
    println!("  comparison runs of files: {verdicts:?}");
    println!("  compared topics: {topics:?}");
    for (kind, [equal, different]) in &values {
        println!("    {kind}: values of {equal} topics within the tolerance, of {different} not");
    }
    for (reason, count) in &reasons {
        println!("    {count} x {reason}");
    }
    println!("  not explained: {}", faults.len());
    if faults.is_empty() { Ok(()) } else { Err(Failed(faults.join("\n       "))) }
}

fn entries(trial: &Trial) -> impl Iterator<Item = &Value> {
    trial.report.iter().flat_map(|report| report["elements"].as_array().into_iter().flatten())
}
