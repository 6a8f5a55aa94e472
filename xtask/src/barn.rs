//! The BARN challenge: a Jackal drives ten metres through fields of cylinders, without a map.
//!
//! Source of the rules and of both scores: `run.py` and `report_test.py` of the BARN challenge.

mod course;
mod score;

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::Instant;

use serde_json::Value;

use self::course::Course;
use self::score::{Outcome, Summary};
use crate::parallel::for_all;
use crate::step::{Failed, root, run};

/// Robot of the challenge, in the corpus.
const ROBOT: &str = "corpus/jackal/jackal_description/urdf/jackal.urdf.xacro";

/// Options of the lidar of the robot, as in `gazebo_launch.launch` of the challenge.
const LIDAR: [(&str, &str); 3] = [
    ("JACKAL_LASER", "1"),
    ("JACKAL_LASER_MODEL", "ust10"),
    ("JACKAL_LASER_OFFSET", "-0.065 0 0.01"),
];

/// Drive of a run: start in the world, goal ahead of it, and the largest speed of the robot.
const DRIVE: [&str; 10] = [
    "--pose=-2.25,3,1.57",
    "--no-map",
    "--goal=10,0",
    "--max-speed=2.0",
    "--arrival-radius=1.0",
    "--end-at-collision",
    "--timeout=100",
    "--threads=1",
    "--json",
    "--quiet",
];

/// Worlds and number of the runs.
pub(crate) struct Plan {
    /// Folder of the worlds, with `index.json`; that of the shared data without one.
    pub(crate) worlds: Option<PathBuf>,
    /// Runs of each world.
    pub(crate) seeds: u64,
    /// Every n-th world only.
    pub(crate) every: usize,
    /// Run everything twice and compare the bags.
    pub(crate) twice: bool,
    /// Runs at a time.
    pub(crate) jobs: usize,
}

/// Outcome of a run, and the checksum of its bag if that is compared.
type Recorded = (Outcome, Option<Vec<u8>>);

/// A run of a world with a seed.
struct Run<'a> {
    course: &'a Course,
    seed: u64,
}

/// Runs all and prints the scores; without the data it prints that it was skipped.
pub(crate) fn evaluate(plan: &Plan) -> Result<(), Failed> {
    let shared = root().join("../shared");
    let worlds = plan.worlds.clone().unwrap_or_else(|| shared.join("nav/barn"));
    let robot = shared.join(ROBOT);
    if !worlds.join("index.json").is_file() || !robot.is_file() {
        println!("SKIPPED: the worlds ({}) or the robot ({ROBOT}) are missing", worlds.display());
        return Ok(());
    }
    let folder = root().join("target/barn");
    let setup = Setup::prepare(&folder, &shared, robot)?;
    let courses = course::read(&worlds, &folder, plan.every.max(1))?;
    let mut build = crate::step::cargo();
    run(build.args(["build", "--release", "--package", "periplus-cli"]), "correct the errors")?;
    let runs: Vec<Run<'_>> = courses
        .iter()
        .flat_map(|course| (0..plan.seeds).map(move |seed| Run { course, seed }))
        .collect();
    let begin = Instant::now();
    let first = setup.all(&runs, plan)?;
    let wall_s = begin.elapsed().as_secs_f64();
    score::print_table(&runs_by_world(&runs, &first));
    let outcomes = first.iter().map(|(outcome, _)| outcome);
    println!("{}", Summary::of("Periplus", outcomes));
    if let Ok(text) = fs::read_to_string(worlds.join("dwa_out.txt")) {
        score::print_baseline(&text, &courses);
    }
    println!("{} runs in {wall_s:.0} s, {} at a time", runs.len(), plan.jobs);
    if plan.twice {
        let second = setup.all(&runs, plan)?;
        let differing = first.iter().zip(&second).filter(|((_, one), (_, two))| one != two).count();
        if differing > 0 {
            return Err(Failed(format!("{differing} of {} runs gave another bag", runs.len())));
        }
        println!("all {} bags are equal in a second round", runs.len());
    }
    Ok(())
}

fn runs_by_world<'a>(runs: &[Run<'_>], results: &'a [Recorded]) -> BTreeMap<u64, Vec<&'a Outcome>> {
    let mut found: BTreeMap<u64, Vec<&Outcome>> = BTreeMap::new();
    for (run, (outcome, _)) in runs.iter().zip(results) {
        found.entry(run.course.world).or_default().push(outcome);
    }
    found
}

/// Files and program of all runs.
struct Setup {
    folder: PathBuf,
    packages: PathBuf,
    corpus: PathBuf,
    parameters: PathBuf,
    robot: PathBuf,
    program: PathBuf,
}

impl Setup {
    fn prepare(folder: &Path, shared: &Path, robot: PathBuf) -> Result<Self, Failed> {
        let packages = folder.join("packages");
        for (package, files) in course::EMPTY_PACKAGES {
            write(&packages.join(package).join("package.xml"), &course::manifest(package))?;
            for file in files {
                write(&packages.join(package).join("urdf").join(file), course::EMPTY_XACRO)?;
            }
        }
        let parameters = folder.join("controllers.yaml");
        write(&parameters, course::CONTROLLERS)?;
        let program =
            root().join("target/release").join(format!("periplus{}", std::env::consts::EXE_SUFFIX));
        let corpus = shared.join("corpus/jackal");
        Ok(Self { folder: folder.to_owned(), packages, corpus, parameters, robot, program })
    }

    /// Runs all, several at a time; the results are in the order of the runs.
    fn all(&self, runs: &[Run<'_>], plan: &Plan) -> Result<Vec<Recorded>, Failed> {
        let results = for_all(runs, plan.jobs, |one| self.one(one, plan.twice));
        results.into_iter().collect()
    }

    /// Runs one, with its bag if asked.
    fn one(&self, one: &Run<'_>, keeps_bag: bool) -> Result<Recorded, Failed> {
        let Run { course, seed } = one;
        let bag = self.folder.join(format!("world_{}-{seed}.mcap", course.world));
        let mut command = Command::new(&self.program);
        command.arg("navigate").arg(&course.file).arg("--robot").arg(&self.robot).args(DRIVE);
        for path in [&self.packages, &self.corpus] {
            command.arg("--resource-path").arg(path);
        }
        command.arg("--seed").arg(seed.to_string()).envs(LIDAR);
        if keeps_bag {
            command.arg("--record").arg(&bag);
        }
        command.args(["--ros-args", "--params-file"]).arg(&self.parameters);
        let failed = |what: String| Failed(format!("world {}, seed {seed}: {what}", course.world));
        let done = command.output().map_err(|error| failed(error.to_string()))?;
        let report: Value = serde_json::from_slice(&done.stdout)
            .map_err(|_| failed(String::from_utf8_lossy(&done.stderr).into_owned()))?;
        let bytes = keeps_bag.then(|| fs::read(&bag)).transpose();
        let bytes = bytes.map_err(|error| failed(format!("{}: {error}", bag.display())))?;
        if keeps_bag {
            let _ = fs::remove_file(&bag);
        }
        Ok((Outcome::read(&report, course.optimal_s), bytes.map(|bytes| score::digest(&bytes))))
    }
}

fn write(path: &Path, text: &str) -> Result<(), Failed> {
    let failed = |error: std::io::Error| Failed(format!("{}: {error}", path.display()));
    if let Some(folder) = path.parent() {
        fs::create_dir_all(folder).map_err(failed)?;
    }
    fs::write(path, text).map_err(failed)
}
