//! Errors, bounds and namespaces of expressions.
#![allow(clippy::unwrap_used, reason = "a test may fail")]

use std::collections::BTreeMap;
use std::rc::Rc;

use expect_test::{Expect, expect};
use periplus_python_expr::{
    Budget, EmptyScope, Expression, ExpressionDialect, ExpressionError, Scope, Value, evaluate,
};

#[derive(Default)]
struct Properties(BTreeMap<String, Value>);

impl Scope for Properties {
    fn lookup(&self, name: &str, budget: &mut Budget) -> Result<Option<Value>, ExpressionError> {
        if name == "broken" {
            return Err(ExpressionError::new("the property `broken` is broken"));
        }
        if name == "lazy" {
            return evaluate(&Expression::parse("wheel_radius * 2")?, self, budget).map(Some);
        }
        Ok(self.0.get(name).cloned())
    }

    fn names(&self) -> Vec<String> {
        self.0.keys().cloned().collect()
    }

    fn member(
        &self,
        namespace: &str,
        name: &str,
        _: &mut Budget,
    ) -> Result<Option<Value>, ExpressionError> {
        Ok((namespace == "arm" && name == "length").then_some(Value::Float(0.5)))
    }

    fn member_names(&self, _: &str) -> Vec<String> {
        vec!["length".to_owned()]
    }

    fn call_host(
        &self,
        function: &str,
        arguments: &[Value],
        keywords: &[(Rc<str>, Value)],
        _: &mut Budget,
    ) -> Option<Result<Value, ExpressionError>> {
        match (function, arguments) {
            ("xacro.arg", [name]) => {
                Some(Ok(
                    Value::list(vec![name.clone(), Value::Int(keywords.len() as i128)]).unwrap()
                ))
            }
            _ => None,
        }
    }
}

fn properties() -> Properties {
    let lidar = Value::dict(vec![
        (Value::text("mass"), Value::Float(0.13)),
        (Value::text("items"), Value::Int(1)),
    ])
    .unwrap();
    let sensors = Value::dict(vec![
        (Value::text("lidar"), lidar.clone()),
        (Value::text("all"), Value::list(vec![lidar]).unwrap()),
    ])
    .unwrap();
    Properties(BTreeMap::from([
        ("wheel_radius".to_owned(), Value::Float(0.033)),
        ("side".to_owned(), Value::text("left")),
        ("plain".to_owned(), sensors.clone()),
        ("sensors".to_owned(), sensors.dotted()),
        ("arm".to_owned(), Value::Namespace("arm".into())),
        ("e".to_owned(), Value::Int(5)),
    ]))
}

fn outcome(text: &str) -> Result<String, ExpressionError> {
    let mut budget = Budget::default();
    let value = evaluate(&Expression::parse(text)?, &properties(), &mut budget)?;
    value.to_text(&mut budget)
}

fn check(text: &str, expected: &Expect) {
    let shown = outcome(text).unwrap_or_else(|error| {
        let marks = "^".repeat(text[error.range.clone()].chars().count().max(1));
        let help = error.help.map(|help| format!("\nhelp: {help}")).unwrap_or_default();
        format!(
            "{}\n{text}\n{}{marks}{help}",
            error.message,
            " ".repeat(text[..error.range.start].chars().count())
        )
    });
    expected.assert_eq(&shown);
}

#[test]
fn properties_come_before_built_in_names() {
    check("e", &expect!["5"]);
    check("math.e", &expect!["2.718281828459045"]);
    check("python.sum([1, 2]) + lazy", &expect!["3.066"]);
    check("xacro.arg('x', y=1)", &expect!["['x', 1]"]);
    check("xacro.tokenize('1, 2;3')", &expect!["['1', '2', '3']"]);
}

#[test]
fn keys_of_dotted_dicts_are_attributes() {
    check("sensors.lidar.mass", &expect!["0.13"]);
    check("sensors['lidar'].mass", &expect!["0.13"]);
    check("sensors.all[0].mass", &expect!["0.13"]);
    check("[s.mass for s in sensors.all]", &expect!["[0.13]"]);
    check("list(sensors.lidar.items())", &expect!["[('mass', 0.13), ('items', 1)]"]);
    check("xacro.dotify(plain).lidar.mass", &expect!["0.13"]);
    check("arm.length", &expect!["0.5"]);
}

#[test]
fn errors_teach() {
    check(
        "2 * wheel_radis",
        &expect![[r#"
        `wheel_radis` is not defined; did you mean `wheel_radius`?
        2 * wheel_radis
            ^^^^^^^^^^^"#]],
    );
    check(
        "1 + side",
        &expect![[r#"
        `+` does not work between `int` and `str`
        1 + side
        ^^^^^^^^
        help: to join text, turn the other side into text: str(...); to add, turn the text into a number: float(...)"#]],
    );
    check(
        "wheel_radius / (1 - 1)",
        &expect![[r#"
        division by zero
        wheel_radius / (1 - 1)
        ^^^^^^^^^^^^^^^^^^^^^^"#]],
    );
    check(
        "abs(-1)",
        &expect![[r#"
        `abs` is not defined
        abs(-1)
        ^^^
        help: xacro has it as `python.abs`"#]],
    );
    check(
        "true",
        &expect![[r#"
        `true` is not defined
        true
        ^^^^
        help: write `True`"#]],
    );
    check(
        "side == 'left' && 1",
        &expect![[r#"
        expected an operator or the end, found `&&`
        side == 'left' && 1
                       ^^
        help: write `and`"#]],
    );
    check(
        "side = 'left'",
        &expect![[r#"
        expected an operator or the end, found `=`
        side = 'left'
             ^
        help: use `==` to compare; an expression cannot assign"#]],
    );
    check(
        "2 + broken",
        &expect![[r#"
        the property `broken` is broken
        2 + broken
            ^^^^^^"#]],
    );
    check(
        "sensors.lydar.mass",
        &expect![[r#"
        the dict has no key 'lydar'
        sensors.lydar.mass
                ^^^^^
        help: did you mean 'lidar'?"#]],
    );
    check(
        "plain.lidar",
        &expect![[r#"
        a `dict` has no attribute `lidar`
        plain.lidar
              ^^^^^
        help: write ['lidar'], or make the keys attributes: xacro.dotify(...)"#]],
    );
    check(
        "[1].append(2)",
        &expect![[r#"
        `append` would change the list, and values in expressions never change
        [1].append(2)
            ^^^^^^
        help: make a new list: values + [value]"#]],
    );
    check(
        "math.sinus(1)",
        &expect![[r#"
        `math` has no `sinus`
        math.sinus(1)
             ^^^^^"#]],
    );
    check(
        "arm.lenght",
        &expect![[r#"
        the namespace `arm` has no `lenght`; did you mean `length`?
        arm.lenght
            ^^^^^^"#]],
    );
    check(
        "xacro.load_yaml('a')",
        &expect![[r#"
        `xacro.load_yaml` is not available here
        xacro.load_yaml('a')
        ^^^^^^^^^^^^^^^^^^^^"#]],
    );
    check(
        "",
        &expect![[r#"
        the expression is empty

        ^"#]],
    );
    check(
        "ä + ö",
        &expect![[r#"
        `ä` is not defined
        ä + ö
        ^
        help: define it with a property, or write 'ä' if it is meant as text"#]],
    );
}

#[test]
fn attributes_that_are_not_listed_are_closed() {
    for text in [
        "().__class__",
        "''.format.__globals__",
        "'{0.__class__}'.format(1)",
        "__import__('os')",
        "(1).real",
        "math.__dict__",
        "[].__len__()",
    ] {
        assert!(outcome(text).is_err(), "{text}");
    }
}

#[test]
fn costs_are_bounded() {
    let deep = |open: &str, inside: &str, close: &str, times: usize| {
        format!("{}{inside}{}", open.repeat(times), close.repeat(times))
    };
    let texts = [
        "10**10**10".to_owned(),
        "2.0**1000000".to_owned(),
        "'a' * 10**12".to_owned(),
        "[0] * 10**9".to_owned(),
        "[x for x in python.range(10**9)]".to_owned(),
        "[0 for x in range(10**5) for y in range(10**5)]".to_owned(),
        "list(range(10**30))".to_owned(),
        "python.sum(range(10**12))".to_owned(),
        "python.any(0 for x in range(10**12))".to_owned(),
        "'%1000000000d' % 1".to_owned(),
        "'%.1000000000f' % 1".to_owned(),
        "'{:1000000000}'.format(1)".to_owned(),
        "'{:.1000000000f}'.format(1)".to_owned(),
        "'a'.center(10**12)".to_owned(),
        "('a' * 10**6).replace('a', 'b' * 10**6)".to_owned(),
        "'1'.zfill(10**12)".to_owned(),
        "1 << 10**9".to_owned(),
        "factorial(10**9)".to_owned(),
        "len([(x, x) for x in range(10**8)])".to_owned(),
        "(lambda f: f(f))(lambda f: f(f))".to_owned(),
        deep("(", "1", ")", 100_000),
        deep("[", "", "]", 100_000),
        deep("-", "1", "", 100_000),
        deep("not ", "1", "", 100_000),
        deep("lambda: ", "1", "", 100_000),
        deep("2**", "1", "", 100_000),
        deep("1 if 1 else ", "1", "", 100_000),
        deep("f'{", "1", "}'", 100_000),
        deep("", "sin", "(1)", 100_000),
        deep("str(", "1", ")", 200),
        // Shared halves: 2^60 elements when written out.
        deep("(lambda x: [x, x])(", "1", ")", 60),
        deep("(lambda x: (x, x))(", "1", ")", 70) + " in {1: 2}",
    ];
    for text in texts {
        let shown: String = text.chars().take(60).collect();
        assert!(outcome(&text).is_err(), "{shown}");
    }
}

#[test]
fn long_chains_do_not_nest() {
    let sum = vec!["1"; 10_000].join(" + ");
    assert_eq!(outcome(&sum).unwrap(), "10000");
    let all = vec!["1"; 10_000].join(" and ");
    assert_eq!(outcome(&all).unwrap(), "1");
    assert_eq!(outcome(&format!("{}1{}", "(".repeat(60), ")".repeat(60))).unwrap(), "1");
    assert_eq!(outcome(&format!("{}1{}", "(1 + ".repeat(60), ")".repeat(60))).unwrap(), "61");
}

#[test]
fn deprecated_names_are_told() {
    struct Told(std::cell::RefCell<Vec<String>>);
    impl Scope for Told {
        fn lookup(&self, _: &str, _: &mut Budget) -> Result<Option<Value>, ExpressionError> {
            Ok(None)
        }
        fn names(&self) -> Vec<String> {
            Vec::new()
        }
        fn deprecated(&self, name: &str, replacement: &str, range: std::ops::Range<usize>) {
            self.0.borrow_mut().push(format!("{name} -> {replacement} at {range:?}"));
        }
    }
    let told = Told(Default::default());
    evaluate(&Expression::parse("1 + len(range(3))").unwrap(), &told, &mut Budget::default())
        .unwrap();
    expect!["range -> python.range at 8..13"].assert_eq(&told.0.borrow().join("\n"));
}

#[test]
fn eval_has_pythons_own_names() {
    struct Eval;
    impl Scope for Eval {
        fn lookup(&self, name: &str, _: &mut Budget) -> Result<Option<Value>, ExpressionError> {
            Ok((name == "optenv").then(|| Value::host_function("optenv")))
        }
        fn names(&self) -> Vec<String> {
            Vec::new()
        }
        fn call_host(
            &self,
            function: &str,
            arguments: &[Value],
            _: &[(Rc<str>, Value)],
            _: &mut Budget,
        ) -> Option<Result<Value, ExpressionError>> {
            (function == "optenv").then(|| Ok(arguments[1].clone()))
        }
        fn dialect(&self) -> ExpressionDialect {
            ExpressionDialect::SubstitutionArgs
        }
    }
    let text =
        "abs(-1) == 1 and true and not optenv('OS', 'unknown').lower().startswith('windows')";
    let value = evaluate(&Expression::parse(text).unwrap(), &Eval, &mut Budget::default()).unwrap();
    assert!(value.is_true());
}

mod any_text {
    use super::*;
    use proptest::prelude::*;

    fn run(text: &str) {
        let mut budget = Budget::new(20_000, 1 << 20);
        match Expression::parse(text)
            .and_then(|expression| evaluate(&expression, &EmptyScope, &mut budget))
        {
            Ok(value) => {
                let _ = value.to_text(&mut budget);
            }
            Err(error) => assert!(text.get(error.range.clone()).is_some(), "{text:?}: {error:?}"),
        }
    }

    proptest! {
        #[test]
        fn never_panics(text in ".{0,60}") {
            run(&text);
        }

        #[test]
        fn never_panics_on_likely_words(words in prop::collection::vec(prop::sample::select(vec![
            "(", ")", "[", "]", "{", "}", ",", ":", ".", "+", "-", "*", "**", "/", "//", "%", "<", "==", "=", "'", "\"", "f'", "{", "}", "'{:>5}'", ".format",
            "1", "0", "2.5", "1e400", "x", "lambda", "for", "in", "if", "else", "not", "and", "is", "str", "len", "round", "sorted", "python.zip", "math.sin",
            "[1, 2]", "'äb'", "\\", "\n", "<<", "~", "!r", "None", "True", " ", "range(9)", ".split", ".find", "170141183460469231731687303715884105727",
        ]), 0..14)) {
            run(&words.concat());
            run(&words.join(" "));
        }

        #[test]
        fn floats_read_back(bits in any::<u64>()) {
            let float = f64::from_bits(bits);
            prop_assume!(float.is_finite());
            let text = Value::Float(float).to_text(&mut Budget::default()).unwrap();
            prop_assert_eq!(text.parse::<f64>().unwrap().to_bits(), bits);
            // Python turns to exponents beyond these bounds only, and never writes an integer.
            let plain = float == 0.0 || (1e-4..1e16).contains(&float.abs());
            prop_assert_eq!(plain, !text.contains('e'));
            prop_assert!(!plain || text.contains('.'));
        }

        #[test]
        fn division_keeps_its_promise(a in any::<i64>(), b in any::<i64>().prop_filter("not zero", |b| *b != 0)) {
            let text = format!("({a} // {b}) * {b} + ({a} % {b}) == {a} and 0 <= ({a} % {b}) * (1 if {b} > 0 else -1) < python.abs({b})");
            prop_assert_eq!(outcome(&text).unwrap(), "True");
        }
    }
}
