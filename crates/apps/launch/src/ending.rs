//! Shutdown functions of a launch file in Python.

use serde_json::Value;

use crate::outside::{Complaint, Interpreter};

/// Functions to call at shutdown (`OnShutdown`), and the interpreter that has them. They are called
/// by [`Ending::run`] only.
#[derive(Default)]
pub struct Ending {
    pub(crate) interpreter: Option<Box<dyn Interpreter>>,
    pub(crate) calls: Vec<Value>,
}

impl Ending {
    /// Calls the functions in order; returns their errors.
    pub fn run(self) -> Vec<Complaint> {
        let Some(mut interpreter) = self.interpreter else { return Vec::new() };
        let refuse = |_| Err("this is not available at shutdown".to_owned());
        let call = |call| interpreter.ask(call, &mut { refuse }).err();
        self.calls.into_iter().filter_map(call).collect()
    }
}
