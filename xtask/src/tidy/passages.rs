//! Passages of prose in the files of the tree.

use super::prose::{Part, Passage, Source, atoms};
use super::rust::Kind;
use super::source::{File, Rust};
use super::viewer;

/// Fewest words of a string literal that is taken for a message.
const MESSAGE_MIN_WORD_COUNT: usize = 3;

/// All prose of a file that is not Rust.
pub(crate) fn of_text(file: &File) -> Vec<Passage> {
    let text = &file.text;
    if file.path.ends_with(".md") {
        let mut passage = Passage::new(Source::Page);
        passage.push(text, 0..text.len());
        vec![passage]
    } else if file.path.ends_with(".svelte") || file.path.ends_with(".ts") {
        viewer::passages(file)
    } else {
        description(text).into_iter().collect()
    }
}

/// Description of a package in its manifest.
fn description(manifest: &str) -> Option<Passage> {
    let key = "\ndescription = \"";
    let start = manifest.find(key)? + key.len();
    let len = manifest[start..].find('"')?;
    let mut passage = Passage::new(Source::Manifest);
    passage.push(manifest, start..start + len);
    Some(passage)
}

/// All prose of a Rust file.
pub(crate) fn of_rust(rust: &Rust) -> Vec<Passage> {
    let mut passages = Vec::new();
    let mut at = 0;
    while at < rust.tokens.len() {
        let token = &rust.tokens[at];
        let (passage, next) = match token.kind {
            Kind::LineDoc { .. } | Kind::LineComment => line_comments(rust, at),
            Kind::BlockDoc | Kind::BlockComment => {
                let source = comment_source(rust, at);
                (whole(rust, at, source), at + 1)
            }
            Kind::Text { is_raw } if is_doc_attribute(rust, at) => {
                (literal(rust, at, comment_source(rust, at), is_raw), at + 1)
            }
            Kind::Text { is_raw } if is_clap_text(rust, at) => {
                (literal(rust, at, Source::Help, is_raw), at + 1)
            }
            Kind::Text { is_raw } if !rust.is_test[at] => {
                let passage = literal(rust, at, Source::Message, is_raw);
                let is_message = is_message(&passage);
                passages.extend(is_message.then_some(passage));
                at += 1;
                continue;
            }
            _ => {
                at += 1;
                continue;
            }
        };
        passages.push(passage);
        at = next;
    }
    passages
}

fn comment_source(rust: &Rust, at: usize) -> Source {
    match rust.tokens[at].kind {
        Kind::LineComment | Kind::BlockComment => Source::Comment,
        _ if rust.is_help[at] => Source::Help,
        _ => Source::Doc,
    }
}

/// Comment lines of one kind below each other as one passage, and the index after them.
fn line_comments(rust: &Rust, start: usize) -> (Passage, usize) {
    let file = &rust.file.text;
    let mut passage = Passage::new(comment_source(rust, start));
    let mut at = start;
    loop {
        let token = &rust.tokens[at];
        passage.push(file, token.range.clone());
        passage.push_text("\n", token.range.end);
        let Some(next) = rust.tokens.get(at + 1) else { return (passage, at + 1) };
        let between = &file[token.range.end..next.range.start];
        if next.kind != token.kind || between.matches('\n').count() != 1 {
            return (passage, at + 1);
        }
        at += 1;
    }
}

fn whole(rust: &Rust, at: usize, source: Source) -> Passage {
    let mut passage = Passage::new(source);
    // Lines of a block comment may start with `*`.
    let range = rust.tokens[at].range.clone();
    let mut offset = range.start;
    for line in rust.file.text[range].split_inclusive('\n') {
        let trimmed = line.trim_start();
        let skipped = if trimmed.starts_with('*') { line.len() - trimmed.len() + 1 } else { 0 };
        passage.push(&rust.file.text, offset + skipped..offset + line.len());
        offset += line.len();
    }
    passage
}

/// Text of a string literal, escapes resolved.
fn literal(rust: &Rust, at: usize, source: Source, is_raw: bool) -> Passage {
    let (file, range) = (&rust.file.text, rust.tokens[at].range.clone());
    let mut passage = Passage::new(source);
    if is_raw {
        passage.push(file, range);
        return passage;
    }
    let mut start = range.start;
    while let Some(len) = file[start..range.end].find('\\') {
        let escape = start + len;
        passage.push(file, start..escape);
        let tail = &file[escape + 1..range.end];
        let (text, skipped) = match tail.chars().next() {
            Some('n') => ("\n", 1),
            Some('t') => ("\t", 1),
            Some('"') => ("\"", 1),
            Some('\n') => ("", tail.len() - tail.trim_start().len()),
            Some('u') => ("", tail.find('}').map_or(1, |len| len + 1)),
            Some('x') => ("", tail.len().min(3)),
            Some(other) => ("", other.len_utf8()),
            None => ("", 0),
        };
        passage.push_text(text, escape);
        start = escape + 1 + skipped;
    }
    passage.push(file, start..range.end);
    passage
}

/// True for `#[doc = "..."]`.
fn is_doc_attribute(rust: &Rust, at: usize) -> bool {
    at >= 4
        && rust.is_punct(at - 1, b'=')
        && rust.is_ident(at - 2, "doc")
        && rust.is_punct(at - 3, b'[')
}

/// True for `help = "..."`, `about = "..."` and the like in attributes of clap.
fn is_clap_text(rust: &Rust, at: usize) -> bool {
    let names = ["help", "long_help", "about", "long_about", "after_help", "before_help"];
    at >= 2 && rust.is_punct(at - 1, b'=') && names.iter().any(|name| rust.is_ident(at - 2, name))
}

/// True for sentences; names, keys and embedded code are none.
fn is_message(passage: &Passage) -> bool {
    let text = passage.text.trim_start();
    if text.starts_with('<') && text.contains('\n') {
        return false;
    }
    let atoms = atoms(passage);
    atoms.iter().filter(|atom| atom.part == Part::Word).count() >= MESSAGE_MIN_WORD_COUNT
}

#[cfg(test)]
mod tests {
    use super::super::source::made_up;
    use super::*;

    #[track_caller]
    fn check(path: &str, text: &str, expected: &[(Source, &str)]) {
        let file = made_up(path, text);
        let passages =
            if path.ends_with(".rs") { of_rust(&Rust::new(&file)) } else { of_text(&file) };
        let found: Vec<_> =
            passages.iter().map(|passage| (passage.source, passage.text.trim())).collect();
        assert_eq!(found, expected);
    }

    #[test]
    fn comments_below_each_other_are_one_passage() {
        check(
            "a/src/lib.rs",
            "//! A\n//! b\n\n/// C\n/// d\nfn c() {} // E\n// f\n\n/* G\n * h */\n#[doc = \"I\"]",
            &[
                (Source::Doc, "A\n b"),
                (Source::Doc, "C\n d"),
                (Source::Comment, "E\n f"),
                (Source::Comment, "G\n h"),
                (Source::Doc, "I"),
            ],
        );
    }

    #[test]
    fn messages_are_sentences_outside_tests() {
        check(
            "a/src/lib.rs",
            "f(\"no map here\\n\\u{e9} \\\n   so {x}\"); f(\"map_server\"); #[cfg(test)] fn t() { f(\"no map here\") }",
            &[(Source::Message, "no map here\n so {x}")],
        );
    }

    #[test]
    fn texts_of_clap_are_help() {
        check(
            "a/src/lib.rs",
            "#[arg(help = \"Map\")] finding.help(\"name the map\")",
            &[(Source::Help, "Map"), (Source::Message, "name the map")],
        );
    }

    #[test]
    fn manifests_and_pages() {
        let manifest = "[package]\nname = \"a\"\ndescription = \"Maps\"\n";
        check("a/Cargo.toml", manifest, &[(Source::Manifest, "Maps")]);
        check("a.md", "# A", &[(Source::Page, "# A")]);
    }

    #[test]
    fn positions_survive_escapes() {
        let text = "f(\"one two\\n\\\n   three {x}\")";
        let file = made_up("a/src/lib.rs", text);
        let passages = of_rust(&Rust::new(&file));
        let at = passages[0].text.find("three").expect("the word");
        assert_eq!(passages[0].offset_in_file(at), text.find("three").expect("the word"));
    }
}
