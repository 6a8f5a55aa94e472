//! The program `periplus`.

use std::process::ExitCode;

fn main() -> ExitCode {
    let own = std::env::current_exe().ok().map(|path| vec![path.display().to_string()]);
    periplus_cli::run(std::env::args().collect(), own.unwrap_or_default(), None)
}
