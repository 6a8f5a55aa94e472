//! The language of the tree: words, openings of doc comments, names of constants and types.
//!
//! The words are data, in `xtask/tidy/words.yaml`. Findings that the tree still has are counted in
//! `xtask/tidy/ratchet.yaml`; the command fails where a count rises.

mod checks;
mod passages;
mod pattern;
mod prose;
mod ratchet;
mod rules;
mod rust;
mod sample;
mod source;
#[cfg(test)]
mod tree;
mod viewer;

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write as _;
use std::fs;
use std::ops::Range;
use std::path::Path;
use std::process::Command;

use crate::step::{Failed, root};
use checks::{Check, Finding, constants, results, types};
use prose::{Part, Passage, Source};
use ratchet::Counts;
use rules::Rules;
use sample::Random;
use source::{File, Rust, line_and_column};

/// File of the words, below the root.
const WORDS: &str = "xtask/tidy/words.yaml";
/// Folder of the checks, below the root.
const RULES: &str = "xtask/src/tidy";
/// File of the counts that are left, below the root.
const RATCHET: &str = "xtask/tidy/ratchet.yaml";
/// Bytes shown on each side of a sampled finding.
const CONTEXT_BYTE_COUNT: usize = 140;

/// Options of `cargo xtask tidy`.
#[derive(Default, clap::Args)]
pub(crate) struct Options {
    /// Print the findings of a check: file:line:column: text -> replacement
    #[arg(long, value_name = "CHECK", conflicts_with_all = ["counts", "update"])]
    list: Option<Check>,
    /// With --list: only findings of this package (`periplus-slam`, `docs`, `viewer`)
    #[arg(long = "crate", value_name = "PACKAGE", requires = "list")]
    package: Option<String>,
    /// With --list words: only findings of the entry of this name
    #[arg(long, value_name = "WORDS", requires = "list")]
    entry: Option<String>,
    /// Print a table of all counts
    #[arg(long, conflicts_with_all = ["update", "sample"])]
    counts: bool,
    /// Print N random sentences of each source of prose; with --list, N random findings in context
    #[arg(long, value_name = "N", conflicts_with = "update")]
    sample: Option<usize>,
    /// Seed of the sample
    #[arg(long, value_name = "S", default_value_t = 1, requires = "sample")]
    seed: u64,
    /// Commit to fewer findings: lower the counts to the present ones
    #[arg(long)]
    update: bool,
    /// With --update: accept more findings in a package when others have as many fewer, since code moved
    #[arg(long, requires = "update")]
    moved: bool,
    /// With --update: accept more findings, since this change makes a rule stricter
    #[arg(long, requires = "update")]
    stricter: bool,
}

/// Everything that was read and found.
struct Report {
    files: Vec<File>,
    /// Findings with the indices of their files, in the order of files and positions.
    findings: Vec<(usize, Finding)>,
    passages: Vec<(usize, Passage)>,
    rules: Rules,
    /// Number of public types and of their names, without shared ones.
    type_count: usize,
    type_name_count: usize,
}

/// Runs the command.
///
/// # Errors
/// More findings than committed, and data files that cannot be read.
pub(crate) fn run(options: &Options) -> Result<(), Failed> {
    let root = root();
    let words = read(&root, WORDS)?;
    let rules = Rules::parse(WORDS, &words)?;
    let report = report(source::files(&root)?, rules);
    if let Some(check) = options.list {
        list(&report, check, options);
        return Ok(());
    }
    if options.counts {
        print!("{}", table(&report));
        return Ok(());
    }
    if let Some(count) = options.sample {
        sentences(&report, count, options.seed);
        return Ok(());
    }
    let allowed = match fs::read_to_string(root.join(RATCHET)) {
        Ok(text) => ratchet::parse(RATCHET, &text)?,
        // Without the file nothing is allowed.
        Err(_) => Counts::new(),
    };
    let packages: BTreeSet<String> = report.files.iter().map(|file| file.package.clone()).collect();
    let found = counts(&report);
    if options.update {
        if options.stricter {
            stricter(&root)?;
            return write(&root, &ratchet::render(&found));
        }
        let lowered = ratchet::lowered(&allowed, &found, &packages, options.moved)
            .map_err(|rises| refused(&rises))?;
        return write(&root, &ratchet::render(&lowered));
    }
    let rises = ratchet::rises(&allowed, &found, &packages);
    if !rises.is_empty() {
        return Err(refused(&rises));
    }
    let total = |counts: &Counts| counts.values().flat_map(BTreeMap::values).sum::<usize>();
    println!("{} findings, {} allowed", total(&found), total(&allowed));
    if total(&found) < total(&allowed) {
        println!("lower the allowed ones with `cargo xtask tidy --update`");
    }
    Ok(())
}

fn read(root: &Path, path: &str) -> Result<String, Failed> {
    fs::read_to_string(root.join(path))
        .map_err(|error| Failed(format!("{path}: {error}; restore it with `git checkout {path}`")))
}

/// Refuses where the rules are as committed.
fn stricter(root: &Path) -> Result<(), Failed> {
    let mut command = Command::new("git");
    command.current_dir(root).args(["status", "--porcelain", "--", WORDS, RULES]);
    let output = command.output().map_err(|error| {
        Failed(format!("`git status` cannot be started ({error}): install Git"))
    })?;
    if output.stdout.is_empty() {
        let why = format!("neither {WORDS} nor {RULES} has changed; mend the findings");
        return Err(Failed(why));
    }
    Ok(())
}

/// Writes the counts, or removes their file when nothing is left.
fn write(root: &Path, text: &str) -> Result<(), Failed> {
    let path = root.join(RATCHET);
    let done = match text {
        "" if path.exists() => fs::remove_file(&path),
        "" => Ok(()),
        text => fs::write(&path, text),
    };
    done.map_err(|error| {
        Failed(format!("{RATCHET} cannot be written: {error}; mend that and repeat"))
    })
}

fn refused(rises: &[ratchet::Rise]) -> Failed {
    let mut lines = vec!["more findings than are committed; mend the new ones:".to_owned()];
    lines.extend(rises.iter().map(|rise| {
        let ratchet::Rise { check, package, allowed, found } = rise;
        format!(
            "{check} in {package}: {found}, {allowed} allowed; \
             `cargo xtask tidy --list {check} --crate {package}` shows them"
        )
    }));
    lines.push(
        "where code only moved between packages, `cargo xtask tidy --update --moved` accepts it"
            .into(),
    );
    Failed(lines.join("\n       "))
}

/// Runs all checks.
fn report(files: Vec<File>, rules: Rules) -> Report {
    let mut findings: Vec<(usize, Finding)> = Vec::new();
    let mut passages: Vec<(usize, Passage)> = Vec::new();
    let mut all_types = Vec::new();
    let mut text_constants: BTreeSet<String> = BTreeSet::new();
    for (at, file) in files.iter().enumerate() {
        if rules.is_exempt(&file.path) {
            continue;
        }
        let found = if file.path.ends_with(".rs") {
            let rust = Rust::new(file);
            let objections = constants::check(&rust, &rules.constants)
                .into_iter()
                .chain(results::check_signatures(&rust))
                .chain(results::check_codes(&rust));
            findings.extend(objections.map(|finding| (at, finding)));
            text_constants.extend(results::text_constants(&rust).map(str::to_owned));
            all_types.extend(types::types(&rust, &rules.types, at));
            passages::of_rust(&rust)
        } else {
            passages::of_text(file)
        };
        for passage in found {
            findings.extend(
                checks::prose::check(&passage, &rules).into_iter().map(|finding| (at, finding)),
            );
            passages.push((at, passage));
        }
    }
    findings.retain(|(_, finding)| {
        finding.check != Check::Codes
            || finding.entry.is_empty()
            || text_constants.contains(&finding.entry)
    });
    findings.extend(types::check(&all_types, &rules.types, |file| files[file].path.clone()));
    findings.sort_by_key(|(file, finding)| (*file, finding.range.start, finding.check));
    let names: BTreeSet<&str> = all_types.iter().map(|one| one.name.as_str()).collect();
    let (type_count, type_name_count) = (all_types.len(), names.len());
    Report { files, findings, passages, rules, type_count, type_name_count }
}

fn counts(report: &Report) -> Counts {
    let mut counts = Counts::new();
    for (file, finding) in &report.findings {
        let package = report.files[*file].package.clone();
        *counts.entry(finding.check).or_default().entry(package).or_default() += 1;
    }
    counts
}

fn list(report: &Report, check: Check, options: &Options) {
    let is_wanted = |(file, finding): &&(usize, Finding)| {
        let package = &report.files[*file].package;
        let is_of_package = options.package.as_ref().is_none_or(|wanted| {
            wanted == package || package.strip_prefix("periplus-") == Some(wanted.as_str())
        });
        let is_of_entry = options.entry.as_ref().is_none_or(|wanted| *wanted == finding.entry);
        finding.check == check && is_of_package && is_of_entry
    };
    let mut wanted: Vec<_> = report.findings.iter().filter(is_wanted).collect();
    if let Some(count) = options.sample {
        wanted = Random::new(options.seed).pick(wanted, count);
    }
    for (file, finding) in &wanted {
        let file = &report.files[*file];
        let (line, column) = line_and_column(&file.text, finding.range.start);
        println!("{}:{line}:{column}: {} -> {}", file.path, finding.text, finding.advice);
        if options.sample.is_some() {
            println!("    {}", context(&file.text, &finding.range));
        }
    }
}

/// Text around a finding in one line, the finding in brackets.
fn context(text: &str, range: &Range<usize>) -> String {
    let start = text.floor_char_boundary(range.start.saturating_sub(CONTEXT_BYTE_COUNT));
    let end = text.ceil_char_boundary((range.end + CONTEXT_BYTE_COUNT).min(text.len()));
    let one_line = |part: &str| {
        let words = part.split_whitespace().filter(|word| !matches!(*word, "///" | "//!" | "//"));
        words.collect::<Vec<_>>().join(" ")
    };
    let (before, hit, after) =
        (&text[start..range.start], &text[range.clone()], &text[range.end..end]);
    format!("{} [[{}]] {}", one_line(before), one_line(hit), one_line(after))
}

/// Table of all counts.
fn table(report: &Report) -> String {
    let count =
        |check| report.findings.iter().filter(|(_, finding)| finding.check == check).count();
    let is_doc =
        |(_, passage): &&(usize, Passage)| matches!(passage.source, Source::Doc | Source::Help);
    let docs = report.passages.iter().filter(is_doc).count();
    let opening_count = count(Check::Openings);
    let percent = 100.0 * opening_count as f64 / docs.max(1) as f64;
    let repeated: BTreeSet<&str> = report
        .findings
        .iter()
        .filter(|(_, finding)| finding.check == Check::Types)
        .map(|(_, finding)| finding.text.as_str())
        .collect();
    let mut rows = vec![
        ("openings".to_owned(), opening_count, format!("{percent:.1} % of {docs} doc comments")),
        (
            "types".to_owned(),
            count(Check::Types),
            format!(
                "of {}; {} of {} names are defined more than once",
                report.type_count,
                repeated.len(),
                report.type_name_count
            ),
        ),
        ("constants".to_owned(), count(Check::Constants), String::new()),
        ("results".to_owned(), count(Check::Results), "public signatures".to_owned()),
        ("codes".to_owned(), count(Check::Codes), String::new()),
        ("words".to_owned(), count(Check::Words), String::new()),
    ];
    let mut by_entry: BTreeMap<&str, usize> = BTreeMap::new();
    for (_, finding) in report.findings.iter().filter(|(_, finding)| finding.check == Check::Words)
    {
        *by_entry.entry(&finding.entry).or_default() += 1;
    }
    rows.extend(report.rules.entries.iter().map(|entry| {
        let count = by_entry.get(entry.name.as_str()).copied().unwrap_or_default();
        (format!("  {}", entry.name), count, entry.advice())
    }));
    let mut table = String::new();
    for (name, count, remark) in rows {
        let _ = writeln!(table, "{}", format!("{name:<28} {count:>6}  {remark}").trim_end());
    }
    table
}

/// Prints random sentences of each source.
fn sentences(report: &Report, count: usize, seed: u64) {
    type IsOf = fn(&str, Source) -> bool;
    let sources: [(&str, IsOf); 5] = [
        ("README", |path, _| path == "README.md"),
        ("docs", |path, source| path.starts_with("docs/") && source == Source::Page),
        ("help", |_, source| source == Source::Help),
        ("messages", |_, source| source == Source::Message),
        ("doc comments", |_, source| source == Source::Doc),
    ];
    for (title, is_of) in sources {
        println!("== {title}");
        let of = report
            .passages
            .iter()
            .filter(|(file, passage)| is_of(&report.files[*file].path, passage.source));
        let all: Vec<_> = of
            .flat_map(|(file, passage)| split(passage).map(move |range| (*file, passage, range)))
            .collect();
        for (file, passage, range) in Random::new(seed).pick(all, count) {
            let file = &report.files[file];
            let (line, _) = line_and_column(&file.text, passage.offset_in_file(range.start));
            let words: Vec<&str> = passage.text[range].split_whitespace().collect();
            println!("{}:{line}: {}", file.path, words.join(" "));
        }
    }
}

/// Sentences of at least three words.
fn split(passage: &Passage) -> impl Iterator<Item = Range<usize>> + use<> {
    let atoms = prose::atoms(passage);
    let mut sentences = Vec::new();
    let mut from = 0;
    for at in 0..=atoms.len() {
        if at < atoms.len() && atoms[at].part != Part::Stop {
            continue;
        }
        let words = atoms[from..at].iter().filter(|atom| atom.part == Part::Word).count();
        if words >= 3 {
            let end = atoms.get(at).filter(|stop| stop.range.len() == 1).unwrap_or(&atoms[at - 1]);
            sentences.push(atoms[from].range.start..end.range.end);
        }
        from = at + 1;
    }
    sentences.into_iter()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_words_can_be_read() {
        let text = read(&root(), WORDS).expect("the words");
        let rules = Rules::parse(WORDS, &text).unwrap_or_else(|Failed(why)| panic!("{why}"));
        assert!(rules.entries.len() > 10);
    }

    #[test]
    fn sentences_end_at_stops() {
        let text = "# A\nOne two three. Four five. Six seven\neight nine\n\nTen";
        let mut passage = Passage::new(Source::Page);
        passage.push(text, 0..text.len());
        let found: Vec<_> = split(&passage).map(|range| text[range].to_owned()).collect();
        assert_eq!(found, ["One two three.", "Six seven\neight nine"]);
    }

    #[test]
    fn findings_are_shown_in_context() {
        assert_eq!(context("/// a\n/// who b\n", &(10..13)), "a [[who]] b");
    }
}
