//! Random goals: robots drive with Nav2's own parameters, localized by AMCL on maps that SLAM made, in several worlds.

mod courses;
mod robots;

use std::fmt;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::Instant;

use serde_json::Value;

use self::courses::Course;
use self::robots::{PreparedRobot, Robot};
use crate::parallel::for_all;
use crate::step::{Failed, cargo, root, run};

/// Runs of the command.
pub(crate) struct Plan {
    /// Goals of each run.
    pub(crate) goals: usize,
    /// Only robots and worlds whose name contains this.
    pub(crate) only: Option<String>,
    /// Runs at a time.
    pub(crate) jobs: usize,
}

/// Robots in the courses in which they fit.
fn drives() -> Vec<(&'static Robot, &'static Course)> {
    let fits = |robot: &Robot, course: &Course| robot.courses.contains(&course.name);
    let of = |robot: &'static Robot| {
        courses::ALL
            .iter()
            .filter(move |course| fits(robot, course))
            .map(move |course| (robot, course))
    };
    robots::ALL.iter().flat_map(of).collect()
}

/// Maps and drives all, prints a table; without the shared data it prints that it was skipped.
pub(crate) fn evaluate(plan: &Plan) -> Result<(), Failed> {
    let shared = root().join("../shared");
    if !shared.join("nav/bringup").is_dir() || !shared.join("corpus").is_dir() {
        println!("SKIPPED: robots and parameter files are missing ({})", shared.display());
        return Ok(());
    }
    let folder = root().join("target/goals");
    let setup = Setup::prepare(folder, shared)?;
    run(cargo().args(["build", "--release", "--package", "periplus-cli"]), "correct the errors")?;
    let mut chosen = drives();
    if let Some(only) = &plan.only {
        chosen.retain(|(robot, course)| format!("{} {}", robot.name, course.name).contains(only));
    }
    println!("{}", Drive::HEAD);
    let outcomes = for_all(&chosen, plan.jobs, |(robot, course)| {
        match setup.drive(robot, course, plan.goals) {
            Ok(drive) => {
                println!("{drive}");
                drive.failure()
            }
            Err(Failed(why)) => Some(format!("{} in {}: {why}", robot.name, course.name)),
        }
    });
    let failures: Vec<String> = outcomes.into_iter().flatten().collect();
    if failures.is_empty() { Ok(()) } else { Err(Failed(failures.join("\n"))) }
}

/// Files and program of all runs.
struct Setup {
    folder: PathBuf,
    shared: PathBuf,
    program: PathBuf,
}

impl Setup {
    fn prepare(folder: PathBuf, shared: PathBuf) -> Result<Self, Failed> {
        fs::create_dir_all(&folder)
            .map_err(|error| Failed(format!("{}: {error}", folder.display())))?;
        let program = format!("target/release/periplus{}", std::env::consts::EXE_SUFFIX);
        Ok(Self { folder, shared, program: root().join(program) })
    }

    /// Maps a course with a robot, then drives to random goals on the map.
    fn drive(&self, robot: &Robot, course: &Course, goals: usize) -> Result<Drive, Failed> {
        let ready = robot.prepare(&self.shared, &self.folder)?;
        let map = self.folder.join(format!("{}-{}", robot.name, course.name));
        let mut mapping = self.navigate(&ready, course);
        mapping.args(["--timeout", "3000", "--slam-out"]).arg(&map);
        for goal in course.tour {
            mapping.arg(format!("--goal={goal}"));
        }
        let mapped = report(mapping)?;
        let missed = missed_goals(&mapped);
        if missed > 0 {
            return Err(Failed(format!("{missed} goals of the drive that maps were not reached")));
        }
        let mut driving = self.navigate(&ready, course);
        driving.arg("--map").arg(map.join("map.yaml")).args(["--initial-pose", "0,0,0"]);
        driving.args(["--timeout", "30000", "--random-goals"]).arg(goals.to_string());
        if let Some(parameters) = &ready.parameters {
            driving.arg("--params-file").arg(parameters);
        }
        let begin = Instant::now();
        let driven = report(driving)?;
        Ok(Drive::read(robot, course, &driven, begin.elapsed().as_secs_f64()))
    }

    fn navigate(&self, robot: &PreparedRobot, course: &Course) -> Command {
        let mut command = Command::new(&self.program);
        command.arg("navigate").arg(course.file(&self.shared));
        command.arg("--robot").arg(&robot.file).arg(format!("--pose={}", course.start));
        command.args(["--json", "--quiet"]).args(robot.options);
        for folder in robot.packages.iter().chain(&course.packages(&self.shared)) {
            command.arg("--resource-path").arg(folder);
        }
        command
    }
}

/// Runs a drive and reads its report; goals that were not reached are in the report.
fn report(mut command: Command) -> Result<Value, Failed> {
    let done = command.output().map_err(|error| Failed(error.to_string()))?;
    serde_json::from_slice(&done.stdout)
        .map_err(|_| Failed(String::from_utf8_lossy(&done.stderr).into_owned()))
}

fn missed_goals(report: &Value) -> usize {
    let goals = report["goals"].as_array().map_or(&[][..], Vec::as_slice);
    goals.iter().filter(|goal| goal["is_reached"] != true).count()
}

/// Result of a drive to random goals.
struct Drive {
    robot: &'static str,
    course: &'static str,
    parameters: &'static str,
    goals: usize,
    reached: usize,
    collisions: u64,
    length_m: f64,
    clearance_m: f64,
    simulated_s: f64,
    wall_s: f64,
}

impl Drive {
    const HEAD: &str = "robot      world      parameters  reached    collisions  length m  clearance m  \
                        simulated s  real-time factor";

    fn read(robot: &Robot, course: &Course, report: &Value, wall_s: f64) -> Self {
        let (goals, truth) = (report["goals"].as_array().map_or(0, Vec::len), &report["truth"]);
        Self {
            robot: robot.name,
            course: course.name,
            parameters: robot.parameters.name(),
            goals,
            reached: goals - missed_goals(report),
            collisions: truth["collisions"].as_u64().unwrap_or(u64::MAX),
            length_m: truth["length_m"].as_f64().unwrap_or(f64::NAN),
            clearance_m: truth["min_clearance_m"].as_f64().unwrap_or(f64::NAN),
            simulated_s: report["run"]["simulated_s"].as_f64().unwrap_or(f64::NAN),
            wall_s,
        }
    }

    /// Reason why the drive does not count as a success.
    fn failure(&self) -> Option<String> {
        let is_success = self.goals > 0 && self.reached == self.goals && self.collisions == 0;
        (!is_success).then(|| {
            let Self { robot, course, reached, goals, collisions, .. } = self;
            format!(
                "{robot} in {course}: {reached} of {goals} goals reached, {collisions} collisions"
            )
        })
    }
}

impl fmt::Display for Drive {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let reached = format!("{} of {}", self.reached, self.goals);
        write!(
            f,
            "{:<10} {:<10} {:<11} {reached:<10} {:<11} {:<9.1} {:<12.3} {:<12.1} {:.1}",
            self.robot,
            self.course,
            self.parameters,
            self.collisions,
            self.length_m,
            self.clearance_m,
            self.simulated_s,
            self.simulated_s / self.wall_s
        )
    }
}

fn write(path: &Path, text: &str) -> Result<(), Failed> {
    fs::write(path, text).map_err(|error| Failed(format!("{}: {error}", path.display())))
}
