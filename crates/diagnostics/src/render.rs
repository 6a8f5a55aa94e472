//! A finding as a person reads it in a terminal.

use std::fmt::Write as _;
use std::ops::Range;

use annotate_snippets::renderer::DecorStyle;
use annotate_snippets::{AnnotationKind, Element, Group, Level, Patch, Renderer, Snippet};

use crate::source::{Expansion, SourceMap, Span};
use crate::{Diagnostic, Severity};

/// Longest piece of a line that is shown; generated files hold lines of megabytes.
const MOST_SHOWN: usize = 160;

/// How many steps of a long chain of macro calls are shown.
const MOST_STEPS: usize = 6;

/// Colours and letters of a rendering.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Style {
    /// ASCII without colours: for files, pipes and tests.
    Plain,
    /// ANSI colours and box-drawing characters: for a terminal.
    Colour,
}

/// Renders one finding with the text it is about.
#[must_use]
pub fn render(diagnostic: &Diagnostic, sources: &SourceMap, style: Style) -> String {
    let level = match diagnostic.severity {
        Severity::Error => Level::ERROR,
        Severity::Warning => Level::WARNING,
        Severity::Hint => Level::INFO.with_name(Some("hint")),
    };
    let mut group = Group::with_title(level.primary_title(&diagnostic.message).id(diagnostic.code));
    if let Some(span) = diagnostic.span {
        group = group.elements(places(diagnostic, sources, span));
        for step in backtrace(sources, span) {
            group = group.element(Level::NOTE.message(step));
        }
    }
    for note in &diagnostic.notes {
        group = group.element(Level::NOTE.message(note));
    }
    for help in &diagnostic.help {
        group = group.element(Level::HELP.message(help));
    }
    let mut report = vec![group];
    if let Some(replacement) = &diagnostic.replacement {
        let (shown, snippet) = excerpt(sources, replacement.span);
        report.push(
            Level::HELP
                .secondary_title(&replacement.message)
                .element(snippet.patch(Patch::new(shown, &replacement.text))),
        );
    }
    let renderer = match style {
        Style::Plain => Renderer::plain().decor_style(DecorStyle::Ascii),
        Style::Colour => Renderer::styled().decor_style(DecorStyle::Unicode),
    };
    let mut text = renderer.render(&report);
    text.push('\n');
    text
}

/// The marked text and the related places, those of one file in one snippet when they are near.
fn places<'a>(diagnostic: &'a Diagnostic, sources: &'a SourceMap, span: Span) -> Vec<Element<'a>> {
    let mut elements = Vec::new();
    let (shown, snippet) = excerpt(sources, span);
    let mut annotation = AnnotationKind::Primary.span(shown);
    if let Some(label) = &diagnostic.label {
        annotation = annotation.label(label);
    }
    elements.push(snippet.annotation(annotation).into());
    for (place, label) in &diagnostic.related {
        let (shown, snippet) = excerpt(sources, *place);
        elements.push(snippet.annotation(AnnotationKind::Context.span(shown).label(label)).into());
    }
    elements
}

/// The lines of a span (only the first, when it covers many) and the span within them.
fn excerpt<'a, T: Clone>(sources: &'a SourceMap, span: Span) -> (Range<usize>, Snippet<'a, T>) {
    let file = sources.file(span.file);
    let (mut lines, first_line) = file.lines_around(span.start, span.start);
    let start = (span.start as usize).clamp(lines.start, lines.end);
    let end = (span.end as usize).clamp(start, lines.end);
    // Keep whole characters: spans come from parsers and lie on boundaries, cuts need not.
    let floor = |mut byte: usize| {
        while !file.text.is_char_boundary(byte) {
            byte -= 1;
        }
        byte
    };
    if lines.len() > MOST_SHOWN {
        let from = floor(start.saturating_sub(MOST_SHOWN / 2).max(lines.start));
        let to = floor((from + MOST_SHOWN).min(lines.end));
        lines = from..to;
    }
    let start = floor(start.clamp(lines.start, lines.end));
    let end = floor(end.clamp(start, lines.end));
    let snippet = Snippet::source(&file.text[lines.clone()])
        .line_start(first_line)
        .path(&file.name)
        .fold(false);
    (start - lines.start..end - lines.start, snippet)
}

fn backtrace(sources: &SourceMap, span: Span) -> Vec<String> {
    let mut steps: Vec<String> = sources
        .backtrace(span)
        .take(MOST_STEPS + 1)
        .map(|expansion| {
            let (file, position) = sources.locate(expansion.site());
            let place = format!("{file}:{}:{}", position.line, position.column);
            match expansion {
                Expansion::Macro { name, .. } => {
                    format!("in the macro `{name}`, called at {place}")
                }
                Expansion::Include { .. } => format!("included at {place}"),
            }
        })
        .collect();
    if steps.len() > MOST_STEPS {
        steps.truncate(MOST_STEPS);
        if let Some(last) = steps.last_mut() {
            let _ = write!(last, " (and further out)");
        }
    }
    steps
}

#[cfg(test)]
mod tests {
    use expect_test::{Expect, expect};

    use super::*;

    fn check(build: impl FnOnce(&mut SourceMap) -> Diagnostic, expected: Expect) {
        let mut sources = SourceMap::new();
        let diagnostic = build(&mut sources);
        expected.assert_eq(&render(&diagnostic, &sources, Style::Plain));
    }

    #[test]
    fn a_finding_shows_its_line_and_a_correction() {
        check(
            |sources| {
                let file =
                    sources.add("robot.urdf", "<robot>\n  <sphere raduis=\"1\"/>\n</robot>\n");
                let span = sources.whole(file).part(18, 24);
                Diagnostic::warning("unknown-attribute", "`sphere` has no attribute `raduis`")
                    .at(span)
                    .label("nobody reads this")
                    .did_you_mean(span, "raduis", ["radius", "length"])
            },
            expect![[r#"
                warning[unknown-attribute]: `sphere` has no attribute `raduis`
                 --> robot.urdf:2:11
                  |
                2 |   <sphere raduis="1"/>
                  |           ^^^^^^ nobody reads this
                  |
                help: did you mean `radius`?
                  |
                2 -   <sphere raduis="1"/>
                2 +   <sphere radius="1"/>
                  |
            "#]],
        );
    }

    #[test]
    fn a_finding_in_a_macro_shows_the_calls() {
        check(
            |sources| {
                let file = sources.add("a.xacro", "<macro>\n<call/>\n");
                let call = sources.whole(file).part(8, 15);
                let context = sources.expand(Expansion::Macro { name: "wheel".into(), call });
                Diagnostic::error("division-by-zero", "division by zero")
                    .at(sources.whole(file).part(1, 6).within(context))
                    .help("give the macro a radius other than 0")
            },
            expect![[r#"
                error[division-by-zero]: division by zero
                 --> a.xacro:1:2
                  |
                1 | <macro>
                  |  ^^^^^
                  |
                  = note: in the macro `wheel`, called at a.xacro:2:1
                  = help: give the macro a radius other than 0
            "#]],
        );
    }

    #[test]
    fn a_line_of_a_megabyte_is_cut() {
        let mut sources = SourceMap::new();
        let file = sources.add("long.xml", "x".repeat(1_000_000));
        let diagnostic =
            Diagnostic::error("long", "long").at(sources.whole(file).part(500_000, 500_003));
        assert!(render(&diagnostic, &sources, Style::Plain).len() < 1_000);
    }
}
