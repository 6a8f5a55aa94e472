//! Conversion of written parameters to values.

use std::borrow::Cow;
use std::collections::BTreeMap;

use periplus_diagnostics::{Diagnostic, DiagnosticCause, Diagnostics, Origin, Span};

use crate::value::quote;
use crate::values::Located;
use crate::{Default, ParamError, ParamType, ParamValue, ParamValues, Parameter, Table};

/// Parameter as written.
#[derive(Clone, Debug)]
pub struct Given<'a> {
    /// Name as written.
    pub name: &'a str,
    /// Value as written.
    pub text: Cow<'a, str>,
    /// Source location of the name.
    pub name_origin: Origin,
    /// Source location of the value.
    pub origin: Origin,
}

impl<'a> Given<'a> {
    /// Returns a parameter without a source location.
    #[must_use]
    pub fn new(name: &'a str, text: impl Into<Cow<'a, str>>) -> Self {
        Self { name, text: text.into(), name_origin: Origin::default(), origin: Origin::default() }
    }
}

impl Table {
    /// Reads written parameters. Each unknown name is a warning with the most similar known name; each
    /// unreadable or invalid value is an error and replaced by the default; a missing required parameter is
    /// an error at `whole`.
    pub fn check<'a>(
        &'static self,
        given: impl IntoIterator<Item = Given<'a>>,
        whole: Option<Span>,
        diagnostics: &mut Diagnostics,
    ) -> ParamValues {
        let (values, written) = self.read(given, diagnostics);
        self.report_missing(&values, &written, whole, diagnostics);
        values
    }

    /// Reads parameters like [`Table::check`], and leaves missing required parameters unset.
    pub fn check_given<'a>(
        &'static self,
        given: impl IntoIterator<Item = Given<'a>>,
        diagnostics: &mut Diagnostics,
    ) -> ParamValues {
        self.read(given, diagnostics).0
    }

    /// Values, and the names that were written, also those with unreadable values.
    fn read<'a>(
        &'static self,
        given: impl IntoIterator<Item = Given<'a>>,
        diagnostics: &mut Diagnostics,
    ) -> (ParamValues, BTreeMap<&'static str, Origin>) {
        let mut values: BTreeMap<&'static str, Vec<Located>> = BTreeMap::new();
        let mut written: BTreeMap<&'static str, Origin> = BTreeMap::new();
        for given in given {
            let Some(parameter) = self.find(given.name) else {
                diagnostics.push(self.unknown(&given));
                continue;
            };
            if let Some(first) = written.get(parameter.name)
                && !parameter.repeated
            {
                diagnostics.push(
                    Diagnostic::warning(
                        "repeated-parameter",
                        format!("`{}` is set twice; only the first counts", parameter.name),
                    )
                    .at(given.name_origin)
                    .related(*first, "first set here"),
                );
                continue;
            }
            written.entry(parameter.name).or_insert(given.name_origin);
            match ParamValue::read(parameter, &given.text) {
                Ok(value) => values
                    .entry(parameter.name)
                    .or_default()
                    .push(Located { value, origin: given.origin }),
                Err(error) => diagnostics.push(self.unreadable(&given, &error)),
            }
        }
        (ParamValues::new(self, values), written)
    }

    fn report_missing(
        &self,
        values: &ParamValues,
        written: &BTreeMap<&'static str, Origin>,
        whole: Option<Span>,
        diagnostics: &mut Diagnostics,
    ) {
        let is_waived = |parameter: &Parameter| {
            parameter
                .unless
                .is_some_and(|flag| values.is_given(flag) && values.flag(flag) == Some(true))
        };
        for parameter in self.parameters {
            if parameter.default == Default::Required
                && !written.contains_key(parameter.name)
                && !is_waived(parameter)
            {
                let mut diagnostic = Diagnostic::error(
                    "missing-parameter",
                    format!("{} needs `{}`", self.name, parameter.name),
                );
                diagnostic.span = whole;
                diagnostics.push(diagnostic.note(format!("{}: {}", parameter.name, parameter.doc)));
            }
        }
    }

    /// Finding for an unknown name.
    #[must_use]
    pub fn unknown(&self, given: &Given<'_>) -> Diagnostic {
        let message = format!("{} has no parameter `{}`", self.name, given.name);
        Diagnostic::warning("unknown-parameter", message)
            .caused_by(DiagnosticCause::UnknownParameter)
            .at(given.name_origin)
            .label("this is ignored")
            .did_you_mean(given.name_origin, given.name, self.names())
    }

    fn unreadable(&self, given: &Given<'_>, error: &ParamError) -> Diagnostic {
        let code = match error {
            ParamError::OutOfRange { .. } => "out-of-range",
            _ => "bad-value",
        };
        let message = format!("`{}`: the value {} {error}", given.name, quote(&given.text));
        let mut diagnostic = Diagnostic::error(code, message).at(given.origin);
        if given.text.contains("${") || given.text.contains("$(") {
            diagnostic = diagnostic
                .help("this is a xacro expression: name the file `.xacro` so that it is evaluated");
        }
        let Some(parameter) = self.find(given.name) else { return diagnostic };
        if let ParamType::Choice(words) = parameter.kind {
            diagnostic =
                diagnostic.did_you_mean(given.origin, given.text.trim(), words.iter().copied());
        }
        match parameter.default {
            Default::Value(default) => {
                let unit = parameter.unit.map(|unit| format!(" {unit}")).unwrap_or_default();
                diagnostic.note(format!("the default is used: {default}{unit}"))
            }
            Default::Required | Default::None => diagnostic,
        }
    }
}

#[cfg(test)]
mod tests {
    use expect_test::{Expect, expect};
    use periplus_diagnostics::{RenderStyle, SourceMap, render};

    use super::*;
    use crate::{choice, flag, integer, number, text};

    static WHEEL: Table = Table {
        name: "the wheel",
        doc: "A wheel.",
        parameters: &[
            number("wheel_diameter", "m", "Across.").or("0.15").above(0.0).repeated(),
            text("joint", "What turns it.").required(),
            integer("count", "How many.").or("1").within(1.0, 8.0),
            choice("side", &["left", "right"], "Where."),
            flag("powered", "Whether it drives.").or("true").also(&["driven"]),
        ],
    };

    /// The text has lines `name value`.
    fn check(input: &str, expected: Expect) -> ParamValues {
        let mut sources = SourceMap::new();
        let file = sources.add("wheel.txt", input);
        let mut diagnostics = Diagnostics::new();
        let mut start = 0;
        let mut given = Vec::new();
        for line in input.lines() {
            let (name, text) = line.split_once(' ').unwrap_or((line, ""));
            let at = |from: usize, to: usize| {
                Origin(Some(sources.whole(file).part(start + from, start + to)))
            };
            given.push(Given {
                name,
                text: text.into(),
                name_origin: at(0, name.len()),
                origin: at(name.len() + 1, line.len()),
            });
            start += line.len() + 1;
        }
        let values = WHEEL.check(given, Some(sources.whole(file)), &mut diagnostics);
        let text: String =
            diagnostics.iter().map(|d| render(d, &sources, RenderStyle::Plain)).collect();
        expected.assert_eq(&text);
        values
    }

    #[test]
    fn good_values_are_silent() {
        let values =
            check("wheel_diameter 0.2\nwheel_diameter 0.3\njoint a\ndriven 0", expect![[""]]);
        assert_eq!(values.numbers("wheel_diameter"), [0.2, 0.3]);
        assert_eq!(values.flag("powered"), Some(false));
        assert_eq!(values.integer("count"), Some(1));
        assert!(!values.is_given("count"));
        assert_eq!(values.text("side"), None);
    }

    #[test]
    fn each_slip_says_what_to_do() {
        check(
            "wheelDiameter 0.2\nside lefft\ncount 9\npowered 1\npowered 0",
            expect![[r#"
                warning[unknown-parameter]: the wheel has no parameter `wheelDiameter`
                 --> wheel.txt:1:1
                  |
                1 | wheelDiameter 0.2
                  | ^^^^^^^^^^^^^ this is ignored
                  |
                help: did you mean `wheel_diameter`?
                  |
                1 - wheelDiameter 0.2
                1 + wheel_diameter 0.2
                  |
                error[bad-value]: `side`: the value `lefft` is none of `left`, `right`
                 --> wheel.txt:2:6
                  |
                2 | side lefft
                  |      ^^^^^
                  |
                help: did you mean `left`?
                  |
                2 - side lefft
                2 + side left
                  |
                error[out-of-range]: `count`: the value `9` is out of range: 9 must be 1 to 8
                 --> wheel.txt:3:7
                  |
                3 | count 9
                  |       ^
                  |
                  = note: the default is used: 1
                warning[repeated-parameter]: `powered` is set twice; only the first counts
                 --> wheel.txt:5:1
                  |
                4 | powered 1
                  | ------- first set here
                5 | powered 0
                  | ^^^^^^^
                error[missing-parameter]: the wheel needs `joint`
                 --> wheel.txt:1:1
                  |
                1 | wheelDiameter 0.2
                  | ^^^^^^^^^^^^^^^^^
                  |
                  = note: joint: What turns it.
            "#]],
        );
    }

    #[test]
    fn a_flag_can_make_a_parameter_optional() {
        static CAR: Table = Table {
            name: "the car",
            doc: "A car.",
            parameters: &[
                text("wheel", "What drives it.").required().unless("steering_only"),
                flag("steering_only", "Whether it only steers.").or("false"),
            ],
        };
        let errors = |given: &[(&'static str, &'static str)]| {
            let given = given.iter().map(|(name, text)| Given::new(name, *text));
            let mut diagnostics = Diagnostics::new();
            CAR.check(given, None, &mut diagnostics);
            diagnostics.errors()
        };
        assert_eq!(errors(&[]), 1);
        assert_eq!(errors(&[("steering_only", "false")]), 1);
        assert_eq!(errors(&[("steering_only", "true")]), 0);
        assert_eq!(errors(&[("wheel", "w")]), 0);
    }

    #[test]
    fn an_unexpanded_expression_is_explained() {
        check(
            "joint a\nwheel_diameter ${2*r}",
            expect![[r#"
            error[bad-value]: `wheel_diameter`: the value `${2*r}` is not a number
             --> wheel.txt:2:16
              |
            2 | wheel_diameter ${2*r}
              |                ^^^^^^
              |
              = note: the default is used: 0.15 m
              = help: this is a xacro expression: name the file `.xacro` so that it is evaluated
        "#]],
        );
    }
}
