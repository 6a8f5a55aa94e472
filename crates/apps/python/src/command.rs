//! The command `periplus` in this module, so that the package has no second copy of the program.

use std::io::Write as _;
use std::process::ExitCode;

use pyo3::prelude::*;
use pyo3::types::PyModule;

pub(crate) fn register(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_function(wrap_pyfunction!(run_command, module)?)
}

/// Runs the command line `arguments`, the first of which is the name of the program, and returns its exit code.
/// `interpreter` is the Python that runs, to start this command and nodes in Python in other processes.
#[pyfunction]
fn run_command(py: Python<'_>, arguments: Vec<String>, interpreter: String) -> u8 {
    let own_command = vec![interpreter.clone(), "-m".to_owned(), "periplus".to_owned()];
    let code = py.detach(|| {
        let code = periplus_cli::run(arguments, own_command, Some(interpreter));
        // At the end of a Rust program this happens by itself. A closed pipe is nothing to report.
        let _ = std::io::stdout().flush();
        code
    });
    (0..=u8::MAX).find(|number| ExitCode::from(*number) == code).unwrap_or(1)
}
