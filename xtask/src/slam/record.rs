//! Runs as the example `logs` writes them.

use std::path::Path;

use serde_json::Value;

use crate::step::Failed;

/// One run of one log.
pub(crate) struct Record {
    pub(crate) log: String,
    pub(crate) run: String,
    pub(crate) method: String,
    pub(crate) seed: Option<u64>,
    pub(crate) verdict: String,
    pub(crate) remedy: Option<String>,
    pub(crate) remarks: Vec<String>,
    /// As it was written.
    pub(crate) line: String,
    value: Value,
}

impl Record {
    fn new(line: &str) -> Option<Self> {
        let value: Value = serde_json::from_str(line).ok()?;
        let text = |name: &str| value[name].as_str().map(str::to_owned);
        let texts = value["remarks"].as_array()?.iter();
        Some(Self {
            log: text("log")?,
            run: text("run")?,
            method: text("method")?,
            seed: value["seed"].as_u64(),
            verdict: text("verdict")?,
            remedy: text("remedy"),
            remarks: texts.filter_map(Value::as_str).map(str::to_owned).collect(),
            line: line.to_owned(),
            value,
        })
    }

    /// A number by its name, or of a group of errors by `group.name`; 0 where there is none.
    pub(crate) fn number(&self, name: &str) -> f64 {
        let value = name.split('.').fold(&self.value, |value, part| &value[part]);
        value.as_f64().unwrap_or_default()
    }

    /// True if relations between revisited poses are known.
    pub(crate) fn has_loops(&self) -> bool {
        self.number("loops.relations") > 0.0
    }

    pub(crate) fn is_wrong(&self) -> bool {
        self.is_silently_wrong() || self.verdict.starts_with("wrong")
    }

    pub(crate) fn is_silently_wrong(&self) -> bool {
        self.verdict == "SILENTLY WRONG"
    }

    pub(crate) fn is_warned(&self) -> bool {
        self.verdict.ends_with("warned")
    }

    pub(crate) fn is_judged(&self) -> bool {
        !self.verdict.starts_with("not judged")
    }
}

/// Reads a file of runs.
pub(crate) fn read(path: &Path) -> Result<Vec<Record>, Failed> {
    let text = std::fs::read_to_string(path).map_err(super::failed(path))?;
    let record = |(index, line): (usize, &str)| {
        let why =
            || Failed(format!("{}:{}: this is not the record of a run", path.display(), index + 1));
        Record::new(line).ok_or_else(why)
    };
    text.lines().enumerate().map(record).collect()
}
