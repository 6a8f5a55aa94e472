//! Evaluation of scripts.

use super::parse::{Expr, ExprKind};
use super::{MAX_SCRIPT_TEXT_BYTES, ScriptEnums, ScriptError};
use crate::TreeValue;
use crate::blackboard::Blackboard;

/// Difference up to which two numbers are equal: the machine epsilon of single precision.
const EQUAL_TOLERANCE: f64 = f32::EPSILON as f64;

pub(super) struct Scope<'a> {
    pub(super) blackboard: &'a mut Blackboard,
    pub(super) board: usize,
    pub(super) enums: &'a ScriptEnums,
}

impl Scope<'_> {
    pub(super) fn evaluate(&mut self, expr: &Expr) -> Result<TreeValue, ScriptError> {
        let fault = |message: String| ScriptError::new(message, expr.range.clone());
        match &expr.kind {
            ExprKind::Literal(value) => Ok(value.clone()),
            ExprKind::Name(name) => self.named(name).map_err(fault),
            ExprKind::Unary(mark, operand) => {
                let value = self.evaluate(operand)?;
                unary(mark, &value).ok_or_else(|| fault(inapplicable(mark, &[&value])))
            }
            ExprKind::Binary(mark, operands) => {
                let left = self.evaluate(&operands.0)?;
                let right = self.evaluate(&operands.1)?;
                let value = binary(mark, &left, &right)
                    .ok_or_else(|| fault(inapplicable(mark, &[&left, &right])))?;
                bounded(value).map_err(fault)
            }
            ExprKind::Comparison(operands, marks) => self.comparison(operands, marks),
            ExprKind::Choice(parts) => {
                let [condition, then, otherwise] = &**parts;
                let value = self.evaluate(condition)?;
                let is_true = match &value {
                    TreeValue::Text(text) => !text.is_empty(),
                    other => other.as_bool().unwrap_or_default(),
                };
                self.evaluate(if is_true { then } else { otherwise })
            }
            ExprKind::Assignment(mark, name, right) => {
                if *mark != ":=" && !self.blackboard.exists(self.board, name) {
                    return Err(fault(format!(
                        "the entry `{name}` does not exist; `:=` creates one"
                    )));
                }
                let right = self.evaluate(right)?;
                let value = if matches!(*mark, ":=" | "=") {
                    right
                } else {
                    let left = self.named(name).map_err(fault)?;
                    let mark = &mark[..1];
                    binary(mark, &left, &right)
                        .ok_or_else(|| fault(inapplicable(mark, &[&left, &right])))?
                };
                let value = bounded(value).map_err(fault)?;
                self.blackboard
                    .set_in(self.board, name, value.clone())
                    .map_err(|error| fault(error.to_string()))?;
                Ok(self.blackboard.get_in(self.board, name).cloned().unwrap_or(value))
            }
        }
    }

    fn named(&self, name: &str) -> Result<TreeValue, String> {
        if let Some(number) = self.enums.get(name) {
            return Ok(TreeValue::Int(*number));
        }
        match self.blackboard.get_in(self.board, name) {
            Some(value) => Ok(value.clone()),
            None if self.blackboard.exists(self.board, name) => {
                Err(format!("the entry `{name}` has no value yet"))
            }
            None => Err(format!("the entry `{name}` does not exist")),
        }
    }

    fn comparison(
        &mut self,
        operands: &[Expr],
        marks: &[&'static str],
    ) -> Result<TreeValue, ScriptError> {
        let mut operands = operands.iter();
        let Some(first) = operands.next() else { return Ok(TreeValue::Bool(true)) };
        let mut left = self.evaluate(first)?;
        for (expr, mark) in operands.zip(marks) {
            let right = self.evaluate(expr)?;
            let holds = self.compare(mark, &left, &right).ok_or_else(|| {
                ScriptError::new(inapplicable(mark, &[&left, &right]), expr.range.clone())
            })?;
            if !holds {
                return Ok(TreeValue::Bool(false));
            }
            left = right;
        }
        Ok(TreeValue::Bool(true))
    }

    fn compare(&self, mark: &str, left: &TreeValue, right: &TreeValue) -> Option<bool> {
        if let (TreeValue::Text(left), TreeValue::Text(right)) = (left, right) {
            return Some(match mark {
                "==" => left == right,
                "!=" => left != right,
                "<" => left < right,
                "<=" => left <= right,
                ">" => left > right,
                _ => left >= right,
            });
        }
        let [left, right] = [self.number(left)?, self.number(right)?];
        let is_equal = (left - right).abs() <= EQUAL_TOLERANCE || left == right;
        Some(match mark {
            "==" => is_equal,
            "!=" => !is_equal,
            "<" => left < right,
            "<=" => left <= right,
            ">" => left > right,
            _ => left >= right,
        })
    }

    /// Number of a value that is compared with a number; texts may be numbers, truth values and
    /// enumerations.
    #[allow(clippy::cast_precision_loss, reason = "the only number type of scripts is double")]
    fn number(&self, value: &TreeValue) -> Option<f64> {
        match value {
            TreeValue::Text(text) => match &**text {
                "true" => Some(1.0),
                "false" => Some(0.0),
                name => match self.enums.get(name) {
                    Some(number) => Some(*number as f64),
                    None => name.trim().parse().ok(),
                },
            },
            other => other.as_f64(),
        }
    }
}

fn unary(mark: &str, value: &TreeValue) -> Option<TreeValue> {
    match (mark, value) {
        ("-", TreeValue::Int(number)) => number.checked_neg().map(TreeValue::Int),
        ("-", _) => value.as_f64().map(|number| TreeValue::Real(-number)),
        ("~", _) => value.as_i64().map(|number| TreeValue::Int(!number)),
        _ => value.as_f64().map(|number| TreeValue::Bool(number == 0.0)),
    }
}

fn binary(mark: &str, left: &TreeValue, right: &TreeValue) -> Option<TreeValue> {
    let has_text = left.as_text().is_some() || right.as_text().is_some();
    if mark == ".." || (mark == "+" && left.as_text().is_some() && right.as_text().is_some()) {
        return has_text
            .then(|| Some(format!("{}{}", left.to_text()?, right.to_text()?).as_str().into()))
            .flatten();
    }
    if matches!(mark, "&" | "|" | "^") {
        let [left, right] = [left.as_i64()?, right.as_i64()?];
        return Some(TreeValue::Int(match mark {
            "&" => left & right,
            "|" => left | right,
            _ => left ^ right,
        }));
    }
    let [left, right] = [left.as_f64()?, right.as_f64()?];
    Some(match mark {
        "+" => TreeValue::Real(left + right),
        "-" => TreeValue::Real(left - right),
        "*" => TreeValue::Real(left * right),
        "/" => TreeValue::Real(left / right),
        "&&" => TreeValue::Bool(left != 0.0 && right != 0.0),
        "||" => TreeValue::Bool(left != 0.0 || right != 0.0),
        _ => return None,
    })
}

fn bounded(value: TreeValue) -> Result<TreeValue, String> {
    match value.as_text() {
        Some(text) if text.len() > MAX_SCRIPT_TEXT_BYTES => {
            Err(format!("the text is longer than {MAX_SCRIPT_TEXT_BYTES} bytes"))
        }
        _ => Ok(value),
    }
}

fn inapplicable(mark: &str, operands: &[&TreeValue]) -> String {
    let types: Vec<&str> = operands.iter().map(|operand| operand.type_name()).collect();
    format!("`{mark}` cannot be applied to {}", types.join(" and "))
}
