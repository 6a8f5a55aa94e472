//! `--filter`: Python expressions over a message `m`, evaluated by the evaluator of xacro.

use std::rc::Rc;

use periplus_msgs as msgs;
use periplus_msgs::{DynamicMessage, Number, Part};
use periplus_python_expr::{
    Budget, Expression, ExpressionDialect, ExpressionError, Scope, Value, evaluate,
};

use crate::show::whole_number;
use crate::{Failure, Outcome};

/// Limits of work and memory for a message, sufficient to sum up a whole image.
const MAX_STEPS: u64 = 50_000_000;
const MAX_BYTES: u64 = 1 << 30;

/// Filter expression.
pub(crate) struct Filter(Expression);

impl Filter {
    /// Parses an expression.
    ///
    /// # Errors
    /// When it is not a valid expression.
    pub(crate) fn read(text: &str) -> Outcome<Self> {
        Expression::parse(text).map(Self).map_err(|error| {
            Failure::Usage(format!("the filter `{text}` is not a valid expression: {error}"))
        })
    }

    /// Returns true if a message passes.
    ///
    /// # Errors
    /// When the expression cannot be evaluated for it.
    pub(crate) fn wants(&self, message: &DynamicMessage) -> Outcome<bool> {
        let scope = Fields { message };
        let mut budget = Budget::new(MAX_STEPS, MAX_BYTES);
        match evaluate(&self.0, &scope, &mut budget) {
            Ok(value) => Ok(value.is_true()),
            Err(error) => {
                let text = self.0.text();
                Err(Failure::failed(format!("the filter `{text}` has no value: {error}")))
            }
        }
    }
}

/// Scope that looks fields up lazily, so that `m.header.stamp.sec` costs nothing for an image. A
/// message is a namespace named by its path.
struct Fields<'m> {
    message: &'m DynamicMessage,
}

impl Fields<'_> {
    fn path(namespace: &str) -> &str {
        namespace.strip_prefix("m").unwrap_or(namespace).trim_start_matches('.')
    }

    fn names_in(&self, namespace: &str) -> Vec<String> {
        let path = Self::path(namespace);
        let nested = if path.is_empty() {
            Some(self.message.layout())
        } else {
            self.message.part(path).ok().and_then(|part| part.layout())
        };
        nested.map_or(Vec::new(), |layout| layout.fields().map(str::to_owned).collect())
    }
}

impl Scope for Fields<'_> {
    fn lookup(&self, name: &str, _: &mut Budget) -> Result<Option<Value>, ExpressionError> {
        Ok((name == "m").then(|| Value::Namespace("m".into())))
    }

    fn names(&self) -> Vec<String> {
        vec!["m".to_owned()]
    }

    fn member(
        &self,
        namespace: &str,
        name: &str,
        _: &mut Budget,
    ) -> Result<Option<Value>, ExpressionError> {
        let path = Self::path(namespace);
        let path = if path.is_empty() { name.to_owned() } else { format!("{path}.{name}") };
        match self.message.part(&path) {
            Ok(part) => value(&part, &path).map(Some),
            Err(_) => Ok(None),
        }
    }

    fn member_names(&self, namespace: &str) -> Vec<String> {
        self.names_in(namespace)
    }

    fn dialect(&self) -> ExpressionDialect {
        ExpressionDialect::SubstitutionArgs
    }
}

fn value(part: &Part<'_>, path: &str) -> Result<Value, ExpressionError> {
    let message = |path: &str| Value::Namespace(Rc::from(format!("m.{path}")));
    Ok(match part.peek() {
        msgs::Value::Number(number) => self::number(*number),
        msgs::Value::Text(text) => Value::text(text.as_str()),
        msgs::Value::Struct(_) => message(path),
        msgs::Value::Numbers(numbers) => {
            let numbers = numbers.borrow();
            let all = (0..numbers.len()).filter_map(|index| numbers.get(index).map(number));
            Value::list(all.collect())?
        }
        msgs::Value::List(list) => {
            let one = |(index, value): (usize, &msgs::Value)| match value {
                msgs::Value::Text(text) => Value::text(text.as_str()),
                _ => message(&format!("{path}[{index}]")),
            };
            Value::list(list.iter().enumerate().map(one).collect())?
        }
    })
}

fn number(number: Number) -> Value {
    match number {
        Number::Bool(truth) => Value::Bool(truth),
        Number::F32(number) => Value::Float(number.into()),
        Number::F64(number) => Value::Float(number),
        number => Value::Int(whole_number(number)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use expect_test::{Expect, expect};
    use periplus_msgs::{geometry_msgs, sensor_msgs, tf2_msgs};

    fn check(message: &DynamicMessage, filter: &str, expected: Expect) {
        let wants = Filter::read(filter).and_then(|filter| filter.wants(message));
        expected.assert_eq(&match wants {
            Ok(wants) => wants.to_string(),
            Err(failure) => failure.to_string(),
        });
    }

    #[test]
    fn filters_look_into_messages() {
        let mut scan = sensor_msgs::LaserScan { ranges: vec![1.0, 2.0], ..Default::default() };
        scan.header.frame_id = "lidar".into();
        let scan = DynamicMessage::of(&scan).unwrap();
        check(&scan, "m.header.frame_id == 'lidar'", expect!["true"]);
        check(&scan, "m.ranges[0] > 1 or len(m.ranges) == 3", expect!["false"]);
        check(&scan, "min(m.ranges) < 1.5 and m.header.stamp.sec == 0", expect!["true"]);
        check(
            &scan,
            "m.rangs",
            expect![
                "the filter `m.rangs` has no value: the namespace `m` has no `rangs`; did you mean `ranges`?"
            ],
        );
        check(
            &scan,
            "m.ranges[",
            expect![
                "the filter `m.ranges[` is not a valid expression: the expression ends where a value is needed"
            ],
        );
        let transform =
            geometry_msgs::TransformStamped { child_frame_id: "base".into(), ..Default::default() };
        let frames = DynamicMessage::of(&tf2_msgs::TFMessage { transforms: vec![transform] });
        let filter = "any([t.child_frame_id == 'base' for t in m.transforms])";
        check(&frames.unwrap(), filter, expect!["true"]);
    }
}
