//! The page of the docs on what maps of real logs come to.

use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::path::Path;

use crate::step::Failed;

use super::peers;
use super::program::{Whole, budget_bytes};
use super::record::Record;

const HEAD: &str = "# SLAM on logs of real robots

Written by `cargo xtask bench slam`; edit `xtask/src/slam/page.rs`, not this file. One program and one \
set of parameters for all logs and all runs.

- **Error**: mean translational error over known relations between poses, the metric of Kümmerle et al. \
2009. *Loops* are the relations between poses more than 60 s apart. The relations of `intel`, `intel-full` \
and `aces-full` are those of the public benchmark (of Intel without the relations at the log's few inexact \
stamps, both logs). Those of the other logs come from a published trajectory of a particle filter, which is \
itself off by 0.05 to 0.1 m: smaller differences there mean nothing.
- **Right**: loops are off by at most 0.12 m in the mean (particles: 0.2 m). `hospital` has no relations, \
but the robot returns: the last scan laid onto the first by an exhaustive search, apart from this program, \
puts the end 2.0 m beside the begin, and a map is right when its trajectory ends within 1 m of there. For \
`broken-odometry`, `car` and `ydlidar` nothing is known: they are not judged.
- **Warned**: the program printed at least one warning by which the map may be wrong. The verdict \
right or wrong never asks the program.
- The logs are public (Radish, Freiburg's SLAM evaluation, by way of `mola_test_datasets`; CC BY 3.0 or not \
stated) and are not part of this project.

";

const LEGEND: &str = "Each cell is the error of the loops \\[m\\] (`hospital`: from where the robot was at the end). \
`w`: right, and warned. **W**: wrong, and warned. **SILENT**: wrong without a warning. `r`: a fault of \
mounting or axes was recognized and undone, and the log mapped again. `-`: nothing known there, or cut out \
with the part of the log that is missing. Empty: not run.

| run | what it is |
|---|---|
| rotate, jitter | the first pose turned by 1 rad; stamps off by up to 10 ms |
| drop, third, gaps | every 10th scan missing; every 3rd kept; 30 s missing of every 180 s |
| thin, thin4 | every 2nd beam; every 4th |
| scale, x0.9, x1.1 | odometry times 1.03, 0.9, 1.1 |
| awful, heading | 12 % slip, a fifth of each turn, a pull to one side; 2 degrees of noise a metre |
| zero, blind, reset | odometry all zero; none; set to zero in the middle of the log |
| kidnap1..3, cut1..3 | a fifth of the log missing: carried with still wheels; the logger off |
| flipped, turned90, swapped, reversed | scanner upside down; turned by 90 degrees; axes of odometry swapped; wheels reversed |
| spurious | 5 % of the readings are random |

";

/// The page as a whole.
pub(crate) fn whole(records: &[Record], programs: &[Whole]) -> String {
    let mut text = HEAD.to_owned();
    text += "![maps of the logs](pictures/slam-maps.png)\n\n";
    text += "From the left, row by row, in pairs of ours and the published trajectory of a particle filter \
             (Rao-Blackwellized, 50 particles), both drawn from the same scans: `aces`, `csail-full`; \
             `edmonton`, `fr101`; `intel`, `seattle`. Below ours alone, from the full-rate logs: \
             `aces-full`, `car`, `hospital`, `intel-full`.\n\n";
    text += &tables(records, programs);
    text
}

/// All tables.
pub(crate) fn tables(records: &[Record], programs: &[Whole]) -> String {
    let graph: Vec<&Record> = records.iter().filter(|it| it.method == "graph").collect();
    let particles: Vec<&Record> = records.iter().filter(|it| it.method == "gmapping").collect();
    let mut text = as_they_are(&graph);
    text += &losses(&graph, &particles, programs);
    text += &perturbed(&graph);
    text += &of_particles(&particles);
    text += &costs(&graph, programs);
    text
}

fn metres(value: f64) -> String {
    if value < 1.0 { format!("{value:.3}") } else { format!("{value:.1}") }
}

fn row<T: AsRef<str>>(cells: impl IntoIterator<Item = T>) -> String {
    cells.into_iter().fold("|".to_owned(), |row, cell| row + " " + cell.as_ref() + " |") + "\n"
}

fn head(title: &str, cells: &[&str]) -> String {
    format!("## {title}\n\n{}{}\n", row(cells), "|---".repeat(cells.len()) + "|")
}

fn plain<'a>(graph: &[&'a Record]) -> Vec<&'a Record> {
    graph.iter().filter(|it| it.run == "plain").copied().collect()
}

fn as_they_are(graph: &[&Record]) -> String {
    let mut text = head(
        "As they were recorded, beside other methods",
        &[
            "log",
            "scans",
            "path m",
            "**ours**",
            "loops",
            "largest",
            "degrees",
            "Cartographer",
            "graph mapping",
            "RBPF",
            "slam_toolbox",
            "GMapping",
            "verdict",
        ],
    );
    let maybe = |value: Option<f64>| value.map_or("-".to_owned(), |it| format!("{it:.4}"));
    let pair = |value: Option<(f64, Option<f64>)>| match value {
        Some((all, Some(loops))) => format!("{all:.3} (loops {loops:.3})"),
        Some((all, None)) => format!("{all:.4}"),
        None => "-".to_owned(),
    };
    for it in plain(graph) {
        let known = it.number("all.relations") > 0.0;
        let error = |name: &str| if known { format!("{:.4}", it.number(name)) } else { "-".into() };
        let peers = peers::of(&it.log);
        let ours = if known { format!("**{}**", error("all.mean_m")) } else { "-".to_owned() };
        let end = format!("{}; ends {:.2} m from its begin", it.verdict, it.number("end_m"));
        text += &row([
            it.log.clone(),
            it.number("scans").to_string(),
            format!("{:.0}", it.number("path_m")),
            ours,
            error("loops.mean_m"),
            error("all.max_m"),
            error("all.mean_deg"),
            maybe(peers.cartographer),
            maybe(peers.graph),
            maybe(peers.rbpf),
            pair(peers.karto),
            pair(peers.gmapping),
            if it.has_loops() { it.verdict.clone() } else { end },
        ]);
    }
    text + "\nCartographer: Hess et al. 2016. Graph mapping and RBPF (a particle filter with 50 particles): \
            Kümmerle et al. 2009, on the full-rate logs. `slam_toolbox` (Karto with its default parameters) \
            and GMapping (30 particles): the programs themselves, measured on the same logs and with the \
            same relations. Cartographer on `hospital`: 0.108 m over local relations and 5.2 m over global \
            ones, which are not available here.\n\n"
}

/// Everything that another method does better, or that is not as it should be.
fn losses(graph: &[&Record], particles: &[&Record], programs: &[Whole]) -> String {
    let mut lines: Vec<String> = Vec::new();
    for it in plain(graph) {
        let (peers, ours) = (peers::of(&it.log), it.number("all.mean_m"));
        let others = [
            ("Cartographer", peers.cartographer),
            ("graph mapping", peers.graph),
            ("RBPF", peers.rbpf),
            ("slam_toolbox", peers.karto.map(|it| it.0)),
            ("GMapping", peers.gmapping.map(|it| it.0)),
        ];
        for (name, theirs) in others {
            if let Some(theirs) = theirs.filter(|theirs| *theirs < ours) {
                lines.push(format!("`{}`: {name} has {theirs:.4} m, ours {ours:.4} m.", it.log));
            }
        }
    }
    for it in graph.iter().chain(particles).filter(|it| it.is_wrong()) {
        let error = if it.has_loops() {
            format!("loops are off by {} m", metres(it.number("loops.mean_m")))
        } else {
            format!("it ends {} m from where the robot was", metres(it.number("end_error_m")))
        };
        let seed = it.seed.map_or(String::new(), |seed| format!(" (particles, seed {seed})"));
        let warned = match (it.is_silently_wrong(), it.remarks.last()) {
            (false, Some(remark)) => {
                format!("The last of {} remarks: \"{remark}\"", it.remarks.len())
            }
            _ => "**Without a warning.**".to_owned(),
        };
        lines.push(format!("`{}`, {}{seed}: {error}. {warned}", it.log, it.run));
    }
    for it in programs {
        let (peak, budget) = (it.peak_bytes, budget_bytes(it.path_m));
        if peak > budget {
            lines.push(format!(
                "`{}`: the process takes {:.1} MB, more than 30 MB + 8 MB/km, which are {:.1} MB.",
                it.log,
                peak * 1e-6,
                budget * 1e-6
            ));
        }
    }
    if lines.is_empty() {
        lines.push("Nowhere in these tables.".to_owned());
    }
    format!(
        "## Where it loses\n\n{}\n\n",
        lines.iter().map(|it| format!("- {it}")).collect::<Vec<_>>().join("\n")
    )
}

/// A cell of the table of perturbed runs.
fn cell(it: &Record) -> String {
    let remade = if it.remedy.is_some() { " r" } else { "" };
    if !it.is_judged() {
        return format!("-{}{remade}", if it.is_warned() { " w" } else { "" });
    }
    let error = metres(it.number(if it.has_loops() { "loops.mean_m" } else { "end_error_m" }));
    let mark = match (it.is_wrong(), it.is_warned()) {
        (true, false) => " **SILENT**",
        (true, true) => " **W**",
        (false, true) => " w",
        (false, false) => "",
    };
    error + mark + remade
}

fn perturbed(graph: &[&Record]) -> String {
    let logs = super::names(graph.iter().copied());
    let mut runs: Vec<&str> = Vec::new();
    for it in graph {
        if !runs.contains(&it.run.as_str()) {
            runs.push(&it.run);
        }
    }
    let mut cells = vec!["run"];
    cells.extend(logs.iter().map(String::as_str));
    let mut text = head("Perturbed", &cells);
    let missing = runs.len() * logs.len() - graph.len();
    for run in runs {
        let find = |log: &String| graph.iter().find(|it| it.run == run && it.log == *log);
        let cells = logs.iter().map(|log| find(log).map_or(String::new(), |it| cell(it)));
        text += &row(std::iter::once(run.to_owned()).chain(cells));
    }
    let judged: Vec<&&Record> = graph.iter().filter(|it| it.is_judged()).collect();
    let count = |takes: &dyn Fn(&Record) -> bool| judged.iter().filter(|it| takes(it)).count();
    let _ = writeln!(
        text,
        "\nOf {} judged runs {} are right without a warning, {} right with one, {} wrong with a warning, \
         and **{} wrong without a warning**. {} were mapped again after a fault was undone.\n",
        judged.len(),
        count(&|it| !it.is_wrong() && !it.is_warned()),
        count(&|it| !it.is_wrong() && it.is_warned()),
        count(&|it| it.is_wrong() && it.is_warned()),
        count(&|it| it.is_silently_wrong()),
        graph.iter().filter(|it| it.remedy.is_some()).count()
    );
    if missing > 0 {
        let _ = writeln!(
            text,
            "**{missing} of the {} runs of this table have not been made yet** (empty cells; `cargo xtask bench \
             slam` makes all).\n",
            missing + graph.len()
        );
    }
    text + LEGEND
}

fn of_particles(particles: &[&Record]) -> String {
    let mut text = head(
        "Particles (`--method gmapping`)",
        &[
            "log and seed",
            "all",
            "loops",
            "updates",
            "resamplings",
            "memory MB",
            "CPU ms a scan",
            "verdict",
        ],
    );
    for it in particles {
        let known = it.number("all.relations") > 0.0;
        let error = |name: &str| if known { format!("{:.4}", it.number(name)) } else { "-".into() };
        let end = format!("{}; ends {:.2} m from its begin", it.verdict, it.number("end_m"));
        text += &row([
            format!("{} {}", it.log, it.seed.unwrap_or_default()),
            error("all.mean_m"),
            error("loops.mean_m"),
            it.number("kept").to_string(),
            it.number("resamplings").to_string(),
            format!("{:.1}", it.number("bytes") * 1e-6),
            format!("{:.1}", it.number("scan_ms")),
            if it.has_loops() { it.verdict.clone() } else { end },
        ]);
    }
    text + "\nThirty particles, the logs as they were recorded. Memory is that of the mapper; the times are of \
            one machine, see below.\n\n"
}

fn costs(graph: &[&Record], programs: &[Whole]) -> String {
    let mut text = head(
        "Time and memory on one machine",
        &[
            "log",
            "CPU ms a scan",
            "p99",
            "longest",
            "at the end ms",
            "process MB",
            "30 MB + 8 MB/km",
            "whole CPU s",
            "exit code",
            "edges",
        ],
    );
    for it in plain(graph) {
        let program = programs.iter().find(|program| program.log == it.log);
        let ms = |name: &str| format!("{:.1}", it.number(name));
        let of = |value: fn(&Whole) -> String| program.map_or(String::new(), value);
        text += &row([
            it.log.clone(),
            format!("{:.2}", it.number("scan_ms")),
            ms("p99_ms"),
            ms("worst_ms"),
            ms("finish_ms"),
            of(|it| format!("{:.1}", it.peak_bytes * 1e-6)),
            of(|it| format!("{:.1}", budget_bytes(it.path_m) * 1e-6)),
            of(|it| format!("{:.1}", it.cpu_s)),
            of(|it| it.code.map_or("-".to_owned(), |it| it.to_string())),
            of(|it| it.edges.to_string()),
        ]);
    }
    text + "\nTimes are CPU of one thread, while other programs ran beside it. Times, and the memory of the \
            process, differ from run to run and from machine to machine; nothing else on this page does. \
            *Process* is the peak of the whole of `periplus slam LOG --out DIR`, with the log read and all \
            pictures drawn. *Edges* are those of the graph as `--g2o` writes it; the command fails unless the \
            report has the same.\n"
}

/// Columns that differ from machine to machine.
const MEASURED: [&str; 10] = [
    "CPU ms a scan",
    "p99",
    "longest",
    "at the end ms",
    "process MB",
    "30 MB + 8 MB/km",
    "whole CPU s",
    "exit code",
    "edges",
    "memory MB",
];

/// Cells of all tables: by heading, first cell of the row, and column.
fn cells(text: &str) -> BTreeMap<(String, String, String), String> {
    let mut cells = BTreeMap::new();
    let (mut title, mut columns) = (String::new(), Vec::new());
    for line in text.lines() {
        if let Some(name) = line.strip_prefix("## ") {
            (title, columns) = (name.to_owned(), Vec::new());
        }
        let Some(inner) = line.strip_prefix("| ").and_then(|it| it.strip_suffix(" |")) else {
            continue;
        };
        let words: Vec<String> = inner.split(" | ").map(|it| it.trim().to_owned()).collect();
        if columns.is_empty() {
            columns = words;
            continue;
        }
        for (column, word) in columns.iter().zip(&words).skip(1) {
            if !MEASURED.contains(&column.as_str()) {
                cells.insert((title.clone(), words[0].clone(), column.clone()), word.clone());
            }
        }
    }
    cells
}

/// Compares runs with what the page has of them, but for times and memory.
///
/// # Errors
/// When a figure is another one, or the page has none.
pub(crate) fn check(path: &Path, records: &[Record]) -> Result<(), Failed> {
    let text = std::fs::read_to_string(path).map_err(super::failed(path))?;
    let (on_page, now) = (cells(&text), cells(&tables(records, &[])));
    let compared = now.iter().filter(|(_, cell)| !cell.is_empty());
    let (mut count, mut faults) = (0, Vec::new());
    for (key, cell) in compared {
        count += 1;
        let page = on_page.get(key).map_or("nothing", String::as_str);
        if page != cell {
            faults
                .push(format!("{}, {}, {}: the page has {page}, now {cell}", key.0, key.1, key.2));
        }
    }
    if faults.is_empty() {
        println!("{count} figures are those of {}", path.display());
        return Ok(());
    }
    Err(Failed(format!(
        "{} of {count} figures differ from {}; write it again with `cargo xtask bench slam`\n{}",
        faults.len(),
        path.display(),
        faults.join("\n")
    )))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tables_are_read_back_without_what_is_measured() {
        let text = format!(
            "{}{}\n",
            head("Perturbed", &["run", "aces", "p99"]),
            row(["plain", "0.034 w", "1.5"])
        );
        let key = ("Perturbed".to_owned(), "plain".to_owned(), "aces".to_owned());
        assert_eq!(cells(&text), BTreeMap::from([(key, "0.034 w".to_owned())]));
    }
}
