//! Comparison of the evaluator with Python, by the table that python_expressions.py writes.

use periplus_python_expr::{
    Budget, EmptyScope, Expression, ExpressionDialect, ExpressionError, Scope, Value, evaluate,
};

/// The names of `$(eval ...)`, which has all of Python's functions.
struct AllNames;

impl Scope for AllNames {
    fn lookup(&self, name: &str, budget: &mut Budget) -> Result<Option<Value>, ExpressionError> {
        EmptyScope.lookup(name, budget)
    }

    fn names(&self) -> Vec<String> {
        Vec::new()
    }

    fn dialect(&self) -> ExpressionDialect {
        ExpressionDialect::SubstitutionArgs
    }
}

fn unescaped(text: &str) -> String {
    let mut result = String::new();
    let mut letters = text.chars();
    while let Some(letter) = letters.next() {
        result.push(match letter {
            '\\' => match letters.next() {
                Some('t') => '\t',
                Some('n') => '\n',
                Some('r') => '\r',
                other => other.unwrap_or('\\'),
            },
            other => other,
        });
    }
    result
}

fn ours(expression: &str) -> Result<String, ExpressionError> {
    let mut budget = Budget::default();
    let value = evaluate(&Expression::parse(expression)?, &AllNames, &mut budget)?;
    value.to_text(&mut budget)
}

#[test]
fn agrees_with_python() {
    let table = include_str!("python_expressions.tsv");
    let mut differences = Vec::new();
    let mut count = 0;
    for line in table.lines() {
        let (expression, expected) = line.split_once('\t').unwrap();
        let (expression, expected) = (unescaped(expression), unescaped(expected));
        count += 1;
        let ours = ours(&expression);
        let agrees = match (&ours, expected.strip_prefix('=')) {
            (Ok(text), Some(expected)) => text == expected,
            (Err(_), None) => true,
            _ => false,
        };
        if !agrees {
            let ours =
                ours.map_or_else(|error| format!("error: {error}"), |text| format!("={text}"));
            differences.push(format!("{expression}\n    Python {expected}\n    ours   {ours}"));
        }
    }
    assert!(count > 2500, "the table has only {count} lines");
    assert!(
        differences.is_empty(),
        "{} of {count} differ:\n{}",
        differences.len(),
        differences.join("\n")
    );
}
