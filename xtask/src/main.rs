//! The one entry for developers: `cargo xtask`.
#![allow(
    clippy::disallowed_methods,
    clippy::print_stdout,
    clippy::print_stderr,
    reason = "a tool that runs other programs, reads the source tree and prints results"
)]

mod attack;
mod bags;
mod barn;
mod codegen;
mod corpus;
mod costmap;
mod crowds;
mod determinism;
mod dist;
mod docs;
mod drive;
mod fleet;
mod fuzz;
mod goals;
mod layers;
mod localization;
mod migration;
mod package;
mod parallel;
mod physics;
mod pictures;
mod platforms;
mod python;
mod rays;
mod results;
mod ros1;
mod ros2;
mod runs;
mod scenarios;
mod slam;
mod soak;
mod step;
mod sweeps;
mod tidy;
mod tutorials;
mod viewer;
mod wasm;
mod wire;
mod workflows;
mod zenoh;

use std::process::ExitCode;

use clap::{Parser, Subcommand, ValueEnum};

use crate::crowds::CrowdExperiment;
use crate::determinism::DebugProgram;
use crate::step::{Failed, cargo, run, timed};

/// Tasks of a developer of Periplus.
#[derive(Parser)]
#[command(name = "cargo xtask", bin_name = "cargo xtask")]
struct Arguments {
    #[command(subcommand)]
    task: Task,
}

#[derive(Subcommand)]
enum Task {
    /// Run all checks, the fastest first, and then the tests
    Ci,
    /// Check the format of the sources
    Fmt,
    /// Run clippy, with every warning as an error
    Clippy,
    /// Check the dependencies of crates against the allowed ones
    Layers,
    /// Package every library without building it: checks metadata, README, and included files
    Package,
    /// Check licences, sources and bans of dependencies
    Deny,
    /// Check the documentation: links and anchors of every page, the site, and that of the code, with every
    /// warning as an error
    Docs {
        /// Run only this part
        #[arg(long, value_enum)]
        only: Option<docs::Part>,
        /// Write docs/llms.txt, the list of the pages for programs
        #[arg(long, conflicts_with = "only")]
        update: bool,
    },
    /// Run all tests
    Test {
        /// Arguments for `cargo test`
        #[arg(trailing_var_arg = true, allow_hyphen_values = true)]
        rest: Vec<String>,
    },
    /// Check the language of the tree: words, doc comments, names of constants and types
    Tidy(tidy::Options),
    /// Compare the corpus of real files with libsdformat, liburdfdom and PyPI's xacro
    Corpus,
    /// Measure speed in comparison with other programs; run `corpus` first
    Bench {
        /// Benchmark: `loading`, or one of the others, which do not need `corpus`
        only: Option<Contest>,
        /// `wire`: only loads whose names contain this, printed only. `ros2`: only the part `rates`, `lists` or
        /// `idle`
        #[arg(long)]
        load: Option<String>,
        /// `ros2` and `subscribers`: few and short measurements, printed only
        #[arg(long)]
        quick: bool,
        /// `slam`: logs by name, separated by commas; the results are printed only
        #[arg(long = "only", value_name = "LOG,..", id = "logs")]
        logs: Option<String>,
        /// `slam`: runs by name (`plain,rotate,..`), separated by commas; the results are printed only
        #[arg(long, value_name = "RUN,..")]
        runs: Option<String>,
        /// `slam`: a line of JSON for each run
        #[arg(long)]
        json: bool,
        /// `slam`: fail where a figure differs from docs/slam-benchmark.md, except times
        #[arg(long, conflicts_with = "json")]
        check: bool,
        /// `slam`: continue interrupted runs
        #[arg(long)]
        resume: bool,
        /// `slam`: write the page again from the last runs
        #[arg(long, conflicts_with_all = ["json", "check", "logs", "runs"])]
        page: bool,
        /// `slam` and `fleet`: program whose memory is measured, in place of a release build
        #[arg(long, value_name = "FILE")]
        program: Option<std::path::PathBuf>,
    },
    /// Generate Rust code of the messages from `crates/messages/msgs/interfaces`
    Codegen {
        /// Only check that the generated code is up to date
        #[arg(long)]
        check: bool,
    },
    /// Convert every robot and world of the corpus to Gazebo Harmonic, load the results with libsdformat, and compare the
    /// old and the new files in a run
    Migration(migration::Options),
    /// Drive every robot of the corpus with a drive for five simulated seconds
    Drive,
    /// Drive robots to random goals in several worlds, on maps that SLAM made, with Nav2's own parameters; prints goals
    /// reached, collisions and speed
    Goals {
        /// Goals of each run
        #[arg(long, default_value_t = 100)]
        goals: usize,
        /// Run only robots and worlds whose names contain this
        #[arg(long, value_name = "TEXT")]
        only: Option<String>,
        /// Runs at a time
        #[arg(long, default_value_t = 1)]
        jobs: usize,
    },
    /// Compile for WebAssembly all crates of a browser tab, build its module, and compare its bag with that of the
    /// native program
    Wasm {
        /// Only check that the crates compile
        #[arg(long)]
        check: bool,
        /// Only build the page without a server into `target/tab/page`
        #[arg(long, conflicts_with = "check")]
        page: bool,
        /// Simulated seconds of the comparison
        #[arg(long, default_value_t = 60)]
        seconds: u32,
    },
    /// Prove that a sweep is the same on a local pool and on a Ray cluster that loses a node; takes minutes
    Sweeps {
        /// Run only this part
        #[arg(long, value_parser = ["proof", "speed"])]
        only: Option<String>,
    },
    /// Run the scenarios of the folder `scenarios`
    Scenarios {
        /// Run five of them this many times, and fail if one byte differs
        #[arg(long, default_value_t = 1)]
        repeat: u32,
        /// Run only those whose names contain this
        #[arg(long, value_name = "TEXT")]
        only: Option<String>,
    },
    /// Run the BARN challenge: a Jackal drives through fields of cylinders without a map; prints success, collisions
    /// and scores, beside the published runs of DWA
    Barn {
        /// Folder with `index.json` and `worlds/`
        #[arg(long, value_name = "DIR")]
        worlds: Option<std::path::PathBuf>,
        /// Runs of each world
        #[arg(long, default_value_t = 5)]
        seeds: u64,
        /// Run only every Nth world
        #[arg(long, default_value_t = 1, value_name = "N")]
        every: usize,
        /// Run everything twice and compare the bags
        #[arg(long)]
        twice: bool,
        /// Runs at a time
        #[arg(long, default_value_t = 2)]
        jobs: usize,
    },
    /// Compare the bags of different builds and numbers of threads, and of every platform whose program is built by
    /// `dist` and runs on this machine
    Determinism,
    /// Build the files of a release: archives with programs, wheels, the package for npm, bills of materials,
    /// checksums. zig links for every system; it comes from PyPI
    Dist(dist::Options),
    /// Run the programs that `dist` built as on their systems, and compare their files with those of this machine: arm64
    /// by QEMU, Windows by Wine, musl without any other file
    Platforms(platforms::Options),
    /// Run all commands on hostile inputs, generated from a fixed seed: crashes, time-outs over 10 s and memory
    /// over 500 MB are faults
    Attack {
        /// Only kinds whose names contain this
        only: Option<String>,
        /// Run every Nth input separately
        #[arg(long, default_value_t = 1)]
        every: usize,
        /// Seed of the inputs
        #[arg(long, default_value_t = attack::SEED)]
        seed: u64,
        /// Program to test, in place of a release build
        #[arg(long, value_name = "FILE")]
        program: Option<std::path::PathBuf>,
    },
    /// Run for a long time: costmaps among moving obstacles for an hour, and a robot with a map and costmaps for
    /// ten hours; memory must not grow, and no published number may be NaN
    Soak {
        /// Simulated hours of the robot only, without the costmaps among moving obstacles
        #[arg(long)]
        hours: Option<f64>,
    },
    /// Print published experiments with people beside both models of crowds; with `--office` let 200 people and ten
    /// robots walk in an office for half an hour
    Crowds {
        /// Run the office in place of the experiments
        #[arg(long)]
        office: bool,
        /// Measure AMCL, SLAM and costmaps of a robot among people in place of the experiments
        #[arg(long, conflicts_with = "office")]
        accuracy: bool,
    },
    /// Generate the pictures of the documentation
    Pictures,
    /// Build or test the page in `viewer`, which needs Node
    #[command(subcommand)]
    Viewer(Page),
    /// Run every command of the tutorials in `docs/tutorials`, and check its output
    Tutorials {
        /// Only tutorials whose names contain this
        only: Option<String>,
        /// Take their screenshots too, which needs Node and Chromium
        #[arg(long)]
        pictures: bool,
    },
    /// Check the optional transport for Zenoh, which no other task builds: clippy and tests with PyPI's
    /// eclipse-zenoh, installed into `.venv`
    Zenoh,
    /// Build the Python wheel and check it as installed: types, tests, docstrings, examples, notebooks, and
    /// the command in it. Environments are in `target/python`
    Python {
        /// Run only this part, on a wheel that is built
        #[arg(long)]
        only: Option<python::Part>,
        /// Write the reference page and the types of the messages instead
        #[arg(long, conflicts_with = "only")]
        update: bool,
    },
    /// Check the workflows of releases with actionlint, and test the action `periplus-check`
    Workflows {
        /// Program for the action, in place of a release build
        #[arg(long, value_name = "FILE")]
        program: Option<std::path::PathBuf>,
    },
    /// Run fuzz targets, starting from the seeds in `fuzz/seeds`
    Fuzz {
        #[command(flatten)]
        options: fuzz::Options,
        /// Targets to run; by default all
        targets: Vec<String>,
    },
}

/// Action on the page.
#[derive(Clone, Copy, Subcommand)]
enum Page {
    /// Build it into `crates/transports/web/page`, where it is committed
    Build,
    /// Check format and types, run the tests, and compare the build with the committed one
    Check,
    /// Test it in a browser with a running `periplus`
    Browse,
    /// Check its accessibility by the rules of axe, in a browser
    Axe,
}

/// Benchmarks.
#[derive(Clone, Copy, ValueEnum)]
enum Contest {
    /// Large recordings
    Bags,
    /// Carts between casters that are too low, in three physics engines
    Casters,
    /// Costmaps: inflation and updates
    Costmap,
    /// Fleets in the warehouse: speed and memory for 1 to 500 robots
    Fleet,
    Loading,
    /// The page: time until the demo shows it, and its size
    Page,
    Physics,
    Rays,
    /// Whole runs of `periplus sim`
    Sim,
    /// Messages to and from Fast DDS and Cyclone DDS
    Wire,
    /// Messages to and from roscpp of ROS 1
    Ros1,
    /// Comparison with ROS 2 (rclpy): rates and losses of sensor messages, completeness of lists, CPU time of calls
    Ros2,
    /// Real time factor of a simulation with stopped and with reading subscribers
    Subscribers,
    /// Maps and trajectories from logs of real robots
    Slam,
    /// Maps of simulated worlds, compared with their truth
    SlamWorlds,
    /// Localization: worlds with known truth, speed, logs of real robots
    Localization,
}

fn main() -> ExitCode {
    match perform(&Arguments::parse().task) {
        Ok(()) => ExitCode::SUCCESS,
        Err(Failed(why)) => {
            eprintln!("\nxtask: {why}");
            ExitCode::FAILURE
        }
    }
}

fn perform(task: &Task) -> Result<(), Failed> {
    match task {
        Task::Ci => ci(),
        Task::Fmt => fmt(),
        Task::Clippy => clippy(),
        Task::Layers => layers::run(),
        Task::Package => package::check(),
        Task::Deny => deny(),
        Task::Docs { update: true, .. } => docs::update(),
        Task::Docs { only, .. } => docs::run(*only),
        Task::Test { rest } => test(rest),
        Task::Tidy(options) => tidy::run(options),
        Task::Corpus => corpus::run_all(),
        Task::Bench { only, load, quick, logs, runs, json, check, resume, page, program } => {
            match only {
                Some(Contest::Bags) => bags::bench(),
                Some(Contest::Casters) => physics::casters(),
                Some(Contest::Costmap) => costmap::bench(),
                Some(Contest::Fleet) => fleet::bench(program.clone()),
                Some(Contest::Loading) => corpus::bench(),
                Some(Contest::Page) => viewer::bench(),
                Some(Contest::Physics) => physics::bench(),
                Some(Contest::Rays) => rays::bench(),
                Some(Contest::Sim) => runs::bench(),
                Some(Contest::Wire) => wire::bench(load.as_deref()),
                Some(Contest::Ros1) => ros1::bench(),
                Some(Contest::Ros2) => ros2::bench(load.as_deref(), *quick),
                Some(Contest::Subscribers) => ros2::subscribers(*quick),
                Some(Contest::Slam) => slam::bench(&slam::Wish {
                    logs: logs.clone(),
                    runs: runs.clone(),
                    json: *json,
                    check: *check,
                    resume: *resume,
                    page: *page,
                    program: program.clone(),
                }),
                Some(Contest::SlamWorlds) => slam::worlds(),
                Some(Contest::Localization) => localization::bench(),
                None => corpus::bench()
                    .and_then(|()| physics::bench())
                    .and_then(|()| rays::bench())
                    .and_then(|()| runs::bench())
                    .and_then(|()| costmap::bench()),
            }
        }
        Task::Codegen { check } => codegen::run(*check),
        Task::Drive => drive::corpus(),
        Task::Migration(options) => migration::run_all(options),
        Task::Wasm { check: true, .. } => wasm::check(),
        Task::Wasm { page: true, .. } => wasm::page(),
        Task::Wasm { seconds, .. } => wasm::all(*seconds),
        Task::Sweeps { only } => sweeps::prove(only.as_deref()),
        Task::Scenarios { repeat, only } => scenarios::suite(*repeat, only.as_deref()),
        Task::Attack { only, every, seed, program } => attack::attack(&attack::Wish {
            seed: *seed,
            only: only.clone(),
            every: *every,
            program: program.clone(),
        }),
        Task::Crowds { office: true, .. } => crowds::run_experiment(CrowdExperiment::Office),
        Task::Crowds { accuracy: true, .. } => crowds::run_experiment(CrowdExperiment::Accuracy),
        Task::Crowds { .. } => crowds::run_experiment(CrowdExperiment::Published),
        Task::Soak { hours: Some(hours) } => soak::kbot(Some(*hours)),
        Task::Soak { hours: None } => costmap::soak().and_then(|()| soak::kbot(None)),
        Task::Barn { worlds, seeds, every, twice, jobs } => {
            let worlds = worlds.clone();
            barn::evaluate(&barn::Plan {
                worlds,
                seeds: *seeds,
                every: *every,
                twice: *twice,
                jobs: *jobs,
            })
        }
        Task::Goals { goals, only, jobs } => {
            goals::evaluate(&goals::Plan { goals: *goals, only: only.clone(), jobs: *jobs })
        }
        Task::Determinism => determinism::check(DebugProgram::Own),
        Task::Dist(options) => dist::run(options),
        Task::Platforms(options) => platforms::run(options),
        Task::Pictures => pictures::draw(),
        Task::Viewer(Page::Build) => viewer::build(),
        Task::Viewer(Page::Check) => viewer::check(),
        Task::Viewer(Page::Browse) => viewer::in_browser(),
        Task::Viewer(Page::Axe) => viewer::axe(),
        Task::Tutorials { only, pictures } => tutorials::run_all(only.as_deref(), *pictures),
        Task::Zenoh => zenoh::check(),
        Task::Python { update: true, .. } => python::update(),
        Task::Python { only, .. } => python::check(*only),
        Task::Workflows { program } => workflows::check(program.as_deref()),
        Task::Fuzz { options, targets } => fuzz::run_all(options, targets),
    }
}

fn ci() -> Result<(), Failed> {
    timed("fmt", fmt)?;
    timed("layers", layers::run)?;
    timed("tidy", || tidy::run(&tidy::Options::default()))?;
    // Packing reads files on one core, for as long as half of clippy takes.
    let packing = std::thread::spawn(|| timed("package", package::check));
    let linted = timed("clippy", clippy);
    let packed = packing.join().unwrap_or_else(|_| Err(Failed("packing panicked".to_owned())));
    linted.and(packed)?;
    timed("wasm", wasm::check_if_installed)?;
    timed("deny", deny)?;
    timed("docs", || docs::run(None))?;
    timed("tests: compile", || test(&["--no-run".to_owned()]))?;
    timed("determinism", || determinism::check(DebugProgram::OfTests))?;
    timed("test", || test(&[]))
}

fn fmt() -> Result<(), Failed> {
    run(cargo().args(["fmt", "--all", "--check"]), "put it right with `cargo fmt --all`")
}

fn clippy() -> Result<(), Failed> {
    let arguments = ["clippy", "--workspace", "--all-targets", "--", "-D", "warnings"];
    run(cargo().args(arguments), "see the findings above")
}

fn deny() -> Result<(), Failed> {
    // Not `advisories`: their database is fetched, and a check that depends on the day does not
    // belong among those that judge a change.
    let arguments = ["deny", "check", "bans", "licenses", "sources"];
    run(
        cargo().args(arguments),
        "see above; without cargo-deny, `cargo install --locked cargo-deny`",
    )
}

fn test(rest: &[String]) -> Result<(), Failed> {
    run(cargo().args(["test", "--workspace"]).args(rest), "see the failures above")
}
