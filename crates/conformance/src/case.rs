//! A case.

use serde_json::Value;

use crate::reader::{Reader, Unreadable};

/// What a case says.
#[derive(Clone, Debug)]
pub struct Case {
    /// The name of the file.
    pub file: String,
    /// Its own name.
    pub id: String,
    /// What is checked.
    pub kind: String,
    /// The same in words.
    pub title: String,
    /// The distributions of ROS that behave so.
    pub applies_to: Vec<String>,
    /// How far a number may be off; without it whole numbers are exact and others to 1e-6.
    pub tolerance: Option<f64>,
    content: Value,
}

/// How far numbers that are not whole may be off.
const TOLERANCE: f64 = 1e-6;

impl Case {
    /// Reads a case.
    ///
    /// # Errors
    /// Why it is none.
    pub fn read(file: &str, text: &str) -> Result<Self, Unreadable> {
        let content: Value =
            serde_json::from_str(text).map_err(|error| Unreadable(format!("no JSON: {error}")))?;
        let reader = Reader::new(&content, "case");
        let word = |name: &str| Ok(reader.get(name)?.text()?.to_owned());
        let applies_to = match reader.find("applies_to") {
            Some(list) => list.each(|it| Ok(it.text()?.to_owned()))?,
            None => Vec::new(),
        };
        Ok(Self {
            file: file.to_owned(),
            id: word("id")?,
            kind: word("kind")?,
            title: word("title").unwrap_or_default(),
            applies_to,
            tolerance: reader.find("tolerance").map(|it| it.number()).transpose()?,
            content,
        })
    }

    /// What is given.
    #[must_use]
    pub fn given(&self) -> Reader<'_> {
        Reader::new(&self.content["given"], "given")
    }

    /// What to expect.
    #[must_use]
    pub fn expect(&self) -> Reader<'_> {
        Reader::new(&self.content["expect"], "expect")
    }

    /// How far a number that is not whole may be off.
    #[must_use]
    pub fn tolerance(&self) -> f64 {
        self.tolerance.unwrap_or(TOLERANCE)
    }
}
