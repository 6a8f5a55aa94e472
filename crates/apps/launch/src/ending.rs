//! What a launch file in Python does when everything ends.

use serde_json::Value;

use crate::outside::{Complaint, Interpreter};

/// Functions that a launch file wants to be called at its end (`OnShutdown`), and the interpreter that
/// knows them. Without a call of [`Ending::run`] they are not called.
#[derive(Default)]
pub struct Ending {
    pub(crate) interpreter: Option<Box<dyn Interpreter>>,
    pub(crate) calls: Vec<Value>,
}

impl Ending {
    /// Calls the functions in their order; what they complain about.
    pub fn run(self) -> Vec<Complaint> {
        let Some(mut interpreter) = self.interpreter else { return Vec::new() };
        let refuse = |_| Err("this is not known any more when everything ends".to_owned());
        let call = |call| interpreter.ask(call, &mut { refuse }).err();
        self.calls.into_iter().filter_map(call).collect()
    }
}
