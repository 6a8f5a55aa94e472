//! "Did you mean" suggestions.

use periplus_diagnostics::{Diagnostic, closest};

pub(crate) trait Suggest {
    /// Adds the most similar known name, if there is one.
    fn suggest<'a>(self, written: &str, known: impl IntoIterator<Item = &'a str>) -> Self;
}

impl Suggest for Diagnostic {
    fn suggest<'a>(self, written: &str, known: impl IntoIterator<Item = &'a str>) -> Self {
        match closest(written, known) {
            Some(near) => self.help(format!("did you mean `{near}`?")),
            None => self,
        }
    }
}
