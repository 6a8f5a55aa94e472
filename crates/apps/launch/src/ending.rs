//! Shutdown functions of a launch file in Python.

use serde_json::Value;

use crate::outside::{Interpreter, LaunchError};

/// Functions to call at shutdown (`OnShutdown`), and the interpreter that has them. They are called
/// by [`ShutdownHandlers::run`] only.
#[derive(Default)]
pub struct ShutdownHandlers {
    pub(crate) interpreter: Option<Box<dyn Interpreter>>,
    pub(crate) calls: Vec<Value>,
}

impl ShutdownHandlers {
    /// Calls the functions in order; returns their errors.
    pub fn run(self) -> Vec<LaunchError> {
        let Some(mut interpreter) = self.interpreter else { return Vec::new() };
        let refuse = |_| Err("this is not available at shutdown".to_owned().into());
        let call = |call| interpreter.ask(call, &mut { refuse }).err();
        self.calls.into_iter().filter_map(call).collect()
    }
}
