//! `periplus slam` as a whole: the peak of its memory, and whether its report is what it wrote.

use std::collections::BTreeMap;
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::Duration;

use serde_json::{Value, json};

use crate::step::{Failed, cargo, peak_memory_kb, run};

/// Result of a run of the program.
pub(crate) struct Whole {
    pub(crate) log: String,
    pub(crate) path_m: f64,
    /// The larger of what the system and what the report have as the peak \[bytes\].
    pub(crate) peak_bytes: f64,
    /// CPU of the whole process \[s\], and its exit code.
    pub(crate) cpu_s: f64,
    pub(crate) code: Option<i32>,
    /// Edges of the graph by `--g2o`, which are those of the report.
    pub(crate) edges: usize,
}

/// Memory budget of a process \[bytes\]: 30 MB and 8 MB per kilometre.
pub(crate) fn budget_bytes(path_m: f64) -> f64 {
    30e6 + 8e6 * path_m / 1000.0
}

/// Runs the released program on each log.
///
/// # Errors
/// When the program cannot be run, or the edges of its report are not those of the graph.
pub(crate) fn measure(
    program: Option<&Path>,
    logs: &Path,
    names: &[String],
    out: &Path,
) -> Result<Vec<Whole>, Failed> {
    let periplus = match program {
        Some(program) => program.to_owned(),
        None => {
            let mut build = cargo();
            build.args(["build", "--quiet", "--release", "--package", "periplus-cli"]);
            run(&mut build, "the command cannot be built")?;
            super::target().join("release/periplus")
        }
    };
    let one = |name: &String| {
        eprintln!("periplus slam {name}");
        measure_one(&periplus, &logs.join(name).join("raw.clf"), &out.join(name))
            .map(|whole| Whole { log: name.clone(), ..whole })
    };
    let wholes: Vec<Whole> = names.iter().map(one).collect::<Result<_, _>>()?;
    let lines: String = wholes.iter().map(|it| it.to_json().to_string() + "\n").collect();
    let path = out.join(FILE);
    std::fs::write(&path, lines).map_err(super::failed(&path))?;
    Ok(wholes)
}

/// Runs of the program that [`measure`] has left.
const FILE: &str = "program.json";

/// Reads what the last [`measure`] found.
///
/// # Errors
/// When there is none.
pub(crate) fn read(out: &Path) -> Result<Vec<Whole>, Failed> {
    let path = out.join(FILE);
    let text = std::fs::read_to_string(&path).map_err(super::failed(&path))?;
    let whole = |(index, line): (usize, &str)| {
        let value = serde_json::from_str(line).ok();
        let why =
            || Failed(format!("{}:{}: this is not the record of a run", path.display(), index + 1));
        value.as_ref().and_then(Whole::of_json).ok_or_else(why)
    };
    text.lines().enumerate().map(whole).collect()
}

impl Whole {
    fn to_json(&self) -> Value {
        json!({
            "log": self.log,
            "path_m": self.path_m,
            "peak_bytes": self.peak_bytes,
            "cpu_s": self.cpu_s,
            "code": self.code,
            "edges": self.edges,
        })
    }

    fn of_json(value: &Value) -> Option<Self> {
        Some(Self {
            log: value["log"].as_str()?.to_owned(),
            path_m: value["path_m"].as_f64()?,
            peak_bytes: value["peak_bytes"].as_f64()?,
            cpu_s: value["cpu_s"].as_f64()?,
            code: value["code"].as_i64().and_then(|it| i32::try_from(it).ok()),
            edges: usize::try_from(value["edges"].as_u64()?).ok()?,
        })
    }
}

fn measure_one(periplus: &Path, log: &Path, out: &Path) -> Result<Whole, Failed> {
    std::fs::create_dir_all(out).map_err(super::failed(out))?;
    let g2o = out.join("graph.g2o");
    let mut command = Command::new(periplus);
    command.arg("slam").arg(log).arg("--out").arg(out).arg("--g2o").arg(&g2o).arg("--quiet");
    let mut child = command.stderr(Stdio::null()).spawn().map_err(super::failed(periplus))?;
    let status = format!("/proc/{}/status", child.id());
    let mut peak_bytes: f64 = 0.0;
    let code = loop {
        if let Some(code) = child.try_wait().map_err(super::failed(periplus))? {
            break code.code();
        }
        peak_bytes = peak_bytes.max(high_water_bytes(&status).unwrap_or_default());
        std::thread::sleep(Duration::from_millis(5));
    };
    let path = out.join("report.json");
    let text = std::fs::read_to_string(&path).map_err(super::failed(&path))?;
    let report: Value = serde_json::from_str(&text)
        .map_err(|error| Failed(format!("{}: {error}", path.display())))?;
    let number = |name: &str| report[name].as_f64().unwrap_or_default();
    let graph = std::fs::read_to_string(&g2o).map_err(super::failed(&g2o))?;
    let (told, written) = (edges_of_report(&report), edges_of_graph(&graph));
    if told != written {
        return Err(Failed(format!(
            "{}: the report has {} edges, {} has {}, and they are not the same",
            path.display(),
            told.values().sum::<usize>(),
            g2o.display(),
            written.values().sum::<usize>()
        )));
    }
    Ok(Whole {
        log: String::new(),
        path_m: number("path_m"),
        peak_bytes: peak_bytes.max(number("peak_memory_bytes")),
        cpu_s: number("cpu_s"),
        code,
        edges: written.values().sum(),
    })
}

/// The peak of what a process had in memory \[bytes\].
fn high_water_bytes(status: &str) -> Option<f64> {
    Some(1024.0 * peak_memory_kb(&std::fs::read_to_string(status).ok()?)? as f64)
}

/// Number of constraints between each pair of kept scans.
type Edges = BTreeMap<(u64, u64), usize>;

fn edges_of_report(report: &Value) -> Edges {
    let mut edges = Edges::new();
    for edge in report["edges"].as_array().into_iter().flatten() {
        let key = |at: usize| edge["keys"][at].as_u64().unwrap_or(u64::MAX);
        *edges.entry((key(0), key(1))).or_default() += 1;
    }
    edges
}

fn edges_of_graph(text: &str) -> Edges {
    let mut edges = Edges::new();
    for line in text.lines().filter_map(|line| line.strip_prefix("EDGE_SE2 ")) {
        let mut keys = line.split(' ').map(|word| word.parse().unwrap_or(u64::MAX));
        let mut key = || keys.next().unwrap_or(u64::MAX);
        *edges.entry((key(), key())).or_default() += 1;
    }
    edges
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn edges_are_compared_by_what_they_tie() {
        let graph =
            "VERTEX_SE2 0 0 0 0\nEDGE_SE2 0 1 1 0 0 1 0 0 1 0 1\nEDGE_SE2 0 1 1 0 0 1 0 0 1 0 1\n";
        let report = json!({"edges": [{"keys": [0, 1]}, {"keys": [0, 1]}]});
        assert_eq!(edges_of_graph(graph), edges_of_report(&report));
        assert_ne!(edges_of_graph(graph), edges_of_report(&json!({"edges": [{"keys": [0, 1]}]})));
    }

    #[test]
    fn a_run_is_read_as_it_was_written() {
        let whole = Whole {
            log: "aces".to_owned(),
            path_m: 321.5,
            peak_bytes: 20.5e6,
            cpu_s: 1.0,
            code: None,
            edges: 561,
        };
        let read = Whole::of_json(&whole.to_json()).unwrap();
        assert_eq!(read.to_json(), whole.to_json());
    }

    #[test]
    fn a_kilometre_takes_eight_megabytes() {
        assert_eq!(budget_bytes(2000.0), 46e6);
    }
}
