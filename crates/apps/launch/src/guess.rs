//! "Did you mean" suggestions.

use periplus_diagnostics::{Diagnostic, closest};

pub(crate) trait Guess {
    /// Adds the most similar known name, if there is one.
    fn guess<'a>(self, written: &str, known: impl IntoIterator<Item = &'a str>) -> Self;
}

impl Guess for Diagnostic {
    fn guess<'a>(self, written: &str, known: impl IntoIterator<Item = &'a str>) -> Self {
        match closest(written, known) {
            Some(near) => self.help(format!("did you mean `{near}`?")),
            None => self,
        }
    }
}
