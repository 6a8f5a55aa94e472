//! A case.

use serde_json::Value;

use crate::expected::Expected;
use crate::reader::{CaseReader, Unreadable};
use crate::used::Used;

/// A conformance case.
#[derive(Debug)]
pub struct Case {
    /// The name of the file.
    pub file: String,
    /// Its own name.
    pub id: String,
    /// Behaviour that is checked.
    pub kind: String,
    /// The same in words.
    pub title: String,
    /// The distributions of ROS that behave so: `applies_to`, or `distro` in cases of navigation.
    pub applies_to: Vec<String>,
    /// Tolerance of numbers; by default integers are exact and others have 1e-6.
    pub tolerance: Option<f64>,
    content: Value,
    used: Used,
}

/// Default tolerance of numbers that are not integers.
const TOLERANCE: f64 = 1e-6;

impl Case {
    /// Reads a case.
    ///
    /// # Errors
    /// Why it is none.
    pub fn read(file: &str, text: &str) -> Result<Self, Unreadable> {
        let content: Value =
            serde_json::from_str(text).map_err(|error| Unreadable(format!("not JSON: {error}")))?;
        let used = Used::default();
        let reader = CaseReader::new(&content, &used, "case");
        let word = |name: &str| Ok(reader.get(name)?.text()?.to_owned());
        for about in ["source", "basis", "title"] {
            if let Some(about) = reader.find(about) {
                about.skip();
            }
        }
        let applies_to = match reader.find_any(&["applies_to", "distro"]) {
            Some(list) => list.each(|it| Ok(it.text()?.to_owned()))?,
            None => Vec::new(),
        };
        let (id, kind) = (word("id")?, word("kind")?);
        let title = word("title").unwrap_or_default();
        let tolerance = reader.find("tolerance").map(|it| it.number()).transpose()?;
        Ok(Self { file: file.to_owned(), id, kind, title, applies_to, tolerance, content, used })
    }

    /// Inputs of the case.
    #[must_use]
    pub fn given(&self) -> CaseReader<'_> {
        CaseReader::new(&self.content["given"], &self.used, "given")
    }

    /// Expected results.
    #[must_use]
    pub fn expect(&self) -> Expected<'_> {
        Expected::new(CaseReader::new(&self.content["expect"], &self.used, "expect"))
    }

    /// The paths of what no check of this case has used yet.
    #[must_use]
    pub fn unused(&self) -> Vec<String> {
        let unused = self.used.unused(&self.content, "");
        unused.into_iter().map(|path| path.trim_start_matches('.').to_owned()).collect()
    }

    /// Tolerance of numbers that are not integers.
    #[must_use]
    pub fn tolerance(&self) -> f64 {
        self.tolerance.unwrap_or(TOLERANCE)
    }
}
