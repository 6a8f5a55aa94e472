//! Script language of BehaviorTree.CPP 4: assignments and expressions on blackboard entries.
//!
//! `:=` creates an entry if needed, `=` needs an existing one; `+= -= *= /=`; `+ - * /`, `..` joins texts;
//! `& | ^ ~` on integers; `&& || !`; comparisons, which may be chained; `condition ? a : b`; `'text'`,
//! numbers, `true`, `false`, names of enumerations. Statements are separated by `;`, and the last one is the
//! value of the script.

mod eval;
mod parse;
mod token;

use std::collections::BTreeMap;
use std::fmt;
use std::ops::Range;

use crate::TreeValue;
use crate::blackboard::Blackboard;

/// Maximum length of a script \[bytes\].
pub const MAX_SCRIPT_BYTES: usize = 16_384;
/// Maximum number of tokens of a script.
pub const MAX_SCRIPT_TOKEN_COUNT: usize = 1_000;
/// Maximum nesting of expressions.
pub const MAX_SCRIPT_DEPTH: usize = 64;
/// Maximum length of a text that a script makes \[bytes\].
pub const MAX_SCRIPT_TEXT_BYTES: usize = 65_536;

/// Names of enumerations and their numbers.
pub type ScriptEnums = BTreeMap<String, i64>;

/// Parsed script.
#[derive(Clone, Debug)]
pub struct Script {
    source: String,
    statements: Vec<parse::Expr>,
}

/// Fault of a script.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ScriptError {
    /// Description of the fault.
    pub message: String,
    /// Bytes of the script at which it was found.
    pub range: Range<usize>,
}

impl fmt::Display for ScriptError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.message)
    }
}

impl std::error::Error for ScriptError {}

impl ScriptError {
    fn new(message: impl Into<String>, range: Range<usize>) -> Self {
        Self { message: message.into(), range }
    }
}

impl Script {
    /// Parses a script.
    ///
    /// # Errors
    /// When it is not valid, empty, too long or nested too deeply, with the location.
    pub fn parse(source: &str) -> Result<Self, ScriptError> {
        if source.len() > MAX_SCRIPT_BYTES {
            let message = format!("the script is longer than {MAX_SCRIPT_BYTES} bytes");
            return Err(ScriptError::new(message, 0..source.len()));
        }
        let statements = parse::statements(source)?;
        if statements.is_empty() {
            return Err(ScriptError::new("the script is empty", 0..source.len()));
        }
        Ok(Self { source: source.to_owned(), statements })
    }

    /// Text of the script.
    #[must_use]
    pub fn source(&self) -> &str {
        &self.source
    }

    /// Executes the script on the root of a blackboard and returns the value of its last statement.
    ///
    /// # Errors
    /// When an entry is missing or an operation has operands of the wrong type.
    pub fn run(
        &self,
        blackboard: &mut Blackboard,
        enums: &ScriptEnums,
    ) -> Result<TreeValue, ScriptError> {
        self.run_in(blackboard, crate::blackboard::ROOT, enums)
    }

    pub(crate) fn run_in(
        &self,
        blackboard: &mut Blackboard,
        board: usize,
        enums: &ScriptEnums,
    ) -> Result<TreeValue, ScriptError> {
        let mut scope = eval::Scope { blackboard, board, enums };
        let mut last = TreeValue::Bool(false);
        for statement in &self.statements {
            last = scope.evaluate(statement)?;
        }
        Ok(last)
    }

    /// Executes the script and returns its truth value.
    pub(crate) fn test_in(
        &self,
        blackboard: &mut Blackboard,
        board: usize,
        enums: &ScriptEnums,
    ) -> Result<bool, ScriptError> {
        let value = self.run_in(blackboard, board, enums)?;
        value.as_bool().ok_or_else(|| {
            let message = format!("`{}` is neither true nor false", self.source);
            ScriptError::new(message, 0..self.source.len())
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn run(source: &str) -> Result<TreeValue, String> {
        let mut blackboard = Blackboard::new();
        blackboard.set("x", TreeValue::Int(3)).unwrap();
        blackboard.set("name", "map").unwrap();
        let enums = ScriptEnums::from([("RED".to_owned(), 4)]);
        let script = Script::parse(source).map_err(|error| error.message)?;
        script.run(&mut blackboard, &enums).map_err(|error| error.message)
    }

    #[test]
    fn expressions_have_the_precedence_of_c() {
        let check = |source: &str, expected: f64| {
            assert_eq!(run(source).unwrap().as_f64(), Some(expected), "{source}");
        };
        check("1 + 2 * 3", 7.0);
        check("(1 + 2) * 3", 9.0);
        check("-2 * 3", -6.0);
        check("7 / 2", 3.5);
        check("x > 2 && !(x == 4)", 1.0);
        check("1 < x <= 3", 1.0);
        check("1 < x < 3", 0.0);
        check("x == 3 ? 10 : 20", 10.0);
        check("6 & 3 | 8", 10.0);
        check("0x1F", 31.0);
        check("1.5e1", 15.0);
        check("RED", 4.0);
        check("true || false", 1.0);
        check("a := 2; a += x; a *= 2; a", 10.0);
        check("~0", -1.0);
    }

    #[test]
    fn texts_are_joined_and_compared() {
        assert_eq!(run("name .. '_server'").unwrap(), "map_server".into());
        assert_eq!(run("name == 'map'").unwrap().as_bool(), Some(true));
        assert_eq!(run("'n' .. 3").unwrap(), "n3".into());
        assert_eq!(run("'2.5' > x").unwrap().as_bool(), Some(false));
    }

    #[test]
    fn faults_are_described() {
        let check = |source: &str, expected: &str| {
            let error = run(source).unwrap_err();
            assert!(error.contains(expected), "{source}: {error}");
        };
        check("y = 1", "`y` does not exist");
        check("y + 1", "`y` does not exist");
        check("1 +", "an operand is missing");
        check("", "empty");
        check("3 := 4", "left of `:=`");
        check("'a' - 1", "cannot be applied");
        check("(1", "`)`");
        check("'open", "never closed");
        check("1 # 2", "unexpected character");
        check(&"(".repeat(100), "nested");
        check(&"x".repeat(20_000), "longer");
        check(&format!("1{}", "+1".repeat(5_000)), "tokens");
    }
}
