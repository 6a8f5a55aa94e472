//! Comparison with the results of other programs on the corpus.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use serde_json::{Value, json};

use crate::step::{Failed, cargo, copy_folder, root, run, timed};

/// Runs the oracles over `../shared/corpus`, then the tests that compare.
pub(crate) fn run_all() -> Result<(), Failed> {
    let corpus = root().join("../shared/corpus");
    let Ok(corpus) = corpus.canonicalize() else {
        println!("SKIPPED: there is no ../shared/corpus to compare on");
        return Ok(());
    };
    let work = Work::prepare(corpus)?;
    timed("oracles: build", || work.build())?;
    timed("oracle: xacro", || work.ask_xacro())?;
    timed("oracle: libsdformat", || work.ask_sdf())?;
    timed("oracle: liburdfdom", || work.ask_urdf())?;
    for (package, test) in [
        ("periplus-xacro", "corpus"),
        ("periplus-sdf", "corpus"),
        ("periplus-urdf", "check_urdf"),
        ("periplus-urdf", "libsdformat"),
        ("periplus-urdf", "corpus"),
        ("periplus-loader", "corpus"),
    ] {
        timed(&format!("{package}: {test}"), || work.compare(package, test))?;
    }
    Ok(())
}

/// Races the oracles over the files that they accepted.
pub(crate) fn bench() -> Result<(), Failed> {
    let Ok(corpus) = root().join("../shared/corpus").canonicalize() else {
        println!("SKIPPED: there is no ../shared/corpus to load");
        return Ok(());
    };
    let work = Work::prepare(corpus)?;
    let mut race = cargo();
    race.args(["run", "--quiet", "--release", "--package", "periplus-benches", "--"]);
    race.arg(&work.folder).arg(work.folder.join("bench.json"));
    work.surroundings(&mut race);
    run(&mut race, "run `cargo xtask corpus` first: it builds the peers and asks what they accept")
}

/// Folders of the corpus, of the oracles and of their results.
struct Work {
    corpus: PathBuf,
    folder: PathBuf,
}

impl Work {
    fn prepare(corpus: PathBuf) -> Result<Self, Failed> {
        let target = std::env::var_os("CARGO_TARGET_DIR").map(PathBuf::from);
        let folder = target.unwrap_or_else(|| root().join("target")).join("oracles");
        let work = Self { corpus, folder };
        // The robot in xacro's own tests asks for the package `xacro`, whose folder has another
        // name in the corpus.
        let packages = work.folder.join("packages");
        copy_folder(&work.corpus.join("xacro_tests"), &packages.join("xacro"), |_| true)
            .map_err(|error| Failed(format!("cannot write to {}: {error}", packages.display())))?;
        Ok(work)
    }

    fn build(&self) -> Result<(), Failed> {
        let help = "install libsdformat-dev and liburdfdom-dev";
        run(Command::new("sh").arg(oracle("build.sh")).arg(self.folder.join("bin")), help)
    }

    fn ask_xacro(&self) -> Result<(), Failed> {
        let files = self.listed(&["xacro", "urdf"])?;
        let jobs: String =
            files.iter().map(|file| json!({ "file": file }).to_string() + "\n").collect();
        let expanded = self.folder.join("expanded");
        let mut python = Command::new("python3");
        python.arg(oracle("xacro_oracle.py")).arg("--expand-to").arg(&expanded);
        self.ask(&mut python, &jobs, "xacro")
    }

    fn ask_sdf(&self) -> Result<(), Failed> {
        let mut jobs = lines(&self.listed(&["sdf", "world", "urdf"])?);
        jobs.push_str(&self.expanded("\t")?);
        self.ask(&mut Command::new(self.folder.join("bin/sdf_oracle")), &jobs, "sdf")
    }

    fn ask_urdf(&self) -> Result<(), Failed> {
        let mut jobs = lines(&self.listed(&["urdf"])?);
        jobs.push_str(&self.expanded("")?);
        self.ask(&mut Command::new(self.folder.join("bin/urdf_oracle")), &jobs, "urdf")
    }

    /// The corpus files of some kinds, as its index names them.
    fn listed(&self, kinds: &[&str]) -> Result<Vec<PathBuf>, Failed> {
        let index = self.corpus.join("INDEX.csv");
        let text = fs::read_to_string(&index)
            .map_err(|error| Failed(format!("cannot read {}: {error}", index.display())))?;
        let rows = text.lines().skip(1).filter_map(|row| {
            let mut cells = row.split(',');
            Some((cells.next()?, cells.next()?))
        });
        Ok(rows
            .filter(|(_, kind)| kinds.contains(kind))
            .map(|(file, _)| self.corpus.join(file))
            .collect())
    }

    /// The documents that xacro expanded; after `separator`, where they came from.
    fn expanded(&self, separator: &str) -> Result<String, Failed> {
        let path = self.answers("xacro");
        let text = fs::read_to_string(&path)
            .map_err(|error| Failed(format!("cannot read {}: {error}", path.display())))?;
        let mut jobs = String::new();
        for line in text.lines() {
            let answer: Value = serde_json::from_str(line)
                .map_err(|error| Failed(format!("{}: {error}", path.display())))?;
            if let (Some(expanded), Some(file)) =
                (answer["expanded"].as_str(), answer["file"].as_str())
            {
                jobs.push_str(expanded);
                if !separator.is_empty() {
                    jobs.push_str(separator);
                    jobs.push_str(file);
                }
                jobs.push('\n');
            }
        }
        Ok(jobs)
    }

    fn ask(&self, oracle: &mut Command, jobs: &str, name: &str) -> Result<(), Failed> {
        let input = self.folder.join(format!("{name}.jobs"));
        let open = |path: &Path| {
            fs::File::open(path)
                .map_err(|error| Failed(format!("cannot read {}: {error}", path.display())))
        };
        let create = |path: &Path| {
            fs::File::create(path)
                .map_err(|error| Failed(format!("cannot write {}: {error}", path.display())))
        };
        fs::write(&input, jobs)
            .map_err(|error| Failed(format!("cannot write {}: {error}", input.display())))?;
        self.surroundings(oracle);
        oracle.stdin(open(&input)?).stdout(create(&self.answers(name))?);
        // libsdformat speaks of every file; what matters is in its answers.
        oracle.stderr(Stdio::from(create(&self.folder.join(format!("{name}.log")))?));
        run(oracle, "see its log in target/oracles")
    }

    fn compare(&self, package: &str, test: &str) -> Result<(), Failed> {
        let mut cargo = cargo();
        cargo.args(["test", "--quiet", "--package", package, "--test", test, "--", "--nocapture"]);
        self.surroundings(&mut cargo);
        cargo.env("PERIPLUS_XACRO_ORACLE", self.answers("xacro"));
        cargo.env("PERIPLUS_SDF_ORACLE", self.answers("sdf"));
        cargo.env("PERIPLUS_URDF_ORACLE", self.answers("urdf"));
        run(&mut cargo, "we and an outside program disagree: the files are named above")
    }

    /// Sets the paths on which the oracles and Periplus look for packages and models.
    fn surroundings(&self, command: &mut Command) {
        let folders = [
            self.folder.join("packages"),
            self.corpus.join("gazebo_models"),
            self.corpus.join("sdformat14_tests/test/integration/model"),
            oracle("models"),
        ];
        let folders: Vec<String> =
            folders.iter().map(|folder| folder.display().to_string()).collect();
        command.env("PERIPLUS_ORACLE_ROOT", &self.corpus);
        command.env("PERIPLUS_ORACLE_PATH", folders.join(":"));
    }

    fn answers(&self, name: &str) -> PathBuf {
        self.folder.join(format!("{name}.jsonl"))
    }
}

fn oracle(name: &str) -> PathBuf {
    root().join("benches/oracles").join(name)
}

fn lines(files: &[PathBuf]) -> String {
    files.iter().map(|file| format!("{}\n", file.display())).collect()
}
