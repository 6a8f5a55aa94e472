//! HTML of a report.

use std::fmt::Write as _;

/// Part of a report.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Section {
    pub(super) title: String,
    /// HTML, with everything from the recording escaped.
    pub(super) body: String,
}

/// Escapes text for elements and attributes.
pub(super) fn escape(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for character in text.chars() {
        match character {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            '\'' => out.push_str("&#39;"),
            // Control characters are not allowed in HTML.
            other if other.is_control() && other != '\n' && other != '\t' => out.push('\u{fffd}'),
            other => out.push(other),
        }
    }
    out
}

/// Returns a paragraph of plain text.
pub(super) fn paragraph(text: &str) -> String {
    format!("<p>{}</p>\n", escape(text))
}

/// Returns a table whose first column names the rows. Wide tables scroll by themselves, also by keyboard.
pub(super) fn table(caption: &str, head: &[&str], rows: &str) -> String {
    let caption = escape(caption);
    let mut out = format!(
        "<div class=\"scroll\" role=\"region\" tabindex=\"0\" aria-label=\"{caption}\"><table>\
         <caption>{caption}</caption>\n"
    );
    if !head.is_empty() {
        out.push_str("<thead><tr>");
        for name in head {
            let _ = write!(out, "<th scope=\"col\">{}</th>", escape(name));
        }
        out.push_str("</tr></thead>\n");
    }
    let _ = write!(out, "<tbody>\n{rows}</tbody></table></div>\n");
    out
}

/// Returns a complete document.
pub(super) fn document(title: &str, sections: &[Section]) -> String {
    let title = escape(title);
    let mut out = format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
         <meta name=\"color-scheme\" content=\"light dark\">\n<title>{title}</title>\n\
         <style>\n{STYLE}</style>\n</head>\n<body>\n<main>\n<h1>{title}</h1>\n"
    );
    if sections.len() > 3 {
        out.push_str("<nav aria-label=\"Contents\"><ul>\n");
        for (index, section) in sections.iter().enumerate() {
            let _ = writeln!(out, "<li><a href=\"#s{index}\">{}</a></li>", escape(&section.title));
        }
        out.push_str("</ul></nav>\n");
    }
    for (index, section) in sections.iter().enumerate() {
        let _ = write!(
            out,
            "<section aria-labelledby=\"s{index}\">\n<h2 id=\"s{index}\">{}</h2>\n{}</section>\n",
            escape(&section.title),
            section.body
        );
    }
    let _ = write!(
        out,
        "</main>\n<footer><p>Written by Periplus {}.</p></footer>\n</body>\n</html>\n",
        env!("CARGO_PKG_VERSION")
    );
    out
}

/// Colours have a contrast of at least 4.5:1 for text and 3:1 for lines, in both schemes.
const STYLE: &str = "\
:root { color-scheme: light dark; --back: #ffffff; --text: #1b1f24; --quiet: #57606a; --line: #d0d7de;
  --link: #0b57d0; --s0: #0b57d0; --s1: #b35900; --s2: #1a7f37; --bad: #b3261e; --warn: #8a5a00; }
@media (prefers-color-scheme: dark) { :root { --back: #14171b; --text: #e6e9ed; --quiet: #9aa4af; --line: #3a424b;
  --link: #8ab4f8; --s0: #8ab4f8; --s1: #ffa657; --s2: #5fd07a; --bad: #ff8a80; --warn: #f2c14e; }
  image.map { filter: invert(0.92) hue-rotate(180deg); } }
* { box-sizing: border-box; }
body { margin: 0; background: var(--back); color: var(--text);
  font: 16px/1.5 system-ui, -apple-system, 'Segoe UI', Roboto, sans-serif; }
main, footer { max-width: 72rem; margin: 0 auto; padding: 0 1rem; }
h1 { font-size: 1.6rem; line-height: 1.25; overflow-wrap: anywhere; }
h2 { font-size: 1.2rem; margin: 2rem 0 0.5rem; padding-top: 0.5rem; border-top: 1px solid var(--line); }
h3 { font-size: 1rem; margin: 1rem 0 0.25rem; }
a { color: var(--link); }
a:focus-visible, summary:focus-visible, .scroll:focus-visible { outline: 2px solid var(--link); outline-offset: 2px; }
nav ul { display: flex; flex-wrap: wrap; gap: 0.25rem 1rem; padding: 0; list-style: none; }
nav a { display: inline-block; padding: 0.25rem 0; }
.scroll { overflow-x: auto; }
table { border-collapse: collapse; font-variant-numeric: tabular-nums; }
caption { text-align: left; color: var(--quiet); padding: 0.25rem 0; }
th, td { text-align: left; vertical-align: top; padding: 0.25rem 0.75rem 0.25rem 0; border-bottom: 1px solid var(--line); }
th { font-weight: 600; }
td, tbody th { overflow-wrap: anywhere; }
summary { padding: 0.5rem 0; cursor: pointer; }
td.error, td.warning { white-space: nowrap; }
td.number, th.number { text-align: right; white-space: nowrap; }
.facts th { min-width: 9rem; }
.quiet, figcaption { color: var(--quiet); }
.error { color: var(--bad); font-weight: 600; }
.warning { color: var(--warn); font-weight: 600; }
.figures { display: grid; grid-template-columns: repeat(auto-fit, minmax(min(100%, 26rem), 1fr)); gap: 1rem; }
figure { margin: 0.5rem 0; }
figure svg { display: block; width: 100%; height: auto; }
figure svg.floor { max-height: 80vh; }
svg text { fill: var(--text); font: 13px system-ui, sans-serif; }
svg .axis { stroke: var(--line); }
svg .curve { fill: none; stroke-width: 1.5; stroke-linejoin: round; vector-effect: non-scaling-stroke; }
svg .path { fill: none; stroke-width: 2; stroke-linejoin: round; vector-effect: non-scaling-stroke; }
.s0 { stroke: var(--s0); } .s1 { stroke: var(--s1); } .s2 { stroke: var(--s2); }
.dash { stroke-dasharray: 6 4; }
.f0 { fill: var(--s0); } .f1 { fill: var(--s1); } .f2 { fill: var(--s2); } .f3 { fill: var(--bad); }
image { image-rendering: pixelated; }
.key { display: inline-block; width: 1.5rem; height: 0.6rem; margin-right: 0.35rem; vertical-align: baseline; }
.legend { display: flex; flex-wrap: wrap; gap: 0.25rem 1rem; padding: 0; margin: 0.25rem 0; list-style: none; }
footer { color: var(--quiet); margin-top: 2rem; }
@media print { :root { --back: #fff; --text: #000; --quiet: #444; --line: #bbb; --link: #000; --s0: #0b57d0; --s1: #b35900;
  --s2: #1a7f37; --bad: #b3261e; --warn: #8a5a00; }
  image.map { filter: none; } nav { display: none; } .scroll { overflow: visible; }
  figure, tr { break-inside: avoid; } h2 { break-after: avoid; } }
";

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn everything_from_a_recording_is_escaped() {
        assert_eq!(escape("<b a='1'>&\"\u{1}"), "&lt;b a=&#39;1&#39;&gt;&amp;&quot;\u{fffd}");
        let section = Section { title: "<script>".into(), body: paragraph("</p><script>") };
        let html = document("<script>", &[section]);
        assert!(!html.contains("<script>") && html.contains("&lt;script&gt;"));
    }
}
