//! `periplus check`.

use std::io::{self, Write as _};
use std::process::ExitCode;

use periplus_session::check::{CheckedFile, report};

use crate::error::CliError;
use crate::options::{CheckOptions, split};
use crate::terminal::with_setting;

pub(crate) fn run(options: &CheckOptions) -> Result<ExitCode, CliError> {
    let (files, arguments) = split(&options.words);
    if files.is_empty() {
        return Err(CliError::usage(
            "no file is given, only `name:=value`; see `periplus check --help`",
        ));
    }
    let mut out = anstream::AutoStream::auto(io::stdout().lock());
    with_setting(&options.search.resource_path, arguments, |setting| {
        let mut failed = false;
        let mut reports = Vec::new();
        // Several files share the arguments: an argument that no file declares is an error.
        let mut unknown: Vec<&str> =
            setting.arguments.iter().map(|(name, _)| name.as_str()).collect();
        for (index, file) in files.iter().enumerate() {
            let mut checked = CheckedFile::read(file, setting);
            let of_this = checked.loaded.unknown_arguments(&setting.arguments);
            unknown.retain(|name| of_this.contains(name));
            if index + 1 == files.len() {
                unknown.iter().for_each(|name| checked.loaded.warn_of_argument(name));
            }
            failed |= checked.is_bad(options.strict);
            if options.json {
                reports.push(checked.to_json());
            } else {
                if index > 0 && !options.quiet {
                    writeln!(out)?;
                }
                checked.write_text(&mut out, options.quiet)?;
            }
        }
        if options.json {
            writeln!(out, "{:#}", report(&reports, !failed))?;
        }
        out.flush()?;
        Ok(if failed { ExitCode::FAILURE } else { ExitCode::SUCCESS })
    })
}
