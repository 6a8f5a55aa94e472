//! `data_files` of a `setup.py`: files that the build of a Python package installs into the share folder.
//!
//! Nothing is executed. Texts joined by `+`, `os.path.join` or an f-string are read as one path, and a
//! variable among them is assumed to be the name of the package, which is nearly always right.

use std::path::{Path, PathBuf};

/// Maximum nesting depth of brackets.
const MAX_DEPTH: usize = 16;

/// Source of one entry: a file, or a pattern whose files are installed into the same folder.
struct Source {
    folder: PathBuf,
    /// Name of the only file; `None` for a pattern.
    name: Option<String>,
}

/// Paths in the package's sources from which the build may install a file.
pub(crate) fn sources(text: &str, installed: &Path) -> Vec<PathBuf> {
    let (Some(name), Some(folder)) = (installed.file_name(), installed.parent()) else {
        return Vec::new();
    };
    let mut found = Vec::new();
    for (to, sources) in entries(text) {
        for source in sources.iter().filter(|_| to == folder) {
            if source.name.as_deref().is_none_or(|own| name == own) {
                found.push(source.folder.join(name));
            }
        }
    }
    found
}

/// Folders in the package's share folder, with the sources installed there.
fn entries(text: &str) -> Vec<(PathBuf, Vec<Source>)> {
    let without_comments: Vec<&str> =
        text.lines().map(|line| line.split('#').next().unwrap_or_default()).collect();
    let text = without_comments.join("\n");
    let Some((_, list)) = text.split_once("data_files") else { return Vec::new() };
    let Some(list) = bracketed(list, '[', ']') else { return Vec::new() };
    let tuples = split(list).into_iter().filter_map(|entry| {
        let inner = bracketed(entry, '(', ')').filter(|_| entry.trim().starts_with('('))?;
        let parts = split(inner);
        let [to, sources, ..] = parts.as_slice() else { return None };
        let to = joined(to);
        let mut folders = to.split('/').filter(|part| !part.is_empty());
        // `share/PACKAGE/...`.
        let _ = folders.next().filter(|first| *first == "share").and(folders.next())?;
        Some((folders.collect(), listed(sources)))
    });
    tuples.collect()
}

/// Sources of an entry: a list of paths, or patterns in calls of `glob`.
fn listed(expression: &str) -> Vec<Source> {
    let mut sources = Vec::new();
    for term in expression.split('+').filter(|term| !term.trim().is_empty()) {
        let is_list = term.trim().starts_with('[');
        let elements = match bracketed(term, '[', ']').filter(|_| is_list) {
            Some(list) => split(list),
            None => vec![term],
        };
        for element in elements {
            let call = element.trim();
            let is_glob = call.starts_with("glob");
            let path = match bracketed(call, '(', ')').filter(|_| is_glob) {
                // Further arguments, such as `recursive=True`, are not part of the pattern.
                Some(inner) => joined(split(inner).first().copied().unwrap_or_default()),
                None => joined(call),
            };
            sources.extend(source(Path::new(&path), is_glob));
        }
    }
    sources
}

fn source(path: &Path, is_glob: bool) -> Option<Source> {
    let folder = path.parent()?.to_path_buf();
    let has_wildcard = folder.to_string_lossy().contains(['*', '?', '[']);
    let is_inside = path.is_relative() && !path.components().any(|part| part.as_os_str() == "..");
    if has_wildcard || !is_inside {
        return None;
    }
    let name = path.file_name()?.to_str()?.to_owned();
    Some(Source { folder, name: (!is_glob).then_some(name) })
}

/// Texts of an expression as one path.
fn joined(expression: &str) -> String {
    let mut parts: Vec<String> = Vec::new();
    let mut rest = expression;
    while let Some(letter) = rest.chars().next() {
        if matches!(letter, '\'' | '"') {
            let inner = &rest[1..];
            let end = inner.find(letter).unwrap_or(inner.len());
            let mut literal = &inner[..end];
            let mut text = String::new();
            // Placeholder of an f-string.
            while let Some((before, (_, after))) = literal
                .split_once('{')
                .and_then(|(before, after)| Some((before, after.split_once('}')?)))
            {
                text.push_str(before);
                text.push_str("PACKAGE");
                literal = after;
            }
            parts.push(text + literal);
            rest = inner.get(end + 1..).unwrap_or_default();
        } else if letter.is_alphabetic() || letter == '_' {
            let end =
                rest.find(|letter: char| !(letter.is_alphanumeric() || "_.".contains(letter)));
            let word = &rest[..end.unwrap_or(rest.len())];
            let after = &rest[word.len()..];
            let is_prefix = after.starts_with(['\'', '"']);
            if !is_prefix && !after.trim_start().starts_with('(') {
                parts.push("PACKAGE".into());
            }
            rest = after;
        } else {
            rest = &rest[letter.len_utf8()..];
        }
    }
    let whole = parts.join("/");
    let parts: Vec<&str> =
        whole.split('/').filter(|part| !part.is_empty() && *part != ".").collect();
    parts.join("/")
}

/// Content of the first pair of brackets of a type.
fn bracketed(text: &str, open: char, close: char) -> Option<&str> {
    let start = text.find(open)? + open.len_utf8();
    let mut depth = 1usize;
    for (at, letter) in outside_texts(&text[start..]) {
        if letter == open {
            depth += 1;
        } else if letter == close {
            depth -= 1;
        }
        if depth == 0 {
            return Some(&text[start..start + at]);
        }
        if depth > MAX_DEPTH {
            return None;
        }
    }
    None
}

/// Parts between commas outside of brackets.
fn split(text: &str) -> Vec<&str> {
    let mut parts = Vec::new();
    let (mut start, mut depth) = (0, 0usize);
    for (at, letter) in outside_texts(text) {
        match letter {
            '(' | '[' | '{' => depth += 1,
            ')' | ']' | '}' => depth = depth.saturating_sub(1),
            ',' if depth == 0 => {
                parts.push(&text[start..at]);
                start = at + 1;
            }
            _ => {}
        }
    }
    parts.push(&text[start..]);
    parts.retain(|part| !part.trim().is_empty());
    parts
}

/// Characters of an expression outside of quotes, with their positions.
fn outside_texts(text: &str) -> impl Iterator<Item = (usize, char)> {
    let mut quote = None;
    text.char_indices().filter(move |(_, letter)| match quote {
        Some(open) => {
            if *letter == open {
                quote = None;
            }
            false
        }
        None if matches!(letter, '\'' | '"') => {
            quote = Some(*letter);
            false
        }
        None => true,
    })
}

#[cfg(test)]
mod tests {
    use std::path::{Path, PathBuf};

    use super::sources;

    const SETUP: &str = "
import os
from glob import glob
package_name = 'bot'
setup(
    name=package_name,  # data of [no] interest, ('share/bot', ['x'])
    data_files=[
        ('share/ament_index/resource_index/packages', ['resource/' + package_name]),
        ('share/' + package_name, ['package.xml', 'top/own.yaml']),
        (os.path.join('share', package_name, 'launch'), glob('bringup/launch/*.launch.py')),
        (os.path.join('share', package_name, 'config'),
         glob(os.path.join('params', '*.yaml')) + ['extra/b.yaml']),
        (f'share/{package_name}/worlds/small', glob('sim/worlds/*[.world|.sdf]', recursive=True)),
        ('lib/bot', ['tool/run.py']),
        ('share/bot/away', ['../../etc/passwd', glob('any/*/x.txt')]),
    ],
)";

    #[test]
    fn installed_paths_lead_to_sources() {
        let check = |installed: &str, wanted: &[&str]| {
            let wanted: Vec<PathBuf> = wanted.iter().map(PathBuf::from).collect();
            assert_eq!(sources(SETUP, Path::new(installed)), wanted, "{installed}");
        };
        check("launch/a.launch.py", &["bringup/launch/a.launch.py"]);
        check("config/b.yaml", &["params/b.yaml", "extra/b.yaml"]);
        check("config/c.yaml", &["params/c.yaml"]);
        check("worlds/small/w.sdf", &["sim/worlds/w.sdf"]);
        check("own.yaml", &["top/own.yaml"]);
        check("other.yaml", &[]);
        check("run.py", &[]);
        check("away/passwd", &[]);
        check("away/x.txt", &[]);
    }

    #[test]
    fn broken_files_give_nothing() {
        for text in
            ["", "data_files", "data_files=[(", "data_files=[('share/a', ['b", "data_files=[()]"]
        {
            assert!(sources(text, Path::new("a/b")).is_empty(), "{text}");
        }
        let deep = format!("data_files={}", "[".repeat(100_000));
        assert!(sources(&deep, Path::new("a")).is_empty());
    }
}
