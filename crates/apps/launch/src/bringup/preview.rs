//! Outcomes of a plan before it runs.

use crate::bringup::catalogue::Role;
use crate::bringup::parts::{BuiltInRequest, Part, Work};
use crate::bringup::report::{PartOutcome, PartOutcomeKind, PartReport};
use crate::bringup::runner::LaunchRunner;
use crate::bringup::tasks::installed_program;

impl LaunchRunner {
    /// Returns true if the plan starts users' own nodes in Python.
    #[must_use]
    pub fn has_python_nodes(&self) -> bool {
        self.parts().any(|part| match &part.work {
            Work::Program(program) => program.python.is_some(),
            _ => false,
        })
    }

    /// Expected outcomes of all parts that are nodes or programs, without starting anything.
    #[must_use]
    pub fn preview(&self) -> Vec<PartReport> {
        let report = |part: &Part| {
            let outcome = self.expected(part)?;
            Some(PartReport { step: part.step, asked: part.asked.clone(), outcome })
        };
        self.parts().filter_map(report).collect()
    }

    fn expected(&self, part: &Part) -> Option<PartOutcome> {
        let outcome = |kind, node, told: String| Some(PartOutcome { kind, node, told });
        match &part.work {
            Work::World(wish) => {
                let file = wish.file.as_deref().unwrap_or("an empty plane");
                outcome(PartOutcomeKind::World, None, format!("the simulation of {file}"))
            }
            Work::Ours(ask) => Some(of_built_in(ask)),
            Work::Xacro(_) => {
                outcome(PartOutcomeKind::BuiltIn, None, "the built-in xacro".to_owned())
            }
            Work::Program(program) => match &program.python {
                Some(python) => match self.settings().python.command() {
                    Ok(interpreter) => outcome(
                        PartOutcomeKind::Python,
                        program.full_name(),
                        format!("the Python node of {}, by {interpreter}", python.path().display()),
                    ),
                    Err(why) => {
                        outcome(PartOutcomeKind::Missing, program.full_name(), why.to_string())
                    }
                },
                None => match installed_program(program, self.settings()) {
                    Ok(path) => outcome(
                        PartOutcomeKind::Program,
                        program.full_name(),
                        format!("the program {path}"),
                    ),
                    Err(why) => outcome(PartOutcomeKind::Missing, program.full_name(), why),
                },
            },
            Work::Nothing(why) => outcome(PartOutcomeKind::Missing, None, why.clone()),
            Work::Transition { .. } | Work::Log { .. } | Work::Shutdown { .. } => None,
        }
    }
}

fn of_built_in(ask: &BuiltInRequest) -> PartOutcome {
    let (kind, node) = match ask.entry.role {
        Role::Viewer | Role::Needless | Role::Container | Role::Gazebo => {
            (PartOutcomeKind::Needless, None)
        }
        Role::Lacking => (PartOutcomeKind::Missing, None),
        _ => (PartOutcomeKind::BuiltIn, Some(ask.full_name())),
    };
    PartOutcome { kind, node, told: ask.entry.becomes.to_owned() }
}
