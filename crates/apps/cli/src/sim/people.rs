//! People of a run, by their number or from a file.

use std::path::Path;

use periplus_sim::{MAX_PEOPLE_COUNT, PeopleFile, read_people};

use crate::error::CliError;
use crate::terminal;

/// Reads the value of `--people`, and prints the findings of a file.
pub(crate) fn read(word: &str) -> Result<PeopleFile, CliError> {
    if let Ok(count) = word.parse::<i64>() {
        return match usize::try_from(count) {
            Ok(count @ 1..=MAX_PEOPLE_COUNT) => Ok(PeopleFile::wandering(count)),
            _ => Err(CliError::Usage(format!(
                "`--people {word}`: expected a number of people from 1 to {MAX_PEOPLE_COUNT}, or a YAML file"
            ))),
        };
    }
    let (file, findings) = read_people(Path::new(word));
    terminal::diagnostics(&mut anstream::stderr().lock(), &findings, &file.sources)?;
    if findings.has_errors() {
        return Err(CliError::Failed(format!("people cannot be read from `{word}`")));
    }
    Ok(file)
}
