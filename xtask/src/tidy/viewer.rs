//! Prose of the viewer: comments and strings of TypeScript, visible texts of Svelte.

use std::ops::Range;

use super::prose::{Passage, Source};
use super::source::File;

/// Passages of a file of the viewer.
pub(crate) fn passages(file: &File) -> Vec<Passage> {
    let text = &file.text;
    let mut found = Found { file: text, passages: Vec::new() };
    if file.path.ends_with(".ts") {
        found.script(0..text.len());
    } else {
        found.component();
    }
    found.passages
}

struct Found<'a> {
    file: &'a str,
    passages: Vec<Passage>,
}

impl Found<'_> {
    fn push(&mut self, range: Range<usize>) {
        // A label of one word is a name, not a sentence.
        if self.file[range.clone()].trim().contains(' ') {
            let mut passage = Passage::new(Source::Viewer);
            passage.push(self.file, range);
            self.passages.push(passage);
        }
    }

    /// Comments and strings of a script.
    fn script(&mut self, range: Range<usize>) {
        let bytes = self.file.as_bytes();
        let mut at = range.start;
        while at < range.end {
            let rest = &self.file.as_bytes()[at..range.end];
            if rest.starts_with(b"//") {
                let len = rest.iter().position(|&byte| byte == b'\n').unwrap_or(rest.len());
                self.push(at + 2..at + len);
                at += len;
            } else if rest.starts_with(b"/*") {
                let end = self.file[at..range.end].find("*/").map_or(range.end, |len| at + len);
                self.block_comment(at + 2..end);
                at = end + 2;
            } else if matches!(rest[0], b'"' | b'\'') {
                let end = string_end(bytes, at, range.end);
                self.push(at + 1..end);
                at = end + 1;
            } else if rest[0] == b'`' {
                at = self.template(at, range.end);
            } else {
                at += 1;
            }
        }
    }

    fn block_comment(&mut self, range: Range<usize>) {
        let mut passage = Passage::new(Source::Viewer);
        let mut offset = range.start;
        for line in self.file[range].split_inclusive('\n') {
            let trimmed = line.trim_start();
            let skipped = if trimmed.starts_with('*') { line.len() - trimmed.len() + 1 } else { 0 };
            passage.push(self.file, offset + skipped..offset + line.len());
            offset += line.len();
        }
        self.passages.push(passage);
    }

    /// Template string; its expressions are scripts. Returns the offset after it.
    fn template(&mut self, start: usize, limit: usize) -> usize {
        let bytes = self.file.as_bytes();
        let mut passage = Passage::new(Source::Viewer);
        let (mut at, mut from) = (start + 1, start + 1);
        while at < limit && bytes[at] != b'`' {
            if bytes[at] == b'\\' {
                at += 2;
            } else if bytes[at..limit].starts_with(b"${") {
                passage.push(self.file, from..at);
                passage.push_text("`x`", at);
                let end = braces_end(bytes, at + 1, limit);
                self.script(at + 2..end.saturating_sub(1).max(at + 2).min(limit));
                (at, from) = (end, end);
            } else {
                at += 1;
            }
        }
        let end = at.min(limit);
        passage.push(self.file, from.min(end)..end);
        if passage.text.trim().contains(' ') {
            self.passages.push(passage);
        }
        at + 1
    }

    /// Scripts, texts between tags and texts of attributes.
    fn component(&mut self) {
        let (file, bytes) = (self.file, self.file.as_bytes());
        let (mut at, mut text_from, mut in_tag) = (0, 0, false);
        while at < bytes.len() {
            match bytes[at] {
                b'{' => {
                    if !in_tag {
                        self.push(text_from..at);
                    }
                    let end = braces_end(bytes, at, bytes.len());
                    self.script(at + 1..end.saturating_sub(1).max(at + 1));
                    (at, text_from) = (end, end);
                }
                b'<' if !in_tag => {
                    self.push(text_from..at);
                    let hidden = ["script", "style"];
                    let name = hidden.iter().find(|name| file[at + 1..].starts_with(*name));
                    if let Some(name) = name {
                        let start = file[at..].find('>').map_or(bytes.len(), |len| at + len + 1);
                        let close = format!("</{name}>");
                        let end = file[start..].find(&close).map_or(bytes.len(), |len| start + len);
                        if *name == "script" {
                            self.script(start..end);
                        }
                        at = (end + close.len()).min(bytes.len());
                        text_from = at;
                    } else if file[at..].starts_with("<!--") {
                        let end = file[at..].find("-->").map_or(bytes.len(), |len| at + len);
                        self.push(at + 4..end.max(at + 4));
                        at = (end + 3).min(bytes.len());
                        text_from = at;
                    } else {
                        in_tag = true;
                        at += 1;
                    }
                }
                b'>' if in_tag => {
                    in_tag = false;
                    at += 1;
                    text_from = at;
                }
                b'"' | b'\'' if in_tag => {
                    let quote = bytes[at];
                    let len = bytes[at + 1..].iter().position(|&byte| byte == quote);
                    let end = len.map_or(bytes.len(), |len| at + 1 + len);
                    self.push(at + 1..end);
                    at = end + 1;
                }
                _ => at += 1,
            }
        }
        if !in_tag && text_from < bytes.len() {
            self.push(text_from..bytes.len());
        }
    }
}

/// Offset of the quote that ends a string, at the latest the end of its line.
fn string_end(bytes: &[u8], start: usize, limit: usize) -> usize {
    let mut at = start + 1;
    while at < limit && bytes[at] != bytes[start] && bytes[at] != b'\n' {
        at += if bytes[at] == b'\\' { 2 } else { 1 };
    }
    at.min(limit)
}

/// Offset after the brace that closes the one at `open`; strings may have braces.
fn braces_end(bytes: &[u8], open: usize, limit: usize) -> usize {
    let (mut depth, mut at) = (0, open);
    while at < limit {
        match bytes[at] {
            b'{' => depth += 1,
            b'}' => {
                depth -= 1;
                if depth == 0 {
                    return at + 1;
                }
            }
            b'"' | b'\'' => at = string_end(bytes, at, limit),
            _ => {}
        }
        at += 1;
    }
    limit
}

#[cfg(test)]
mod tests {
    use super::super::source::made_up;
    use super::*;

    #[track_caller]
    fn check(path: &str, text: &str, expected: &[&str]) {
        let file = made_up(path, text);
        let passages = passages(&file);
        let found: Vec<_> = passages.iter().map(|passage| passage.text.trim()).collect();
        assert_eq!(found, expected);
    }

    #[test]
    fn scripts() {
        check(
            "viewer/src/a.ts",
            "// a b\nconst c = 'd e' + \"f\\\" g\"; /** h\n * i */ `j ${k('l m', {})} n`",
            &["a b", "d e", "f\\\" g", "h\n i", "l m", "j `x` n"],
        );
    }

    #[test]
    fn components() {
        check(
            "viewer/src/a.svelte",
            "<script lang=\"ts\">let a = 'b c';</script>\n<p title=\"d e\" onclick={() => f('g h')}>i j {k} l m</p>\
             <style>n o</style><!-- p q -->",
            &["b c", "d e", "g h", "i j", "l m", "p q"],
        );
    }

    #[test]
    fn unclosed_ends_with_the_text() {
        for text in [
            "`a ${b c",
            "'a b",
            "<p title=\"a b",
            "{a 'b c",
            "<script>a",
            "<!-- a b",
            "/* a b",
            "'a\\",
        ] {
            check_runs("viewer/src/a.ts", text);
            check_runs("viewer/src/a.svelte", text);
        }
    }

    fn check_runs(path: &str, text: &str) {
        passages(&made_up(path, text));
    }
}
