//! The tutorials in `docs/tutorials`: every block of commands is run, and what it promises is checked.
//!
//! The first line of a block defines its kind:
//!
//! | block | what is done |
//! |---|---|
//! | `sh` | its commands are run to their end, and have to succeed |
//! | `sh terminal=NAME` | they run on, as in a terminal that is left open; a later block of that name ends what ran there |
//! | `text` | what the last block printed has these lines, in this order; `...` stands for anything |
//! | `... file=PATH` | a reader saves it there |
//!
//! Between them comments that a reader does not see: `<!-- check: COMMAND -->` has to succeed at once,
//! `<!-- await: COMMAND -->` within a minute, `<!-- close: NAME -->` ends what runs in a terminal.
//! `<!-- picture: FILE.png [FILE.rviz] -->` takes a picture of the page, when pictures are wished.

mod page;
mod play;

use std::path::{Path, PathBuf};

use crate::python;
use crate::step::{Failed, build_program, root, timed};

/// Runs all tutorials, or those whose names contain a word; takes their pictures if that is wished.
pub(crate) fn run_all(only: Option<&str>, pictures: bool) -> Result<(), Failed> {
    timed("tutorials: periplus", build_program)?;
    let python = python::with_package()?;
    let files = files()?;
    let chosen = |file: &PathBuf| only.is_none_or(|word| name(file).contains(word));
    for file in files.into_iter().filter(chosen) {
        timed(&format!("tutorial {}", name(&file)), || follow(&file, &python, pictures))?;
    }
    Ok(())
}

/// Those with something to run.
fn files() -> Result<Vec<PathBuf>, Failed> {
    let folder = root().join("docs/tutorials");
    let failed = |error| Failed(format!("cannot read {}: {error}", folder.display()));
    let entries = std::fs::read_dir(&folder).map_err(failed)?;
    let mut files: Vec<PathBuf> = entries.filter_map(|it| Some(it.ok()?.path())).collect();
    files.retain(|file| file.extension().is_some_and(|it| it == "md"));
    files.sort();
    Ok(files)
}

fn name(file: &Path) -> String {
    file.file_stem().unwrap_or_default().to_string_lossy().into_owned()
}

fn follow(file: &Path, python: &Path, pictures: bool) -> Result<(), Failed> {
    let text = std::fs::read_to_string(file)
        .map_err(|error| Failed(format!("cannot read {}: {error}", file.display())))?;
    let steps = page::steps(&text).map_err(|why| Failed(format!("{}:{why}", file.display())))?;
    if steps.is_empty() {
        return Ok(());
    }
    let terminals = play::Terminals::new(&name(file), python, pictures)?;
    play::play(&steps, terminals).map_err(|why| Failed(format!("{}:{why}", file.display())))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_tutorial_can_be_read() {
        for file in files().unwrap_or_default() {
            let text = std::fs::read_to_string(&file).unwrap_or_default();
            if let Err(why) = page::steps(&text) {
                panic!("{}:{why}", file.display());
            }
        }
    }
}
