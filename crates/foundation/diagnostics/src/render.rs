//! Rendering of findings for a terminal.

use std::fmt::Write as _;
use std::ops::Range;

use annotate_snippets::renderer::DecorStyle;
use annotate_snippets::{AnnotationKind, Element, Group, Level, Patch, Renderer, Snippet};

use crate::source::{Expansion, SourceMap, Span};
use crate::{Diagnostic, Severity};

/// Maximum length of a piece of a line that is shown [bytes]; generated files may have lines of megabytes.
const MAX_LINE_BYTES: usize = 160;

/// Maximum distance of two locations in one snippet [lines].
const NEAR_LINES: usize = 8;

/// Maximum number of steps of a chain of macro calls that are shown.
const MAX_BACKTRACE_STEPS: usize = 6;

/// Output style.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RenderStyle {
    /// ASCII without colours: for files, pipes and tests.
    Plain,
    /// ANSI colours and box-drawing characters: for a terminal.
    Colour,
}

/// Renders one finding with the source text that it refers to.
#[must_use]
pub fn render(diagnostic: &Diagnostic, sources: &SourceMap, style: RenderStyle) -> String {
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
        let (lines, snippet) = excerpt(sources, replacement.span, replacement.span);
        let patch = Patch::new(lines.shown(replacement.span), &replacement.text);
        report
            .push(Level::HELP.secondary_title(&replacement.message).element(snippet.patch(patch)));
    }
    let renderer = match style {
        RenderStyle::Plain => Renderer::plain().decor_style(DecorStyle::Ascii),
        RenderStyle::Colour => Renderer::styled().decor_style(DecorStyle::Unicode),
    };
    let mut text = renderer.render(&report);
    text.push('\n');
    text
}

/// Marked text and related locations; those near it in the same snippet.
fn places<'a>(diagnostic: &'a Diagnostic, sources: &'a SourceMap, span: Span) -> Vec<Element<'a>> {
    let is_near = |place: &&(Span, String)| near(sources, span, place.0);
    let first = diagnostic.related.iter().filter(is_near).map(|(place, _)| place.start);
    let last = diagnostic.related.iter().filter(is_near).map(|(place, _)| place.end);
    let around = Span {
        start: first.fold(span.start, u32::min),
        end: last.fold(span.start, u32::max),
        ..span
    };
    let (lines, snippet) = excerpt(sources, span, around);
    let mut annotation = AnnotationKind::Primary.span(lines.shown(span));
    if let Some(label) = &diagnostic.label {
        annotation = annotation.label(label);
    }
    let mut snippet = snippet.annotation(annotation);
    for (place, label) in diagnostic.related.iter().filter(is_near) {
        let annotation = AnnotationKind::Context.span(lines.shown(*place)).label(label);
        snippet = snippet.annotation(annotation);
    }
    let mut elements = vec![snippet.into()];
    for (place, label) in diagnostic.related.iter().filter(|place| !is_near(place)) {
        let (lines, snippet) = excerpt(sources, *place, *place);
        let annotation = AnnotationKind::Context.span(lines.shown(*place)).label(label);
        elements.push(snippet.annotation(annotation).into());
    }
    elements
}

/// Returns true if two locations are near enough for one snippet.
fn near(sources: &SourceMap, span: Span, other: Span) -> bool {
    let file = sources.file(span.file);
    let lines = file.position(span.start).line.abs_diff(file.position(other.start).line);
    span.file == other.file && lines <= NEAR_LINES && span.start.abs_diff(other.end) < 2_000
}

/// Piece of a text that is shown.
struct Shown<'a> {
    text: &'a str,
    bytes: Range<usize>,
}

impl Shown<'_> {
    /// Range of a span in the piece; of a span over many lines only the first line.
    fn shown(&self, span: Span) -> Range<usize> {
        let start = floor(self.text, (span.start as usize).clamp(self.bytes.start, self.bytes.end));
        let end = floor(self.text, (span.end as usize).clamp(start, self.bytes.end));
        let line = self.text[start..end].find('\n').map_or(end, |newline| start + newline);
        start - self.bytes.start..line - self.bytes.start
    }
}

/// Lines of the `around` spans; of long lines only a piece around the span.
fn excerpt<'a, T: Clone>(
    sources: &'a SourceMap,
    span: Span,
    around: Span,
) -> (Shown<'a>, Snippet<'a, T>) {
    let file = sources.file(span.file);
    let text: &str = &file.text;
    let last = if around == span { span.start } else { around.end };
    let (mut lines, mut first_line) = file.lines_around(around.start, last);
    let longest = text[lines.clone()].lines().map(str::len).max().unwrap_or(0);
    if longest > MAX_LINE_BYTES {
        (lines, first_line) = file.lines_around(span.start, span.start);
        let start = (span.start as usize).clamp(lines.start, lines.end);
        let from = floor(text, start.saturating_sub(MAX_LINE_BYTES / 2).max(lines.start));
        lines = from..floor(text, (from + MAX_LINE_BYTES).min(lines.end));
    }
    let snippet =
        Snippet::source(&text[lines.clone()]).line_start(first_line).path(&file.name).fold(true);
    (Shown { text, bytes: lines }, snippet)
}

/// Start of the character that contains a byte.
fn floor(text: &str, mut byte: usize) -> usize {
    while !text.is_char_boundary(byte) {
        byte -= 1;
    }
    byte
}

fn backtrace(sources: &SourceMap, span: Span) -> Vec<String> {
    let mut steps: Vec<String> = sources
        .backtrace(span)
        .take(MAX_BACKTRACE_STEPS + 1)
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
    if steps.len() > MAX_BACKTRACE_STEPS {
        steps.truncate(MAX_BACKTRACE_STEPS);
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
        expected.assert_eq(&render(&diagnostic, &sources, RenderStyle::Plain));
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
                    .label("this is ignored")
                    .did_you_mean(span, "raduis", ["radius", "length"])
            },
            expect![[r#"
                warning[unknown-attribute]: `sphere` has no attribute `raduis`
                 --> robot.urdf:2:11
                  |
                2 |   <sphere raduis="1"/>
                  |           ^^^^^^ this is ignored
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
        assert!(render(&diagnostic, &sources, RenderStyle::Plain).len() < 1_000);
    }
}
